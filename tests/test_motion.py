"""The life of a motion, apart from how a flight is computed: launch, rest by proof, its ends."""

import math

import numpy as np
import pytest

import topheavy
from topheavy import Pulse, Record, RockingBlock
from topheavy.free_rocking import barrier, energy, quarter_period
from topheavy.linear import simulate_linear_exact
from topheavy.motion import MOST_FREE_IMPACTS, Event, force, start
from topheavy.reference import simulate

BLOCK = RockingBlock(2.0, 0.25, 0.9)
BOTH = pytest.mark.parametrize("block", [BLOCK, BLOCK.linear()], ids=["exact", "linear"])


def small_speed(block: RockingBlock, peak: float) -> float:
    """Speed at θ = 0 that reaches a rotation of `peak` α."""
    return block.frequency_parameter * math.sqrt(2 * energy(block, peak * block.slenderness, 0.0))


@pytest.fixture
def count_all(monkeypatch):
    """Count every impact, however small the rotation that it ends."""
    monkeypatch.setattr("topheavy.motion.COUNTED_PEAK", -1.0)


def test_impact_is_counted_only_if_it_ends_a_rotation_of_a_millionth_of_alpha():
    small, large = (simulate(BLOCK, velocity=small_speed(BLOCK, x)) for x in (0.9e-6, 1.1e-6))
    assert (len(small.impacts), len(large.impacts)) == (0, 1)


@pytest.mark.parametrize("value", ["2.0", True, np.array([1.0, 2.0]), np.ma.masked, 0.0, math.nan])
@pytest.mark.parametrize("route", [simulate, topheavy.simulate, simulate_linear_exact])
def test_every_route_refuses_a_duration_that_is_no_positive_number(route, value):
    with pytest.raises(ValueError, match=r"^duration is .*; expected (a|more)"):
        route(BLOCK.linear(), Pulse("one-sine", 0.5, 5.0), duration=value)


# ---------------------------------------------------------------------------- rest


@BOTH
def test_block_rests_at_the_first_impact_whose_bounce_is_negligible(block):
    response = simulate(block, velocity=small_speed(block, 1.5e-5), samples=2)
    # each bounce peaks 0.81 times as high: 1.5e-5 · 0.81¹³ is the first below 1e-6
    assert response.outcome == "rests"
    assert len(response.impacts) == 13


@pytest.mark.usefixtures("count_all")
@BOTH
def test_bounces_are_followed_while_the_ground_may_lift_the_block_before_they_die(block):
    # Negligible bounces under way, and the ground about to exceed the threshold: no rest. The
    # same block on ground that stays below half of what is left rests at its first impact.
    speed = small_speed(block, 0.9e-6)
    step = 2e-3
    first = 2 * quarter_period(block, 0.9e-6 * block.slenderness)[0]
    assert first < 1.1 * step
    beyond = 1.5 * block.uplift_acceleration
    strong = Record(step, np.array([0.0, 0.0, 0.0, beyond, beyond, 0.0]))
    quiet = strong.scaled(0.3 / 1.5)
    shaken = simulate(block, strong, velocity=speed, samples=2)
    still = simulate(block, quiet, velocity=speed, samples=2)
    assert still.outcome == "rests"
    assert len(still.impacts) == 1
    # on resting ground each bounce lasts 0.9 times as long as the one before it
    before = shaken.impacts[shaken.impacts < 2 * step]
    expected = first * np.cumsum([1.0, 0.9, 0.81])
    np.testing.assert_allclose(before, expected, rtol=1e-5)


@pytest.mark.usefixtures("count_all")
def test_threshold_far_ahead_lets_the_block_rest_until_it_is_reached():
    speed = small_speed(BLOCK, 0.9e-6)
    late = Record(0.5, np.array([0.0, 0.0, 2.0, 0.0]) * BLOCK.uplift_acceleration)
    alone = simulate(BLOCK, late, samples=np.linspace(0.0, 1.5, 31))
    bounced = simulate(BLOCK, late, velocity=speed, samples=alone.time)
    assert bounced.impacts[0] < 0.5
    assert np.any(alone.rotation != 0.0)
    # to the last bit the motion of a block that had been at rest
    np.testing.assert_array_equal(bounced.rotation[1:], alone.rotation[1:])


def test_ground_that_is_over_does_not_keep_the_block_from_resting():
    # Had the rise at the start gone on, it would be beyond the threshold when the bounces die.
    block = BLOCK.with_restitution(0.3)
    nudge = Record(0.05, np.array([0.0, 0.05, *np.zeros(30)]))
    shaken = simulate(block, nudge, rotation=0.1, samples=2)
    free = simulate(block, rotation=0.1, samples=2)
    assert shaken.outcome == free.outcome == "rests"
    assert 0.3 < shaken.impacts[0] < nudge.duration - 0.5
    assert len(shaken.impacts) == len(free.impacts)


@pytest.mark.parametrize("route", [simulate, topheavy.simulate])
def test_lossless_block_is_never_said_to_rest(route):
    lossless = BLOCK.with_restitution(1.0)
    for peak in (1e-8, 1e-3):
        response = route(lossless, velocity=small_speed(BLOCK, peak), duration=5.0, samples=2)
        assert response.outcome == "rocking"
        assert np.abs(response.rotation).max() <= peak * BLOCK.slenderness
    assert route(lossless, Pulse("one-sine", 0.2, 5.0)).outcome == "no uplift"


@pytest.mark.usefixtures("count_all")
def test_block_that_lands_on_ground_beyond_the_threshold_is_not_put_to_rest():
    push = 1.2 * BLOCK.uplift_acceleration
    pulse = Pulse("constant", push, math.pi / 0.3)  # rocks it to θ < 0
    response = simulate(BLOCK, pulse, rotation=1e-9, samples=np.linspace(0.0, 0.3, 31))
    assert response.number_of_impacts == 1
    assert np.all(response.rotation[1:] < 0.0)


# ---------------------------------------------------------------------------- launch


class Hover:
    """A flight that stays up, and keeps its samples."""

    def __init__(self):
        self.legs = []

    def __call__(self, block, segment, stop, motion, possible):
        self.legs.append((motion.time, stop, motion.side, possible))
        motion.time, motion.rotation = stop, 0.1


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("ratio", [1.001, 1.3, 4.0])
def test_no_impact_is_looked_for_while_the_push_that_lifted_the_block_goes_on(sign, ratio):
    pulse = Pulse("one-sine", sign * ratio * BLOCK.uplift_acceleration, 3.0)
    hover, motion = Hover(), start(BLOCK, 0.0, 0.0)
    force(BLOCK, pulse, motion, hover)
    lifted = math.asin(1 / ratio) / 3.0
    released = math.pi / 3.0 - lifted
    assert hover.legs[0][0] == pytest.approx(lifted, rel=1e-12)
    for begin, stop, side, possible in hover.legs:
        assert side == -sign
        assert stop > begin
        assert possible == (begin > lifted + 0.9 * (released - lifted))
    assert any(stop == pytest.approx(released, rel=1e-12) for _, stop, _, _ in hover.legs)


def test_block_that_is_thrown_may_meet_the_ground_from_the_start():
    hover, motion = Hover(), start(BLOCK, 0.01, 0.0)
    force(BLOCK, Pulse("one-sine", -0.9, 3.0), motion, hover)
    assert all(possible for _, _, _, possible in hover.legs)


@pytest.mark.usefixtures("count_all")
def test_strong_ground_lifts_again_after_an_impact_that_stops_the_block():
    class Lands(Hover):
        def __call__(self, block, segment, stop, motion, possible):
            super().__call__(block, segment, stop, motion, possible)
            motion.rotation, motion.rate = 0.0, -1.0
            return Event.IMPACT if len(self.legs) == 3 else None

    lands, motion = Lands(), start(BLOCK, 0.0, 0.0)
    force(BLOCK.with_restitution(0.0), Pulse("one-sine", 4 * 0.2553, 3.0), motion, lands)
    sides = [side for _, _, side, _ in lands.legs]
    assert sides[0] == -1
    assert sides[-1] == 1  # lifted anew, by the second half of the sine
    assert motion.impacts == [lands.legs[2][1]]


# ---------------------------------------------------------------------------- ends


def test_history_without_loss_ends_after_a_thousand_impacts():
    block = BLOCK.with_restitution(1.0).linear()
    response = simulate_linear_exact(block, rotation=0.1, samples=2)
    quarter = quarter_period(block, 0.1)[0]
    assert MOST_FREE_IMPACTS == len(response.impacts) == 1000
    assert response.outcome == "rocking"
    assert response.number_of_impacts == 0
    assert response.impacts[-1] == pytest.approx(1999 * quarter, rel=1e-9)
    assert response.time[-1] == response.impacts[-1]


def test_impacts_behind_the_forcing_are_counted_anew():
    block = BLOCK.with_restitution(1.0).linear()
    pulse = Pulse("one-sine", 0.4, 9.0)
    response = simulate_linear_exact(block, pulse, rotation=0.02, samples=2)
    assert response.number_of_impacts > 0
    assert len(response.impacts) == 1000 + response.number_of_impacts


@BOTH
@pytest.mark.parametrize("side", [1.0, -1.0])
def test_history_of_a_block_poised_at_its_slenderness_ends(block, side):
    response = simulate(block, rotation=side * block.slenderness, samples=11)
    assert response.outcome == "rocking"
    assert response.peak_rotation == block.slenderness
    assert math.isfinite(response.time[-1])
    np.testing.assert_array_equal(response.rotation, side * block.slenderness)


@BOTH
def test_history_of_a_fallen_block_ends_lying_flat(block):
    summit = block.frequency_parameter * math.sqrt(2 * barrier(block))
    response = simulate(block, velocity=-1.01 * summit, samples=11)
    assert response.outcome == "overturned"
    assert response.rotation[-1] == pytest.approx(-math.pi / 2, rel=1e-9)
    assert response.rotation[-1] == min(response.rotation)


def test_linear_block_may_pass_the_right_angle_while_the_ground_can_bring_it_back():
    # Beyond α + max|ü_g|/g nothing does; here that lies beyond π/2.
    block = RockingBlock(1.0, 0.25, 0.3, linearised=True)
    there = 1.8  # rad; a push of 3 g for so long gives it more than the barrier, and not too much
    pulse = Pulse("constant", 3.0, math.pi / 0.77)
    response = simulate(block, pulse, rotation=there, samples=np.linspace(0.0, 1.7, 18))
    assert response.rotation[0] == there
    assert response.peak_rotation == there
    assert not response.overturned


@pytest.mark.parametrize("push", [0.5, 4.0])
def test_linear_block_has_fallen_where_no_ground_of_this_motion_brings_it_back(push):
    block = RockingBlock(2.0, 0.25, 0.9, linearised=True)
    pulse = Pulse("constant", -push, math.pi / 5.0)
    response = simulate(block, pulse, samples=np.linspace(0.0, 5.0, 5001))
    assert response.overturned
    last = response.rotation[np.isfinite(response.rotation)][-1]
    assert last == pytest.approx(max(math.pi / 2, 0.25 + push), rel=1e-2)


def test_cut_motion_is_judged_by_what_is_left_of_it():
    response = simulate(BLOCK, rotation=0.2, duration=0.1)
    assert response.outcome == "rocking"
    assert response.peak_rotation == 0.2
    assert response.time[-1] == 0.1


def test_duration_must_be_positive():
    for value in (0.0, -1.0, math.nan):
        with pytest.raises(ValueError, match="duration is"):
            simulate(BLOCK, rotation=0.1, duration=value)
