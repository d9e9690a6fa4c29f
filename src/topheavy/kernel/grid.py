"""Many rocking histories at once: outcomes of blocks under pulses of one shape, or one record.

A scale is ω/p of a pulse, p Δt of a record. The histories run in the lanes of the CPU
(`kernel.lanes`), on all cores; no result depends on how many
lanes or cores there are, or on which histories run beside each other.
"""

import math
import os
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from topheavy.kernel.forcing import NO_RECORD, RECORD, SHAPES, pulse_forcing, record_forcing
from topheavy.kernel.interrupt import LONG, in_threads
from topheavy.kernel.lanes.pulses import pulse_outcomes
from topheavy.kernel.lanes.records import record_outcomes
from topheavy.kernel.lanes.steps import ROWS
from topheavy.kernel.lanes.vectors import HAS_FMA, WIDTH, rows
from topheavy.kernel.outcome import NO_RATIOS, NO_SAMPLES, Outcome, outcome
from topheavy.kernel.step import MAX_STEPS, PULSE_ORDER, TOLERANCE, working_array
from topheavy.kernel.taylor import Oscillator

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Outcomes = tuple[Array, NDArray[np.bool_], NDArray[np.int64]]

#: Cells are split into at most so many batches of neighbours, which do much the same in all lanes.
#: Threads take up the batches as they come free.
BATCHES = 64
#: How many histories run at once in a core, and whether it multiplies and adds in one operation.
LANES, FUSED = WIDTH, HAS_FMA
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

    Returns
    -------
    peak, overturned, impacts : array, shape (n,)
        As in `outcome.Outcome`.

    Raises
    ------
    ArithmeticError
        For a history that takes more than `step.MAX_STEPS` steps.
    """
    results = np.empty(which.size), np.empty(which.size, bool), np.empty(which.size, np.int64)
    lifts = np.zeros(which.size) if lifts is None else lifts
    linearised = np.array([block.linearised for block in blocks])[which]
    # A row of floats for each block; cells in C order, as for other arrays it would compile anew.
    rows = np.array([block[:5] for block in blocks])
    for equation in (False, True):  # the lanes follow one equation at a time
        (at,) = np.nonzero(linearised == equation)
        if not at.size:
            continue
        cells = [np.ascontiguousarray(values[at]) for values in (which, scales, amplitudes, lifts)]
        some = tuple(np.empty(at.size, values.dtype) for values in results)
        histories = (blocks[which[at[0]]], rows)
        if shape == RECORD:
            given: Any = ((*histories, *cells), record, tolerance, in_full, some)
            size = (at.size, FEWEST_FACTORS, record.shape[1])
            lost = _shared(record_outcomes, given, size, threads)
        else:
            none = (NO_RECORD, NO_RATIOS, NO_SAMPLES)
            given = ((*histories, *cells[:3]), shape, none, PULSE_ORDER, tolerance, some)
            lost = _shared(pulse_outcomes, given, (at.size, FEWEST_PULSES, 1), threads)
        if lost >= 0:
            number, scale, amplitude = (values[lost] for values in cells[:3])
            raise _unresolved(blocks[number], shape, float(scale), float(amplitude))
        for values, found in zip(results, some, strict=True):
            values[at] = found
    return results


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
        given = (order, tolerance, block, forcing, record, ratios, NO_SAMPLES)
        found: Outcome = outcome(workspace, *given)
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
