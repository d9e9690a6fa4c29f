"""Outcomes of many pulses, one history in each lane (see `steps`).

All lanes take their steps together, each a step of its own length. A lane whose history is over
takes up the next cell.
"""

import math

from topheavy.kernel.compiled import compiled
from topheavy.kernel.forcing import (
    ANTISYMMETRIC_PEAK,
    KAPPA,
    RICKER_ANTISYMMETRIC,
    RICKER_SYMMETRIC,
    UNIT_BOUND,
)
from topheavy.kernel.lanes.histories import fill, history_of, lift_off, put, rests
from topheavy.kernel.lanes.steps import MAX_ORDER, advance, block_of_lanes, evaluate, impact
from topheavy.kernel.lanes.vectors import (
    WIDTH,
    absolute,
    bits,
    exponential,
    fields,
    first_lane,
    fma,
    select,
    square_root,
)
from topheavy.kernel.rest import next_tick
from topheavy.kernel.step import HALT, MAX_STEPS, PULSE_ORDER
from topheavy.kernel.tail import free_rocking, is_poised

assert PULSE_ORDER <= MAX_ORDER

#: In place of the number of impacts: the history ends poised at the barrier, and the scalar kernel
#: is to follow it, so that a map and `judge` agree up to the last bits of a boundary.
POISED = -1


@compiled(forceinline=True)
def is_certain(v, block, rotation, velocity):
    """Return the lanes whose blocks are certain to overturn (see `step.is_certain_to_overturn`).

    The arc tangent is replaced by a bound, atan x ≤ πx/(1 + 2√(1 + x²)) (Fink 1995).
    """
    strength = UNIT_BOUND * absolute(v.factor)
    outward = (rotation > block.slenderness) & (velocity > 0.0)
    if block.linearised:
        return outward & (velocity > block.slenderness + strength - rotation)
    root = square_root(fma(strength, strength, 1.0 + 0.0 * strength))
    balance = math.pi * strength / (1.0 + 2.0 * root) + block.slenderness
    comes_back = velocity <= square_root(root) * (balance - rotation)
    return outward & (balance < block.flat) & ~comes_back


@compiled(forceinline=True)
def renew_push(v, level, shape):
    """Set the push to that of a Ricker wavelet: its series leave out terms that would add up."""
    kappa = v.frequency * KAPPA[shape]
    y = kappa * (v.time - v.centre)
    square = y * y
    bell = v.factor * exponential(-square)
    if shape == RICKER_SYMMETRIC:
        value, rate = fma(square, -2.0, 1.0), y * fma(square, 4.0, -6.0)
    else:
        bell = bell * (math.sqrt(2) / ANTISYMMETRIC_PEAK)
        value, rate = y * fma(square, 2.0, -3.0), fma(square, fma(square, -4.0, 12.0), -3.0)
    v.push[0] = fma(bell, value, -level)
    v.push[1] = bell * rate * kappa


@compiled(nogil=True)
def pulse_outcomes(batch, alone, cells, span, tolerance, results):
    """Fill the results of a span of cells; see `grid.outcomes_of`.

    Parameters
    ----------
    batch, alone : array
        As of `steps.new_batch`; a working array for steps that a lane takes alone, which may say
        halt (`step.HALT`).
    span : int, int
        The first cell, and the one after the last.

    Returns
    -------
    int
        The first cell that was given up (see `step.MAX_STEPS`), or −1.
    """
    w = batch[0]
    v, (cell, last), shape = fields(w), span, cells.shape
    unresolved, busy, vacant = -1, 0, (1 << WIDTH) - 1
    while True:  # each time around a lane takes one of its `MAX_STEPS` steps, or there is none left
        if vacant:
            started, cell = fill(w, cells, results, vacant, cell, last, True)
            busy, vacant = busy & ~vacant | started, 0
        if busy == 0:
            return unresolved
        if alone[HALT, 0] != 0.0:
            return int(w.cell[int(alone[HALT, 1])])
        block = block_of_lanes(v, cells.flat, cells.linearised)
        landed, fallen = advance(w, alone, block, PULSE_ORDER, tolerance, False, busy)
        time = select(v.step >= v.longest, v.end, v.time + v.step)
        v.time = time
        v.longest = v.end - time
        rotation, velocity = evaluate(v, block, PULSE_ORDER, busy)
        if shape in (RICKER_SYMMETRIC, RICKER_ANTISYMMETRIC):
            renew_push(v, block.level, shape)
        fallen |= bits(is_certain(v, block, rotation, velocity)) & busy
        landed = (landed | bits(rotation <= 0.0) & busy) & ~fallen
        resting = impact(v, block, False, landed) if landed else 0
        over = bits(time >= v.end) & busy
        events = fallen | over | resting | bits(v.steps > MAX_STEPS) & busy
        while events:
            lane = first_lane(events)
            events &= events - 1
            number = int(w.cell[lane])
            own_block, forcing = history_of(cells, number)
            overturned, peak, impacts = False, w.peak[lane], int(w.impacts[lane])
            if fallen >> lane & 1:
                overturned = True
            elif over >> lane & 1:
                tail = free_rocking(own_block, w.rotation[0, lane], w.velocity[0, lane])
                overturned, peak = tail.overturned, max(peak, tail.peak)
                impacts += tail.impacts
                if is_poised(own_block, w.rotation[0, lane], w.velocity[0, lane]):
                    impacts = POISED
            elif w.steps[lane] > MAX_STEPS:
                unresolved = number if unresolved < 0 else min(unresolved, number)
            elif not rests(w, lane, own_block, forcing) or lift_off(
                w, lane, own_block, forcing, next_tick(w.time[lane])
            ):
                continue
            put(results, number, overturned, peak, impacts)
            vacant |= 1 << lane
