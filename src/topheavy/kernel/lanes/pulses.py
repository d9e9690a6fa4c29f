"""Outcomes of many pulses, one history in each lane (see `steps`).

A history that ends poised at the barrier is followed once more by the scalar kernel, so that a map
and `judge` tell the same up to the last bits of a boundary.

All lanes take their steps together, each a step of its own length. A lane whose history is over
takes up the next cell. What follows from the physics of one history (the next uplift, coming to
rest, the free rocking after the pulse) is done by the functions of the scalar kernel.
"""

import math

from topheavy.kernel.compiled import compiled
from topheavy.kernel.forcing import (
    ANTISYMMETRIC_PEAK,
    KAPPA,
    RICKER_ANTISYMMETRIC,
    RICKER_SYMMETRIC,
    UNIT_BOUND,
    equation,
    next_uplift,
    pulse_forcing,
)
from topheavy.kernel.lanes.steps import (
    CELL,
    CENTRE,
    D1,
    END,
    FACTOR,
    FREQUENCY,
    IMPACTS,
    LENGTH,
    LONGEST,
    MAX_ORDER,
    PEAK,
    PUSH,
    ROTATION,
    STEPS,
    TIME,
    VELOCITY,
    C,
    advance,
    finish,
    lift,
    numbered,
    rests,
    seat,
    seated,
    still,
    strike,
)
from topheavy.kernel.lanes.vectors import (
    WIDTH,
    absolute,
    bits,
    exponential,
    first_lane,
    fma,
    load,
    select,
    square_root,
    store,
)
from topheavy.kernel.outcome import outcome
from topheavy.kernel.rest import next_tick
from topheavy.kernel.step import HALT, MAX_STEPS, PULSE_ORDER
from topheavy.kernel.tail import free_rocking, is_poised

assert PULSE_ORDER <= MAX_ORDER


@compiled
def begin(w, lane, block, forcing, record):
    """Let a block stand in a lane; return whether the pulse lifts it."""
    still(w, lane)
    seat(w, lane, block)
    time, push, rate, side = next_uplift(forcing, record, 0.0, block.level)
    if time >= forcing.end:
        return False
    lift(w, lane, time, push, rate, side, forcing.amplitude)
    w[END, lane], w[FREQUENCY, lane] = forcing.end, forcing.frequency
    w[LONGEST, lane] = forcing.end - time
    c, d0, d1 = equation(forcing, 0.0)
    w[C, lane], w[D1, lane], w[CENTRE, lane] = c, d1, -d0 / d1 if d1 > 0.0 else 0.0
    return True


@compiled(forceinline=True)
def certain(w, block, rotation, velocity):
    """Return the lanes whose blocks are certain to overturn (see `step.is_certain_to_overturn`).

    The arc tangent is replaced by a bound, atan x ≤ πx/(1 + 2√(1 + x²)) (Fink 1995).
    """
    strength = UNIT_BOUND * absolute(load(w, FACTOR))
    outward = (rotation > block.slenderness) & (velocity > 0.0)
    if block.linearised:
        return outward & (velocity > block.slenderness + strength - rotation)
    whole = square_root(fma(strength, strength, 1.0 + 0.0 * strength))
    balance = math.pi * strength / (1.0 + 2.0 * whole) + block.slenderness
    held = velocity <= square_root(whole) * (balance - rotation)
    return outward & (balance < block.flat) & ~held


@compiled(forceinline=True)
def renew(w, level, shape):
    """Take the push of a Ricker wavelet from the wavelet (see `step.renewed`)."""
    kappa, factor = load(w, FREQUENCY) * KAPPA[shape], load(w, FACTOR)
    y = kappa * (load(w, TIME) - load(w, CENTRE))
    square = y * y
    bell = factor * exponential(-square)
    if shape == RICKER_SYMMETRIC:
        value, rate = fma(square, -2.0, 1.0), y * fma(square, 4.0, -6.0)
    else:
        bell = bell * (math.sqrt(2) / ANTISYMMETRIC_PEAK)
        value, rate = y * fma(square, 2.0, -3.0), fma(square, fma(square, -4.0, 12.0), -3.0)
    store(w, PUSH, fma(bell, value, -level))
    store(w, PUSH + 1, bell * rate * kappa)


@compiled
def lifts_again(w, lane, block, forcing, record):
    """Let the block of a lane wait at rest; return whether the pulse lifts it again."""
    time, push, rate, side = next_uplift(forcing, record, next_tick(w[TIME, lane]), block.level)
    if time >= forcing.end:
        return False
    lift(w, lane, time, push, rate, side, forcing.amplitude)
    w[LONGEST, lane] = forcing.end - time
    return True


@compiled(nogil=True)
def pulse_outcomes(workspaces, part, histories, shape, none, order, tolerance, outcomes):
    """Fill one of as many parts of the cells as there are batches; see `grid.outcomes_of`.

    Parameters
    ----------
    workspaces, part, outcomes
        As of `records.record_outcomes`.
    histories
        The blocks, as `numbered` takes them, and the number of the block, scale and amplitude of
        each cell.
    none : array, array, tuple
        `NO_RECORD`, `NO_RATIOS`, `NO_SAMPLES`. As arguments, not as constants, they have the types
        that they have in `grid.outcome_of`: what both call is then compiled but once.
    order : int
        That of the scalar kernel. A constant would have it compiled anew, to other last bits.

    Returns
    -------
    int
        The first cell that was given up (see `step.MAX_STEPS`), or −1.
    """
    (w, alone), (batch, batches), (peak, overturned, impacts) = workspaces, part, outcomes
    kind, blocks, which, scales, amplitudes = histories
    record, no_ratios, no_samples = none
    coming, last = batch * peak.size // batches, (batch + 1) * peak.size // batches
    lost, busy, vacant = -1, 0, (1 << WIDTH) - 1
    while True:  # each time around a lane takes one of its `MAX_STEPS` steps, or there is none left
        busy &= ~vacant
        while vacant:
            lane, lifted = first_lane(vacant), False
            vacant &= vacant - 1
            while coming < last and not lifted:
                forcing = pulse_forcing(shape, amplitudes[coming], scales[coming])
                lifted = begin(w, lane, numbered(kind, blocks, which[coming]), forcing, record)
                if not lifted:
                    peak[coming], overturned[coming], impacts[coming] = 0.0, False, 0
                w[CELL, lane] = coming
                coming += 1
            if lifted:
                busy |= 1 << lane
            else:
                still(w, lane)
        if busy == 0:
            return lost
        if alone[HALT, 0] != 0.0:
            return int(w[CELL, int(alone[HALT, 1])])
        block = seated(w, kind)
        landed, fallen = advance(w, alone, block, PULSE_ORDER, tolerance, False, busy)
        time, end, step = load(w, TIME), load(w, END), load(w, LENGTH)
        time = select(step >= load(w, LONGEST), end, time + step)
        store(w, TIME, time)
        store(w, LONGEST, end - time)
        rotation, velocity = finish(w, block, PULSE_ORDER, busy)
        if shape in (RICKER_SYMMETRIC, RICKER_ANTISYMMETRIC):
            renew(w, block.level, shape)
        fallen |= bits(certain(w, block, rotation, velocity)) & busy
        landed = (landed | bits(rotation <= 0.0) & busy) & ~fallen
        resting = strike(w, block, False, landed) if landed else 0
        over = bits(time >= end) & busy
        ending = fallen | over | resting | bits(load(w, STEPS) > MAX_STEPS) & busy
        while ending:
            lane = first_lane(ending)
            ending &= ending - 1
            cell = int(w[CELL, lane])
            own = numbered(kind, blocks, which[cell])
            fell, highest, count = False, w[PEAK, lane], w[IMPACTS, lane]
            if fallen >> lane & 1:
                fell = True
            elif over >> lane & 1:
                tail = free_rocking(own, w[ROTATION, lane], w[VELOCITY, lane])
                fell, highest = tail.overturned, max(highest, tail.peak)
                count += tail.impacts
                if is_poised(own, w[ROTATION, lane], w[VELOCITY, lane]):
                    forcing = pulse_forcing(shape, amplitudes[cell], scales[cell])
                    again = outcome(
                        alone, order, tolerance, own, forcing, record, no_ratios, no_samples
                    )
                    fell, highest, count = again.overturned, again.peak, again.impacts
                    if not again.resolved:
                        lost = cell if lost < 0 else min(lost, cell)
            elif w[STEPS, lane] > MAX_STEPS:
                lost = cell if lost < 0 else min(lost, cell)
            else:
                forcing = pulse_forcing(shape, amplitudes[cell], scales[cell])
                if not rests(w, lane, own, forcing, record):
                    continue
                if lifts_again(w, lane, own, forcing, record):
                    continue
            peak[cell] = math.nan if fell else highest
            overturned[cell], impacts[cell] = fell, count
            vacant |= 1 << lane
