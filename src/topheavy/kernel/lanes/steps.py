"""Taylor steps with proven events, one history in each lane (see `vectors`).

The series is that of `kernel.taylor`, the proof that of `step.advance`. Where the Bernstein
coefficients rise first and fall then (or the other way round, or do one of the two), so does φ: it
has at most one turn, and at most one landing that follows from its ends. Halley's iteration finds
both. A lane for which this fails takes its step by `proven`, as the scalar kernel does.

The histories of a batch are one record `w` with a float a lane in each field (see `new_batch`);
`alone` is the working array of the scalar kernel, for a lane that is taken alone. `order` and
`is_straight` are constants where these functions are called, so that their loops become straight
code.
"""

from topheavy.kernel.bernstein import CONVERT
from topheavy.kernel.compiled import compiled
from topheavy.kernel.lanes.vectors import (
    absolute,
    batch,
    bits,
    fields,
    first_lane,
    fma,
    mask_of,
    maximum,
    minimum,
    rough_power,
    select,
    square_root,
)
from topheavy.kernel.rest import MIN_COUNTED_PEAK
from topheavy.kernel.step import FLAT, HALT, LANDING, POLYNOMIAL, proven
from topheavy.kernel.taylor import INVERSE, Oscillator

#: The largest order.
MAX_ORDER = 15
#: Coefficients of φ, φ', sin φ, cos φ, cos(α − φ) and the push q, and of the step polynomial.
SERIES = ("rotation", "velocity", "sine", "cosine", "tilt", "push", "polynomial")
#: The number of the cell, its block, and the speed below which it survives (`tail.safe_speed`).
OF_BLOCK = "cell slenderness restitution level cos_alpha sin_alpha inverse_cosine safe_speed"
#: The side s, the amplitude or factor times −s; of a pulse its end, ω/p, c, d₁ and the τ at which
#: d₀ = 0 (`forcing.equation`); of a record p Δt, the factor on the vertical one, the piece that the
#: lane is at, gravity G and G'.
OF_FORCING = "side factor end frequency c d1 centre sampling vertical piece gravity gravity_rate"
#: τ, the longest step allowed, the step taken; the largest φ so far, and that of this flight (0 as
#: long as it is below `rest.MIN_COUNTED_PEAK` α); impacts and steps so far.
OF_MOTION = "time longest step peak flight_peak impacts steps"

#: The steps are this much shorter than the rough power says.
STEP_MARGIN = 0.95
#: Newton's correction, over x, below which Halley's leaves an error of its cube.
LANDING_CORRECTION, TURN_CORRECTION = 1e-4, 1e-2
#: |f f″/2f′²| above which Halley's iteration is not trusted (its correction vanishes with f′).
MAX_CURVATURE = 0.1
MAX_ITERATIONS = 5


def new_batch():
    """Return the record that the histories in the lanes work in."""
    return batch(" ".join((OF_BLOCK, OF_FORCING, OF_MOTION)).split(), SERIES, MAX_ORDER + 1)


@compiled(forceinline=True)
def block_of_lanes(v, flat, linearised):
    """Return the blocks of all lanes as one `Oscillator` of lanes."""
    angles = (v.cos_alpha, v.sin_alpha)
    return Oscillator(v.slenderness, v.restitution, v.level, *angles, flat, linearised)


@compiled(forceinline=True)
def expand(v, block, order, is_straight):
    """Fill the series with the solution through their first terms; see `taylor.expand`.

    `is_straight` says that the push and gravity are straight lines: a piece of a record.
    """
    if not is_straight:
        c, d1 = v.c, v.d1
        d0 = d1 * (v.time - v.centre)
        first, second = v.push[0] + block.level, v.push[1]
        for n in range(order - 2):
            curvature = fma(d1, n, c) * first + d0 * (n + 1) * second
            first, second = second, curvature * -(INVERSE[n + 1] * INVERSE[n + 2])
            v.push[n + 2] = second
    if block.linearised:
        for n in range(order):  # φ'' = φ + q
            force = v.rotation[n]
            if is_straight:
                force = force * v.gravity
            if is_straight and n > 0:
                force = fma(v.gravity_rate, v.rotation[n - 1], force)
            if n < 2 or not is_straight:
                force = force + v.push[n]
            v.rotation[n + 1] = v.velocity[n] * INVERSE[n + 1]
            v.velocity[n + 1] = force * INVERSE[n + 1]
        return
    inverse_cosine = v.inverse_cosine
    first_sine, first_cosine, first_push = v.sine[0], v.cosine[0], v.push[0]
    first_velocity, zero = v.velocity[0], v.push[0] * 0.0
    heavy, heavier = inverse_cosine, zero
    if is_straight:
        heavy, heavier = inverse_cosine * v.gravity, inverse_cosine * v.gravity_rate
    for n in range(order):  # the sums wait for their newest terms, which come last
        cosine, sine, force = zero, zero, zero
        for i in range(1, n):
            velocity = v.velocity[i]
            cosine = fma(v.cosine[n - i], velocity, cosine)
            sine = fma(v.sine[n - i], velocity, sine)
            if i == n - 1 or not is_straight:
                force = fma(v.push[n - i], v.tilt[i], force)
        sine_n, cosine_n, velocity_n = v.sine[n], v.cosine[n], v.velocity[n]
        if n > 0:
            cosine = fma(first_velocity, cosine_n, cosine)
            sine = fma(first_velocity, sine_n, sine)
        if n == 1 or (n > 0 and not is_straight):
            force = fma(v.push[n], v.tilt[0], force)
        tilt = fma(cosine_n, block.cosine, sine_n * block.sine)
        v.tilt[n] = tilt
        cosine = fma(first_cosine, velocity_n, cosine)
        sine = fma(first_sine, velocity_n, sine)
        force = fma(first_push, tilt, fma(sine_n, heavy, force))  # Eq. (23)
        if is_straight and n > 0:
            force = fma(v.sine[n - 1], heavier, force)
        v.rotation[n + 1] = velocity_n * INVERSE[n + 1]
        v.sine[n + 1] = cosine * INVERSE[n + 1]
        v.cosine[n + 1] = sine * -INVERSE[n + 1]
        v.velocity[n + 1] = force * INVERSE[n + 1]


@compiled(forceinline=True)
def longest_steps(v, block, order, tolerance):
    """Return the steps over which the last two terms of φ' are below `tolerance`."""
    bound = tolerance * maximum(v.rotation[0], block.slenderness)
    last, second = absolute(v.velocity[order - 1]), absolute(v.velocity[order - 2])
    step = minimum(
        rough_power(bound / maximum(last, 1e-200), INVERSE[order - 1]),
        rough_power(bound / maximum(second, 1e-200), INVERSE[order - 2]),
    )
    return minimum(step * STEP_MARGIN, v.longest)


@compiled(forceinline=True)
def hull(v, order, step):
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
        v.polynomial[k] = v.rotation[k] * power
        power = power * step
    first, second = v.rotation[0], v.polynomial[1]
    low, high, before, final = first, first, first, first
    zero = first * 0.0
    dips, tops, slope = zero, zero, zero
    for i in range(1, order + 1):
        total = fma(second, CONVERT[order, i, 1], first)
        for k in range(2, i + 1):
            total = fma(v.polynomial[k], CONVERT[order, i, k], total)
        low, high = minimum(low, total), maximum(high, total)
        change = total - final
        dips, tops = maximum(dips, minimum(-slope, change)), maximum(tops, minimum(slope, -change))
        before, final, slope = final, total, change
    return low, high, before, final, dips, tops


@compiled(forceinline=True)
def only_root(series, degree, step, ends, wanted, correction):
    """Find the only root in (0, step) of a polynomial, by Halley's iteration.

    Each lane ends independently, so that no root depends on the neighbours of its lane.

    Parameters
    ----------
    ends : lanes, lanes, lanes
        Value and slope at 0, value at the step, all of x/step: the iteration begins at the root of
        the parabola that has these.
    wanted : mask
        The lanes that have a root.
    correction : float
        Newton's correction, over x, at which the root is accurate enough.

    Returns
    -------
    x : lanes
    is_accurate : mask
    """
    start, slope, stop = ends
    bend = stop - start - slope
    square = square_root(maximum(slope * slope - 4.0 * bend * start, 0.0))
    x = step * select(start > 0.0, 2.0 * start / (square - slope), 0.5)
    x = select((x > 0.0) & (x < step), x, 0.5 * step)
    zero = step * 0.0
    error = zero + 2.0  # accurate at 1 or less
    for _ in range(MAX_ITERATIONS):
        value, slope, bend = series[degree], zero, zero
        for k in range(degree - 1, -1, -1):
            bend = fma(bend, x, slope)
            slope = fma(slope, x, value)
            value = fma(value, x, series[k])
        newton = value / slope
        curve = newton * bend / slope
        trial = x - newton / (1.0 - curve)
        is_open = error > 1.0
        bent = absolute(curve) * (1.0 / MAX_CURVATURE)
        latest = maximum(absolute(newton) / (correction * x), bent)
        error = select(is_open, latest, error)
        trial = select((trial > 0.0) & (trial < step), trial, 0.5 * x)
        x = select(is_open, trial, x)
        if bits((error > 1.0) & wanted) == 0:
            break
    return x, wanted & (error <= 1.0)


@compiled(forceinline=True)
def landing(v, order, step, final, lands):
    """Return the time of the only landing in the step, as `only_root` does.

    A block on the ground leaves it first: the series over its first term has the other root.
    """
    is_down, zero = v.rotation[0] <= 0.0, step * 0.0
    for k in range(order):
        v.polynomial[k] = select(is_down, v.rotation[k + 1], v.rotation[k])
    v.polynomial[order] = select(is_down, zero, v.rotation[order])
    stop = select(is_down, final / step, final)
    slope = v.polynomial[1] * step
    ends = (v.polynomial[0], slope, stop)
    return only_root(v.polynomial, order, step, ends, lands, LANDING_CORRECTION)


@compiled
def step_alone(w, alone, lane, order, flat):
    """Take the step of one lane as the scalar kernel does; return its event."""
    step, zeros, power = w.step[lane], 0, 1.0
    while zeros < 3 and w.rotation[zeros, lane] == 0.0:
        zeros += 1
    for k in range(order + 1):
        alone[POLYNOMIAL, k] = w.rotation[k, lane] * power
        power *= step
    end, event, w.flight_peak[lane] = proven(alone, order, zeros, flat, w.flight_peak[lane])
    w.step[lane] = step * end
    alone[HALT, 1] = lane  # the lane to name in the error if the step limit is exceeded
    return event


@compiled(forceinline=True)
def advance(w, alone, block, order, tolerance, is_straight, active):
    """Find the step of each lane and what ends it; set `step` and `flight_peak`.

    Parameters
    ----------
    active : int
        Bits of the lanes whose events matter.

    Returns
    -------
    landed, fallen : int
        Bits of the lanes whose blocks land, and of those whose blocks lie flat, at the end.
    """
    v = fields(w)
    expand(v, block, order, is_straight)
    step = longest_steps(v, block, order, tolerance)
    low, high, before, final, dips, tops = hull(v, order, step)
    first, peak = v.rotation[0], v.flight_peak
    highest = maximum(peak, maximum(first, final))
    leaves = maximum(first, v.polynomial[1]) > 0.0
    lands = ((dips <= 0.0) | (tops <= 0.0)) & (final < 0.0) & leaves
    turns = (high > highest) & (dips <= 0.0)
    hard = ((low < 0.0) & ~lands & ((dips > 0.0) | (final <= 0.0))) | (high > block.flat)
    hard = (hard | ((high > highest) & (dips > 0.0))) & mask_of(active)
    lands, turns, length = lands & ~hard, turns & ~hard, step
    if bits(lands) & active:
        x, is_accurate = landing(v, order, step, final, lands)
        hard, lands = hard | (lands & ~is_accurate), is_accurate
        length = select(is_accurate, x, step)
    if bits(turns) & active:
        ends = (v.velocity[0], v.velocity[1] * step, order * (final - before) / step)
        x, is_accurate = only_root(v.velocity, order - 1, step, ends, turns, TURN_CORRECTION)
        hard = hard | (turns & ~is_accurate)
        value = v.rotation[order]
        for k in range(order - 1, -1, -1):
            value = fma(value, x, v.rotation[k])
        highest = select(is_accurate, value, highest)
    v.step = select(hard, step, length)
    v.flight_peak = select(hard, peak, highest)
    landed, fallen, unsettled = bits(lands & ~hard) & active, 0, bits(hard) & active
    while unsettled and alone[HALT, 0] == 0.0:  # one bit less each time
        lane = first_lane(unsettled)
        unsettled &= unsettled - 1
        event = step_alone(w, alone, lane, order, block.flat)
        landed |= (1 << lane) if event == LANDING else 0
        fallen |= (1 << lane) if event == FLAT else 0
    return landed, fallen


@compiled(forceinline=True)
def evaluate(v, block, order, active):
    """Move every lane to the end of its step (see `taylor.evaluate`); return φ and φ' there.

    `active` are the bits of the lanes whose step is counted.
    """
    step = v.step
    rotation, velocity = v.rotation[order], step * 0.0
    sine, cosine, push, rate = velocity, velocity, velocity, velocity
    for n in range(order - 1, -1, -1):
        rotation = fma(rotation, step, v.rotation[n])
        velocity = fma(velocity, step, v.velocity[n])
        sine = fma(sine, step, v.sine[n])
        cosine = fma(cosine, step, v.cosine[n])
        rate = fma(rate, step, push)
        push = fma(push, step, v.push[n])
    highest = v.flight_peak
    v.peak = maximum(v.peak, highest)
    is_rocking = highest > MIN_COUNTED_PEAK * block.slenderness
    v.flight_peak = select(is_rocking, v.peak, highest)
    v.rotation[0] = rotation
    v.velocity[0] = velocity
    v.sine[0] = sine
    v.cosine[0] = cosine
    v.push[0] = push
    v.push[1] = rate
    v.steps = v.steps + select(mask_of(active), 1.0, 0.0)
    return rotation, velocity


@compiled(forceinline=True)
def impact(v, block, is_straight, landed):
    """Let the blocks of the lanes that landed go over to their other side (`step.after_impact`).

    Returns
    -------
    int
        Bits of those that may come to rest now (the first conditions of `rest.comes_to_rest`).
    """
    has_landed = mask_of(landed)
    velocity = maximum(-v.velocity[0], 0.0) * block.restitution
    both, side, rate = 2.0 * block.level, v.side, -v.push[1]
    if is_straight:
        rate = rate - both * v.gravity_rate
        both = both * v.gravity
    push = -v.push[0] - both
    low = v.flight_peak <= MIN_COUNTED_PEAK * block.slenderness
    v.impacts = v.impacts + select(has_landed & ~low, 1.0, 0.0)
    v.flight_peak = select(has_landed, 0.0, v.flight_peak)
    v.side = select(has_landed, -side, side)
    v.factor = select(has_landed, -v.factor, v.factor)
    v.rotation[0] = select(has_landed, 0.0, v.rotation[0])
    v.sine[0] = select(has_landed, 0.0, v.sine[0])
    v.cosine[0] = select(has_landed, 1.0, v.cosine[0])
    v.velocity[0] = select(has_landed, velocity, v.velocity[0])
    v.push[0] = select(has_landed, push, v.push[0])
    v.push[1] = select(has_landed, rate, v.push[1])
    weakest = minimum(-push, push + both)
    energy = weakest * (block.cosine * MIN_COUNTED_PEAK * block.slenderness)
    return bits(((weakest > 0.0) & (velocity * velocity <= energy)) | (velocity <= 0.0)) & landed
