"""Enclosures: balls, blocks, the ground and flights between impacts."""

import math
import subprocess
import sys
from fractions import Fraction

import numpy as np
import pytest

from topheavy import Column, FixedMassColumn, MonolithicPortal, Pulse, Record, RockingFrame
from topheavy.ground.shapes import ENDING
from topheavy.proven import BlockBox
from topheavy.proven.balls import Undecided, arb, bounds, exact, hull, power, precision, root
from topheavy.proven.blocks import Balls, enclosed
from topheavy.proven.flight import Box, Law, Step, step
from topheavy.proven.forcing import prepared


def test_float_stands_for_the_decimal_that_it_is_printed_as():
    with precision(200):
        assert (exact(0.1) - arb(1) / 10).contains(0)
        assert exact(0.1).rad() < arb(2) ** -190


@pytest.mark.parametrize("number", ["0.1", "-0.1", "0.7", "3.3", "-2.7"])
def test_bounds_are_not_inside_the_ball(number):
    with precision(200):  # in 53 bits the ball's own ends are floats already
        low, high = bounds(arb(number))
    assert Fraction(low) < Fraction(number) < Fraction(high)


def test_ball_that_is_no_number_has_no_bounds():
    with pytest.raises(Undecided, match="enclosure"):
        bounds(arb(-1).sqrt())


@pytest.mark.parametrize("sign", [1, -1])
def test_root_is_enclosed_to_the_last_digits_even_near_a_zero_of_the_slope(sign):
    found = root(
        lambda x: sign * (power(x, 3) - exact(1e-6)), lambda x: sign * 3 * x * x, arb(-1), arb(1)
    )
    assert found.contains(exact(0.01))
    assert found.rad() < 1e-9


@pytest.mark.parametrize("ends", [(0.0, "middle"), ("middle", 7.0)])
def test_root_is_the_one_between_the_ends_where_a_ball_of_them_has_two(ends):
    gap = arb(2) ** -40  # of two zeros; a ball's radius has 30 bits
    low, high = (1 + gap / 2 if end == "middle" else arb(end) for end in ends)
    found = root(lambda x: (x - 1) * (x - 1 - gap), lambda x: 2 * x - 2 - gap, low, high)
    assert (found.contains(1), found.contains(1 + gap)) == (high < 2, low > 0)


def test_ends_of_one_sign_are_undecided():
    with pytest.raises(Undecided, match="root"):
        root(lambda x: x * x - 2, lambda x: 2 * x, arb(-3), arb(3))


def run(code):
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)


def test_library_imports_no_flint_until_something_is_proven():
    assert run("import sys, topheavy; sys.exit('flint' in sys.modules)").returncode == 0


COLUMN = Column(0.5, 3.0)
STRUCTURES = [
    COLUMN,
    *(RockingFrame(COLUMN, gamma) for gamma in (0.0, 0.25, 1.0, math.inf)),
    *(FixedMassColumn(COLUMN, gamma, 0.4, 0.7) for gamma in (0.0, 1.0, math.inf)),
    MonolithicPortal(COLUMN, 1.0, 4.0, 0.7, 0.2),
]


@pytest.mark.parametrize("structure", STRUCTURES, ids=repr)
def test_balls_are_those_of_the_floats_to_rounding(structure):
    with precision(136):
        balls, block = enclosed(structure, linearised=False), structure.block()
        for name in ("slenderness", "frequency_parameter", "restitution"):
            ball, number = getattr(balls, name), getattr(block, name)
            assert ball.rad() < 1e-35
            assert abs(float(ball) - number) < 4e-16 * abs(number)


def test_slenderness_is_that_of_the_dimensions_and_not_a_float():
    with precision(136):
        for structure in (COLUMN, RockingFrame(COLUMN, 1.0), FixedMassColumn(COLUMN, 0.0)):
            balls = enclosed(structure, linearised=False)
            assert (balls.slenderness.tan() - arb(1) / 6).contains(0)
            assert not balls.slenderness.contains(exact(COLUMN.slenderness))
            assert not balls.frequency_parameter.contains(exact(COLUMN.frequency_parameter))


def test_box_contains_its_blocks():
    balls = enclosed(BlockBox((1.0, 1.1), 0.2, (0.8, 0.9)), linearised=False)
    assert all(balls.frequency_parameter.contains(exact(x)) for x in (1.0, 1.05, 1.1))
    assert all(balls.restitution.contains(exact(x)) for x in (0.8, 0.9))


def test_box_of_no_blocks_is_refused():
    with pytest.raises(ValueError, match=r"restitution is \(0.9, 0.8\); expected the lower"):
        BlockBox(1.0, 0.2, (0.9, 0.8))
    with pytest.raises(ValueError, match=r"restitution is 1\.2"):
        BlockBox(1.0, 0.2, (0.9, 1.2))


SHAPES = pytest.mark.parametrize("shape", ENDING)
RECORD = Record(0.02, [0.01, 0.05, -0.3, 0.2, 0.0])


@SHAPES
def test_values_are_those_of_the_pulse(shape):
    pulse = Pulse(shape, 0.7, 3.0)
    forcing = prepared(pulse)
    (piece,) = forcing.pieces
    assert abs(float(piece.stop) - 3.0 * pulse.duration) < 1e-14
    for time in np.linspace(0.0, pulse.duration, 31):
        value = float(forcing.value(piece, exact(3.0) * exact(time)))
        assert value == pytest.approx(pulse.excitation(time), abs=1e-14)


@SHAPES
def test_series_has_all_its_terms(shape):
    """Its sum at a distance is the value there: a series cut short is off by a finite amount."""
    with precision(200):
        forcing = prepared(Pulse(shape, 0.7, 3.0))
        (piece,) = forcing.pieces
        for sigma in (arb("0.1"), arb("1.3"), piece.stop / 2):
            terms = forcing.series(piece, sigma, 60)
            step = arb("0.6")
            total = sum((x * power(step, k) for k, x in enumerate(terms)), arb(0))
            assert abs(total - forcing.value(piece, sigma + step)) < 1e-25


def test_range_contains_all_samples_on_the_way_and_the_rest_behind_the_end():
    forcing = prepared(RECORD)
    inside = forcing.range(1, arb("1.5"), arb("2.5"))
    assert inside.contains(exact(-0.3))
    assert not inside.contains(exact(0.2))
    assert prepared(Record(0.02, [0.1, 0.2, 0.3])).range(0, arb("0.5"), arb(2)).contains(0)
    behind = prepared(Pulse("constant", 0.4, 1.0)).range(0, arb(3), arb(4))
    assert behind.contains(0)
    assert behind.contains(exact(0.4))


ALPHA, PUSH = arb("0.3"), arb("-0.5")
BLOCK = Balls(ALPHA, arb(1), arb("0.9"), True)
LAW = Law(BLOCK, arb("1.21"))
EXACT = Law(Balls(ALPHA, arb(1), arb("0.9"), False), arb("1.21"))


def made(law, phi, rate, order, h, zeros=0):
    push = [PUSH] + [arb(0)] * (order - 1)
    return step(law, law.series(phi, rate, push, order), (push, push), h, zeros)


def closed_form(phi, rate, time):
    """φ and φ' of the linearised block under a constant push: κ = 1.1, about α + s a."""
    kappa, centre = arb("1.1"), ALPHA + PUSH
    hyperbolic_sine, hyperbolic_cosine = (kappa * time).sinh_cosh()
    off = phi - centre
    return (
        centre + off * hyperbolic_cosine + rate / kappa * hyperbolic_sine,
        off * kappa * hyperbolic_sine + rate * hyperbolic_cosine,
    )


@pytest.mark.parametrize("order", [3, 4, 6, 12])
@pytest.mark.parametrize("time", ["0.1", "0.35", "0.5"])
def test_step_contains_the_closed_form_whatever_its_order(order, time):
    """At a low order only the remainder makes it so."""
    phi, rate = arb("0.05"), arb("0.1")
    found = made(LAW, phi, rate, order, 0.5).at(arb(time))
    for ball, true in zip(found, closed_form(phi, rate, arb(time)), strict=True):
        assert ball.overlaps(true)
        assert ball.rad() < 10 * 0.6**order


@pytest.mark.parametrize("law", [LAW, EXACT], ids=["linearised", "exact"])
def test_step_of_low_order_contains_that_of_high_order(law):
    for order in (3, 4, 5, 8):
        low, high = (made(law, arb("0.05"), arb("0.1"), n, 0.5) for n in (order, 26))
        for time in (arb("0.2"), arb("0.5")):
            pairs = [
                *zip(low.at(time), high.at(time), strict=True),
                (low.gain(time), high.gain(time)),
            ]
            assert all(wide.overlaps(narrow) for wide, narrow in pairs)


@pytest.mark.parametrize("law", [LAW, EXACT], ids=["linearised", "exact"])
def test_energy_under_a_changing_push_is_gained_by_its_power(law):
    """φ'²/2 + κ² (Φ + s a ψ) changes by ∫ κ² s a' ψ alone."""
    order, h = 20, 0.4
    push = [PUSH, arb("0.7")] + [arb(0)] * (order - 2)
    over = [PUSH + arb("0.7") * hull(0, h), *push[1:]]
    start = law.series(arb("0.05"), arb("0.1"), push, order)
    one = step(law, start, (push, over), h, 0)
    phi, rate = one.at(arb(h))
    before = law.potential(arb("0.05"), PUSH) + arb("0.1") * arb("0.1") / 2
    after = law.potential(phi, PUSH + arb("0.7") * arb(h)) + rate * rate / 2
    assert abs(after - before - one.gain(arb(h))) < 1e-13
    assert one.gain(arb(h)) > 1e-4


def polynomial(*coefficients, h=1.0, zeros=0):
    box = Box(hull(-10, 10), hull(-10, 10), hull(-10, 10))
    return Step(h, [arb(x) for x in coefficients], [arb(0)], box, zeros)


def test_impact_is_the_first_root_and_its_ball_holds_those_of_all_motions():
    found = polynomial("0.25", "-1.25", 1).impact()  # (t − 1/4)(t − 1)
    assert found.contains(arb("0.25"))
    assert found < 0.26
    for thick in (hull("0.24", "0.26"), hull("0.2", "0.3")):  # roots of c − t
        impact = polynomial(thick, -1, 0).impact()
        assert impact.contains(thick)


def test_graze_and_impact_at_the_end_are_undecided():
    with pytest.raises(Undecided, match="graze"):
        polynomial("0.25", -1, 1).impact()
    with pytest.raises(Undecided, match="end"):
        polynomial(arb(1, 1e-9), -1, 0).impact()
    with pytest.raises(Undecided, match="start"):
        polynomial(arb(0, 1e-9), 1, 0).impact()


def test_remainder_of_the_quotient_by_time_is_not_differentiated_as_one_ball():
    """ρ = R(t) t³ with R in [−1, 1]: t² sin(1/t)-like remainders are steeper than 2 R t."""
    slope = polynomial(0, 1, 0, arb(0, 1), zeros=1).slope
    assert slope(arb(1)).contains(4)  # 3 R' − R for R' = 1, R = −1
