"""Many rocking histories at once: the outcome of every pair of a scale and an amplitude.

A scale is ω/p of a pulse, p Δt of a record. All cores work on it; no result depends on how many.
"""

import math
import os
from concurrent.futures import ThreadPoolExecutor

import numpy as np
from numba import njit
from numpy.typing import NDArray

from topheavy.kernel.forcing import NO_RECORD, RECORD, pulse_forcing, record_forcing
from topheavy.kernel.outcome import PULSE_ORDER, TOLERANCE, outcome, working_array
from topheavy.kernel.taylor import Oscillator

Array = NDArray[np.float64]

#: Cells are dealt out to this many hands, which the threads take up as they come free: cell i goes
#: to hand i mod HANDS, so that each has its share of the dear ones. No result depends on it.
HANDS = 64
#: So few cells are done before a second thread would have started.
SMALL = 100


@njit(cache=True, nogil=True, error_model="numpy")
def outcomes(
    hand, block, shape, scales, amplitudes, record, order, tolerance, peak, overturned, impacts
):
    """Fill one hand's cells of `peak`, `overturned` and `impacts`.

    Threads call this without Python's lock. (The default layer of numba's own `prange` must not be
    entered from two threads.)

    Parameters
    ----------
    scales : array
        Of a pulse, ω/p; of a record, p Δt.
    amplitudes : array
        In g; of a record, the factors on it.
    record : array
        As `forcing.prepare_record` gives it.
    peak, overturned, impacts : array, shape (len(scales), len(amplitudes))

    Returns
    -------
    int
        The number of cells that were given up (see `outcome.MAX_STEPS`).
    """
    lost, columns = 0, amplitudes.size
    w = working_array()
    for cell in range(hand, scales.size * columns, HANDS):
        i, j = cell // columns, cell % columns
        if shape == RECORD:
            forcing = record_forcing(record, scales[i], amplitudes[j])
        else:
            forcing = pulse_forcing(shape, amplitudes[j], scales[i])
        result = outcome(w, order, tolerance, block, forcing, record)
        peak[i, j] = result.peak
        overturned[i, j] = result.overturned
        impacts[i, j] = result.impacts
        lost += 0 if result.resolved else 1
    return lost


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
    """Return peak, overturned and impacts of all pairs; see `outcomes`.

    `threads` is one for each core that the process may use, unless given.
    """
    size = (len(scales), len(amplitudes))
    peak, overturned = np.empty(size), np.empty(size, dtype=bool)
    impacts = np.empty(size, dtype=np.int64)
    order = record_order(max(scales), tolerance) if shape == RECORD else PULSE_ORDER
    given = (block, shape, scales, amplitudes, record, order, tolerance)

    def deal(hand: int) -> int:
        return int(outcomes(hand, *given, peak, overturned, impacts))

    hands = range(min(HANDS, peak.size))
    threads = threads or len(os.sched_getaffinity(0))
    if threads == 1 or peak.size <= SMALL:
        lost = sum(map(deal, hands))
    else:
        with ThreadPoolExecutor(threads) as pool:
            lost = sum(pool.map(deal, hands))
    if lost:
        raise ArithmeticError(
            f"{lost} of {peak.size} histories bounce too often to be followed to the end of "
            f"the forcing (restitution {block.restitution}); a smaller restitution lets them come "
            "to rest"
        )
    return peak, overturned, impacts
