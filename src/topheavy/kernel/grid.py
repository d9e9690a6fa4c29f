"""Many rocking histories at once: the outcome of every pair of a scale and an amplitude.

A scale is ω/p of a pulse, p Δt of a record. All cores work on it; no result depends on how many.
"""

import math
import os
from functools import partial

import numpy as np
from numba import njit
from numpy.typing import NDArray

from topheavy.kernel.forcing import NO_RECORD, RECORD, SHAPES, pulse_forcing, record_forcing
from topheavy.kernel.interrupt import LONG, in_threads
from topheavy.kernel.outcome import MAX_STEPS, PULSE_ORDER, TOLERANCE, outcome, working_array
from topheavy.kernel.taylor import Oscillator

Array = NDArray[np.float64]

#: Cells are dealt out to this many hands, which the threads take up as they come free: cell i goes
#: to hand i mod HANDS, so that each has its share of the dear ones. No result depends on it.
HANDS = 64
#: So few cells are done before a second thread would have started.
SMALL = 100


@njit(cache=True, nogil=True, error_model="numpy")
def outcomes(
    w, hand, block, shape, scales, amplitudes, record, order, tolerance, peak, overturned, impacts
):
    """Fill one hand's cells of `peak`, `overturned` and `impacts`.

    Threads call this without Python's lock. (The default layer of numba's own `prange` must not be
    entered from two threads.)

    Parameters
    ----------
    w : array
        The working array; the cells that are left are left out once it says halt.
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
        The first cell that was given up (see `outcome.MAX_STEPS`), or −1.
    """
    columns = amplitudes.size
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
        if not result.resolved:
            return cell
    return -1


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

    def deal(hand: int, w: Array) -> int:
        return int(outcomes(w, hand, *given, peak, overturned, impacts))

    hands = range(min(HANDS, peak.size))
    is_small = peak.size <= SMALL
    if is_small and peak.size * record.shape[1] <= LONG:
        w = working_array()
        lost = [deal(hand, w) for hand in hands]
    else:
        threads = threads or (1 if is_small else len(os.sched_getaffinity(0)))
        lost = in_threads([partial(deal, hand) for hand in hands], threads)
    if max(lost) >= 0:
        i, j = divmod(min(cell for cell in lost if cell >= 0), len(amplitudes))
        raise ArithmeticError(_unresolved(block, shape, float(scales[i]), float(amplitudes[j])))
    return peak, overturned, impacts


def _unresolved(block: Oscillator, shape: int, scale: float, amplitude: float) -> str:
    forcing = f"{amplitude:.6g} times the record with p Δt = {scale:.6g}"
    if shape != RECORD:
        name = next(name for name, number in SHAPES.items() if number == shape)
        forcing = f"the {name} pulse of {amplitude:.6g} g with ω/p = {scale:.6g}"
    equation = "linearised" if block.linearised else "exact"
    return (
        f"{MAX_STEPS} steps and ten a sample do not reach the end of {forcing}: the block "
        f"(slenderness {block.slenderness:.6g} rad, restitution {block.restitution:.6g}, "
        f"{equation} equation) bounces too often; a smaller restitution lets it come to rest"
    )
