"""Outcomes of many histories under one record.

Each lane has a history (see `steps`), and is at a piece of the record of its own. Most pieces are
passed over by the short series of `march`, which proves that they hold no event; a lane for which
it does not waits until as many lanes need the long series of `steps`. So both work with many lanes
at a time. What follows from the physics of one history is done by the functions of the scalar
kernel.
"""

import math

from topheavy.kernel.compiled import compiled
from topheavy.kernel.forcing import (
    AT,
    IMPULSE,
    START,
    STOP,
    UP,
    UP_STOP,
    gravity,
    next_uplift,
    piece_of,
    piece_start,
    record_forcing,
)
from topheavy.kernel.lanes.steps import (
    ARC,
    CELL,
    CHANGE,
    COSINE,
    FACTOR,
    GRAVITY,
    IMPACTS,
    INVERSE_COS,
    LENGTH,
    LIFT,
    LONGEST,
    PEAK,
    PIECE,
    PUSH,
    ROTATION,
    SAFE_SPEED,
    SAMPLING,
    SINE,
    STEPS,
    TIME,
    VELOCITY,
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
    among,
    bits,
    first_lane,
    fma,
    load,
    maximum,
    minimum,
    number,
    select,
    store,
    take,
)
from topheavy.kernel.march import LARGEST_TURN, derivatives, powers
from topheavy.kernel.rest import LAST_BOUNCE, next_tick
from topheavy.kernel.step import HALT, MAX_STEPS, is_certain_to_overturn
from topheavy.kernel.tail import free_rocking, safe_speed
from topheavy.kernel.taylor import State

#: Terms of φ in a long step. A piece of p Δt = 0.1 takes one step at the usual tolerance.
RECORD_ORDER = 9
#: The long series waits until fewer than this share of the lanes go on without it.
FEW = WIDTH // 3


@compiled(forceinline=True)
def march_lanes(w, block, record, tolerance, marching):
    """Pass over the pieces that `marching` lanes are at, as far as they are proven to hold nothing.

    The terms and the proof are those of `march.march`. Lanes for which it fails are made ready for
    the long series over their piece.

    Parameters
    ----------
    tolerance : float
        Bound on the last term of φ', over α.

    Returns
    -------
    int
        Bits of the lanes that passed.
    """
    bound, inverse_cosine = tolerance * block.slenderness, load(w, INVERSE_COS)
    piece, factor, peak = load(w, PIECE), load(w, FACTOR), load(w, PEAK)
    rotation, velocity = load(w, ROTATION), load(w, VELOCITY)
    sine, cosine, start = load(w, SINE), load(w, COSINE), take(record[AT], piece)
    begin = start * load(w, SAMPLING)
    longest = (take(record[AT], piece + 1.0) - start) * load(w, SAMPLING)
    h, h2, h3, h4, h5, h6, h7 = powers(longest)
    per_piece = 1.0 / h
    before, after = take(record[START], piece), take(record[STOP], piece)
    lift, up = load(w, LIFT), take(record[UP], piece)
    gravity = fma(lift, up, h * 0.0 + 1.0)
    change = lift * (take(record[UP_STOP], piece) - up) * per_piece
    heavy, heavier = inverse_cosine * gravity, inverse_cosine * change
    push = factor * before - block.level * gravity
    rate = factor * (after - before) * per_piece - block.level * change
    passed = 0
    if not block.linearised:
        tilt = fma(cosine, block.cosine, sine * block.sine)  # cos(α − φ)
        lean = fma(cosine, block.sine, -(sine * block.cosine))  # sin(α − φ)
        force = fma(push, tilt, sine * heavy)  # Eq. (23)
        slope = fma(push, lean, cosine * heavy)
        bend, sway = fma(sine, heavier, rate * tilt), fma(cosine, heavier, rate * lean)
        d3, d4, d5, d6, d7 = derivatives(force, slope, bend, sway, velocity)
        c1, c2, c3, c4 = velocity * h, force * h2, d3 * h3, d4 * h4
        c5, c6, c7 = d5 * h5, d6 * h6, d7 * h7
        others = absolute(c3) + absolute(c4) + absolute(c5) + absolute(c6) + absolute(c7)
        turn = c1 + c2 + (c3 + (c4 + (c5 + (c6 + c7))))
        rises = minimum(c1, c1 + 2.0 * c2) > 7.0 * others
        low = minimum(minimum(0.5 * c1, c1 + c2), 0.0) - others
        high = maximum(maximum(0.5 * c1, c1 + c2), 0.0) + others
        fine = rises | ((rotation + low > 0.0) & (rotation + high <= peak))
        fine = fine & (h6 * maximum(absolute(d7), 6.0 * absolute(d6)) <= bound)
        fine = fine & (absolute(turn) <= LARGEST_TURN) & (rotation <= block.slenderness)
        fine = fine & (load(w, ARC) > LAST_BOUNCE * block.slenderness)
        fine = fine & (piece < record.shape[1] - 2.0) & among(marching)
        gain = 2.0 * c2 + 3.0 * c3 + 4.0 * c4 + 5.0 * c5 + 6.0 * c6 + 7.0 * c7
        square = turn * turn  # sin and cos − 1 of a turn so small, to the last digit
        swing = turn + turn * square * (-1 / 6 + square * (1 / 120 - square * (1 / 5040)))
        drop = square * (-1 / 2 + square * (1 / 24 + square * (-1 / 720 + square * (1 / 40320))))
        store(w, VELOCITY, select(fine, fma(gain, per_piece, velocity), velocity))
        store(w, ROTATION, select(fine, rotation + turn, rotation))
        store(w, PEAK, select(fine, maximum(peak, rotation + turn), peak))
        store(w, SINE, select(fine, sine + fma(cosine, swing, sine * drop), sine))
        store(w, COSINE, select(fine, cosine + (cosine * drop - sine * swing), cosine))
        store(w, PIECE, select(fine, piece + 1.0, piece))
        passed = bits(fine)
    if passed != marching:
        halted, arc = among(marching & ~passed), load(w, ARC)
        whole = (arc > LAST_BOUNCE * block.slenderness) & halted
        store(w, ARC, select(whole, peak, arc))
        store(w, PUSH, select(halted, push, load(w, PUSH)))
        store(w, PUSH + 1, select(halted, rate, load(w, PUSH + 1)))
        store(w, GRAVITY, select(halted, gravity, load(w, GRAVITY)))
        store(w, CHANGE, select(halted, change, load(w, CHANGE)))
        store(w, TIME, select(halted, begin, load(w, TIME)))
        store(w, LONGEST, select(halted, longest, load(w, LONGEST)))
    return passed


@compiled
def begin(w, lane, block, forcing, in_full):
    """Let a block stand in a lane, under a record; `in_full` is that of `record_outcomes`."""
    still(w, lane)
    seat(w, lane, block)
    w[SAFE_SPEED, lane] = 0.0 if in_full else safe_speed(block)
    w[SAMPLING, lane], w[LIFT, lane] = forcing.step, forcing.lift


@compiled
def lifts(w, lane, block, forcing, record, time):
    """Let the block of a lane wait at rest from `time` on; return whether it may overturn."""
    time, push, rate, side = next_uplift(forcing, record, time, block.level)
    if time >= forcing.end:
        return False
    piece = piece_of(forcing, record, time)
    if abs(forcing.amplitude) * forcing.step * record[IMPULSE, piece] < w[SAFE_SPEED, lane]:
        return False
    lift(w, lane, time, push, rate, side, forcing.amplitude)
    w[PIECE, lane], w[LONGEST, lane] = piece, piece_start(forcing, record, piece + 1) - time
    w[GRAVITY, lane], w[CHANGE, lane] = gravity(forcing, record, time)
    return True


@compiled
def overturns(w, lane, block, forcing, record):
    """Say whether the block of a lane is certain to overturn."""
    state = State(w[ROTATION, lane], w[VELOCITY, lane], 0.0, 1.0, 0.0, 0.0, 1.0, 0.0)
    return is_certain_to_overturn(block, forcing, record, w[TIME, lane], state)


@compiled(nogil=True)
def record_outcomes(workspaces, part, histories, record, tolerance, in_full, outcomes):
    """Fill one of as many parts of the factors as there are batches; see `grid.outcomes_of`.

    Parameters
    ----------
    workspaces : array, array
        The rows of the lanes, and a working array for steps that a lane takes alone, which may say
        halt (`step.HALT`).
    part : int, int
        The number of the batch, and of batches.
    histories
        The blocks, as `numbered` takes them, and of each history the number of its block, p Δt, the
        factor on the record, and that on the vertical record that goes with it.
    in_full : bool
        Whether a history is followed once it is sure to survive: only then are the peak and the
        impacts those of all of it.
    outcomes : array, array, array
        Take peaks, whether it overturned, and impacts.

    Returns
    -------
    int
        The first cell that was given up (see `step.MAX_STEPS`), or −1.
    """
    (w, alone), (batch, batches), (peak, overturned, impacts) = workspaces, part, outcomes
    kind, blocks, which, steps, factors, lifts_of = histories
    last_time = record[AT, record.shape[1] - 1]
    most_steps = MAX_STEPS + 10 * record.shape[1]
    coming, last = batch * factors.size // batches, (batch + 1) * factors.size // batches
    lost, vacant = -1, (1 << WIDTH) - 1
    marching, stepping = 0, 0
    # Each time around, a lane passes over a piece or takes one of its `most_steps` steps.
    while True:
        stepping &= ~vacant
        marching &= ~vacant
        while vacant:
            lane, lifted = first_lane(vacant), False
            vacant &= vacant - 1
            while coming < last and not lifted:
                own = numbered(kind, blocks, which[coming])
                forcing = record_forcing(record, steps[coming], factors[coming], lifts_of[coming])
                begin(w, lane, own, forcing, in_full)
                lifted = lifts(w, lane, own, forcing, record, 0.0)
                if not lifted:
                    peak[coming], overturned[coming], impacts[coming] = 0.0, False, 0
                w[CELL, lane] = coming
                coming += 1
            if lifted:
                stepping |= 1 << lane
            else:
                still(w, lane)
                w[PIECE, lane] = 0.0
        if marching | stepping == 0:
            return lost
        if alone[HALT, 0] != 0.0:
            return int(w[CELL, int(alone[HALT, 1])])
        block = seated(w, kind)
        if stepping == 0 or number(marching) > FEW:
            passed = march_lanes(w, block, record, tolerance, marching)
            stepping |= marching & ~passed
            marching = passed
            continue
        landed, fallen = advance(w, alone, block, RECORD_ORDER, tolerance, True, stepping)
        h, time, taken = load(w, SAMPLING), load(w, TIME), load(w, LENGTH)
        piece_end = take(record[AT], load(w, PIECE) + 1.0) * h
        time = select(taken >= load(w, LONGEST), piece_end, time + taken)
        store(w, TIME, time)
        rotation, velocity = finish(w, block, RECORD_ORDER, stepping)
        store(w, GRAVITY, fma(taken, load(w, CHANGE), load(w, GRAVITY)))
        landed = (landed | bits(rotation <= 0.0) & stepping) & ~fallen
        resting = strike(w, block, True, landed) if landed else 0
        coming_speed = absolute(load(w, FACTOR)) * h * take(record[IMPULSE], load(w, PIECE))
        safe = bits(load(w, VELOCITY) + coming_speed < load(w, SAFE_SPEED)) & landed
        over = bits(time >= last_time * h) & stepping
        outward = bits((rotation > block.slenderness) & (velocity > 0.0)) & stepping
        tired = bits(load(w, STEPS) > most_steps) & stepping
        ended = bits(time >= piece_end) & stepping & ~over
        is_in_piece = among(stepping & ~ended)
        store(w, LONGEST, select(is_in_piece, piece_end - time, 0.0))
        store(w, PIECE, select(among(ended), load(w, PIECE) + 1.0, load(w, PIECE)))
        stepping &= ~ended
        marching |= ended
        events = fallen | safe | over | resting | outward | tired
        while events:
            lane = first_lane(events)
            events &= events - 1
            cell = int(w[CELL, lane])
            own = numbered(kind, blocks, which[cell])
            forcing = record_forcing(record, steps[cell], factors[cell], lifts_of[cell])
            fell, highest, count = bool(fallen >> lane & 1), w[PEAK, lane], w[IMPACTS, lane]
            if safe >> lane & 1:
                pass
            elif not fell and over >> lane & 1:
                tail = free_rocking(own, w[ROTATION, lane], w[VELOCITY, lane])
                fell, highest = tail.overturned, max(highest, tail.peak)
                count += tail.impacts
            elif not fell and outward >> lane & 1 and overturns(w, lane, own, forcing, record):
                fell = True
            elif not fell and tired >> lane & 1:
                lost = cell if lost < 0 else min(lost, cell)
            elif not fell:
                if not (resting >> lane & 1 and rests(w, lane, own, forcing, record)):
                    continue
                marching &= ~(1 << lane)
                stepping |= 1 << lane
                if lifts(w, lane, own, forcing, record, next_tick(w[TIME, lane])):
                    continue
            peak[cell] = math.nan if fell else highest
            overturned[cell], impacts[cell] = fell, count
            vacant |= 1 << lane
