"""Bounds without impacts: they hold every motion that the solver follows, and know u's jumps."""

import math
from itertools import product

import numpy as np
import pytest

from topheavy import Column, Pulse, judge, simulate
from topheavy.proven.balls import Undecided, arb, hull, precision, within
from topheavy.proven.blocks import enclosed
from topheavy.proven.bounds import SIDES, START, Bounded
from topheavy.proven.flight import Law
from topheavy.proven.forcing import prepared

COLUMN = Column(0.5, 3.0)
OMEGA = 2.0 * math.pi / 1.5
PULSE = Pulse("one-cosine", 1.0, OMEGA)
LEVEL = COLUMN.uplift_acceleration


@pytest.fixture(autouse=True)
def balls():
    with precision(72):
        yield


def bounded(factor, linearised=False):
    block, forcing = enclosed(COLUMN, linearised), prepared(PULSE)
    kappa = forcing.scale(block.frequency_parameter)
    return Bounded(Law(block, kappa * kappa), forcing, forcing.pieces[0], within(factor))


@pytest.mark.parametrize("linearised", [False, True])
def test_bound_from_rest_holds_the_motions_of_a_box(linearised):
    low, high = 1.05 * LEVEL, 1.0505 * LEVEL
    of = bounded((low, high), linearised)
    block = COLUMN.block().linear() if linearised else COLUMN.block()
    steps = list(of.carried(of.start(arb(0), 0, arb(0), arb(0))))[:-1]  # samples end with it
    times = np.array([float(step.sigma) for step in steps]) / OMEGA
    for factor in np.linspace(low, high, 5):
        one = bounded(float(factor), linearised)
        found = simulate(block, PULSE.scaled(factor), duration=1.5, samples=[0.0, *times])
        closest = 0.0
        for step, phi, rate in zip(steps, found.rotation[1:], found.velocity[1:], strict=True):
            side = 1 if phi > 0.0 else -1
            wall = step.walls[SIDES.index(side)]
            state = one.start(step.sigma, side, arb(abs(phi)), arb(rate / OMEGA))
            assert abs(phi) <= wall * (1.0 + 1e-9)
            assert state.energy / START <= step.energy + 1e-10
            closest = max(closest, abs(phi) / wall)
        assert closest > 0.5  # the first flight, which is all that is known of it


def test_bound_of_a_box_of_states_holds_its_corners():
    ends = [(0.8, 1.2), (0.01, 0.02), (-0.03, 0.03), (0.2, 0.3)]  # σ, φ, φ', factor
    sigma, phi, rate, _ = (hull(*map(str, pair)) for pair in ends)
    for side in SIDES:
        start = bounded(ends[-1]).start(sigma, side, phi, rate)
        for *state, factor in product(*ends):
            one = bounded(factor).start(arb(state[0]), side, *map(arb, state[1:]))
            assert one.energy <= start.energy * 1.001
            assert max(one.walls) <= max(start.walls)


def test_energy_behind_the_pulse_has_its_last_jump():
    of, phi, rate = bounded(0.25), 0.05, 0.01
    end = of.piece.stop
    for side, gain in ((-1, 0.25), (1, 0.0)):  # a ends at +0.25 g, which pushed the side −1
        bound = of.start(end, side, arb(phi), arb(rate))
        free = arb(rate) ** 2 / 2 + of.law.potential(arb(phi), arb(0))
        behind = of.energy_behind(bound)
        assert behind > free
        lever = of.law.square * of.law.lever(arb(START * phi))
        assert float(behind) == pytest.approx(float(bound.energy + gain * lever), rel=1e-6)


def test_amplitude_that_overturns_is_not_bounded():
    assert judge(COLUMN, PULSE.scaled(0.28)).overturned
    of = bounded(0.28)
    with pytest.raises(Undecided, match="bound"):
        list(of.carried(of.start(arb(0), 0, arb(0), arb(0))))
