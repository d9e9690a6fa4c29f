"""Bounces that die out: bounds against bounces that are followed one by one."""

import math

import pytest

from topheavy import Pulse
from topheavy.proven.balls import arb
from topheavy.proven.blocks import Balls
from topheavy.proven.flight import Law
from topheavy.proven.forcing import prepared
from topheavy.proven.rest import dies_out

ROOT = 0.9


def asked(push, rate, root=ROOT, linearised=True):
    """Of a block with α = 0.25 under a constant push, in a clock with κ = 1."""
    law = Law(Balls(arb("0.25"), arb(1), arb(root), linearised), arb(1))
    return dies_out(law, prepared(Pulse("constant", push, 1.0)), arb(1), 0, arb("0.5"), arb(rate))


@pytest.mark.parametrize("push", [0.0, 0.05, 0.15])
def test_all_bounces_end_before_the_bound_and_stay_below_it(push):
    rate = 1e-3
    until, highest = asked(push, rate)
    time, speed, top, side = 0.5, rate, 0.0, -1
    for _ in range(500):  # φ'' = φ − α − s a, in closed form
        side = -side
        depth = 0.25 + side * push
        time += 2.0 * math.atanh(speed / depth)
        top = max(top, depth - math.sqrt(depth**2 - speed**2))
        speed *= ROOT
    assert time < until
    assert top < highest
    assert until < 0.5 + 8.0 * (time - 0.5)


@pytest.mark.parametrize("linearised", [False, True])
def test_bounces_under_more_than_the_uplift_or_without_loss_are_not_said_to_end(linearised):
    assert asked(0.1, 1e-3, linearised=linearised) is not None
    assert asked(0.26, 1e-3, linearised=linearised) is None
    assert asked(0.1, 1e-3, root=1.0, linearised=linearised) is None
    assert asked(0.1, 0.2, linearised=linearised) is None
