"""Outcomes of many histories under one record.

Each lane has a history (see `steps`), and is at a piece of the record of its own. Most pieces are
passed over by the short series of `march`, which proves that they hold no event; a lane for which
it does not waits until as many lanes need the long series of `steps`. So both work with many lanes
at a time.
"""

from topheavy.kernel.compiled import compiled
from topheavy.kernel.forcing import A_END, A_START, IMPULSE, TIME, V_END, V_START
from topheavy.kernel.lanes.histories import fill, history_of, lift_off, put, rests
from topheavy.kernel.lanes.steps import advance, block_of_lanes, evaluate, impact
from topheavy.kernel.lanes.vectors import (
    WIDTH,
    absolute,
    bits,
    count_bits,
    fields,
    first_lane,
    fma,
    mask_of,
    maximum,
    minimum,
    select,
    take,
)
from topheavy.kernel.march import MAX_TURN, derivatives, powers
from topheavy.kernel.rest import MIN_COUNTED_PEAK, next_tick
from topheavy.kernel.step import HALT, MAX_STEPS, is_certain_to_overturn
from topheavy.kernel.tail import free_rocking
from topheavy.kernel.taylor import State

#: Terms of φ in a long step. A piece of p Δt = 0.1 takes one step at the usual tolerance.
RECORD_ORDER = 9
#: The long series waits until this share of the lanes or fewer go on without it.
MAX_MARCHING = WIDTH // 3


@compiled(forceinline=True)
def march_lanes(v, block, record, tolerance, marching):
    """Let the lanes of these bits pass over the pieces that they are at, as `march.march` does.

    Lanes whose piece is not proven to hold nothing are made ready for the long series over it.

    Returns
    -------
    int
        Bits of the lanes that passed.
    """
    bound, inverse_cosine = tolerance * block.slenderness, v.inverse_cosine
    piece, peak, start = v.piece, v.peak, take(record[TIME], v.piece)
    rotation, velocity, sine, cosine = v.rotation[0], v.velocity[0], v.sine[0], v.cosine[0]
    begin = start * v.sampling
    longest = (take(record[TIME], piece + 1.0) - start) * v.sampling
    h, h2, h3, h4, h5, h6, h7 = powers(longest)
    per_piece = 1.0 / h
    a_start, v_start = take(record[A_START], piece), take(record[V_START], piece)
    gravity = fma(v.vertical, v_start, h * 0.0 + 1.0)
    change = v.vertical * (take(record[V_END], piece) - v_start) * per_piece
    weight, weight_rate = inverse_cosine * gravity, inverse_cosine * change
    push = v.factor * a_start - block.level * gravity
    rate = v.factor * (take(record[A_END], piece) - a_start) * per_piece - block.level * change
    passed = 0
    if not block.linearised:
        tilt = fma(cosine, block.cosine, sine * block.sine)  # cos(α − φ)
        lean = fma(cosine, block.sine, -(sine * block.cosine))  # sin(α − φ)
        force = fma(push, tilt, sine * weight)  # Eq. (23)
        slope = fma(push, lean, cosine * weight)
        force_rate = fma(sine, weight_rate, rate * tilt)
        slope_rate = fma(cosine, weight_rate, rate * lean)
        d3, d4, d5, d6, d7 = derivatives(force, slope, force_rate, slope_rate, velocity)
        c1, c2, c3, c4 = velocity * h, force * h2, d3 * h3, d4 * h4
        c5, c6, c7 = d5 * h5, d6 * h6, d7 * h7
        others = absolute(c3) + absolute(c4) + absolute(c5) + absolute(c6) + absolute(c7)
        turn = c1 + c2 + (c3 + (c4 + (c5 + (c6 + c7))))
        rises = minimum(c1, c1 + 2.0 * c2) > 7.0 * others
        low = minimum(minimum(0.5 * c1, c1 + c2), 0.0) - others
        high = maximum(maximum(0.5 * c1, c1 + c2), 0.0) + others
        is_passed = rises | ((rotation + low > 0.0) & (rotation + high <= peak))
        is_passed = is_passed & (h6 * maximum(absolute(d7), 6.0 * absolute(d6)) <= bound)
        is_passed = is_passed & (absolute(turn) <= MAX_TURN) & (rotation <= block.slenderness)
        is_passed = is_passed & (v.flight_peak > MIN_COUNTED_PEAK * block.slenderness)
        is_passed = is_passed & (piece < record.shape[1] - 2.0) & mask_of(marching)
        gain = 2.0 * c2 + 3.0 * c3 + 4.0 * c4 + 5.0 * c5 + 6.0 * c6 + 7.0 * c7
        square = turn * turn  # sin and cos − 1 of a turn so small, to the last digit
        swing = turn + turn * square * (-1 / 6 + square * (1 / 120 - square * (1 / 5040)))
        drop = square * (-1 / 2 + square * (1 / 24 + square * (-1 / 720 + square * (1 / 40320))))
        v.velocity[0] = select(is_passed, fma(gain, per_piece, velocity), velocity)
        v.rotation[0] = select(is_passed, rotation + turn, rotation)
        v.peak = select(is_passed, maximum(peak, rotation + turn), peak)
        v.sine[0] = select(is_passed, sine + fma(cosine, swing, sine * drop), sine)
        v.cosine[0] = select(is_passed, cosine + (cosine * drop - sine * swing), cosine)
        v.piece = select(is_passed, piece + 1.0, piece)
        passed = bits(is_passed)
    if passed != marching:
        stopped, highest = mask_of(marching & ~passed), v.flight_peak
        is_rocking = (highest > MIN_COUNTED_PEAK * block.slenderness) & stopped
        v.flight_peak = select(is_rocking, peak, highest)
        v.push[0] = select(stopped, push, v.push[0])
        v.push[1] = select(stopped, rate, v.push[1])
        v.gravity = select(stopped, gravity, v.gravity)
        v.gravity_rate = select(stopped, change, v.gravity_rate)
        v.time = select(stopped, begin, v.time)
        v.longest = select(stopped, longest, v.longest)
    return passed


@compiled
def overturns(w, lane, block, forcing):
    """Return whether the block of a lane is certain to overturn."""
    rotation, velocity = w.rotation[0, lane], w.velocity[0, lane]
    state = State(w.time[lane], 1.0, rotation, velocity, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0)
    return is_certain_to_overturn(block, forcing, state)


@compiled(nogil=True)
def record_outcomes(batch, alone, cells, span, tolerance, in_full, results):
    """Fill the results of cells under a record, as `pulse_outcomes`; `in_full` is as in `fill`."""
    w, record = batch[0], cells.record
    v, (cell, last) = fields(w), span
    last_time = record[TIME, record.shape[1] - 1]
    most_steps = MAX_STEPS + 10 * record.shape[1]
    unresolved, vacant = -1, (1 << WIDTH) - 1
    marching, stepping = 0, 0
    # Each time around, a lane passes over a piece or takes one of its `most_steps` steps.
    while True:
        if vacant:
            marching, stepping = marching & ~vacant, stepping & ~vacant
            started, cell = fill(w, cells, results, vacant, cell, last, in_full)
            stepping, vacant = stepping | started, 0
        if marching | stepping == 0:
            return unresolved
        if alone[HALT, 0] != 0.0:
            return int(w.cell[int(alone[HALT, 1])])
        block = block_of_lanes(v, cells.flat, cells.linearised)
        if stepping == 0 or count_bits(marching) > MAX_MARCHING:
            passed = march_lanes(v, block, record, tolerance, marching)
            stepping |= marching & ~passed
            marching = passed
            continue
        landed, fallen = advance(w, alone, block, RECORD_ORDER, tolerance, True, stepping)
        step = v.step
        piece_end = take(record[TIME], v.piece + 1.0) * v.sampling
        time = select(step >= v.longest, piece_end, v.time + step)
        v.time = time
        rotation, velocity = evaluate(v, block, RECORD_ORDER, stepping)
        v.gravity = fma(step, v.gravity_rate, v.gravity)
        landed = (landed | bits(rotation <= 0.0) & stepping) & ~fallen
        resting = impact(v, block, True, landed) if landed else 0
        impulse = absolute(v.factor) * v.sampling * take(record[IMPULSE], v.piece)
        safe = bits(v.velocity[0] + impulse < v.safe_speed) & landed
        over = bits(time >= last_time * v.sampling) & stepping
        outward = bits((rotation > block.slenderness) & (velocity > 0.0)) & stepping
        unfinished = bits(v.steps > most_steps) & stepping
        ended = bits(time >= piece_end) & stepping & ~over
        v.longest = select(mask_of(stepping & ~ended), piece_end - time, 0.0)
        v.piece = select(mask_of(ended), v.piece + 1.0, v.piece)
        stepping &= ~ended
        marching |= ended
        events = fallen | safe | over | resting | outward | unfinished
        while events:
            lane = first_lane(events)
            events &= events - 1
            number = int(w.cell[lane])
            own_block, forcing = history_of(cells, number)
            overturned, peak = bool(fallen >> lane & 1), w.peak[lane]
            impacts = int(w.impacts[lane])
            if safe >> lane & 1 or overturned:
                pass
            elif over >> lane & 1:
                tail = free_rocking(own_block, w.rotation[0, lane], w.velocity[0, lane])
                overturned, peak = tail.overturned, max(peak, tail.peak)
                impacts += tail.impacts
            elif outward >> lane & 1 and overturns(w, lane, own_block, forcing):
                overturned = True
            elif unfinished >> lane & 1:
                unresolved = number if unresolved < 0 else min(unresolved, number)
            else:
                if not (resting >> lane & 1 and rests(w, lane, own_block, forcing)):
                    continue
                marching &= ~(1 << lane)
                stepping |= 1 << lane
                if lift_off(w, lane, own_block, forcing, next_tick(w.time[lane])):
                    continue
            put(results, number, overturned, peak, impacts)
            vacant |= 1 << lane
