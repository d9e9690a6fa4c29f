"""Many rocking histories at once: outcomes of blocks under pulses of one shape, or one record.

A scale is ω/p of a pulse, p Δt of a record. The histories run in the lanes of the CPU
(`kernel.lanes`), on all cores; no result depends on how many lanes or cores there are, or on which
histories run beside each other.
"""

import math
import os
from collections.abc import Sequence
from functools import partial
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from topheavy.bodies.free_rocking import Ending
from topheavy.kernel.forcing import NO_RECORD, RECORD, SHAPES, Array, Forcing, forcing_of
from topheavy.kernel.history import (
    FROM_REST,
    NO_RATIOS,
    NO_SAMPLES,
    OVERTURNED,
    UNRESOLVED,
    Course,
    History,
    Samples,
    follow,
    is_straight,
)
from topheavy.kernel.interrupt import MIN_THREADED_SAMPLES, in_threads
from topheavy.kernel.lanes.histories import Cells, Results
from topheavy.kernel.lanes.pulses import POISED, pulse_outcomes
from topheavy.kernel.lanes.records import record_outcomes
from topheavy.kernel.lanes.steps import new_batch
from topheavy.kernel.lanes.vectors import WIDTH
from topheavy.kernel.step import MAX_STEPS, PULSE_ORDER, TOLERANCE, working_array
from topheavy.kernel.taylor import Method, Oscillator

#: Cells are split into at most so many batches of neighbours, which do much the same in all lanes.
#: Threads take up the batches as they come free.
MAX_BATCHES = 64
#: The least number of cells in a batch. Fewer would leave lanes idle at its end, or be done before
#: a second thread has started.
MIN_PULSES, MIN_FACTORS = 32 * WIDTH, 4 * WIDTH


def record_order(step: float, tolerance: float = TOLERANCE) -> int:
    """Return the order with which one Taylor step covers a piece of a record p Δt = `step` long."""
    for order in range(5, PULSE_ORDER):
        if step ** (order - 2) / math.factorial(order - 2) < 0.01 * tolerance:
            return order
    return PULSE_ORDER


def outcomes_of(
    blocks: Sequence[Oscillator],
    shape: int,
    which: NDArray[np.int64],
    scales: Array,
    amplitudes: Array,
    record: Array = NO_RECORD,
    *,
    lifts: Array | None = None,
    tolerance: float = TOLERANCE,
    in_full: bool = True,
    threads: int | None = None,
) -> Results:
    """Return the outcomes of histories of several blocks, each with its scale and amplitude.

    Parameters
    ----------
    shape : int
        A value of `forcing.SHAPES`, or `forcing.RECORD`.
    which : array of int, shape (n,)
        The block of each history, by its place in `blocks`.
    scales, amplitudes : array, shape (n,)
        Of a pulse, ω/p and g; of a record, p Δt and the factor on it.
    record : array
        As `forcing.prepare_record` gives it.
    lifts : array, shape (n,), optional
        The factors on the vertical record; 0 unless given.
    in_full : bool
        If not, a history under a record ends once it is sure to survive (`tail.safe_speed`), and
        its peak and impacts are those so far.
    threads : int, optional
        As `cores`, unless given.

    Raises
    ------
    ArithmeticError
        For a history that takes more than `step.MAX_STEPS` steps.
    """
    results = _empty_results(which.size)
    lifts = np.zeros(which.size) if lifts is None else lifts
    linearised = np.array([block.linearised for block in blocks])[which]
    rows = np.array([block[:5] for block in blocks])
    for equation in (False, True):  # the lanes follow one equation at a time
        (at,) = np.nonzero(linearised == equation)
        if not at.size:
            continue
        # In C order, as numba would compile all anew for arrays that are not.
        values: Any = [
            np.ascontiguousarray(array[at]) for array in (which, scales, amplitudes, lifts)
        ]
        flat = blocks[which[at[0]]].flat
        cells = Cells(shape, record, flat, equation, rows, *values)
        subset = _empty_results(at.size)
        unresolved = _follow_cells(cells, subset, tolerance, in_full, threads)
        if unresolved >= 0:
            raise _unresolved(*_arguments(blocks, cells, unresolved)[:4])
        for cell in np.flatnonzero(subset.impacts == POISED):
            end = outcome_of(*_arguments(blocks, cells, int(cell)), tolerance=tolerance)
            subset.overturned[cell], subset.peaks[cell], subset.impacts[cell] = end
        for array, part in zip(results, subset, strict=True):
            array[at] = part
    return results


def _empty_results(size: int) -> Results:
    return Results(np.empty(size), np.empty(size, bool), np.empty(size, np.int64))


def _arguments(
    blocks: Sequence[Oscillator], cells: Cells, cell: int
) -> tuple[Oscillator, int, float, float, Array]:
    """Return the arguments of `outcome_of` for a cell."""
    scale, amplitude = float(cells.scales[cell]), float(cells.amplitudes[cell])
    return blocks[cells.which[cell]], cells.shape, scale, amplitude, cells.record


def _follow_cells(
    cells: Cells, results: Results, tolerance: float, in_full: bool, threads: int | None
) -> int:
    """Follow all cells in batches, in threads; return the first that was given up, or −1."""
    size, samples = cells.which.size, cells.record.shape[1]
    is_record = cells.shape == RECORD

    def do(first: int, last: int, alone: Array) -> int:
        if is_record:
            how = (tolerance, in_full, results)
            return int(record_outcomes(new_batch(), alone, cells, (first, last), *how))
        return int(pulse_outcomes(new_batch(), alone, cells, (first, last), tolerance, results))

    batches = max(1, min(MAX_BATCHES, size // (MIN_FACTORS if is_record else MIN_PULSES)))
    if batches == 1 and size * max(samples, 1) <= MIN_THREADED_SAMPLES:
        return do(0, size, working_array())
    threads = threads or cores()
    if threads == 1:
        batches = 1  # so that no lane idles at the end of any but the last cells
    ends = [number * size // batches for number in range(batches + 1)]
    calls = [partial(do, first, last) for first, last in pairwise(ends)]
    unresolved = in_threads(calls, min(threads, batches))
    return min((cell for cell in unresolved if cell >= 0), default=-1)


def cores() -> int:
    """Return how many cores the process may use, or OMP_NUM_THREADS if that is less.

    Snakemake sets it for each job: with jobs on all cores, a second thread only costs time.
    """
    available, limit = len(os.sched_getaffinity(0)), os.environ.get("OMP_NUM_THREADS", "")
    return min(available, int(limit)) if limit.isdigit() and int(limit) > 0 else available


def outcome_of(
    block: Oscillator,
    shape: int,
    scale: float,
    amplitude: float,
    record: Array = NO_RECORD,
    *,
    lift: float = 0.0,
    ratios: Array = NO_RATIOS,
    tolerance: float = TOLERANCE,
) -> Ending:
    """Return the outcome of one history, by the scalar kernel; see `outcomes_of` and `follow`."""
    forcing = forcing_of(shape, record, scale, amplitude, lift)
    history = followed(block, forcing, tolerance, ratios)
    if history.result == UNRESOLVED:
        raise _unresolved(block, shape, scale, amplitude)
    overturned = history.result == OVERTURNED
    return Ending(overturned, math.nan if overturned else history.peak, history.impacts)


def followed(
    block: Oscillator,
    forcing: Forcing,
    tolerance: float,
    ratios: Array = NO_RATIOS,
    course: Course = FROM_REST,
    samples: Samples | None = None,
) -> History:
    """Return the history of a block; it is only judged unless there are `samples` to fill."""
    is_record = forcing.shape == RECORD
    order = record_order(forcing.step, tolerance) if is_record else PULSE_ORDER
    method = Method(order, tolerance, is_straight(forcing.shape))
    is_judged, samples = samples is None, samples or NO_SAMPLES

    def call(w: Array) -> History:
        history: History = follow(w, method, block, forcing, ratios, course, samples, is_judged)
        return history

    is_long = forcing.record.shape[1] + samples.times.size > MIN_THREADED_SAMPLES
    return in_threads([call])[0] if is_long else call(working_array())


def _unresolved(block: Oscillator, shape: int, scale: float, amplitude: float) -> ArithmeticError:
    forcing = f"{amplitude:.6g} times the record with p Δt = {scale:.6g}"
    if shape != RECORD:
        name = next(name for name, number in SHAPES.items() if number == shape)
        forcing = f"the {name} pulse of {amplitude:.6g} g with ω/p = {scale:.6g}"
    equation = "linearised" if block.linearised else "exact"
    return ArithmeticError(
        f"{MAX_STEPS} steps and ten a sample do not reach the end of {forcing}: the block "
        f"(slenderness {block.slenderness:.6g} rad, restitution {block.restitution:.6g}, "
        f"{equation} equation) bounces too often; a smaller restitution lets it come to rest"
    )
