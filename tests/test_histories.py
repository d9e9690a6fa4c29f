"""A history from launch to its end: samples only look, rest is proven, and every history ends."""

import math
from dataclasses import replace

import numpy as np
import pytest

import topheavy as th
from steps.shared import plain
from tests.cases import BLOCK, BOTH, fate
from tests.solvers import BY_TWO, EVERY
from topheavy.bodies.free_rocking import potential
from topheavy.kernel.history import MAX_FREE_FLIGHT

SHAKEN = th.Pulse("one-sine", 0.5, angular_frequency=9.0)
LOSSLESS = BLOCK.with_restitution(1.0)
LEVEL = BLOCK.uplift_acceleration


def small_speed(block, peak):
    """Speed at θ = 0 that reaches a rotation of `peak` α."""
    return block.frequency_parameter * math.sqrt(2 * potential(block, peak * block.slenderness))


@pytest.fixture
def count_all(monkeypatch):
    """Count every impact, however small the rotation that it ends."""
    monkeypatch.setattr("audit.COUNTED", -1.0)


# ---------------------------------------------------------------------------- time and samples


@EVERY
@pytest.mark.parametrize(
    ("pulse", "rotation"),
    [
        (th.Pulse("half-sine", 0.1, angular_frequency=4.0), 0.0),  # no uplift
        (SHAKEN, 0.0),
        (th.Pulse("one-sine", 0.4, angular_frequency=6.0), 0.1),  # at rest after the forcing
        (th.Record(0.1, [0.0, 0.4, *np.zeros(150)]), 0.0),  # at rest before its end
        (th.Pulse("one-sine", 0.9, angular_frequency=3.0), 0.0),  # overturned
        (th.Pulse("one-sine", 3.0, angular_frequency=9.0), 0.0),  # overturned under the forcing
    ],
)
def test_samples_only_look(solve, block, pulse, rotation):
    """Wherever they are, and however many: the verdict is that of the whole motion."""
    whole = solve(block, pulse, rotation=rotation)
    assert (whole.time.shape, whole.time[0]) == ((1000,), 0.0)
    if rotation == 0.0:
        end = th.judge(block, pulse)
        assert fate(end) == fate(whole)
        close = 1e-8 * block.slenderness
        assert end.peak_rotation == pytest.approx(whole.peak_rotation, abs=close, nan_ok=True)
    for samples in (3, [0.0, 0.01, 0.05], np.linspace(0.0, 1.2 * whole.time[-1], 77)):
        history = solve(block, pulse, rotation=rotation, samples=samples)
        assert fate(history) == fate(whole)
        # samples end steps of the plain solver, whose error of a peak is below 1e-8 α
        close = {"rel": 1e-9, "abs": 1e-10 * block.slenderness}
        assert history.peak_rotation == pytest.approx(whole.peak_rotation, **close, nan_ok=True)
        places = np.searchsorted(whole.time, history.time)
        for k in np.flatnonzero(np.isin(history.time, whole.time)):
            for name in ("rotation", "velocity"):
                close_value = pytest.approx(getattr(whole, name)[places[k]], abs=1e-9, nan_ok=True)
                assert getattr(history, name)[k] == close_value
        expected = (
            np.linspace(0.0, whole.time[-1], samples) if isinstance(samples, int) else samples
        )
        np.testing.assert_allclose(history.time, expected, rtol=1e-14)


@EVERY
def test_cut_motion_is_judged_by_what_is_left_of_it(solve, block):
    """A one-sine that ends at half its duration is a half-sine, a harmonic after one cycle one."""
    half, once = (
        th.Pulse("half-sine", 0.5, angular_frequency=9.0),
        {"duration": SHAKEN.duration, "samples": 50},
    )
    cut, whole = solve(block, SHAKEN, duration=half.duration), solve(block, half)
    assert cut.time[-1] == pytest.approx(half.duration, rel=1e-12)
    assert cut.overturned == whole.overturned
    assert cut.peak_rotation == pytest.approx(whole.peak_rotation, rel=1e-8)
    assert cut.peak_rotation > 1.01 * np.max(np.abs(cut.rotation))  # reached after the history
    harmonic, sine = (
        solve(block, th.Pulse(s, 0.5, angular_frequency=9.0), **once)
        for s in ("harmonic", "one-sine")
    )
    np.testing.assert_allclose(harmonic.rotation, sine.rotation, rtol=0, atol=1e-9)
    assert harmonic.peak_rotation == pytest.approx(sine.peak_rotation, rel=1e-8)


@BOTH
def test_last_sample_of_a_history_is_known_and_one_at_rest_stays(block):
    for k in range(40):
        slow = replace(block, restitution=1.0 - 0.001 * (k % 2), frequency_parameter=1 + 0.1 * k)
        history = th.simulate(slow, rotation=0.5 * slow.slenderness, samples=3)
        assert (history.outcome, history.time[-1]) == ("rocking", history.impact_times[-1])
        assert np.isfinite([history.rotation, history.velocity]).all()
    lossy = block.with_restitution(0.3)
    history = th.simulate(lossy, SHAKEN, samples=np.linspace(0.0, 60.0, 601), duration=60.0)
    assert history.outcome == "rests"
    assert not np.any([history.rotation[-100:], history.velocity[-100:]])


# ---------------------------------------------------------------------------- rest


@BOTH
def test_block_rests_at_the_first_impact_whose_bounce_is_negligible(block):
    """An impact counts if it ends a rotation of 1e-6 α; each bounce is 0.81 times as high."""
    ends = [plain.simulate(block, velocity=small_speed(block, x), samples=2)
            for x in (0.9e-6, 1.1e-6, 1.5e-5)]  # fmt: skip
    assert [len(end.impact_times) for end in ends] == [0, 1, 13]
    assert ends[2].outcome == "rests"


@pytest.mark.usefixtures("count_all")
def test_threshold_far_ahead_lets_the_block_rest_until_it_is_reached():
    late = th.Record(0.5, np.array([0.0, 0.0, 2.0, 0.0]) * LEVEL)
    rested, bounced = (
        plain.simulate(BLOCK, late, velocity=speed, samples=np.linspace(0.0, 1.5, 31))
        for speed in (0.0, small_speed(BLOCK, 0.9e-6))
    )
    assert bounced.impact_times[0] < 0.5
    assert np.any(rested.rotation != 0.0)
    # to the last bit the motion of a block that had been at rest
    np.testing.assert_array_equal(bounced.rotation[1:], rested.rotation[1:])


@pytest.mark.usefixtures("count_all")
def test_block_that_lands_on_ground_beyond_the_threshold_is_not_put_to_rest():
    pulse = th.Pulse("constant", 1.2 * LEVEL, angular_frequency=math.pi / 0.3)  # rocks it to θ < 0
    history = plain.simulate(BLOCK, pulse, rotation=1e-9, samples=np.linspace(0.0, 0.3, 31))
    assert history.number_of_impacts == 1
    assert np.all(history.rotation[1:] < 0.0)


def test_block_released_from_rest_lands_within_its_first_step():
    """It lands and is pushed up again before that step ends, which it began without a rate."""
    block, push = th.RockingBlock(1.0, 1.0, 0.0), th.Record(0.5, [0.0, 7.787])
    how = {"rotation": -0.0039, "duration": 1.0, "samples": [0.5]}
    fast, slow = (solve(block, push, **how) for solve in (th.simulate, plain.simulate))
    assert slow.rotation == pytest.approx(fast.rotation, rel=1e-6)


# ---------------------------------------------------------------------------- without loss


def test_lossless_block_is_never_said_to_rest():
    solve = th.simulate
    for peak in (1e-8, 1e-3):
        history = solve(LOSSLESS, velocity=small_speed(BLOCK, peak), duration=5.0, samples=2)
        assert history.outcome == "rocking"
        assert np.abs(history.rotation).max() <= peak * BLOCK.slenderness
    assert solve(LOSSLESS, th.Pulse("one-sine", 0.2, angular_frequency=5.0)).outcome == "no uplift"
    low = solve(LOSSLESS, rotation=0.25e-6 * (1 - 1e-9), samples=2)  # too low to count
    assert (low.outcome, len(low.impact_times) <= 1) == ("rocking", True)


# ---------------------------------------------------------------------------- ends


def test_linear_block_has_fallen_only_where_no_ground_of_this_motion_brings_it_back():
    """Beyond α + max|ü_g|/g nothing does; that may lie beyond π/2."""
    block = th.RockingBlock(1.0, 0.25, 0.3, linearised=True)
    # a push of 3 g for so long gives it more than the barrier, and not too much
    pulse = th.Pulse("constant", 3.0, angular_frequency=math.pi / 0.77)
    history = plain.simulate(block, pulse, rotation=1.8, samples=np.linspace(0.0, 1.7, 18))
    assert (history.rotation[0], history.peak_rotation, history.overturned) == (1.8, 1.8, False)
    for push in (0.5, 4.0):
        pulse, times = (
            th.Pulse("constant", -push, angular_frequency=math.pi / 5.0),
            np.linspace(0.0, 5.0, 5001),
        )
        history = plain.simulate(BLOCK.linear(), pulse, samples=times)
        assert history.overturned
        last = history.rotation[np.isfinite(history.rotation)][-1]
        assert last == pytest.approx(max(math.pi / 2, 0.25 + push), rel=1e-2)


# ---------------------------------------------------------------------------- at the last bit

SLOW, QUICK = th.RockingBlock(2.14, 0.25, 0.9), th.Pulse("one-sine", 1.0, angular_frequency=15.7)


def boundary(judged, block, unit, low, high):
    """Two neighbouring factors on a pulse that have different outcomes, between two that have."""
    first = judged(block, unit.scaled(low)).overturned
    while low < (middle := 0.5 * (low + high)) < high:
        is_first = judged(block, unit.scaled(middle)).overturned == first
        low, high = (middle, high) if is_first else (low, middle)
    return low, high


@pytest.mark.parametrize("block", [SLOW, SLOW.linear()], ids=["exact", "linear"])
@BY_TWO
def test_history_at_the_last_bit_is_of_one_piece(block, solve):
    """Poised at α, no survivor goes on outward and no block that overturns comes back."""
    judged = th.judge if solve is th.simulate else plain.judge
    for amplitude in boundary(judged, block, QUICK, 2.0, 4.0):
        history = solve(block, QUICK.scaled(amplitude), samples=400)
        rotation = np.abs(history.rotation[np.isfinite(history.rotation)])
        assert history.time[-1] < 0.7 + MAX_FREE_FLIGHT / 2.14 * 1.1 + 40.0
        if history.overturned:
            assert rotation[-1] > 0.99 * 0.25
        else:
            assert rotation.max() < 1.01 * max(0.25, history.peak_rotation)


def test_impact_right_after_the_start_is_found():
    # The first sample exceeds the level by its last digits: uplift and impact within 1e-15 s.
    block = th.RockingBlock(4.2, 0.25, 0.9, linearised=True)
    record = th.Record(1.0, 0.25 * np.array([-1 - 1e-15, 1 + 1e-15, -1.0, 1.2, 0.0]))
    ends = [judged(block, record) for judged in (th.judge, plain.judge)]
    assert {end.overturned for end in ends} == {False}
    assert ends[0].peak_rotation == pytest.approx(ends[1].peak_rotation, rel=1e-6)


# ---------------------------------------------------------------------------- bounds


def test_history_with_too_many_impacts_is_named():
    lossless = th.RockingBlock(1.0, 0.2, 1.0)
    case = r"RockingBlock\(.* under no excitation: more than 100000 impacts .* shorter duration"
    with pytest.raises(ArithmeticError, match=case):
        th.simulate(lossless, rotation=1e-5, duration=1e6, samples=2)
    # A nudge and a long quiet: without loss, bounces of 1e-4 s each go on through all of it.
    nudge = th.Record(1.0, 1.0001 * math.tan(0.2) * np.array([0.0, 1.0, *np.zeros(300)]), "nudge")
    case = r"(?s)200000 steps.*record.*0\.2 rad, restitution 1,.*bounces too often"
    with pytest.raises(ArithmeticError, match=case):
        th.judge(lossless, nudge)
