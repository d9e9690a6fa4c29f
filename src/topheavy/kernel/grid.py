"""Many rocking histories: outcomes of blocks under pulses of one shape, or under one record.

A scale is ω/p of a pulse, p Δt of a record. Threads share the histories; no result depends on their
number. Compiled code does not look for signals, and Python only between its own instructions. Hence
long calls run in threads that hold no lock of Python's, while the main thread waits for them: a
wait that Ctrl-C ends.
"""

import math
import os
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from itertools import pairwise
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from topheavy.bodies.free_rocking import Outcome
from topheavy.ground.shapes import WAVES
from topheavy.kernel.compiled import compiled
from topheavy.kernel.forcing import RECORD, Array, Forcing, Waveform, forcing_of
from topheavy.kernel.history import (
    OVERTURNED,
    UNRESOLVED,
    History,
    Samples,
    is_straight,
    judge,
    sample,
)
from topheavy.kernel.step import HALT, MAX_STEPS, PULSE_ORDER, TOLERANCE, working_array
from topheavy.kernel.taylor import IMPACTS, OUTCOME, Method, Oscillator

#: Histories are split into at most so many batches, which threads take up as they come free.
MAX_BATCHES = 64
#: The least number of histories in a batch: fewer are over before a second thread has started.
MIN_PULSES, MIN_FACTORS = 256, 32
#: Histories of fewer samples, all together, are over within a second or two, whatever happens.
MIN_THREADED_SAMPLES = 100_000

Result = TypeVar("Result")


class Cells(NamedTuple):
    """Arrays with a value for each history."""

    block: NDArray[np.int64]  # its row of the array of blocks
    scale: Array  # ω/p or p Δt
    amplitude: Array  # of a pulse, or the factor on a record
    vertical_factor: Array  # on the vertical record
    order: NDArray[np.int64]  # of its series


class Results(NamedTuple):
    """Arrays with the peak rotation of each history, whether it overturns, and its impacts.

    Without the detail `taylor.PEAK` peaks are NaN; without `IMPACTS` only zero impacts are exact.
    """

    peaks: Array
    overturned: NDArray[np.bool_]
    impacts: NDArray[np.int64]


def record_order(step: float, tolerance: float = TOLERANCE) -> int:
    """Return the order with which one Taylor step covers a piece of a record p Δt = `step` long."""
    for order in range(5, PULSE_ORDER):
        if step ** (order - 2) / math.factorial(order - 2) < 0.01 * tolerance:
            return order
    return PULSE_ORDER


def outcomes_of(
    blocks: Sequence[Oscillator],
    waveform: Waveform,
    block_index: NDArray[np.int64],
    scales: Array,
    amplitudes: Array,
    *,
    vertical_factors: Array | None = None,
    tolerance: float = TOLERANCE,
    threads: int | None = None,
    detail: int = IMPACTS,
) -> Results:
    """Return the outcomes of histories of several blocks, each with its scale and amplitude.

    Parameters
    ----------
    waveform : Waveform
        That of all histories.
    block_index : array of int, shape (n,)
        The block of each history, by its place in `blocks`.
    scales, amplitudes : array, shape (n,)
        Of a pulse, ω/p and g; of a record, p Δt and the factor on it.
    vertical_factors : array, shape (n,), optional
        The factors on the vertical record; 0 unless given.
    threads : int, optional
        As `cores`, unless given.
    detail : int
        `taylor.OUTCOME`, `PEAK` or `IMPACTS`: how much is computed. Less is faster.

    Raises
    ------
    ArithmeticError
        For a history that takes more than `step.MAX_STEPS` steps.
    """
    size = block_index.size
    results = Results(np.empty(size), np.empty(size, bool), np.empty(size, np.int64))
    orders = np.full(size, PULSE_ORDER)
    is_record = waveform.wave == RECORD
    if is_record:
        order_of = {step: record_order(step, tolerance) for step in {*scales.tolist()}}
        orders = np.array([order_of[step] for step in scales.tolist()], np.int64)
    vertical_factors = np.zeros(size) if vertical_factors is None else vertical_factors
    # In C order, as numba would compile all anew for arrays that are not.
    cells = Cells(
        *map(np.ascontiguousarray, (block_index, scales, amplitudes, vertical_factors, orders))
    )
    rows = np.array([tuple(map(float, block)) for block in blocks])

    def judge_batch(first: int, last: int, w: Array) -> int:
        return int(judge_cells(w, tolerance, rows, waveform, cells, first, last, results, detail))

    batches = max(1, min(MAX_BATCHES, size // (MIN_FACTORS if is_record else MIN_PULSES)))
    if batches == 1 and size * max(waveform.record.shape[1], 1) <= MIN_THREADED_SAMPLES:
        unresolved = [judge_batch(0, size, working_array())]
    else:
        ends = [number * size // batches for number in range(batches + 1)]
        calls = [partial(judge_batch, first, last) for first, last in pairwise(ends)]
        unresolved = in_threads(calls, min(threads or cores(), batches))
    for cell in unresolved:
        if cell >= 0:
            block, scale, amplitude = blocks[block_index[cell]], scales[cell], amplitudes[cell]
            raise _unresolved(block, waveform, float(scale), float(amplitude))
    return results


@compiled(nogil=True)
def judge_cells(w, tolerance, blocks, waveform, cells, first, last, results, detail):
    """Fill the results from the first cell to the one before the last; stop where one is given up.

    Returns
    -------
    int
        The cell that was given up, or −1.
    """
    for cell in range(first, last):
        row = blocks[cells.block[cell]]
        block = Oscillator(row[0], row[1], row[2], row[3], row[4], row[5], row[6] != 0.0)
        scale, amplitude, vertical_factor = (
            cells.scale[cell],
            cells.amplitude[cell],
            cells.vertical_factor[cell],
        )
        forcing = forcing_of(waveform, scale, amplitude, vertical_factor)
        method = Method(cells.order[cell], tolerance, is_straight(waveform.wave), detail)
        history = judge(w, method, block, forcing)
        if history.result == UNRESOLVED:
            return cell
        results.overturned[cell] = history.result == OVERTURNED
        has_peak = detail != OUTCOME and not results.overturned[cell]
        results.peaks[cell] = history.peak if has_peak else math.nan
        results.impacts[cell] = history.impacts
    return -1


def cores() -> int:
    """Return how many cores the process may use, or OMP_NUM_THREADS if that is less.

    Snakemake sets it for each job: with jobs on all cores, a second thread only costs time.
    """
    available, limit = len(os.sched_getaffinity(0)), os.environ.get("OMP_NUM_THREADS", "")
    return min(available, int(limit)) if limit.isdigit() and int(limit) > 0 else available


def outcome_of(
    block: Oscillator,
    waveform: Waveform,
    scale: float,
    amplitude: float,
    *,
    vertical_factor: float = 0.0,
    tolerance: float = TOLERANCE,
) -> Outcome:
    """Return the outcome of one history; see `outcomes_of`."""
    scales, amplitudes, factors = np.array([[scale], [amplitude], [vertical_factor]])
    peaks, overturned, impacts = outcomes_of(
        [block],
        waveform,
        np.zeros(1, np.int64),
        scales,
        amplitudes,
        vertical_factors=factors,
        tolerance=tolerance,
    )
    return Outcome(bool(overturned[0]), float(peaks[0]), int(impacts[0]))


def sampled(
    block: Oscillator,
    forcing: Forcing,
    tolerance: float,
    start: tuple[float, float],
    until: float,
    samples: Samples,
) -> History:
    """Return the history of a block from θ and dθ/dτ on, and fill its samples; see `sample`."""
    is_record = forcing.wave == RECORD
    order = record_order(forcing.step, tolerance) if is_record else PULSE_ORDER
    method = Method(order, tolerance, is_straight(forcing.wave), IMPACTS)

    def call(w: Array) -> History:
        history: History = sample(w, method, block, forcing, *start, until, samples)
        return history

    is_long = forcing.record.shape[1] + samples.times.size > MIN_THREADED_SAMPLES
    return in_threads([call])[0] if is_long else call(working_array())


def _unresolved(
    block: Oscillator, waveform: Waveform, scale: float, amplitude: float
) -> ArithmeticError:
    forcing = f"{amplitude:.6g} times the record with p Δt = {scale:.6g}"
    if waveform.wave != RECORD:
        wave, halves = list(WAVES)[waveform.wave], waveform.last_phase / math.pi
        forcing = (
            f"{halves:g} half periods of the {wave} wave of {amplitude:.6g} g, ω/p {scale:.6g}"
        )
    equation = "linearised" if block.linearised else "exact"
    return ArithmeticError(
        f"{MAX_STEPS} steps and ten a sample do not reach the end of {forcing}: the block "
        f"(slenderness {block.slenderness:.6g} rad, restitution {block.restitution:.6g}, "
        f"{equation} equation) bounces too often; a smaller restitution lets it come to rest"
    )


def in_threads(calls: Sequence[Callable[[Array], Result]], threads: int = 1) -> list[Result]:
    """Return what the calls return; each thread takes the next and gives it its working array.

    Whatever ends the wait halts the histories under way at their next step, and all that follow at
    their first.
    """
    results: dict[int, Result] = {}
    waiting = enumerate(calls)
    arrays = [working_array() for _ in range(threads)]

    def work(w: Array) -> None:
        for number, call in waiting:
            results[number] = call(w)

    with ThreadPoolExecutor(threads) as pool:
        try:
            for done in [pool.submit(work, w) for w in arrays]:
                done.result()
        except BaseException:
            for w in arrays:
                w[HALT, 0] = 1.0
            raise
    return [results[number] for number in range(len(calls))]
