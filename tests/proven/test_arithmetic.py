"""The interval arithmetic of the checker: functions, series, steps and places of sign changes."""

from dataclasses import replace
from fractions import Fraction
from itertools import pairwise, product
from types import SimpleNamespace

import mpmath
import numpy as np
import pytest

from topheavy import Pulse
from topheavy.ground.shapes import FINITE_SHAPES, SHAPES
from topheavy.proven.checking import Check, NotProven, intervals
from topheavy.proven.checking.bounds import SIDES, Bound
from topheavy.proven.checking.intervals import Interval, arctangent, cosine, dot, enclose, sine
from topheavy.proven.checking.model import Block, Ground
from topheavy.proven.checking.taylor_model import TaylorModel

BITS = 112


@pytest.fixture(autouse=True)
def precision():
    intervals.precision(BITS)
    with mpmath.workdps(60):
        yield


def holds(interval, true):
    """Return whether an interval holds a number of mpmath, and not much else."""
    scaled = true * intervals.UNIT
    return interval.low <= scaled <= interval.high


@pytest.mark.parametrize("number", [-3, -1, 0, 1, 4, 30])
@pytest.mark.parametrize("width", [0, 7])
def test_functions_of_intervals_hold_those_of_the_numbers_inside(number, width):
    x = Fraction(number) + Fraction(1, 3)
    interval = enclose(x).hull(enclose(x + Fraction(width, 100)))
    pairs = [(sine, mpmath.sin), (cosine, mpmath.cos)]
    if number >= 0:
        pairs += [(arctangent, mpmath.atan), (intervals.exponential, lambda y: mpmath.exp(-y))]
    for mine, true in pairs:
        for k in range(width + 1):
            y = x + Fraction(k, 100)
            assert holds(mine(interval), true(mpmath.mpf(y.numerator) / y.denominator))
        assert width or mine(interval).high - mine(interval).low < 2**12


def test_arithmetic_of_intervals_is_rounded_outward():
    intervals.precision(8)
    third, seventh = enclose(Fraction(1, 3)), enclose(Fraction(-1, 7))
    for interval, true in (
        (third, Fraction(1, 3)),
        (third * seventh, Fraction(-1, 21)),
        (third / seventh, Fraction(-7, 3)),
        (third / -3, Fraction(-1, 9)),
        (third - seventh, Fraction(10, 21)),
        ((third * third).root(), Fraction(1, 3)),
        (Interval(-5, 3).size(), Fraction(5, 256)),
    ):
        assert Fraction(interval.low, 256) <= true <= Fraction(interval.high, 256)
        assert interval.high - interval.low < 40


def test_sum_of_products_has_the_ends_of_its_corners_whatever_their_signs():
    intervals.precision(0)
    spans = [Interval(a, b) for a in range(-2, 3) for b in range(a, 3)]
    for x, y in product(spans, spans):
        corners = [p * q for p in (x.low, x.high) for q in (y.low, y.high)]
        for interval in (x * y, dot([x, enclose(1), enclose(9)], [y, enclose(0)])):
            assert (interval.low, interval.high) == (min(corners), max(corners))


def ground(shape, amplitude="0.7", factor=("1", "1")):
    wave, halves = SHAPES[shape].wave, int(SHAPES[shape].half_periods)
    pulse = {"wave": wave, "half_periods": halves, "amplitude": amplitude, "angular_frequency": "3"}
    return Ground(pulse, factor, enclose(4))


@pytest.mark.parametrize("shape", FINITE_SHAPES)
def test_ground_is_that_of_the_pulse_and_its_series_has_all_terms(shape):
    """A sum at a distance is the value there: a series cut short is off by a finite amount."""
    pulse, mine = Pulse(shape, 0.7, 3.0), ground(shape)
    assert holds(mine.pi, +mpmath.pi)
    assert mine.stop.low / intervals.UNIT == pytest.approx(3.0 * pulse.duration, rel=1e-15)
    for time in np.linspace(0.0, pulse.duration, 501):
        value = mine.at(enclose(Fraction(3.0 * time)))
        assert value.low / intervals.UNIT == pytest.approx(pulse.excitation(time), abs=1e-14)
        assert value < mine.largest
        assert -1 * value < mine.largest
    for start in (Fraction(1, 10), Fraction(13, 10)):
        terms = mine.series(enclose(start), enclose(Fraction(6, 10)), 60)
        total = sum(terms, enclose(0)) - mine.at(enclose(start + Fraction(6, 10)))
        assert total.size().high < 2**20


@pytest.mark.parametrize("shape", FINITE_SHAPES)
def test_ground_over_a_span_holds_all_its_values(shape):
    mine = ground(shape, "-0.7", ("0.5", "1.5"))
    span = enclose(1).hull(enclose(Fraction(14, 10)))
    over = mine.series(span, enclose(1), 3)
    for k, factor in product(range(5), ("0.5", "1", "1.5")):
        inside = ground(shape, "-0.7", (factor, factor))
        terms = inside.series(enclose(1 + Fraction(k, 10)), enclose(1), 3)
        assert all(x.inside(y) for x, y in zip(terms, over, strict=True))


PUSH, KAPPA = Fraction(-1, 2), Fraction(11, 10)
NUMBERS = {"kind": "block", "slenderness": "0.3", "frequency_parameter": "1", "restitution": "0.9"}


def course(phi, rate, order, *, linearised=True, h=Fraction(1, 2), side=1):
    """A step under a constant push, of a block with α = 0.3 and κ = 1.1."""
    block = Block(NUMBERS, linearised)
    pulse = {"wave": "constant", "half_periods": 1, "angular_frequency": "1"}
    pulse |= {"amplitude": str(side * PUSH)}
    state = SimpleNamespace(block=block, order=order, side=side, sigma=enclose(0), zero_order=0)
    state.phi, state.rate = enclose(Fraction(phi)), enclose(Fraction(rate))
    state.ground = Ground(pulse, ("1", "1"), enclose(KAPPA * KAPPA))
    return TaylorModel(state, h)


def closed_form(phi, rate, time):
    """φ and φ' of the linearised block about α + s a, by hyperbolic functions."""
    kappa, centre = mpmath.mpf("1.1"), mpmath.mpf("-0.2")
    off, turn = mpmath.mpf(phi) - centre, kappa * mpmath.mpf(time)
    sinh, cosh = mpmath.sinh(turn), mpmath.cosh(turn)
    rate = mpmath.mpf(rate)
    return centre + off * cosh + rate / kappa * sinh, off * kappa * sinh + rate * cosh


@pytest.mark.parametrize("order", [4, 6, 12])
@pytest.mark.parametrize("time", ["0.1", "0.35", "0.5"])
def test_step_holds_the_closed_form_whatever_its_order(order, time):
    """At a low order only the remainder makes it so."""
    enclosures = course("0.05", "0.1", order).at(enclose(Fraction(time) * 2))
    for interval, true in zip(enclosures, closed_form("0.05", "0.1", time), strict=True):
        assert holds(interval, true)
        assert interval.high - interval.low < 10 * 0.6**order * intervals.UNIT


@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("linearised", [True, False])
def test_step_of_low_order_meets_that_of_high_order_and_stays_in_its_box(linearised, side):
    high = course("0.05", "0.1", 26, linearised=linearised, side=side)
    for order in (4, 5, 8):
        low = course("0.05", "0.1", order, linearised=linearised, side=side)
        for tau in (enclose(Fraction(2, 5)), enclose(1)):
            for one, other in zip(low.at(tau), high.at(tau), strict=True):
                one.common(other)
            assert high.at(tau)[0].inside(low.box)


def test_box_of_a_long_step_holds_the_motion():
    """The first box that is tried does not."""
    box = course("0.29", "0", 12, h=Fraction(1)).box
    assert all(holds(box, closed_form("0.29", "0", time)[0]) for time in ("0", "0.7", "1"))


def test_wall_that_the_energy_reaches_in_the_step_is_refused():
    """A velocity of 0.0447 over 0.01 of the phase, almost without restoring."""
    block = Block(NUMBERS, linearised=True)
    zero, energy = enclose(0), enclose(Fraction(1, 1000))
    bound = Bound(block, ground("one-sine"), zero, energy, (zero, zero))
    far, near = (enclose(Fraction(share, 10**6)) for share in (470, 430))
    assert bound.stepped(enclose(Fraction(1, 100)), (far, far)).walls == (far, far)
    for walls in ((near, far), (far, near)):
        with pytest.raises(NotProven, match="a wall may be passed"):
            bound.stepped(enclose(Fraction(1, 100)), walls)
    beyond = Fraction(22, 100), Fraction(23, 100)  # a = 0.15 g: V is 0.0050 at 0.15, 0.0006 at 0.29
    bound = replace(bound, sigma=enclose(beyond[0]), walls=(enclose(0), enclose(Fraction(29, 100))))
    with pytest.raises(NotProven, match="a wall may be passed"):
        bound.stepped(enclose(beyond[1]), (far, enclose(Fraction(15, 100))))


@pytest.mark.parametrize("side", SIDES)
def test_bound_on_a_state_has_its_rotation_on_its_side_and_none_on_the_other(side):
    state = enclose(Fraction(1, 10)), enclose(Fraction(1, 100))
    bound = Bound.of_state(Block(NUMBERS, True), ground("one-sine"), enclose(1), side, state)
    walls = dict(zip(SIDES, bound.walls, strict=True))
    assert (walls[side].high, walls[-side].high) == (state[0].high, 0)


@pytest.mark.parametrize(("amplitude", "survives"), [("0.1", False), ("0.0001", True)])
def test_bound_counts_the_jump_at_the_end_of_the_pulse(amplitude, survives):
    """A one-cosine ends at its peak: the energy 0.0195 becomes 0.0284, beyond a barrier of 0.02."""
    wall, energy = enclose(Fraction(2, 10)), enclose(Fraction(195, 10**4))
    block, shaking = Block(NUMBERS, linearised=True), ground("one-cosine", amplitude)
    bound = Bound(block, shaking, enclose(7), energy, (wall, wall))
    assert bound.survives() is survives


@pytest.mark.parametrize("linearised", [False, True])
def test_free_motion_is_judged_by_its_energy(linearised):
    """On either side of the barrier, at rest near it or inward, and not where both are possible."""
    check = Check.__new__(Check)
    check.block, check.ground = Block(NUMBERS, linearised), ground("one-sine")
    check.bound, check.side, check.is_over, check.impacts = None, 1, True, 0
    near = [("0.299999", "0"), ("0.299999", "0.0001"), ("0.300001", "0"), ("0.300001", "-0.0001")]
    for (phi, rate), ends in zip(
        [*near, ("0.1", "-0.15"), ("0.1", "-0.25")], "soosso", strict=True
    ):
        check.result, check.phi, check.rate = "", enclose(Fraction(phi)), enclose(Fraction(rate))
        assert check.end()[0] == ends
    for phi, rate in (("0.3", "0"), ("0.1", "-0.1646")):  # an equilibrium; a rebound to the barrier
        check.result, check.phi, rates = "", enclose(Fraction(phi)), Fraction(rate)
        check.rate = enclose(rates - Fraction(1, 1000)).hull(enclose(rates + Fraction(1, 1000)))
        with pytest.raises(NotProven, match="too near the barrier"):
            check.end()


@pytest.mark.parametrize("start", ["0.2", "1.5", "3.5", "4.6", "6"])
def test_push_over_a_step_and_what_it_gains_are_bounded(start):
    first, h = Fraction(start), Fraction(1, 4)  # the ground's acceleration turns at π/2 and 3π/2
    bound = Bound(None, ground("one-sine"), enclose(first), enclose(0), (enclose(0), enclose(0)))
    _, grounds, rises = bound.pushes(enclose(first + h))
    values = [bound.ground.at(enclose(first + h * k / 40)).middle for k in range(41)]
    for side, over, rise in zip(SIDES, grounds, rises, strict=True):
        pushes = [side * value for value in values]
        assert over.low <= min(pushes) <= max(pushes) <= over.high
        assert sum(max(0, y - x) for x, y in pairwise(pushes)) <= max(0, rise.high)


def test_remainder_of_the_quotient_by_time_is_not_differentiated_as_one_interval():
    """ρ = R(τ) τ³ with R in [−1, 1]: τ² sin(1/τ)-like remainders are steeper than 2 R τ."""
    step = TaylorModel.__new__(TaylorModel)
    step.phi = [enclose(0), enclose(1), enclose(0), enclose(-1).hull(1)]
    slope = step.quotient(1)[1]
    assert slope[-1].high >= 4 * intervals.UNIT  # 3 R' − R for R' = 1, R = −1
    step.phi = [enclose(k) for k in (0, 2, 3, 5, 7)]
    quotient, slope = step.quotient(1)  # 2 + 3 τ + 5 τ² + 7 τ³
    assert [x.middle for x in quotient] == [enclose(k).middle for k in (2, 3, 5, 7)]
    assert [x.middle for x in slope] == [enclose(k).middle for k in (3, 10, 21)]
