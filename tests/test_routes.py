"""Solvers that share no code answer alike, on blocks and motions that nobody chose."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import topheavy as th
from steps.shared import plain
from steps.shared.linear import simulate_linear_exact as closed
from tests.cases import BLOCK, fate
from topheavy.ground.shapes import FINITE_SHAPES

few = settings(max_examples=15, deadline=None, derandomize=True, database=None)


@st.composite
def shaken(draw, records=True):
    """A block; and a pulse that lifts it, or a short record that may lift it."""
    block = th.RockingBlock(
        draw(st.floats(0.5, 5.0)),
        math.radians(draw(st.floats(3.0, 25.0))),
        draw(st.floats(0.3, 0.97)),
        linearised=draw(st.booleans()),
    )
    p, level = block.frequency_parameter, block.uplift_acceleration
    if records and draw(st.booleans()):
        samples = np.array(draw(st.lists(st.floats(-1.0, 1.0), min_size=2, max_size=25)))
        strength, step = draw(st.floats(0.5, 6.0)), draw(st.floats(0.01, 0.3))
        return block, th.Record(step / p, strength * level * samples, unit="g")
    strength = draw(st.floats(1.02, 5.0)) * draw(st.sampled_from([-1.0, 1.0]))
    ratio = draw(st.floats(2.0, 10.0))
    return block, th.Pulse(
        draw(st.sampled_from(FINITE_SHAPES)), strength * level, angular_frequency=ratio * p
    )


def faster(factor, block, pulse):
    fast = replace(block, frequency_parameter=factor * block.frequency_parameter)
    return fast, replace(pulse, angular_frequency=factor * pulse.angular_frequency)


# ---------------------------------------------------------------------------- what always holds


@settings(few, max_examples=30)
@given(shaken())
def test_mirrored_motion_mirrors_the_response_and_a_call_again_gives_the_same_bits(case):
    block, motion = case
    times = np.linspace(0.0, motion.duration, 60)
    right, left, again = (
        th.simulate(block, motion.scaled(sign), samples=times) for sign in (1.0, -1.0, 1.0)
    )
    for name in (
        "time",
        "rotation",
        "velocity",
        "impact_times",
        "peak_rotation",
        "number_of_impacts",
    ):
        values, side = getattr(right, name), -1.0 if name in ("rotation", "velocity") else 1.0
        np.testing.assert_array_equal(getattr(again, name), values)
        np.testing.assert_array_equal(side * getattr(left, name), values)
    assert left.outcome == right.outcome == again.outcome
    if not right.overturned:
        assert np.max(np.abs(right.rotation)) <= right.peak_rotation * (1 + 1e-9)


@few
@given(shaken(records=False), st.sampled_from([0.25, 0.5, 4.0]), st.floats(0.3, 3.0))
def test_factor_on_both_frequencies_scales_time_alone(case, exact, factor):
    """A power of two changes no bit: p is in none of the kernel's formulas, time is p t."""
    plain, doubled, scaled = (th.judge(*faster(by, *case)) for by in (1.0, exact, factor))
    np.testing.assert_equal(doubled, plain)
    assert scaled.overturned == plain.overturned
    np.testing.assert_allclose(
        scaled.peak_rotation, plain.peak_rotation, rtol=0, atol=1e-6 * case[0].slenderness
    )


@few
@given(shaken())
def test_history_is_that_of_the_plain_solver(case):
    block, motion = case
    times = np.linspace(0.0, 1.5 * motion.duration, 100)
    less, kernel, more = (
        th.simulate(block, motion.scaled(1 + x), samples=times) for x in (-1e-8, 0.0, 1e-8)
    )
    slow = plain.simulate(block, motion, samples=times)
    assert kernel.outcome == slow.outcome
    known = np.isfinite(sum(history.rotation for history in (less, kernel, more, slow)))
    assert np.count_nonzero(known) > 5
    apart, decided = np.abs(kernel.rotation - slow.rotation), np.abs(more.rotation - less.rotation)
    # Either route may take the block for at rest before its last bounce, which is below 1e-6 α.
    assert np.all(apart[known] <= 1e-6 * block.slenderness + 2 * decided[known])


def test_closed_form_is_the_history_of_the_kernel_under_a_record():
    times, record = np.linspace(0.0, 4.0, 60), th.Record(0.1, 0.3 * np.sin(np.arange(40.0) / 2.0))
    ours, exact = (solve(BLOCK.linear(), record, samples=times) for solve in (th.simulate, closed))
    np.testing.assert_allclose(ours.rotation, exact.rotation, rtol=0, atol=1e-6)


# ---------------------------------------------------------------------------- extremes


@pytest.mark.sampled(5)
@pytest.mark.parametrize("linearised", [False, True])
@pytest.mark.parametrize("degrees", [0.1, 14.0, 80.0])
@pytest.mark.parametrize("ratio", [0.05, 1e3])
@pytest.mark.parametrize("strength", [1 + 1e-9, 1.5, 1e3])
def test_extreme_input_is_answered_alike_by_both_routes(strength, ratio, degrees, linearised):
    block = th.RockingBlock(2.0, math.radians(degrees), 0.9, linearised)
    for shape in ("one-sine", "one-cosine", "ricker-symmetric", "ricker-antisymmetric"):
        pulse = th.Pulse(shape, strength * block.uplift_acceleration, angular_frequency=ratio * 2.0)
        end, whole = th.judge(block, pulse), th.simulate(block, pulse, samples=5)
        expected = plain.judge(block, pulse)
        assert fate(end) == fate(whole)
        assert end.overturned == expected.overturned
        assert strength < 1.1 or end.overturned == (ratio < 1)
        for peak in (whole.peak_rotation, expected.peak_rotation):
            assert end.peak_rotation == pytest.approx(
                peak, abs=1e-9 * block.slenderness, nan_ok=True
            )
