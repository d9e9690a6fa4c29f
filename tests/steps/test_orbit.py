"""The steady rocking: that of the solvers, proven where it attracts, and not where it does not."""

import math
from dataclasses import replace

import numpy as np
import pytest

from steps.orbit.jets import Jet
from steps.orbit.shaken import Harmonic
from steps.orbit.steady import COARSE, FINE, contraction, settles, steady_rocking
from topheavy import Column, Pulse, RockingFrame, simulate
from topheavy.ground.shaking_table import abrupt_start, table_motion
from topheavy.proven.balls import Undecided, arb, arb_mat, hull, precision
from topheavy.second import reference

FRAME, MOTION = RockingFrame(Column(0.11, 0.40), 0.434), table_motion(0.005, 3.3)
OMEGA, LAST = MOTION.angular_frequency, 30.0
PUSHED = abrupt_start(FRAME, 0.005, 3.3)  # rad/s, to the negative side
START = math.pi, abs(PUSHED) / OMEGA


@pytest.fixture(scope="module")
def steady():
    return steady_rocking(FRAME, MOTION, START)


@pytest.mark.parametrize("solver", [simulate, reference.simulate])
def test_solvers_come_to_the_steady_rocking(steady, solver):
    time = np.linspace(LAST - 2.0, LAST, 4001)
    found = solver(FRAME, MOTION, velocity=PUSHED, duration=LAST, samples=time)
    phases = np.mod(OMEGA * found.impacts[-6:], math.pi)
    low, high = steady.phase
    assert np.all((low - 1e-7 < phases) & (phases < high + 1e-7))
    assert np.diff(OMEGA * found.impacts[-6:]) == pytest.approx([math.pi] * 5, abs=1e-7)
    assert np.abs(found.rotation).max() == pytest.approx(steady.peak[0], rel=1e-5)
    assert steady.peak[1] - steady.peak[0] < 1e-10
    behind = solver(
        FRAME, MOTION, velocity=PUSHED, duration=LAST, samples=found.impacts[-1:] + 1e-7
    )
    assert abs(behind.velocity[0]) / OMEGA == pytest.approx(steady.velocity[0], abs=1e-7)


def test_area_of_starts_shrinks_by_the_square_of_restitution(steady):
    """A flight keeps dσ dE, an impact takes (√r)² of E: det = √r · v/|w|, (√r)² when steady."""
    with precision(136):
        slope = steady.shaken.flight(steady.centre, FINE)[1]
        assert abs(slope.det() - steady.shaken.block.restitution**2) < 1e-10


def test_derivative_of_a_flight_is_that_of_differences(steady):
    with precision(136):
        start, step = steady.centre + arb_mat(2, 1, [0.4, 0.003]), arb("1e-9")
        slope = steady.shaken.flight(start, FINE)[1]
        for k, off in enumerate(([step, 0], [0, step])):
            ends = [
                steady.shaken.lands(start + s * arb_mat(2, 1, off), (136, 1e-28)) for s in (1, -1)
            ]
            change = [(ends[0].sigma - ends[1].sigma), (ends[0].rate - ends[1].rate)]
            for j in (0, 1):
                assert abs(change[j] / (2 * step) - slope[j, k]) < 1e-5


def test_every_tried_start_of_the_disk_comes_closer_by_the_factor(steady):
    random, back = np.random.default_rng(1), steady.frame.inv()
    with precision(72):
        for _ in range(20):
            turn, share = random.uniform(0.0, 6.3), random.uniform(0.0, 1.0)
            off = [steady.radius * share * x for x in (math.cos(turn), math.sin(turn))]
            image = steady.shaken.flight(steady.centre + steady.frame * arb_mat(2, 1, off), FINE)[0]
            near = back * (image - steady.centre)
            assert math.hypot(*map(float, near.entries())) < steady.contraction * math.hypot(*off)


def test_disk_in_which_starts_may_part_is_refused(steady):
    """At the rim of a larger disk the norm exceeds 1, and at its centre it does not."""
    with precision(72):
        rim = steady.centre + steady.frame * arb_mat(2, 1, [0.3, 0.0])
        slope = steady.frame.inv() * steady.shaken.flight(rim, COARSE)[1] * steady.frame
        assert np.linalg.norm(np.array(slope.mid().tolist(), float), 2) > 1.0
        assert contraction(steady.shaken, steady.centre, steady.frame, 0.3) == 1


def test_start_that_is_not_known_well_enough_is_not_said_to_reach_the_disk(steady):
    with precision(72):
        for wide, reaches in ((1e-3, True), (0.04, False)):
            around = arb_mat(2, 1, [hull(-wide, wide), 0])
            march = steady.shaken.lands(steady.centre + around, (72, 1e-13))
            assert steady.attracts(march) is reaches


@pytest.mark.parametrize(
    ("start", "ends"),
    [
        ((0, 0.3, 0.1), "steady"),
        ((1, -0.2, 0.0), "steady"),
        ((3, 0.2, 0.0), "steady"),
        ((0, 0.3, 0.0), "rests"),
        ((0, 0.6, 0.4), "overturns"),
        ((1, 1.0, -0.9), "overturns"),
    ],
)
def test_starts_end_as_by_the_solver(steady, start, ends):
    quarters, rotation, velocity = start
    assert settles(steady, *start) == ends
    if quarters == 0:
        alpha, p = FRAME.slenderness, FRAME.frequency_parameter
        state = {"rotation": rotation * alpha, "velocity": velocity * alpha * p}
        found = simulate(FRAME, MOTION, **state, duration=24.0, samples=2)
        names = {"rocking": "steady", "rests": "rests", "overturned": "overturns"}
        assert names[found.outcome] == ends


def test_there_is_none_without_forcing_enough_or_without_loss():
    weak = Pulse("harmonic", 0.2 * MOTION.amplitude, OMEGA)
    with pytest.raises(Undecided, match="rests"):
        steady_rocking(FRAME, weak, START)
    with pytest.raises(Undecided):
        steady_rocking(FRAME.block().with_restitution(1.0), MOTION, START)


def test_bad_harmonic_is_named(steady):
    with pytest.raises(ValueError, match="expected 'harmonic'"):
        steady_rocking(FRAME, Pulse("one-sine", 0.2, OMEGA), START)
    lifts = replace(steady.shaken, forcing=Harmonic(Pulse("harmonic", 0.28, OMEGA)))
    with pytest.raises(ValueError, match="uplifts a block at rest"):
        settles(replace(steady, shaken=lifts), 0, 0.1, 0.0)


def test_jets_have_the_derivatives_of_the_function():
    x, y = Jet(arb("0.3"), (arb(1), arb(0))), Jet(arb("0.7"), (arb(0), arb(1)))
    sine, cosine = (2 * x * y - 1).sin_cos()
    found = (3 - sine * x) / 2 + cosine
    a, b = 0.3, 0.7
    s, c = math.sin(2 * a * b - 1), math.cos(2 * a * b - 1)
    assert float(found.value) == pytest.approx((3 - s * a) / 2 + c)
    slopes = (-(2 * b * c * a + s) / 2 - 2 * b * s, -(2 * a * c * a) / 2 - 2 * a * s)
    assert [float(z) for z in found.slopes] == pytest.approx(slopes)
