"""Many rocking histories at once: the outcome of every pair of a scale and an amplitude.

A scale is ω/p of a pulse, p Δt of a record. The histories run in the lanes of `pulse_batch` and
`record_batch`, on all cores; no result depends on how many lanes or cores there are.
"""

import math
import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from functools import partial

import numpy as np
from numpy.typing import NDArray

from topheavy.kernel.forcing import NO_RECORD, RECORD
from topheavy.kernel.lanes import WIDTH
from topheavy.kernel.outcome import MAX_STEPS, PULSE_ORDER, TOLERANCE
from topheavy.kernel.pulse_batch import pulse_outcomes
from topheavy.kernel.record_batch import record_outcomes
from topheavy.kernel.taylor import Oscillator

Array = NDArray[np.float64]

#: Cells are split into at most so many batches, cell i into batch i mod BATCHES, so that expensive
#: cells spread evenly. Threads take up the batches as they come free.
BATCHES = 64
#: The least number of cells in a batch. Fewer would leave lanes idle at its end, or be done before
#: a second thread has started.
FEWEST_PULSES, FEWEST_FACTORS = 8 * WIDTH, WIDTH


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
) -> tuple[Array, NDArray[np.bool_], NDArray[np.int64]]:
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
        One for each core that the process may use, unless given.

    Returns
    -------
    peak, overturned, impacts : array, shape (len(scales), len(amplitudes))
        As in `outcome.Outcome`.

    Raises
    ------
    ArithmeticError
        For a history that takes more than `outcome.MAX_STEPS` steps.
    """
    size = (len(scales), len(amplitudes))
    peak, overturned = np.empty(size), np.empty(size, dtype=bool)
    impacts = np.empty(size, dtype=np.int64)
    threads = threads or len(os.sched_getaffinity(0))
    if shape == RECORD:
        for i, step in enumerate(scales):
            given = (block, step, amplitudes, record, tolerance, peak[i], overturned[i], impacts[i])
            lost = _shared(record_outcomes, given, len(amplitudes), FEWEST_FACTORS, threads)
            if lost >= 0:
                raise _unresolved(block, f"factor {amplitudes[lost]:.6g} on a record of p Δt", step)
        return peak, overturned, impacts
    cells = (block, shape, scales, amplitudes, tolerance, peak, overturned, impacts)
    lost = _shared(pulse_outcomes, cells, peak.size, FEWEST_PULSES, threads)
    if lost >= 0:
        i, j = divmod(lost, len(amplitudes))
        raise _unresolved(block, f"amplitude {amplitudes[j]:.6g} g at ω/p", scales[i])
    return peak, overturned, impacts


def _shared(work: Callable[..., int], given: tuple, cells: int, fewest: int, threads: int) -> int:
    """Let the threads do all batches; return the first cell that was given up, or -1."""
    batches = max(1, min(BATCHES, cells // fewest))
    one = partial(_batch, work, batches, given)
    if threads == 1 or batches == 1:
        lost = list(map(one, range(batches)))
    else:
        with ThreadPoolExecutor(threads) as pool:
            lost = list(pool.map(one, range(batches)))
    return min((cell for cell in lost if cell >= 0), default=-1)


def _batch(work: Callable[..., int], batches: int, given: tuple, batch: int) -> int:
    return int(work(batch, batches, *given))


def _unresolved(block: Oscillator, case: str, scale: float) -> ArithmeticError:
    return ArithmeticError(
        f"{case} = {scale:.6g}: the block (α = {block.slenderness:.6g}, √r = {block.restitution}) "
        f"bounces too often to be followed to the end of the forcing, in more than {MAX_STEPS} "
        "steps; a smaller √r lets it come to rest"
    )
