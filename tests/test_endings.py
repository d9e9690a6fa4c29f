"""Every history ends: as it was judged, within a proven number of steps, or by Ctrl-C."""

import math
import re
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

from benchmarks.boundaries import SHAPES, survey
from topheavy import (
    Pulse,
    Record,
    RockingBlock,
    judge,
    overturned_by,
    overturning_intervals,
    reference,
    simulate,
)
from topheavy.kernel import bernstein, forcing, interrupt, outcome, trace
from topheavy.kernel.forcing import NO_RECORD, pulse_forcing
from topheavy.kernel.taylor import oscillator
from topheavy.linear import simulate_linear_exact
from topheavy.response import MOST_SAMPLES

BLOCK = RockingBlock(2.14, 0.25, 0.9)
BOTH = pytest.mark.parametrize("block", [BLOCK, BLOCK.linear()], ids=["exact", "linear"])

# ---------------------------------------------------------------------------- as it was judged


def test_poised_block_that_was_judged_overturned_does_not_bounce():
    """Its energy is the barrier's plus 1e-16; integrated, it falls back."""
    history = simulate(BLOCK, Pulse("one-sine", 2.223221510648727, 15.7))
    assert history.outcome == "overturned"
    assert len(history.impacts) == history.number_of_impacts == 1
    assert history.rotation[-1] == pytest.approx(0.25, rel=1e-3)


def boundary(judged, block, low, high):
    """Two neighbouring amplitudes of a one-sine, the first survived and the second not."""
    while low < (middle := 0.5 * (low + high)) < high:
        if judged(block, Pulse("one-sine", middle, 15.7)).overturned:
            high = middle
        else:
            low = middle
    return low, high


@BOTH
@pytest.mark.parametrize(
    ("judged", "followed"),
    [(judge, simulate), (reference.judge, reference.simulate)],
    ids=["kernel", "reference"],
)
def test_history_at_the_last_bit_is_of_one_piece(block, judged, followed):
    """Poised at α, no survivor goes on outward and no block that overturns comes back."""
    for amplitude in boundary(judged, block, 2.0, 4.0):
        history = followed(block, Pulse("one-sine", amplitude, 15.7), samples=400)
        rotation = np.abs(history.rotation[np.isfinite(history.rotation)])
        assert history.time[-1] < 0.7 + trace.LONGEST_FLIGHT / 2.14 * 1.1 + 40.0
        if history.overturned:
            assert rotation[-1] > 0.99 * 0.25
        else:
            assert rotation.max() < 1.01 * max(0.25, history.peak_rotation)


def test_survivor_that_is_integrated_outward_ends_where_it_is_poised():
    """By rounding alone the exact block at rest at α leaves it, on either side."""
    for alpha in (0.1, 0.25, 0.3, 0.4):
        for rotation in (alpha, math.nextafter(alpha, 0.0), math.nextafter(alpha, 1.0)):
            history = simulate(RockingBlock(1.0, alpha, 0.9), rotation=rotation)
            last = abs(history.rotation[np.isfinite(history.rotation)][-1])
            assert history.overturned == (rotation > alpha)
            assert last > 0.99 * alpha if history.overturned else last < 1.01 * alpha


def test_part_of_the_boundaries_agrees():
    """The whole is benchmarks/boundaries.py: a hundred blocks, every pulse, all records."""
    found = survey(2)
    assert found.pulses >= 20
    assert found.records >= 4
    assert found.decided > 8 * found.pulses
    assert found.wrong == []


@pytest.mark.parametrize("followed", [simulate, reference.simulate])
def test_lossless_bounces_too_low_to_count_end(followed):
    lossless = RockingBlock(1.0, 0.25, 1.0)
    history = followed(lossless, rotation=0.25e-6 * (1 - 1e-9), samples=2)
    assert history.outcome == "rocking"
    assert len(history.impacts) <= 1


@pytest.mark.parametrize("shape", ["one-sine", "ricker-symmetric"])
@pytest.mark.parametrize("strength", [1.1, 6.0])
@BOTH
def test_lossless_block_rocks_for_ever_or_overturns_by_both_solvers(block, shape, strength):
    lossless = block.with_restitution(1.0)
    pulse = Pulse(shape, strength * block.uplift_acceleration, 5.0 * 2.14)
    ends = [judged(lossless, pulse) for judged in (judge, reference.judge)]
    histories = [follow(lossless, pulse, samples=50) for follow in (simulate, reference.simulate)]
    assert {end.overturned for end in ends} == {strength == 6.0}
    for end, history in zip(ends, histories, strict=True):
        assert history.outcome == ("overturned" if end.overturned else "rocking")
        if not end.overturned:
            assert len(history.impacts) == history.number_of_impacts + trace.LAST_IMPACT
            assert end.peak == pytest.approx(ends[0].peak, rel=1e-6)


def test_lossless_bounces_that_the_ground_cannot_raise_are_not_followed(monkeypatch):
    # Bounces of 1e-9 α through five minutes of quiet. A sample above the level behind it may lift
    # the block from any of them, so that all have to be followed.
    monkeypatch.setattr("topheavy.motion.MOST_IMPACTS", 300)
    lossless = RockingBlock(1.0, 0.2, 1.0)
    quiet = 1.0001 * math.tan(0.2) * np.array([0.0, 1.0, *np.zeros(300)])
    history = reference.simulate(lossless, Record(1.0, quiet), samples=2)
    assert history.outcome == "rocking"
    assert history.peak_rotation < 1e-8 * 0.2
    assert not reference.judge(lossless, Record(1.0, quiet)).overturned
    beyond = np.append(quiet, 1.5 * math.tan(0.2))
    with pytest.raises(ArithmeticError, match=r"300 impacts by .* bounces on; a shorter dur"):
        reference.judge(lossless, Record(1.0, beyond))


def test_impact_right_after_the_start_is_found():
    # The first sample exceeds the level by its last digits: uplift and impact within 1e-15 s.
    block = RockingBlock(4.2, 0.25, 0.9, linearised=True)
    record = Record(1.0, 0.25 * np.array([-1 - 1e-15, 1 + 1e-15, -1.0, 1.2, 0.0]))
    ends = [judged(block, record) for judged in (judge, reference.judge)]
    assert {end.overturned for end in ends} == {False}
    assert ends[0].peak == pytest.approx(ends[1].peak, rel=1e-6)


def test_marches_of_the_closed_form_are_bounded(monkeypatch):
    block = BLOCK.linear()
    for amplitude in (*boundary(judge, block, 2.0, 4.0), 0.3, 1.0, 9.0):
        monkeypatch.setattr("topheavy.linear._MOST_MARCHES", 1000)
        simulate_linear_exact(block, Pulse("one-sine", amplitude, 15.7), samples=2)
        monkeypatch.setattr("topheavy.linear._MOST_MARCHES", 2)
        with pytest.raises(ArithmeticError, match=r"RockingBlock\(.*2 marches.*shorter duration"):
            simulate_linear_exact(block, Pulse("one-sine", amplitude, 15.7), samples=2)


def test_impacts_and_steps_of_the_reference_are_bounded(monkeypatch):
    pulse = Pulse("one-sine", 1.0, 15.7)
    monkeypatch.setattr("topheavy.motion.MOST_IMPACTS", 500)
    reference.simulate(BLOCK, pulse, samples=2)
    monkeypatch.setattr("topheavy.motion.MOST_IMPACTS", 3)
    with pytest.raises(ArithmeticError, match=r"RockingBlock\(.*3 impacts.*shorter duration"):
        reference.simulate(BLOCK, pulse, samples=2)
    monkeypatch.setattr("topheavy.reference.MOST_STEPS", 1)
    with pytest.raises(ArithmeticError, match=r"RockingBlock\(.*1 steps.*larger tolerance"):
        reference.simulate(BLOCK, pulse, samples=2)


# ---------------------------------------------------------------------------- bounds of the kernel

#: Strengths over the level and ω/p, from slow to fast and from faint to enormous.
EXTREMES = [(1.0 + 1e-9, 3.0), (1.5, 1e-4), (1e5, 1e-3), (3.0, 5.0), (7.1, 5.0), (9.0, 300.0)]


@pytest.mark.parametrize("shape", SHAPES)
@BOTH
def test_no_history_comes_near_the_most_steps(monkeypatch, shape, block):
    """A hundredth of the bound is enough, also for a trace."""
    there, w = oscillator(block), outcome.working_array()
    monkeypatch.setattr(outcome, "MAX_STEPS", outcome.MAX_STEPS // 100)
    monkeypatch.setattr(trace, "MOST_STEPS", trace.MOST_STEPS // 100)
    for strength, ratio in EXTREMES:
        motion = pulse_forcing(forcing.SHAPES[shape], strength * there.level, ratio)
        given = (w, outcome.PULSE_ORDER, outcome.TOLERANCE, there, motion, NO_RECORD)
        assert outcome.outcome.py_func(*given, outcome.NO_RATIOS).resolved
        rest = (0.0, 0.0, math.inf, np.empty(0), np.empty((2, 0)), np.empty(1000))
        assert trace.trace.py_func(*given, *rest)[1] != trace.UNRESOLVED
    monkeypatch.setattr(outcome, "MAX_STEPS", 0)
    assert not outcome.outcome.py_func(*given, outcome.NO_RATIOS).resolved
    monkeypatch.setattr(trace, "MOST_STEPS", 0)
    assert trace.trace.py_func(*given, *rest)[1] == trace.UNRESOLVED


def test_parts_of_a_polynomial_are_far_fewer_than_the_most(monkeypatch):
    random = np.random.default_rng(7)
    monkeypatch.setattr(bernstein, "MOST_PARTS", bernstein.MOST_PARTS // 4)
    for number in range(300):
        clustered = 0.1 ** random.uniform(0, 9) * random.uniform(size=15)
        places = random.uniform(0.05, 0.9) + (clustered if number % 2 else 0.0 * clustered)
        w = outcome.working_array()
        w[outcome.POLYNOMIAL, :16] = np.polynomial.polynomial.polyfromroots(places)
        bernstein.to_bernstein(w, outcome.POLYNOMIAL, 15, outcome.HULL)
        given = (w, outcome.POLYNOMIAL, 0, 15, outcome.HULL, outcome.STACK, outcome.FOUND, 15)
        bernstein._roots.py_func(*given)
        assert w[outcome.HALT, 0] == 0.0
    monkeypatch.setattr(bernstein, "MOST_PARTS", 2)
    bernstein._roots.py_func(*given)
    assert w[outcome.HALT, 0] == 1.0  # the history is given up


def test_newton_finds_what_is_looked_for_in_a_quarter_of_its_steps(monkeypatch):
    monkeypatch.setattr(forcing, "MOST_NEWTON_STEPS", forcing.MOST_NEWTON_STEPS // 4)
    for shape in (forcing.RICKER_SYMMETRIC, forcing.RICKER_ANTISYMMETRIC):
        for strength in (1 + 1e-12, 1 + 1e-6, 1.01, 2.0, 30.0, 1e5):
            motion, time = pulse_forcing(shape, strength, 2.0), 0.0
            found = forcing.next_uplift(motion, NO_RECORD, time, 1.0)
            turns = [*forcing.RICKER_TURNS[shape - forcing.RICKER_SYMMETRIC] / 2.0]
            high = next((turn for turn in turns if turn > found[0]), motion.end)
            low = max((turn for turn in turns if turn < found[0]), default=0.0)
            if math.isfinite(found[0]) and found[0] > 0.0:
                given = (motion, low, high, -found[3], 1.0)
                few, many = forcing._crossing.py_func(*given), forcing._crossing(*given)
                assert few == pytest.approx(many, rel=1e-8 if strength < 1.01 else 1e-15, abs=1e-5)


def test_harmonic_at_the_level_is_searched_for_a_few_turns_only():
    """By rounding |a| stays at or below the level at turn after turn, of 10¹³ turns."""
    motion = pulse_forcing(forcing.HARMONIC, 0.3 * (1 + 4e-16), 1.0)._replace(end=1e14)
    found = [forcing.next_uplift(motion, NO_RECORD, 1e12 + k, 0.3)[0] for k in range(50)]
    assert math.inf in found
    above = motion._replace(amplitude=0.3 * (1 + 1e-9))
    assert forcing.next_uplift(above, NO_RECORD, 1e7, 0.3)[0] < 1e7 + 7.0


def test_history_with_too_many_impacts_is_named():
    lossless = RockingBlock(1.0, 0.25, 1.0)
    case = r"RockingBlock\(.* under no excitation: more than 100000 impacts .* shorter duration"
    with pytest.raises(ArithmeticError, match=case):
        simulate(lossless, rotation=1e-5, duration=1e6, samples=2)
    nudge = Record(1.0, 1.0001 * math.tan(0.2) * np.array([0.0, 1.0, *np.zeros(300)]), "nudge")
    quiet = RockingBlock(1.0, 0.2, 1.0)
    with pytest.raises(ArithmeticError, match=r"200000 steps.*record.*0\.2 rad, restitution 1,"):
        judge(quiet, nudge)


# ---------------------------------------------------------------------------- what is accepted


@pytest.mark.parametrize("value", [0, 0.0, math.nan, math.inf, -1, 1e10, 1e-300, "1e-9", None])
def test_tolerance_out_of_range_is_refused_alike(value):
    pulse = Pulse("one-sine", 0.6, 6.0)
    says = rf"^tolerance is {re.escape(repr(value))}; expected a float from 1e-1[36] to 0\.01$"
    for call in (
        lambda: simulate(BLOCK, pulse, tolerance=value),
        lambda: judge(BLOCK, pulse, tolerance=value),
        lambda: overturned_by(BLOCK, pulse, [1.0], tolerance=value),
        lambda: reference.simulate(BLOCK, pulse, tolerance=value),
        lambda: reference.judge(BLOCK, pulse, tolerance=value),
    ):
        with pytest.raises(ValueError, match=says):
            call()


@pytest.mark.parametrize("value", [1e-16, np.float64(1e-14), 1e-2])
def test_tolerance_at_the_ends_of_its_range_gives_histories(value):
    pulse = Pulse("ricker-symmetric", 0.4, 6.0)
    end, whole = judge(BLOCK, pulse, tolerance=value), simulate(BLOCK, pulse, tolerance=value)
    assert end.overturned == whole.overturned
    assert whole.peak_rotation == pytest.approx(simulate(BLOCK, pulse).peak_rotation, rel=0.05)


def test_number_of_samples_is_bounded():
    with pytest.raises(ValueError, match=rf"samples is 1000000000; .* {MOST_SAMPLES} .*array"):
        simulate(BLOCK, samples=10**9)


def test_what_is_no_ground_motion_is_refused_with_an_example():
    for call in (
        lambda: judge(BLOCK, 0.3),
        lambda: simulate(BLOCK, 0.3),
        lambda: overturned_by(BLOCK, 0.3, [1.0]),
    ):
        with pytest.raises(ValueError, match=r'excitation is 0\.3; .* Pulse\("one-sine", 0\.3'):
            call()
    for call in (
        lambda: overturned_by(BLOCK, None, [1.0]),
        lambda: overturning_intervals(BLOCK, None, (0.0, 1.0), resolution=0.1),
    ):
        with pytest.raises(ValueError, match="excitation is None; expected a Pulse or a Record"):
            call()


# ---------------------------------------------------------------------------- Ctrl-C

CHILD = """
import os, signal, sys, threading, time
import numpy as np
from topheavy import *
signal.signal(signal.SIGINT, signal.default_int_handler)  # that a shell's background job ignores
block = RockingBlock(2.0, 0.25, 0.95)
def shaking():
    return Record(0.01, np.tile(0.27 * np.sin(np.arange(5_000_000) * 0.06), 3))
def nudge():  # a lossless block bounces a hundred times a sample
    samples = np.zeros(3_000_000)
    samples[1] = 1.0001 * np.tan(0.25)
    return Record(0.5, samples)
calls = {
    "simulate": lambda motion: simulate(block, motion, samples=2),
    "judge": lambda motion: judge(block.with_restitution(1.0), motion),
    "overturning_map": lambda _: overturning_map(
        block, "one-sine", np.linspace(1, 20, 4000), np.linspace(0.26, 1, 4000)
    ),
    "overturning_intervals": lambda _: overturning_intervals(
        block, Pulse("one-sine", 1.0, 6.0), (0.26, 3.0), resolution=2e-7
    ),
}
overturning_map(block, "one-sine", [3.0], [0.3])
def interrupt():
    sent.append(time.process_time())
    os.kill(os.getpid(), signal.SIGINT)
for name, call in calls.items():
    motion, sent = {"simulate": shaking, "judge": nudge}.get(name, str)(), []
    threading.Timer(0.5, interrupt).start()
    try:
        call(motion)
        sys.exit(f"{name} finished")
    except KeyboardInterrupt:
        print(name, time.process_time() - sent[0], flush=True)
raise KeyboardInterrupt
"""


def test_ctrl_c_ends_a_long_call():
    child = subprocess.run(
        [sys.executable, "-c", CHILD], capture_output=True, text=True, timeout=240
    )
    assert child.stderr.rstrip().endswith("KeyboardInterrupt"), child.stderr
    assert child.returncode == -signal.SIGINT
    ended = dict(line.split() for line in child.stdout.splitlines())
    assert set(ended) == {"simulate", "judge", "overturning_map", "overturning_intervals"}
    # of the processor: a busy machine takes longer, but does no more
    assert max(map(float, ended.values())) < 2.0


def test_halted_threads_leave_the_rest_and_pass_on_the_error():
    def stuck(w):
        while w[outcome.HALT, 0] == 0.0:
            time.sleep(0.001)

    def failing(_):
        raise KeyboardInterrupt

    begin = time.perf_counter()
    with pytest.raises(KeyboardInterrupt):
        interrupt.in_threads([failing, stuck, stuck], 2)
    assert time.perf_counter() - begin < 2.0
    assert interrupt.in_threads([lambda _, k=k: k for k in range(9)], 3) == [*range(9)]
