"""What holds for every rocking block and every pulse, tried on blocks that nobody chose."""

import math

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from topheavy import Pulse, RockingBlock, simulate

few = settings(max_examples=15, deadline=None, derandomize=True, database=None)

SHAPES = (
    "one-sine",
    "one-cosine",
    "half-sine",
    "constant",
    "ricker-symmetric",
    "ricker-antisymmetric",
)


@st.composite
def blocks(draw) -> RockingBlock:
    return RockingBlock(
        frequency_parameter=draw(st.floats(0.5, 5.0)),
        slenderness=math.radians(draw(st.floats(3.0, 25.0))),
        restitution=draw(st.floats(0.3, 0.97)),
        linearised=draw(st.booleans()),
    )


@st.composite
def shaken_blocks(draw) -> tuple[RockingBlock, Pulse]:
    """A block, and a pulse that lifts it."""
    block = draw(blocks())
    strength = draw(st.floats(1.02, 5.0)) * draw(st.sampled_from([-1.0, 1.0]))
    pulse = Pulse(
        draw(st.sampled_from(SHAPES)),
        strength * block.uplift_acceleration,
        draw(st.floats(2.0, 10.0)) * block.frequency_parameter,
    )
    return block, pulse


def level(block: RockingBlock, rotation, velocity):
    """Energy above upright, in units of p²."""
    tilt = np.abs(rotation)
    kinetic = 0.5 * (velocity / block.frequency_parameter) ** 2
    if block.linearised:
        return kinetic + tilt * (block.slenderness - tilt / 2)
    return kinetic + np.cos(block.slenderness - tilt) - np.cos(block.slenderness)


@few
@given(shaken_blocks())
def test_mirrored_pulse_mirrors_the_response(case):
    block, pulse = case
    times = np.linspace(0.0, pulse.duration, 60)
    right = simulate(block, pulse, samples=times)
    left = simulate(block, pulse.scaled(-1.0), samples=times)
    assert left.outcome == right.outcome
    assert left.number_of_impacts == right.number_of_impacts
    np.testing.assert_allclose(left.rotation, -right.rotation, rtol=0, atol=1e-12)
    np.testing.assert_allclose(left.peak_rotation, right.peak_rotation, rtol=1e-12)


@few
@given(shaken_blocks(), st.floats(0.3, 3.0))
def test_common_factor_on_both_frequencies_scales_time_alone(case, factor):
    block, pulse = case
    fast = RockingBlock(
        factor * block.frequency_parameter, block.slenderness, block.restitution, block.linearised
    )
    quick = Pulse(pulse.shape, pulse.amplitude, factor * pulse.angular_frequency)
    slow, scaled = simulate(block, pulse), simulate(fast, quick)
    assert scaled.overturned == slow.overturned
    np.testing.assert_allclose(
        scaled.peak_rotation, slow.peak_rotation, rtol=0, atol=1e-6 * block.slenderness
    )


@few
@given(shaken_blocks())
def test_same_call_gives_the_same_bits(case):
    first, second = simulate(*case), simulate(*case)
    for name in ("time", "rotation", "velocity", "impacts", "peak_rotation"):
        np.testing.assert_array_equal(getattr(first, name), getattr(second, name))
    assert first.outcome == second.outcome
    assert first.number_of_impacts == second.number_of_impacts


@few
@given(blocks(), st.floats(0.05, 0.95), st.sampled_from([-1.0, 1.0]))
def test_free_rocking_keeps_its_energy_but_at_impacts(block, fraction, side):
    start = side * fraction * block.slenderness
    whole = simulate(block, rotation=start)
    assert whole.outcome == "rests"
    ends = np.concatenate([[0.0], whole.impacts[:5]])
    inside = ends[:-1, None] + np.diff(ends)[:, None] * np.array([0.1, 0.5, 0.9])
    response = simulate(block, rotation=start, samples=inside.ravel())
    found = level(block, response.rotation, response.velocity).reshape(inside.shape)
    begun = float(level(block, start, 0.0))
    expected = begun * block.restitution ** (2 * np.arange(len(inside)))
    np.testing.assert_allclose(found, expected[:, None] * np.ones(3), rtol=1e-5, atol=1e-9 * begun)
    sides = np.sign(response.rotation).reshape(inside.shape)
    alternating = side * (-1.0) ** np.arange(len(inside))
    np.testing.assert_array_equal(sides, alternating[:, None] * np.ones(3))


@few
@given(shaken_blocks())
def test_survivor_never_leaves_its_peak(case):
    block, pulse = case
    response = simulate(block, pulse)
    assert response.peak_rotation > 0 or response.overturned
    if not response.overturned:
        assert np.max(np.abs(response.rotation)) <= response.peak_rotation * (1 + 1e-9)
