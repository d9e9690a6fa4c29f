"""A step of a flight against closed forms, and the signs that it must not guess."""

import pytest

from topheavy.proven.balls import Undecided, arb, hull
from topheavy.proven.blocks import Balls
from topheavy.proven.flight import Box, Law, Step, step

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
