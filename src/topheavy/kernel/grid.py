"""Many rocking histories at once: outcomes of blocks under pulses of one shape, or one record.

A scale is ω/p of a pulse, p Δt of a record. The histories run in the lanes of the CPU
(`kernel.lanes`, to which this module is the only door), on all cores; no result depends on how many
lanes or cores there are, or on which histories run beside each other.
"""

import math
import os
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from topheavy.kernel.forcing import NO_RECORD, RECORD, SHAPES, UP, pulse_forcing, record_forcing
from topheavy.kernel.interrupt import LONG, in_threads
from topheavy.kernel.lanes.pulses import pulse_outcomes
from topheavy.kernel.lanes.records import record_outcomes
from topheavy.kernel.lanes.steps import ROWS
from topheavy.kernel.lanes.vectors import HAS_FMA, WIDTH, rows
from topheavy.kernel.outcome import (
    MAX_STEPS,
    NO_RATIOS,
    PULSE_ORDER,
    TOLERANCE,
    Outcome,
    outcome,
    working_array,
)
from topheavy.kernel.taylor import Oscillator

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Outcomes = tuple[Array, NDArray[np.bool_], NDArray[np.int64]]

#: Cells are split into at most so many batches of neighbours, which do much the same in all lanes.
#: Threads take up the batches as they come free.
BATCHES = 64
#: How many histories run at once in a core, and whether it multiplies and adds in one operation.
LANES, FUSED = WIDTH, HAS_FMA
#: So many histories in a call leave no lane idle for long: where each call decides on the next, and
#: where only the first that overturns is sought.
FEW_AT_ONCE, MANY_AT_ONCE = 2 * WIDTH, 16 * WIDTH
#: The least number of cells in a batch. Fewer would leave lanes idle at its end, or be done before
#: a second thread has started.
FEWEST_PULSES, FEWEST_FACTORS = 32 * WIDTH, 4 * WIDTH


def record_order(step: float, tolerance: float = TOLERANCE) -> int:
    """Return the order with which one Taylor step covers a piece of a record p Δt = `step` long."""
    for order in range(5, PULSE_ORDER):
        if step ** (order - 2) / math.factorial(order - 2) < 0.01 * tolerance:
            return order
    return PULSE_ORDER


def outcomes_of(
    block: Oscillator,
    shape: int,
    scales: Array,
    amplitudes: Array,
    record: Array = NO_RECORD,
    *,
    tolerance: float = TOLERANCE,
    threads: int | None = None,
) -> Outcomes:
    """Return the outcomes of all pairs of a scale and an amplitude.

    Parameters
    ----------
    shape : int
        A value of `forcing.SHAPES`, or `forcing.RECORD`.
    scales : array
        Of a pulse, ω/p; of a record, p Δt.
    amplitudes : array
        In g; of a record, the factors on it.
    record : array
        As `forcing.prepare_record` gives it.
    threads : int, optional
        As `cores`, unless given.

    Returns
    -------
    peak, overturned, impacts : array, shape (len(scales), len(amplitudes))
        As in `outcome.Outcome`.

    Raises
    ------
    ArithmeticError
        For a history that takes more than `outcome.MAX_STEPS` steps.
    """
    if shape != RECORD:
        rows = scales[:, np.newaxis]
        return pulse_outcomes_of(
            block, shape, rows, amplitudes, tolerance=tolerance, threads=threads
        )
    size = (len(scales), len(amplitudes))
    pairs = np.repeat(scales, size[1]), np.tile(amplitudes, size[0])
    which, lifts = np.zeros(pairs[0].size, np.int64), np.zeros(pairs[0].size)
    given = ([block], which, *pairs, lifts, record)
    found = _record_outcomes(*given, tolerance=tolerance, in_full=True, threads=threads)
    peak, overturned, impacts = found
    return peak.reshape(size), overturned.reshape(size), impacts.reshape(size)


def mixed_outcomes_of(
    blocks: Sequence[Oscillator],
    shape: int,
    which: Indices,
    scales: Array,
    amplitudes: Array,
    record: Array = NO_RECORD,
    *,
    lifts: Array | None = None,
    tolerance: float = TOLERANCE,
    in_full: bool = True,
    threads: int | None = None,
) -> Outcomes:
    """Return the outcomes of histories of several blocks, each with its scale and amplitude.

    Parameters
    ----------
    which : array of int, shape (n,)
        The block of each history, by its place in `blocks`.
    scales, amplitudes : array, shape (n,)
        The rest is as of `outcomes_of`.
    lifts : array, shape (n,), optional
        The factors on the vertical record, of `forcing.prepare_two_records`.
    in_full : bool
        If not, a history under a record ends once it is sure to survive (`tail.safe_speed`), and
        its peak and impacts are those so far.

    Returns
    -------
    peak, overturned, impacts : array, shape (n,)
    """
    peak, overturned = np.empty(which.size), np.empty(which.size, dtype=bool)
    impacts = np.empty(which.size, dtype=np.int64)
    lifts = np.zeros(which.size) if lifts is None else lifts
    linearised = np.array([block.linearised for block in blocks])
    for kind in (False, True):  # the lanes follow one equation at a time
        (members,), (at,) = np.nonzero(linearised == kind), np.nonzero(linearised[which] == kind)
        if not at.size:
            continue
        alike = [blocks[number] for number in members.tolist()]
        of, scale, amplitude = np.searchsorted(members, which[at]), scales[at], amplitudes[at]
        if shape == RECORD:
            given = (alike, of, scale, amplitude, lifts[at], record)
            found = _record_outcomes(*given, tolerance=tolerance, in_full=in_full, threads=threads)
        else:
            cells = (of[np.newaxis], scale[np.newaxis], amplitude[np.newaxis])
            found = _pulse_outcomes(alike, shape, *cells, tolerance, threads)
        peak[at], overturned[at], impacts[at] = (values.ravel() for values in found)
    return peak, overturned, impacts


def pulse_outcomes_of(
    block: Oscillator,
    shape: int,
    scales: Array,
    amplitudes: Array,
    *,
    tolerance: float = TOLERANCE,
    threads: int | None = None,
) -> Outcomes:
    """Return the outcomes of pulses, of all that broadcasting `scales` and `amplitudes` makes.

    The results have two axes, as that has; the rest is as of `outcomes_of`.
    """
    only = np.zeros((1, 1), np.int64)
    return _pulse_outcomes([block], shape, only, scales, amplitudes, tolerance, threads)


def _pulse_outcomes(
    blocks: Sequence[Oscillator],
    shape: int,
    which: Indices,
    scales: Array,
    amplitudes: Array,
    tolerance: float,
    threads: int | None,
) -> Outcomes:
    """Return the outcomes of all that broadcasting the last three makes; blocks of one equation."""
    size = np.broadcast_shapes(scales.shape, amplitudes.shape)
    peak, overturned = np.empty(size), np.empty(size, dtype=bool)
    impacts = np.empty(size, dtype=np.int64)
    # Copies in C order: for arrays that are strided, transposed or read-only it would compile anew.
    cells = [np.array(np.atleast_2d(each), order="C") for each in (which, scales, amplitudes)]
    histories, results = (blocks[0], _rows(blocks), *cells), (peak, overturned, impacts)
    given = (histories, shape, NO_RECORD, PULSE_ORDER, tolerance, results)
    lost = _shared(pulse_outcomes, given, (peak.size, FEWEST_PULSES, 1), threads)
    if lost >= 0:
        of, scale, amplitude = (np.broadcast_to(each, size).flat[lost] for each in cells)
        raise _unresolved(blocks[int(of)], shape, float(scale), float(amplitude))
    return peak, overturned, impacts


def _record_outcomes(
    blocks: Sequence[Oscillator],
    which: Indices,
    steps: Array,
    factors: Array,
    lifts: Array,
    record: Array,
    *,
    tolerance: float,
    in_full: bool,
    threads: int | None,
) -> Outcomes:
    """Return the outcomes of histories under a record, each with its block, p Δt and factors."""
    peak, overturned = np.empty(which.size), np.empty(which.size, dtype=bool)
    impacts = np.empty(which.size, dtype=np.int64)
    vertical = record if record.shape[0] > UP else None
    histories = (blocks[0], _rows(blocks), which, steps, factors, lifts)
    given = (histories, record, vertical, tolerance, in_full, (peak, overturned, impacts))
    size = (which.size, FEWEST_FACTORS, record.shape[1])
    lost = _shared(record_outcomes, given, size, threads)
    if lost >= 0:
        raise _unresolved(blocks[which[lost]], RECORD, float(steps[lost]), float(factors[lost]))
    return peak, overturned, impacts


def _rows(blocks: Sequence[Oscillator]) -> Array:
    """Return the blocks as the lanes take them: a row of floats each."""
    return np.array([block[:5] for block in blocks])


def _shared(
    work: Callable[..., int],
    given: tuple[Any, ...],
    size: tuple[int, int, int],
    threads: int | None,
) -> int:
    """Let the threads do all cells, in batches; return the first cell given up, or −1.

    The size is that of the cells, of the smallest batch, and of the samples of a record.
    """
    cells, fewest, samples = size
    batches = max(1, min(BATCHES, cells // fewest))
    if batches == 1 and cells * samples <= LONG:
        return int(work((rows(ROWS), working_array()), (0, 1), *given))
    threads = threads or cores()
    if threads == 1:
        batches = 1  # so that no lane idles at the end of any but the last cells

    def do(batch: int, workspace: Array) -> int:
        return int(work((rows(ROWS), workspace), (batch, batches), *given))

    lost = in_threads([partial(do, batch) for batch in range(batches)], min(threads, batches))
    return min((cell for cell in lost if cell >= 0), default=-1)


def cores() -> int:
    """Return how many cores the process may use, or OMP_NUM_THREADS if that is less.

    Snakemake sets it for each job: with jobs on all cores, a second thread only costs time.
    """
    own, asked = len(os.sched_getaffinity(0)), os.environ.get("OMP_NUM_THREADS", "")
    return min(own, int(asked)) if asked.isdigit() and int(asked) > 0 else own


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
) -> Outcome:
    """Return the outcome of one history, by the scalar kernel; see `outcomes_of` and `outcome`."""
    if shape == RECORD:
        forcing = record_forcing(record, scale, amplitude, lift)
        order = record_order(scale, tolerance)
    else:
        forcing, order = pulse_forcing(shape, amplitude, scale), PULSE_ORDER

    def call(workspace: Array) -> Outcome:
        found: Outcome = outcome(workspace, order, tolerance, block, forcing, record, ratios)
        return found

    found = in_threads([call])[0] if record.shape[1] > LONG else call(working_array())
    if not found.resolved:
        raise _unresolved(block, shape, scale, amplitude)
    return found


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
