"""The pieces of a record over which nothing happens, or a landing only, one short series each.

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

import numpy as np

from topheavy.kernel.bernstein import isolated_root
from topheavy.kernel.compiled import compiled
from topheavy.kernel.forcing import ground_of_piece, piece_start
from topheavy.kernel.rest import may_rest
from topheavy.kernel.step import POLYNOMIAL, after_impact, is_certain_to_survive
from topheavy.kernel.taylor import IMPACTS, INVERSE, State

#: Between two samples the block turns by less than this, so that seven terms give sin and cos.
MAX_TURN = 0.05
#: Pieces beyond φ = α after which the driver looks whether the block is certain to overturn.
MAX_PIECES_BEYOND = 32
#: Relative to φ = π/2: up to this rotation no piece reaches the end of the exact motion.
MAX_ROTATION = 0.9


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
def short_series(h, force, slope, force_rate, slope_rate, velocity, bound):
    """Return whether seven terms suffice for a piece, its terms of φ, and by how much φ' changes.

    `h` is its length, `bound` that on the first term of φ' left out. That term may vanish, and then
    h/7 of the last term kept stands for it. If the last term kept is as small, so is the first left
    out. The sums are in pairs: each piece waits for those of the piece before it.
    """
    h1, h2, h3, h4, h5, h6, h7 = powers(h)
    d3, d4, d5, d6, d7 = derivatives(force, slope, force_rate, slope_rate, velocity)
    terms = h1 * velocity, h2 * force, h3 * d3, h4 * d4, h5 * d5, h6 * d6, h7 * d7
    gain = ((h1 * force + h2 * d3) + (h3 * d4 + h4 * d5)) + (h5 * d6 + h6 * d7)
    is_enough = h6 * max(abs(d7), abs(d6)) <= bound
    if not is_enough:
        d8 = eighth_derivative(force, slope, force_rate, slope_rate, velocity)
        is_enough = h7 * max(abs(d8), abs(d7)) <= bound
    return is_enough, terms, gain


@compiled(fastmath={"contract"}, forceinline=True)
def is_quiet(terms, rotation, peak):
    """Return whether φ surely stays positive, and grows throughout or stays below `peak`."""
    c1, c2, c3, c4, c5, c6, c7 = terms
    others = abs(c3) + abs(c4) + abs(c5) + abs(c6) + abs(c7)
    if min(c1, c1 + 2 * c2) > 7 * others:
        return True
    low = min(0.5 * c1, c1 + c2, 0.0) - others
    high = max(0.5 * c1, c1 + c2, 0.0) + others
    return rotation + low > 0.0 and rotation + high <= peak


@compiled(fastmath={"contract"})
def landing(w, terms, rotation):
    """Return the share of a piece after which the block lands, and dφ/dx there, x being the share.

    It falls throughout, with φ < 0 at the end: there is one root. Otherwise the share is infinite.
    """
    c1, c2, c3, c4, c5, c6, c7 = terms
    others = abs(c3) + abs(c4) + abs(c5) + abs(c6) + abs(c7)
    w[POLYNOMIAL, 0], final, slope = rotation, rotation, 0.0
    for k in range(7):
        w[POLYNOMIAL, k + 1] = terms[k]
        final += terms[k]
    if max(c1, c1 + 2 * c2) >= -7 * others or final >= 0.0:
        return np.inf, 0.0
    share = isolated_root(w, POLYNOMIAL, 0, 7, 0.0, 1.0, 1.0)
    for k in range(7, 0, -1):
        slope = slope * share + k * w[POLYNOMIAL, k]
    return share, slope


@compiled(fastmath={"contract"}, forceinline=True)
def turned(sine, cosine, turn):
    """Return sin and cos of φ and a turn so small that these terms are exact to the last digit."""
    square = turn * turn
    swing = turn + turn * square * (-1 / 6 + square * (1 / 120 - square * (1 / 5040)))
    drop = square * (-1 / 2 + square * (1 / 24 + square * (-1 / 720 + square * (1 / 40320))))
    return sine + (cosine * swing + sine * drop), cosine + (cosine * drop - sine * swing)


@compiled(fastmath={"contract"})
def skip_quiet_pieces(w, method, block, forcing, state, piece, peak, impacts):
    """Pass over pieces of a record until one is not settled here.

    The block rocks under the exact equation, not below `rest.MIN_COUNTED_PEAK` α. A piece is passed
    over if the terms prove (as in `step.advance`) that it holds no impact and that the rotation
    grows throughout, or stays below `peak`, the largest φ so far. The first term of φ' left out is
    at most the tolerance times α.

    Where not all impacts have to be counted, a block also passes a landing that is proven to be the
    only one in its piece, and too fast for the rest that `rest.comes_to_rest` proves. It stops
    there if it is certain to survive.

    Returns
    -------
    state : State
        Where the first piece that is not passed over begins, or behind a landing in it.
    piece : int
        This piece.
    peak : float
        The largest φ so far.
    impacts : int
    """
    bound, inverse_cosine, beyond = method.tolerance * block.slenderness, 1.0 / block.cosine, 0
    time, side, rotation, velocity, sine, cosine, push, rate, gravity, change = state
    while piece_start(forcing, piece + 1) < forcing.end and beyond < MAX_PIECES_BEYOND:
        if rotation > block.slenderness:
            if rotation > MAX_ROTATION * block.flat:
                break
            beyond += 1
        end = piece_start(forcing, piece + 1)
        h = end - time
        tilt = block.cosine * cosine + block.sine * sine  # cos(α − φ)
        lean = block.sine * cosine - block.cosine * sine  # sin(α − φ)
        weight, weight_rate = inverse_cosine * gravity, inverse_cosine * change
        is_enough, terms, gain = short_series(
            h,
            sine * weight + push * tilt,
            cosine * weight + push * lean,
            sine * weight_rate + rate * tilt,
            cosine * weight_rate + rate * lean,
            velocity,
            bound,
        )
        c1, c2, c3, c4, c5, c6, c7 = terms
        turn = ((c1 + c2) + (c3 + c4)) + (c5 + c6) + c7
        if not (is_enough and abs(turn) <= MAX_TURN):
            break
        if not is_quiet(terms, rotation, peak):
            if method.detail == IMPACTS:
                break
            share, slope = landing(w, terms, rotation)
            after = share * h
            if not time < time + after < end:
                break
            touch = State(
                time + after, side, 0.0, slope / h, 0.0, 1.0,
                push + rate * after, rate, gravity + change * after, change,
            )  # fmt: skip
            landed = after_impact(block, touch)
            if may_rest(block, landed, method, peak):
                break
            impacts += 1
            time, side, rotation, velocity, sine, cosine, push, rate, gravity, change = landed
            if is_certain_to_survive(block, forcing, landed, piece, peak):
                break
            continue
        velocity += gain
        rotation += turn
        peak = max(peak, rotation)
        sine, cosine = turned(sine, cosine, turn)
        piece += 1
        time = end
        value, slope, gravity, change = ground_of_piece(forcing, piece)
        push, rate = (
            -side * value - block.uplift_level * gravity,
            -side * slope - block.uplift_level * change,
        )
    state = State(time, side, rotation, velocity, sine, cosine, push, rate, gravity, change)
    return state, piece, peak, impacts
