"""Histories in lanes are those of the scalar kernel; only the grid opens their door."""

import math
import re
from pathlib import Path

import numpy as np
import pytest
from numba import njit

import topheavy.kernel
from tests.cases import grid_of
from topheavy import RockingBlock
from topheavy.kernel.forcing import (
    RECORD,
    SHAPES,
    lines,
    piece_start,
    prepare_record,
    record_forcing,
)
from topheavy.kernel.grid import outcome_of, outcomes_of
from topheavy.kernel.lanes import records, steps
from topheavy.kernel.lanes.vectors import (
    WIDTH,
    absolute,
    among,
    bits,
    exponential,
    fma,
    load,
    maximum,
    minimum,
    rows,
    select,
    square_root,
    store,
)
from topheavy.kernel.march import powers, short_series
from topheavy.kernel.tail import safe_speed
from topheavy.kernel.taylor import oscillator

ENDING = sorted(set(SHAPES) - {"harmonic"})


#: Peaks differ by so much of α, as both kernels leave out terms below the tolerance.
CLOSE = 1e-8


def alone(block, shape, scales, amplitudes):
    """Peak, overturned and impacts of all cells, by the scalar kernel."""
    found = [[outcome_of(block, shape, s, a) for a in amplitudes] for s in scales]
    peak = [[one.peak for one in row] for row in found]
    overturned = [[one.overturned for one in row] for row in found]
    return np.array(peak), np.array(overturned), [[one.impacts for one in row] for row in found]


@pytest.mark.parametrize("degrees", [3.0, 9.5, 20.0, 40.0])
@pytest.mark.parametrize("linearised", [False, True], ids=["exact", "linearised"])
@pytest.mark.parametrize("shape", ENDING)
def test_outcomes_and_impacts_are_those_of_the_scalar_kernel(shape, linearised, degrees):
    alpha, rng = math.radians(degrees), np.random.default_rng(round(degrees))
    for restitution in (1.0 - 1.5 * math.sin(alpha) ** 2, 0.5):
        block = oscillator(RockingBlock(1.0, alpha, restitution, linearised))
        scales = rng.uniform(0.4, 10.0, 9)
        near = rng.uniform(0.99, 1.2, 8)
        amplitudes = block.level * np.concatenate([near, rng.uniform(1.0, 10.0, 12)])
        peak, overturned, impacts = grid_of(block, SHAPES[shape], scales, amplitudes)
        expected = alone(block, SHAPES[shape], scales, amplitudes)
        np.testing.assert_array_equal(overturned, expected[1])
        np.testing.assert_array_equal(impacts, expected[2])
        np.testing.assert_allclose(peak, expected[0], rtol=0, atol=CLOSE * alpha)
    assert (overturned != overturned[0, 0]).any()


def test_impulse_that_overturns_a_block_is_no_more_than_the_safe_one():
    """Sharp where gravity has no time to act, of a linearised block: φ' grows by the impulse."""
    block, step = oscillator(RockingBlock(1.0, 0.2, 0.9, linearised=True)), 1e-5
    impulse = prepare_record(np.array([0.0, 1.0, *np.zeros(50)]))
    factors = np.array([0.998, 1.001, 1.003]) * safe_speed(block) / step
    given = ([block], RECORD, np.zeros(3, int), np.full(3, step), factors, impulse)
    for in_full in (False, True):
        assert outcomes_of(*given, in_full=in_full)[1].tolist() == [False, False, True]


@njit
def march_all(w, block, record, tolerance):
    return records.march_lanes(w, steps.seated(w, block), record, tolerance, (1 << WIDTH) - 1)


def test_short_series_and_its_bounds_are_those_of_the_scalar_kernel():
    """At steps so long, and tolerances so wide, that every term and every bound counts."""
    block, rng, passed = oscillator(RockingBlock(1.0, 0.25, 0.9)), np.random.default_rng(4), []
    record = prepare_record(rng.uniform(-0.4, 0.4, 60), rng.uniform(-0.5, 0.5, 60), 0.731)
    for case in range(300):
        step, tolerance = 10.0 ** rng.uniform(-1.5, -0.3), 10.0 ** rng.uniform(-7.0, -1.0)
        w, forcing = rows(steps.ROWS), record_forcing(record, step, 1.0, 0.9)
        pieces, peak = rng.integers(0, 40, WIDTH), 0.24
        rotation, velocity = rng.uniform(0.01, 0.26, WIDTH), rng.uniform(-0.05, 0.05, WIDTH) / step
        for lane in range(WIDTH):
            records.begin(w, lane, block, forcing, True)
        w[steps.ROTATION], w[steps.VELOCITY] = rotation, velocity
        w[steps.SINE], w[steps.COSINE] = np.sin(rotation), np.cos(rotation)
        w[steps.FACTOR], w[steps.PIECE], w[steps.PEAK], w[steps.ARC] = -1.0, pieces, peak, peak
        found = march_all(w, block, record, tolerance)
        for lane, (k, turn, rate) in enumerate(zip(pieces, rotation, velocity, strict=True)):
            value, slope, weight, change = lines(forcing, record, k)
            length = piece_start(forcing, record, k + 1) - piece_start(forcing, record, k)
            push, push_rate = -value - block.level * weight, -slope - block.level * change
            tilt, lean = math.cos(0.25 - turn), math.sin(0.25 - turn)
            heavy, heavier = weight / math.cos(0.25), change / math.cos(0.25)
            fine, by, gain = short_series(
                powers(length),
                math.sin(turn) * heavy + push * tilt,
                math.cos(turn) * heavy + push * lean,
                math.sin(turn) * heavier + push_rate * tilt,
                math.cos(turn) * heavier + push_rate * lean,
                rate,
                turn,
                peak,
                tolerance * 0.25,
            )
            fine = fine and turn <= 0.25
            assert found >> lane & 1 == fine, (case, lane)
            passed.append(fine)
            if fine:
                assert w[steps.ROTATION, lane] == pytest.approx(turn + by, abs=1e-14)
                close = 1e-13 * (1.0 + abs(rate))
                assert w[steps.VELOCITY, lane] == pytest.approx(rate + gain / length, abs=close)
                assert w[steps.SINE, lane] == pytest.approx(math.sin(turn + by), abs=1e-14)
    assert 0.1 < np.mean(passed) < 0.9


@njit
def arithmetic(x, out):
    a, b, c = load(x, 0), load(x, 1), load(x, 2)
    store(out, 0, fma(a, b, c))
    store(out, 1, select((a < b) & ~(a <= -1.0), a, b))
    store(out, 2, select(among(5), 1.0 / b, -a))
    store(out, 3, minimum(square_root(absolute(a)), maximum(b, 3 * c)))
    store(out, 4, exponential(a))
    return bits(a < b)


def test_each_lane_is_a_float():
    rng, out = np.random.default_rng(7), rows(5)
    x = rows(3)
    x[:] = a, b, c = rng.normal(size=(3, WIDTH))
    less = arithmetic(x, out)
    assert [less >> lane & 1 for lane in range(WIDTH)] == (a < b).astype(int).tolist()
    assert less >> WIDTH == 0
    some = np.isin(np.arange(WIDTH), (0, 2))
    np.testing.assert_allclose(out[0], a * b + c, rtol=1e-13)
    np.testing.assert_array_equal(out[1], np.where((a < b) & ~(a <= -1), a, b))
    np.testing.assert_array_equal(out[2], np.where(some, 1.0 / b, -a))
    expected = np.minimum(np.sqrt(abs(a)), np.maximum(b, 3 * c))
    np.testing.assert_array_equal(out[3], expected)
    np.testing.assert_allclose(out[4], np.exp(a), rtol=5e-16)


@njit
def root_of_all(w, degree, correction):
    step, start, stop = load(w, steps.LENGTH), load(w, steps.STEP), load(w, steps.TIME)
    slope, sought = load(w, steps.STEP + 1) * step, among((1 << WIDTH) - 1)
    given = (w, steps.STEP, degree, step, start, slope, stop, sought, correction)
    x, is_found = steps.only_root(*given)
    store(w, steps.ARC, x)
    return bits(is_found)


def test_root_is_taken_only_where_the_iteration_is_to_be_trusted():
    """Roots beside a turn, where a correction says little of what is left."""
    rng, kept = np.random.default_rng(6), []
    for _ in range(400):
        w, roots = rows(steps.ROWS), np.empty(WIDTH)
        for lane in range(WIDTH):
            root, gap = rng.uniform(0.3, 1.0), 10.0 ** rng.uniform(-4.0, 0.0)
            others = np.polynomial.Polynomial([3.0, *rng.uniform(-0.6, 0.6, 3)])
            whole = np.polynomial.Polynomial.fromroots([root, root + gap]) * others
            w[steps.STEP : steps.STEP + 6, lane] = whole.coef
            w[steps.LENGTH, lane] = root + 0.5 * gap
            w[steps.TIME, lane], roots[lane] = whole(root + 0.5 * gap), root
        found = root_of_all(w, 5, steps.TURN_CORRECTION)
        off = np.abs(w[steps.ARC] / roots - 1.0)
        kept += [off[lane] for lane in range(WIDTH) if found >> lane & 1]
    assert 0.1 < len(kept) / (400 * WIDTH) < 0.95
    # what Halley's iteration leaves is the square of the bend times the correction
    assert max(kept) < 2.0 * steps.TURN_CORRECTION * 0.1**2


ROOT = Path(__file__).parents[2]
KERNEL = Path(topheavy.kernel.__file__).parent
INSIDE = re.compile(r"topheavy\.kernel\.lanes|topheavy\.kernel import .*\blanes\b")


def test_only_the_grid_imports_the_lanes():
    folders = ("src", "studies", "benchmarks", "figures", "notebooks", "tests")
    files = [path for folder in folders for path in (ROOT / folder).rglob("*.py")]
    files += ROOT.rglob("notebooks/*.ipynb")
    users = {path for path in files if INSIDE.search(path.read_text(encoding="utf-8"))}
    inside = {path for path in users if path.is_relative_to(KERNEL / "lanes")}
    assert users - inside == {KERNEL / "grid.py", Path(__file__)}
