"""The pieces of a record over which nothing happens, one short series each.

Between two samples the push q is a straight line, q' = q₁, and the samples are so close that seven
terms of φ are plenty. Their coefficients have a closed form: with the force of Eq. (23), its slope,
and how both change as the push does,

    F = sin φ / cos α + q cos(α − φ),    G = cos φ / cos α + q sin(α − φ),
    E = q₁ cos(α − φ),                   H = q₁ sin(α − φ),

F' = E + G φ', G' = H − F φ', E' = H φ', H' = −E φ'. So nothing is stored and nothing waits for a
sum: a piece costs a tenth of what `taylor` and `step.advance` take, which follow wherever a
piece is not settled here. The first term left out, φ⁽⁸⁾, has a closed form too, and is bounded.

Gravity multiplies sin φ / cos α and cos φ / cos α. It is a straight line, too, and these times its
slope are added to E and H.
"""

import math

from topheavy.kernel.compiled import compiled
from topheavy.kernel.forcing import TIME, ground_of_piece, impulse_after, piece_start
from topheavy.kernel.rest import MIN_COUNTED_PEAK
from topheavy.kernel.taylor import INVERSE, State

#: Between two samples the block turns by less than this, so that seven terms give sin and cos.
MAX_TURN = 0.05
#: Pieces beyond φ = α after which the driver looks whether the block is certain to overturn.
MAX_PIECES_BEYOND = 32
#: Relative to φ = π/2: up to this rotation no piece reaches the end of the exact motion.
MAX_ROTATION = 0.9
#: For a landing; four are usual.
MAX_NEWTON_STEPS = 12


@compiled(fastmath={"contract"})
def derivatives(force, slope, force_rate, slope_rate, velocity):
    """Return the third to the seventh derivative of φ from F, G, E, H and φ'."""
    f, g, e, h, v = force, slope, force_rate, slope_rate, velocity
    ff, gg, vv = f * f, g * g, v * v
    third = e + g * v
    fourth = f * (g - vv) + 2 * h * v
    fifth = e * (g - 3 * vv) + 3 * f * h + v * (gg - 3 * ff - g * vv)
    sixth = (
        f * (gg - 3 * ff + vv * (vv - 11 * g)) + 4 * e * h + v * (6 * g * h - 16 * e * f)
        - 4 * h * v * vv
    )  # fmt: skip
    seventh = (
        e * (gg - 25 * ff + vv * (5 * vv - 33 * g)) + f * h * (8 * g - 45 * vv)
        + v * (g * (gg - 33 * ff) + 10 * h * h - 20 * e * e + vv * (15 * ff - 11 * gg + g * vv))
    )  # fmt: skip
    return third, fourth, fifth, sixth, seventh


@compiled(fastmath={"contract"})
def eighth_derivative(force, slope, force_rate, slope_rate, velocity):
    """Return the eighth derivative of φ, as `derivatives`."""
    f, g, e, h, v = force, slope, force_rate, slope_rate, velocity
    ff, gg, vv = f * f, g * g, v * v
    return (
        f * (18 * h * h - 70 * e * e + g * (gg - 33 * ff))
        + vv * f * (78 * ff - 102 * gg + vv * (57 * g - vv))
        + e * (10 * g * h - 138 * h * vv + f * v * (128 * vv - 192 * g))
        + h * v * (12 * gg - 156 * ff + vv * (6 * vv - 100 * g))
    )


@compiled
def powers(h):
    """Return hᵏ/k!, k from 1 to 7."""
    h2 = h * h * INVERSE[2]
    h3 = h2 * h * INVERSE[3]
    h4 = h3 * h * INVERSE[4]
    h5 = h4 * h * INVERSE[5]
    h6 = h5 * h * INVERSE[6]
    return h, h2, h3, h4, h5, h6, h6 * h * INVERSE[7]


@compiled(fastmath={"contract"}, forceinline=True, no_cpython_wrapper=False)
def short_series(h, force, slope, force_rate, slope_rate, velocity, rotation, peak, bound):
    """Return whether a piece is proven to hold nothing, and by how much φ and φ' change in it.

    `h` is its length, `bound` that on the first term of φ' left out. That term may vanish, and then
    h/7 of the last term kept stands for it. If the last term kept is as small, so is the first left
    out. The sums are in pairs: each piece waits for those of the piece before it.
    """
    h1, h2, h3, h4, h5, h6, h7 = powers(h)
    d3, d4, d5, d6, d7 = derivatives(force, slope, force_rate, slope_rate, velocity)
    if h6 * max(abs(d7), abs(d6)) > bound:
        d8 = eighth_derivative(force, slope, force_rate, slope_rate, velocity)
        if h7 * max(abs(d8), abs(d7)) > bound:
            return False, 0.0, 0.0
    c1, c2, c3, c4, c5, c6, c7 = (
        h1 * velocity,
        h2 * force,
        h3 * d3,
        h4 * d4,
        h5 * d5,
        h6 * d6,
        h7 * d7,
    )
    others = abs(c3) + abs(c4) + abs(c5) + abs(c6) + abs(c7)
    turn = ((c1 + c2) + (c3 + c4)) + (c5 + c6) + c7
    rises = min(c1, c1 + 2 * c2) > 7 * others
    if not rises:
        low = min(0.5 * c1, c1 + c2, 0.0) - others
        high = max(0.5 * c1, c1 + c2, 0.0) + others
        if rotation + low <= 0.0 or rotation + high > peak:
            return False, 0.0, 0.0
    gain = ((h1 * force + h2 * d3) + (h3 * d4 + h4 * d5)) + (h5 * d6 + h6 * d7)
    return abs(turn) <= MAX_TURN, turn, gain


@compiled(fastmath={"contract"})
def landing(h, force, slope, force_rate, slope_rate, velocity, rotation, bound):
    """Return the share of a piece after which a block lands, and φ' there; 2 if that is not proven.

    It falls throughout, so that Newton's steps from either side lead to the one root.
    """
    h1, h2, h3, h4, h5, h6, h7 = powers(h)
    d3, d4, d5, d6, d7 = derivatives(force, slope, force_rate, slope_rate, velocity)
    if h6 * max(abs(d7), abs(d6)) > bound:
        d8 = eighth_derivative(force, slope, force_rate, slope_rate, velocity)
        if h7 * max(abs(d8), abs(d7)) > bound:
            return 2.0, 0.0
    c1, c2, c3, c4 = h1 * velocity, h2 * force, h3 * d3, h4 * d4
    c5, c6, c7 = h5 * d5, h6 * d6, h7 * d7
    others = abs(c3) + abs(c4) + abs(c5) + abs(c6) + abs(c7)
    if max(c1, c1 + 2 * c2) >= -7 * others or rotation + c1 + c2 + others > 0.0:
        return 2.0, 0.0
    x, rate = rotation / (rotation - (rotation + c1 + c2 + c3)), c1
    for _ in range(MAX_NEWTON_STEPS):
        value, rate = c7, 0.0
        rate = rate * x + value
        value = value * x + c6
        rate = rate * x + value
        value = value * x + c5
        rate = rate * x + value
        value = value * x + c4
        rate = rate * x + value
        value = value * x + c3
        rate = rate * x + value
        value = value * x + c2
        rate = rate * x + value
        value = value * x + c1
        rate = rate * x + value
        value = value * x + rotation
        change = value / rate
        x -= change
        if abs(change) <= 1e-12 * x:
            return (x, rate / h) if 0.0 < x <= 1.0 else (2.0, 0.0)
    return 2.0, 0.0


@compiled(fastmath={"contract"}, forceinline=True)
def turned(sine, cosine, turn):
    """Return sin and cos of φ and a turn so small that these terms are exact to the last digit."""
    square = turn * turn
    swing = turn + turn * square * (-1 / 6 + square * (1 / 120 - square * (1 / 5040)))
    drop = square * (-1 / 2 + square * (1 / 24 + square * (-1 / 720 + square * (1 / 40320))))
    return sine + (cosine * swing + sine * drop), cosine + (cosine * drop - sine * swing)


@compiled(fastmath={"contract"})
def skip_quiet_pieces(block, forcing, state, piece, method, peak, impacts, leaves):
    """Pass over pieces of a record, and landings in them, until one is not proven.

    The block rocks under the exact equation; `state` is that at the first sample of `piece`. A
    piece is passed over if the terms prove (as in `step.advance`) that it holds no impact and that
    the rotation grows throughout, or stays below `peak`, the largest φ so far. A landing is passed
    if it is proven to be the only one in its piece, and too fast to be the first of a train of
    bounces that ends in rest. If the block `leaves`, it stops where its survival is certain.

    Returns
    -------
    piece, state, peak, impacts
    is_low : bool
        The flight is below `MIN_COUNTED_PEAK` α so far.
    """
    bound, inverse_cosine = method.tolerance * block.slenderness, 1.0 / block.cosine
    record, beyond = forcing.record, 0
    time, side, rotation, velocity, sine, cosine, push, rate, gravity, change = state
    slight, is_low = MIN_COUNTED_PEAK * block.slenderness, False
    barrier = math.sqrt(2.0 * (1.0 - block.cosine))
    time, inside = 0.0, False
    while piece_start(forcing, piece + 1) < forcing.end and beyond < MAX_PIECES_BEYOND:
        if rotation > block.slenderness:
            if rotation > MAX_ROTATION * block.flat:
                break
            beyond += 1
        h = (record[TIME, piece + 1] - record[TIME, piece]) * forcing.step
        if inside:
            h = piece_start(forcing, piece + 1) - time
        tilt = block.cosine * cosine + block.sine * sine  # cos(α − φ)
        lean = block.sine * cosine - block.cosine * sine  # sin(α − φ)
        weight, weight_rate = inverse_cosine * gravity, inverse_cosine * change
        force, slope = sine * weight + push * tilt, cosine * weight + push * lean
        force_rate, slope_rate = (
            sine * weight_rate + rate * tilt,
            cosine * weight_rate + rate * lean,
        )
        is_passed, turn, gain = short_series(
            h, force, slope, force_rate, slope_rate, velocity, rotation, peak, bound
        )
        if not is_passed:
            if velocity >= 0.0 or is_low:
                break
            share, speed = landing(
                h, force, slope, force_rate, slope_rate, velocity, rotation, bound
            )
            if share > 1.0:
                break
            after, speed = share * h, -speed * block.restitution
            weight = gravity + change * after
            near, far = -(push + rate * after), push + rate * after + 2.0 * block.uplift_level * weight
            weakest = min(near, far)
            if weakest > 0.0 and speed * speed <= weakest * block.cosine * slight:
                break  # it may come to rest
            if not inside:
                time = piece_start(forcing, piece)
            time, inside, is_low = time + after, True, True
            side, rotation, velocity, sine, cosine = -side, 0.0, speed, 0.0, 1.0
            push, rate = -far, -rate - 2.0 * block.uplift_level * change
            gravity = weight
            impacts += 1
            if leaves:
                left, left_vertical = impulse_after(forcing, time, piece)
                if speed + left + left_vertical * block.sine < barrier:
                    break
            continue
        velocity += gain
        rotation += turn
        peak = max(peak, rotation)
        sine, cosine = turned(sine, cosine, turn)
        piece += 1
        value, slope, gravity, change = ground_of_piece(forcing, piece)
        push, rate = (
            -side * value - block.uplift_level * gravity,
            -side * slope - block.uplift_level * change,
        )
        inside = False
        is_low = is_low and rotation <= slight
    if not inside:
        time = piece_start(forcing, piece)
    state = State(time, side, rotation, velocity, sine, cosine, push, rate, gravity, change)
    return piece, state, peak, impacts, is_low
