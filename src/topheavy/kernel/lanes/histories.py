"""Histories that the lanes take up, one after the other, and their uplift and rest.

When a block is lifted and whether it comes to rest is decided for each lane alone, by the functions
of the scalar kernel.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from topheavy.kernel.compiled import compiled
from topheavy.kernel.forcing import (
    IMPULSE,
    RECORD,
    Array,
    equation,
    forcing_of,
    ground,
    next_uplift,
    piece_of,
    piece_start,
)
from topheavy.kernel.lanes.vectors import first_lane
from topheavy.kernel.rest import comes_to_rest
from topheavy.kernel.tail import safe_speed
from topheavy.kernel.taylor import Oscillator, State


class Cells(NamedTuple):
    """The histories of one call: what all of them share, and arrays with a value for each.

    Attributes
    ----------
    shape, record
        As in `forcing.Forcing`.
    flat, linearised
        As in `taylor.Oscillator`.
    blocks : array, shape (number of blocks, 5)
        α, √r, level, cos α and sin α.
    which : array of int
        The row of `blocks` for each cell.
    scales, amplitudes, verticals : array
        ω/p or p Δt, amplitude or factor, and the factor on the vertical record, of each cell.
    """

    shape: int
    record: Array
    flat: float
    linearised: bool
    blocks: Array
    which: NDArray[np.int64]
    scales: Array
    amplitudes: Array
    verticals: Array


class Results(NamedTuple):
    """The results of the cells: peak rotation, whether it overturns, and impacts."""

    peaks: Array
    overturned: NDArray[np.bool_]
    impacts: NDArray[np.int64]


@compiled
def history_of(cells, cell):
    """Return the block and the forcing of a cell."""
    row, scale = cells.blocks[cells.which[cell]], cells.scales[cell]
    amplitude, vertical = cells.amplitudes[cell], cells.verticals[cell]
    block = Oscillator(row[0], row[1], row[2], row[3], row[4], cells.flat, cells.linearised)
    return block, forcing_of(cells.shape, cells.record, scale, amplitude, vertical)


@compiled
def lift_off(w, lane, block, forcing, time):
    """Let a block at rest wait for its next uplift; return whether there is one that may matter."""
    time, push, rate, side = next_uplift(forcing, time, block.level)
    if time >= forcing.end:
        return False
    longest = forcing.end - time
    if forcing.shape == RECORD:
        piece = piece_of(forcing, time)
        impulse = abs(forcing.amplitude) * forcing.step * forcing.record[IMPULSE, piece]
        if impulse < w.safe_speed[lane]:
            return False
        w.piece[lane], longest = piece, piece_start(forcing, piece + 1) - time
        _, _, w.gravity[lane], w.gravity_rate[lane] = ground(forcing, time)
    w.time[lane], w.longest[lane], w.flight_peak[lane] = time, longest, 0.0
    w.side[lane], w.factor[lane] = side, -side * forcing.amplitude
    w.rotation[0, lane] = w.velocity[0, lane] = w.sine[0, lane] = 0.0
    w.cosine[0, lane] = 1.0
    w.push[0, lane], w.push[1, lane] = push, rate
    return True


@compiled
def rests(w, lane, block, forcing):
    """Return whether the block of a lane comes to rest after its impact."""
    velocity, push, rate = w.velocity[0, lane], w.push[0, lane], w.push[1, lane]
    state = State(w.time[lane], w.side[lane], 0.0, velocity, 0.0, 1.0, push, rate, 1.0, 0.0)
    return comes_to_rest(block, forcing, state, w.peak[lane])


@compiled
def clear(w, lane):
    """Let a lane take steps of no length."""
    w.time[lane], w.longest[lane], w.peak[lane], w.flight_peak[lane] = 0.0, 0.0, 0.0, 0.0
    w.impacts[lane], w.steps[lane], w.factor[lane], w.piece[lane] = 0.0, 0.0, 0.0, 0.0
    w.rotation[0, lane] = w.velocity[0, lane] = w.sine[0, lane] = 0.0
    w.cosine[0, lane] = 1.0
    w.push[0, lane], w.push[1, lane] = 0.0, 0.0


@compiled
def begin(w, lane, block, forcing, in_full):
    """Let the block stand in a lane at the start of its history."""
    clear(w, lane)
    w.slenderness[lane], w.restitution[lane], w.level[lane] = block[:3]
    w.cos_alpha[lane], w.sin_alpha[lane] = block.cosine, block.sine
    w.inverse_cosine[lane] = 1.0 / block.cosine
    w.safe_speed[lane] = 0.0 if in_full else safe_speed(block)
    w.sampling[lane], w.vertical[lane] = forcing.step, forcing.vertical
    w.end[lane], w.frequency[lane] = forcing.end, forcing.frequency
    c, d0, d1 = equation(forcing, 0.0)
    w.c[lane], w.d1[lane], w.centre[lane] = c, d1, -d0 / d1 if d1 > 0.0 else 0.0


@compiled
def fill(w, cells, results, vacant, cell, last, in_full):
    """Let vacant lanes take up cells that begin to rock; return their bits and the next cell.

    Parameters
    ----------
    vacant : int
        Bits of the lanes.
    cell, last : int
        The next cell, and the one before which to stop.
    in_full : bool
        Whether a history is followed once it is sure to survive: only then are the peak and the
        impacts those of all of it.
    """
    busy = 0
    while vacant:
        lane, is_busy = first_lane(vacant), False
        vacant &= vacant - 1
        while cell < last and not is_busy:
            block, forcing = history_of(cells, cell)
            begin(w, lane, block, forcing, in_full)
            is_busy = lift_off(w, lane, block, forcing, 0.0)
            if is_busy:
                busy |= 1 << lane
            else:
                put(results, cell, False, 0.0, 0)
            w.cell[lane] = cell
            cell += 1
        if not is_busy:
            clear(w, lane)
    return busy, cell


@compiled
def put(results, cell, overturned, peak, impacts):
    """Write the result of a cell."""
    results.peaks[cell] = math.nan if overturned else peak
    results.overturned[cell], results.impacts[cell] = overturned, impacts
