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
from topheavy.ground.shapes import FINITE_SHAPES
from topheavy.kernel.forcing import (
    RECORD,
    SHAPES,
    forcing_of,
    ground_of_piece,
    piece_start,
    prepare_record,
)
from topheavy.kernel.grid import outcome_of, outcomes_of
from topheavy.kernel.lanes import records, steps
from topheavy.kernel.lanes.histories import begin
from topheavy.kernel.lanes.vectors import (
    WIDTH,
    absolute,
    batch,
    bits,
    exponential,
    fields,
    fma,
    mask_of,
    maximum,
    minimum,
    select,
    square_root,
)
from topheavy.kernel.march import powers, short_series
from topheavy.kernel.tail import safe_speed
from topheavy.kernel.taylor import oscillator

#: Peaks differ by so much of α, as both kernels leave out terms below the tolerance.
CLOSE = 1e-8


def alone(block, shape, scales, amplitudes):
    """Peak, overturned and impacts of all cells, by the scalar kernel."""
    outcomes = [[outcome_of(block, shape, s, a) for a in amplitudes] for s in scales]
    peak = [[one.peak for one in row] for row in outcomes]
    overturned = [[one.overturned for one in row] for row in outcomes]
    return np.array(peak), np.array(overturned), [[one.impacts for one in row] for row in outcomes]


@pytest.mark.parametrize("degrees", [3.0, 9.5, 20.0, 40.0])
@pytest.mark.parametrize("linearised", [False, True], ids=["exact", "linearised"])
@pytest.mark.parametrize("shape", FINITE_SHAPES)
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
    cells = ([block], RECORD, np.zeros(3, int), np.full(3, step), factors, impulse)
    for in_full in (False, True):
        assert outcomes_of(*cells, in_full=in_full)[1].tolist() == [False, False, True]


@njit
def march_all(batch, record, tolerance):
    v = fields(batch[0])
    block = steps.block_of_lanes(v, math.pi / 2, False)
    return records.march_lanes(v, block, record, tolerance, (1 << WIDTH) - 1)


def test_short_series_and_its_bounds_are_those_of_the_scalar_kernel():
    """At steps so long, and tolerances so wide, that every term and every bound counts."""
    block, rng, passed = oscillator(RockingBlock(1.0, 0.25, 0.9)), np.random.default_rng(4), []
    record = prepare_record(rng.uniform(-0.4, 0.4, 60), rng.uniform(-0.5, 0.5, 60), 0.731)
    for case in range(300):
        step, tolerance = 10.0 ** rng.uniform(-1.5, -0.3), 10.0 ** rng.uniform(-7.0, -1.0)
        w, forcing = steps.new_batch(), forcing_of(RECORD, record, step, 1.0, 0.9)
        pieces, peak = rng.integers(0, 40, WIDTH), 0.24
        rotation, velocity = rng.uniform(0.01, 0.26, WIDTH), rng.uniform(-0.05, 0.05, WIDTH) / step
        for lane in range(WIDTH):
            begin(w[0], lane, block, forcing, True)
        w["rotation"][0, 0], w["velocity"][0, 0] = rotation, velocity
        w["sine"][0, 0], w["cosine"][0, 0] = np.sin(rotation), np.cos(rotation)
        w["factor"], w["piece"], w["peak"], w["flight_peak"] = -1.0, pieces, peak, peak
        passed_lanes = march_all(w, record, tolerance)
        for lane, (k, turn, rate) in enumerate(zip(pieces, rotation, velocity, strict=True)):
            value, slope, weight, change = ground_of_piece(forcing, k)
            length = piece_start(forcing, k + 1) - piece_start(forcing, k)
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
            assert passed_lanes >> lane & 1 == fine, (case, lane)
            passed.append(fine)
            if fine:
                assert w["rotation"][0, 0, lane] == pytest.approx(turn + by, abs=1e-14)
                close = 1e-13 * (1.0 + abs(rate))
                assert w["velocity"][0, 0, lane] == pytest.approx(rate + gain / length, abs=close)
                assert w["sine"][0, 0, lane] == pytest.approx(math.sin(turn + by), abs=1e-14)
    assert 0.1 < np.mean(passed) < 0.9


@njit
def arithmetic(batch):
    v = fields(batch[0])
    a, b, c = v.a, v.b, v.c
    v.out[0] = fma(a, b, c)
    v.out[1] = select((a < b) & ~(a <= -1.0), a, b)
    v.out[2] = select(mask_of(5), 1.0 / b, -a)
    v.out[3] = minimum(square_root(absolute(a)), maximum(b, 3 * c))
    v.out[4] = exponential(a)
    return bits(a < b)


def test_each_lane_is_a_float():
    w = batch(["a", "b", "c"], ["out"], 5)
    a, b, c = w["a"][0], w["b"][0], w["c"][0] = np.random.default_rng(7).normal(size=(3, WIDTH))
    less, out = arithmetic(w), w["out"][0]
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
def root_of_all(batch, degree, correction):
    v, wanted = fields(batch[0]), mask_of((1 << WIDTH) - 1)
    ends = (v.polynomial[0], v.polynomial[1] * v.step, v.time)
    v.flight_peak, is_accurate = steps.only_root(
        v.polynomial, degree, v.step, ends, wanted, correction
    )
    return bits(is_accurate)


def test_iteration_begins_at_the_root_of_the_parabola():
    """Where a landing is close to the turn after it, no other start would do."""
    w, roots = steps.new_batch(), np.linspace(0.1, 0.9, WIDTH)
    for lane, root in enumerate(roots):
        curve = np.polynomial.Polynomial.fromroots([root, root + 1e-3])
        w["polynomial"][0, :3, lane] = curve.coef
        w["step"][0, lane], w["time"][0, lane] = root + 5e-4, curve(root + 5e-4)
    assert root_of_all(w, 2, steps.LANDING_CORRECTION) == (1 << WIDTH) - 1
    np.testing.assert_allclose(w["flight_peak"][0], roots, rtol=1e-9)


def test_root_is_taken_only_where_the_iteration_is_to_be_trusted():
    """Roots beside a turn, where a correction says little of what is left."""
    rng, kept = np.random.default_rng(6), []
    for _ in range(400):
        w, roots = steps.new_batch(), np.empty(WIDTH)
        for lane in range(WIDTH):
            root, gap = rng.uniform(0.3, 1.0), 10.0 ** rng.uniform(-4.0, 0.0)
            others = np.polynomial.Polynomial([3.0, *rng.uniform(-0.6, 0.6, 3)])
            whole = np.polynomial.Polynomial.fromroots([root, root + gap]) * others
            w["polynomial"][0, :6, lane] = whole.coef
            w["step"][0, lane] = root + 0.5 * gap
            w["time"][0, lane], roots[lane] = whole(root + 0.5 * gap), root
        trusted = root_of_all(w, 5, steps.TURN_CORRECTION)
        off = np.abs(w["flight_peak"][0] / roots - 1.0)
        kept += [off[lane] for lane in range(WIDTH) if trusted >> lane & 1]
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
    tests = {Path(__file__), Path(__file__).with_name("test_compiled.py")}
    assert users - inside == {KERNEL / "grid.py"} | tests
