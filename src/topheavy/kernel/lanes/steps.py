"""Taylor steps with proven events, one history in each lane (see `vectors`).

The series is that of `kernel.taylor`, the proof that of `step.advance`. Where the Bernstein
coefficients rise first and fall then (or the other way round, or do one of the two), so does φ: it
has at most one turn, and at most one landing that follows from its ends. Halley's iteration finds
both. A lane for which this fails takes its step by `proven`, as the scalar kernel does.

The array `w` of a batch has a row for every coefficient and every variable, a float a lane. `alone`
is the working array of the scalar kernel (`step.working_array`), for a lane that is taken alone.
`order` and `is_straight` are constants where these functions are called, so that their loops become
straight code.
"""

from topheavy.kernel.bernstein import CONVERT
from topheavy.kernel.compiled import compiled
from topheavy.kernel.lanes.vectors import (
    absolute,
    among,
    bits,
    first_lane,
    fma,
    load,
    maximum,
    minimum,
    rough_power,
    select,
    square_root,
    store,
)
from topheavy.kernel.rest import LAST_BOUNCE, comes_to_rest
from topheavy.kernel.step import FLAT, HALT, LANDING, POLYNOMIAL, proven
from topheavy.kernel.taylor import INVERSE, Oscillator

#: The largest order.
MAX_ORDER = 15
#: The first rows of the coefficients of φ, φ', sin φ, cos φ, cos(α − φ) and q, and of the step
#: polynomial on [0, 1].
ROTATION, VELOCITY, SINE, COSINE, TILT, PUSH, STEP = range(0, 7 * (MAX_ORDER + 1), MAX_ORDER + 1)
#: The side s; the amplitude or factor times −s; c, d₁ and the τ at which d₀ = 0 (`forcing`).
SIDE, FACTOR, C, D1, CENTRE = range(7 * (MAX_ORDER + 1), 7 * (MAX_ORDER + 1) + 5)
#: τ, the longest step allowed, the step taken; the largest φ so far, and the same or 0 as long as
#: the rotation is below `rest.LAST_BOUNCE` α; impacts and steps so far.
TIME, LONGEST, LENGTH, PEAK, ARC, IMPACTS, STEPS = range(CENTRE + 1, CENTRE + 8)
#: The end of a pulse, and its ω/p; the piece of a record that a lane is at.
END, FREQUENCY, PIECE = range(STEPS + 1, STEPS + 4)
#: The block of a lane: α, √r, the level, cos α, sin α, 1/cos α.
ALPHA, RESTITUTION, LEVEL, COS_ALPHA, SIN_ALPHA, INVERSE_COS = range(PIECE + 1, PIECE + 7)
#: Gravity G, G', the factor on the vertical record, and the time h = p Δt between two samples.
GRAVITY, CHANGE, LIFT, SAMPLING = range(INVERSE_COS + 1, INVERSE_COS + 5)
#: The number of the history in a lane, `tail.safe_speed`, and the number of all rows.
CELL, SAFE_SPEED, ROWS = range(SAMPLING + 1, SAMPLING + 4)

#: The steps are this much shorter than the rough power says.
CAUTION = 0.95
#: Newton's correction, over x, below which Halley's leaves an error of its cube.
LANDING_CORRECTION, TURN_CORRECTION = 1e-4, 1e-2
#: |f f″/2f′²| above which Halley's iteration is not trusted (its correction vanishes with f′).
MOST_BEND = 0.1
MOST_CORRECTIONS = 5


@compiled
def numbered(kind, blocks, number):
    """Return a block: its row of `blocks` has α, √r, level, cos α and sin α, `kind` the rest."""
    row = blocks[number]
    return Oscillator(row[0], row[1], row[2], row[3], row[4], kind.flat, kind.linearised)


@compiled
def seat(w, lane, block):
    """Let the lane have this block."""
    w[ALPHA, lane], w[RESTITUTION, lane], w[LEVEL, lane] = block[:3]
    w[COS_ALPHA, lane], w[SIN_ALPHA, lane] = block.cosine, block.sine
    w[INVERSE_COS, lane] = 1.0 / block.cosine


@compiled(forceinline=True)
def seated(w, kind):
    """Return the blocks of all lanes as one `Oscillator` of lanes; `kind` has their equation."""
    angles = (load(w, COS_ALPHA), load(w, SIN_ALPHA))
    three = (load(w, ALPHA), load(w, RESTITUTION), load(w, LEVEL))
    return Oscillator(*three, *angles, kind.flat, kind.linearised)


@compiled(forceinline=True)
def expand(w, block, order, is_straight):
    """Fill `w` with the solution through its first coefficients; see `taylor.expand`.

    `is_straight` says that the push and gravity are straight lines: a piece of a record.
    """
    if not is_straight:
        c, d1 = load(w, C), load(w, D1)
        d0 = d1 * (load(w, TIME) - load(w, CENTRE))
        first, second = load(w, PUSH) + block.level, load(w, PUSH + 1)
        for n in range(order - 2):
            curvature = fma(d1, n, c) * first + d0 * (n + 1) * second
            first, second = second, curvature * -(INVERSE[n + 1] * INVERSE[n + 2])
            store(w, PUSH + n + 2, second)
    if block.linearised:
        for n in range(order):  # φ'' = φ + q
            force = load(w, ROTATION + n)
            if is_straight:
                force = force * load(w, GRAVITY)
            if is_straight and n > 0:
                force = fma(load(w, CHANGE), load(w, ROTATION + n - 1), force)
            if n < 2 or not is_straight:
                force = force + load(w, PUSH + n)
            store(w, ROTATION + n + 1, load(w, VELOCITY + n) * INVERSE[n + 1])
            store(w, VELOCITY + n + 1, force * INVERSE[n + 1])
        return
    inverse_cosine = load(w, INVERSE_COS)
    first_sine, first_cosine, first_push = load(w, SINE), load(w, COSINE), load(w, PUSH)
    first_velocity, zero = load(w, VELOCITY), load(w, PUSH) * 0.0
    heavy, heavier = inverse_cosine, zero
    if is_straight:
        heavy, heavier = inverse_cosine * load(w, GRAVITY), inverse_cosine * load(w, CHANGE)
    for n in range(order):  # the sums wait for their newest terms, which come last
        cosine, sine, force = zero, zero, zero
        for i in range(1, n):
            velocity = load(w, VELOCITY + i)
            cosine = fma(load(w, COSINE + n - i), velocity, cosine)
            sine = fma(load(w, SINE + n - i), velocity, sine)
            if i == n - 1 or not is_straight:
                force = fma(load(w, PUSH + n - i), load(w, TILT + i), force)
        sine_n, cosine_n, velocity_n = load(w, SINE + n), load(w, COSINE + n), load(w, VELOCITY + n)
        if n > 0:
            cosine = fma(first_velocity, cosine_n, cosine)
            sine = fma(first_velocity, sine_n, sine)
        if n == 1 or (n > 0 and not is_straight):
            force = fma(load(w, PUSH + n), load(w, TILT), force)
        tilt = fma(cosine_n, block.cosine, sine_n * block.sine)
        store(w, TILT + n, tilt)
        cosine = fma(first_cosine, velocity_n, cosine)
        sine = fma(first_sine, velocity_n, sine)
        force = fma(first_push, tilt, fma(sine_n, heavy, force))  # Eq. (23)
        if is_straight and n > 0:
            force = fma(load(w, SINE + n - 1), heavier, force)
        store(w, ROTATION + n + 1, velocity_n * INVERSE[n + 1])
        store(w, SINE + n + 1, cosine * INVERSE[n + 1])
        store(w, COSINE + n + 1, sine * -INVERSE[n + 1])
        store(w, VELOCITY + n + 1, force * INVERSE[n + 1])


@compiled(forceinline=True)
def longest_steps(w, block, order, tolerance):
    """Return the steps over which the last two terms of φ' are below `tolerance`."""
    bound = tolerance * maximum(load(w, ROTATION), block.slenderness)
    last, second = absolute(load(w, VELOCITY + order - 1)), absolute(load(w, VELOCITY + order - 2))
    step = minimum(
        rough_power(bound / maximum(last, 1e-200), INVERSE[order - 1]),
        rough_power(bound / maximum(second, 1e-200), INVERSE[order - 2]),
    )
    return minimum(step * CAUTION, load(w, LONGEST))


@compiled(forceinline=True)
def hull(w, order, step):
    """Return bounds of φ on the step, from its Bernstein coefficients.

    Returns
    -------
    low, high, before, final : lanes
        The least and the largest coefficient, the last but one and the last.
    dips, tops : lanes
        Where `dips` is not positive, φ rises first and falls then (or does one of the two); where
        `tops` is not, the other way round.
    """
    power = step
    for k in range(1, order + 1):
        store(w, STEP + k, load(w, ROTATION + k) * power)
        power = power * step
    first, second = load(w, ROTATION), load(w, STEP + 1)
    low, high, before, final = first, first, first, first
    zero = first * 0.0
    dips, tops, slope = zero, zero, zero
    for i in range(1, order + 1):
        total = fma(second, CONVERT[order, i, 1], first)
        for k in range(2, i + 1):
            total = fma(load(w, STEP + k), CONVERT[order, i, k], total)
        low, high = minimum(low, total), maximum(high, total)
        change = total - final
        dips, tops = maximum(dips, minimum(-slope, change)), maximum(tops, minimum(slope, -change))
        before, final, slope = final, total, change
    return low, high, before, final, dips, tops


@compiled(forceinline=True)
def only_root(w, p, degree, step, start, slope, stop, is_sought, correction):
    """Find the only root in (0, step) of the polynomial in row `p`, by Halley's iteration.

    It begins at the root of the parabola with the polynomial's `start`, `slope` and `stop`, and
    each lane ends independently, so that no root depends on the neighbours of its lane.

    Returns
    -------
    x : lanes
    is_found : mask
    """
    bend = stop - start - slope
    square = square_root(maximum(slope * slope - 4.0 * bend * start, 0.0))
    x = step * select(start > 0.0, 2.0 * start / (square - slope), 0.5)
    x = select((x > 0.0) & (x < step), x, 0.5 * step)
    zero = step * 0.0
    doubt = zero + 2.0  # settled from 1 down
    for _ in range(MOST_CORRECTIONS):
        value, slope, bend = load(w, p + degree), zero, zero
        for k in range(degree - 1, -1, -1):
            bend = fma(bend, x, slope)
            slope = fma(slope, x, value)
            value = fma(value, x, load(w, p + k))
        newton = value / slope
        curve = newton * bend / slope
        trial = x - newton / (1.0 - curve)
        is_open = doubt > 1.0
        left = maximum(absolute(newton) / (correction * x), absolute(curve) * (1.0 / MOST_BEND))
        doubt = select(is_open, left, doubt)
        trial = select((trial > 0.0) & (trial < step), trial, 0.5 * x)
        x = select(is_open, trial, x)
        if bits((doubt > 1.0) & is_sought) == 0:
            break
    return x, is_sought & (doubt <= 1.0)


@compiled(forceinline=True)
def landing(w, order, step, final, lands):
    """Return the time of the only landing in the step; see `only_root`.

    A block on the ground leaves it first: the series over its first term has the other root.
    """
    is_down, zero = load(w, ROTATION) <= 0.0, step * 0.0
    for k in range(order):
        store(w, STEP + k, select(is_down, load(w, ROTATION + k + 1), load(w, ROTATION + k)))
    store(w, STEP + order, select(is_down, zero, load(w, ROTATION + order)))
    stop = select(is_down, final / step, final)
    slope = load(w, STEP + 1) * step
    return only_root(
        w, STEP, order, step, load(w, STEP), slope, stop, lands, LANDING_CORRECTION
    )  # fmt: skip


@compiled
def step_alone(w, alone, lane, order, flat):
    """Take the step of one lane as the scalar kernel does; return its event."""
    step, zeros, power = w[LENGTH, lane], 0, 1.0
    while zeros < 3 and w[ROTATION + zeros, lane] == 0.0:
        zeros += 1
    for k in range(order + 1):
        alone[POLYNOMIAL, k] = w[ROTATION + k, lane] * power
        power *= step
    # order + 0 hides a constant, for which numba would compile it all anew.
    end, event, w[ARC, lane] = proven(alone, order + 0, zeros, flat, w[ARC, lane])
    w[LENGTH, lane] = step * end
    alone[HALT, 1] = lane  # which is to blame if this was too much
    return event


@compiled(forceinline=True)
def advance(w, alone, block, order, tolerance, is_straight, active):
    """Find the step of each lane, and what ends it; `LENGTH` and `ARC` take it up.

    Parameters
    ----------
    w, alone : array
        The working array, and one for a history alone (`step.working_array`).
    active : int
        Bits of the lanes that matter.

    Returns
    -------
    landed, fallen : int
        Bits of the lanes whose blocks land, and of those whose blocks lie flat, at the end.
    """
    expand(w, block, order, is_straight)
    step = longest_steps(w, block, order, tolerance)
    low, high, before, final, dips, tops = hull(w, order, step)
    first, arc = load(w, ROTATION), load(w, ARC)
    highest = maximum(arc, maximum(first, final))
    leaves = maximum(first, load(w, STEP + 1)) > 0.0
    lands = ((dips <= 0.0) | (tops <= 0.0)) & (final < 0.0) & leaves
    turns = (high > highest) & (dips <= 0.0)
    hard = ((low < 0.0) & ~lands & ((dips > 0.0) | (final <= 0.0))) | (high > block.flat)
    hard = (hard | ((high > highest) & (dips > 0.0))) & among(active)
    lands, turns, length = lands & ~hard, turns & ~hard, step
    if bits(lands) & active:
        x, is_found = landing(w, order, step, final, lands)
        hard, lands, length = hard | (lands & ~is_found), is_found, select(is_found, x, step)
    if bits(turns) & active:
        start, slope = load(w, VELOCITY), load(w, VELOCITY + 1) * step
        stop = order * (final - before) / step
        x, is_found = only_root(
            w, VELOCITY, order - 1, step, start, slope, stop, turns, TURN_CORRECTION
        )
        hard = hard | (turns & ~is_found)
        value = load(w, ROTATION + order)
        for k in range(order - 1, -1, -1):
            value = fma(value, x, load(w, ROTATION + k))
        highest = select(is_found, value, highest)
    store(w, LENGTH, select(hard, step, length))
    store(w, ARC, select(hard, arc, highest))
    landed, fallen, unsettled = bits(lands & ~hard) & active, 0, bits(hard) & active
    while unsettled and alone[HALT, 0] == 0.0:  # one bit less each time
        lane = first_lane(unsettled)
        unsettled &= unsettled - 1
        event = step_alone(w, alone, lane, order, block.flat)
        landed |= (1 << lane) if event == LANDING else 0
        fallen |= (1 << lane) if event == FLAT else 0
    return landed, fallen


@compiled(forceinline=True)
def finish(w, block, order, active):
    """Move every lane to the end of its step (see `taylor.evaluate`); return φ and φ' there.

    `active` are the bits of the lanes whose step is counted.
    """
    step = load(w, LENGTH)
    rotation, velocity = load(w, ROTATION + order), step * 0.0
    sine, cosine, push, rate = velocity, velocity, velocity, velocity
    for n in range(order - 1, -1, -1):
        rotation = fma(rotation, step, load(w, ROTATION + n))
        velocity = fma(velocity, step, load(w, VELOCITY + n))
        sine = fma(sine, step, load(w, SINE + n))
        cosine = fma(cosine, step, load(w, COSINE + n))
        rate = fma(rate, step, push)
        push = fma(push, step, load(w, PUSH + n))
    arc = load(w, ARC)
    peak = maximum(load(w, PEAK), arc)
    store(w, PEAK, peak)
    store(w, ARC, select(arc > LAST_BOUNCE * block.slenderness, peak, arc))
    store(w, ROTATION, rotation)
    store(w, VELOCITY, velocity)
    store(w, SINE, sine)
    store(w, COSINE, cosine)
    store(w, PUSH, push)
    store(w, PUSH + 1, rate)
    store(w, STEPS, load(w, STEPS) + select(among(active), 1.0, 0.0))
    return rotation, velocity


@compiled(forceinline=True)
def strike(w, block, is_straight, landed):
    """Let the blocks of these lanes go over to their other side (see `step.after_impact`).

    Returns
    -------
    int
        Bits of those that may come to rest now (the first conditions of `rest.comes_to_rest`).
    """
    struck = among(landed)
    velocity = maximum(-load(w, VELOCITY), 0.0) * block.restitution
    both, side, rate = 2.0 * block.level, load(w, SIDE), -load(w, PUSH + 1)
    if is_straight:
        rate = rate - both * load(w, CHANGE)
        both = both * load(w, GRAVITY)
    push = -load(w, PUSH) - both
    low = load(w, ARC) <= LAST_BOUNCE * block.slenderness
    store(w, IMPACTS, load(w, IMPACTS) + select(struck & ~low, 1.0, 0.0))
    store(w, ARC, select(struck, 0.0, load(w, ARC)))
    store(w, SIDE, select(struck, -side, side))
    store(w, FACTOR, select(struck, -load(w, FACTOR), load(w, FACTOR)))
    store(w, ROTATION, select(struck, 0.0, load(w, ROTATION)))
    store(w, SINE, select(struck, 0.0, load(w, SINE)))
    store(w, COSINE, select(struck, 1.0, load(w, COSINE)))
    store(w, VELOCITY, select(struck, velocity, load(w, VELOCITY)))
    store(w, PUSH, select(struck, push, load(w, PUSH)))
    store(w, PUSH + 1, select(struck, rate, load(w, PUSH + 1)))
    weakest = minimum(-push, push + both)
    energy = weakest * (block.cosine * LAST_BOUNCE * block.slenderness)
    return bits(((weakest > 0.0) & (velocity * velocity <= energy)) | (velocity <= 0.0)) & landed


@compiled
def still(w, lane):
    """Let a lane take steps of no length, in a new history or in none."""
    w[TIME, lane], w[LONGEST, lane], w[PEAK, lane], w[ARC, lane] = 0.0, 0.0, 0.0, 0.0
    w[IMPACTS, lane], w[STEPS, lane], w[FACTOR, lane] = 0.0, 0.0, 0.0
    w[ROTATION, lane], w[VELOCITY, lane], w[SINE, lane], w[COSINE, lane] = 0.0, 0.0, 0.0, 1.0
    w[PUSH, lane], w[PUSH + 1, lane] = 0.0, 0.0


@compiled
def lift(w, lane, time, push, rate, side, amplitude):
    """Begin a rotation from rest, as `forcing.next_uplift` gives it."""
    w[TIME, lane], w[ARC, lane] = time, 0.0
    w[SIDE, lane], w[FACTOR, lane] = side, -side * amplitude
    w[ROTATION, lane], w[VELOCITY, lane], w[SINE, lane], w[COSINE, lane] = 0.0, 0.0, 0.0, 1.0
    w[PUSH, lane], w[PUSH + 1, lane] = push, rate


@compiled
def rests(w, lane, block, forcing, record):
    """Say whether the block of a lane comes to rest after its impact."""
    time, velocity, push = w[TIME, lane], w[VELOCITY, lane], w[PUSH, lane]
    side, peak = w[SIDE, lane], w[PEAK, lane]
    return comes_to_rest(block, forcing, record, time, velocity, push, side, peak)
