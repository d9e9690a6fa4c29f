"""The Taylor series of a rocking block over one step.

With φ = |θ|, time τ = p t, and the push q = −s a − tan α by which the ground acceleration exceeds
the uplift level, where s = ±1 is the side of the pivot, Eq. (23) reads

    φ'' = sin φ / cos α + q cos(α − φ),

and linearised, with q = −s a − α,

    φ'' = φ + q.

This is the paper's equation, regrouped so that nothing cancels: φ and q are both zero when the
block lifts off, and the first derivative that is not zero has the right sign, however
slender the block and however small the push. Under a vertical acceleration of G − 1 (g, upward)

    φ'' = G sin φ / cos α + q cos(α − φ),    φ'' = G φ + q (linearised),    q = −s a − G tan α

(or G α). sin φ and cos φ obey (sin φ)' = φ' cos φ and
(cos φ)' = −φ' sin φ, and the push its own linear equation (see `forcing`): a step is
multiplications and additions only (Jorba & Zou 2005, Exp. Math. 14, 99–117, §§2–3).
"""

import math
from typing import NamedTuple

import numpy as np

from topheavy.bodies.structures import RockingBlock
from topheavy.kernel.compiled import compiled

MAX_ORDER = 20
#: A division costs as much as ten multiplications.
INVERSE = 1.0 / np.maximum(np.arange(MAX_ORDER + 2), 1.0)


class Oscillator(NamedTuple):
    """A rocking block without p, which only scales the time.

    `uplift_level` is tan α, linearised α; linearised, `cosine` and `sine` are 1 and 0 (the limit
    α → 0), and the block has no end at φ = π/2 (`flat` is infinite).
    """

    slenderness: float
    restitution: float
    uplift_level: float
    cosine: float
    sine: float
    flat: float
    linearised: bool


def oscillator(block: RockingBlock) -> Oscillator:
    """Return a block as the kernel takes it."""
    alpha, restitution = float(block.slenderness), float(block.restitution)
    if block.linearised:
        return Oscillator(alpha, restitution, alpha, 1.0, 0.0, math.inf, True)
    return Oscillator(
        alpha, restitution, math.tan(alpha), math.cos(alpha), math.sin(alpha), math.pi / 2, False
    )


class State(NamedTuple):
    """A rocking block: τ, its side s, φ, φ', sin φ, cos φ, the push q and q', gravity G and G'."""

    time: float
    side: float
    rotation: float
    velocity: float
    sine: float
    cosine: float
    push: float
    rate: float
    gravity: float
    gravity_rate: float


#: How much of an outcome a history computes: whether the block overturns, and whether an impact
#: comes before; the peak rotation of a survivor, too; or also the number of impacts.
OUTCOME, PEAK, IMPACTS = range(3)


class Method(NamedTuple):
    """How a history is computed."""

    order: int  # of the series of φ
    tolerance: float  # bound on the last two terms of φ' in a step, normalised by α (φ if larger)
    is_straight: bool  # a and G are straight lines: a record's piece, a constant, no motion
    detail: int = IMPACTS  # or `OUTCOME` or `PEAK`


#: Rows of the working array `w`: the coefficients of φ, φ', sin φ, cos φ, cos(α − φ), q and G by
#: powers of τ − τ₀.
ROTATION, VELOCITY, SINE, COSINE, TILT, PUSH, GRAVITY = range(7)


@compiled(fastmath={"contract"})
def expand(w, method, block, state, ground_equation):
    """Fill `w` with the solution through `state`: φ to the order, the others to one less.

    `ground_equation` has the c, d₀ and d₁ of `forcing.equation`.
    """
    (order, _, is_straight, _), (c, d0, d1) = method, ground_equation
    w[ROTATION, 0], w[VELOCITY, 0] = state.rotation, state.velocity
    w[SINE, 0], w[COSINE, 0] = state.sine, state.cosine
    w[PUSH, 0], w[PUSH, 1] = (
        state.push + block.uplift_level,
        state.rate,
    )  # −s a solves the equation of a
    last_push = 1 if is_straight else order - 1
    for n in range(last_push - 1):
        curvature = (c + d1 * n) * w[PUSH, n] + d0 * (n + 1) * w[PUSH, n + 1]
        w[PUSH, n + 2] = -curvature * (INVERSE[n + 1] * INVERSE[n + 2])
    w[PUSH, 0] = state.push
    w[GRAVITY, 0], w[GRAVITY, 1] = state.gravity, state.gravity_rate
    if is_straight:
        _expand_straight(w, order, block)
    elif block.linearised:
        _expand_linearised(w, order)
    else:
        _expand_curved(w, order, block)


@compiled(fastmath={"contract"})
def _expand_linearised(w, order):
    for n in range(order):
        w[ROTATION, n + 1] = w[VELOCITY, n] * INVERSE[n + 1]
        force = w[ROTATION, n] + w[PUSH, n]  # φ'' = φ + q
        w[VELOCITY, n + 1] = force * INVERSE[n + 1]


@compiled(fastmath={"contract"})
def _expand_curved(w, order, block):
    """Eq. (23), φ'' = sin φ / cos α + q cos(α − φ).

    The three products of series are summed in two halves each: a sum waits for its last addition,
    so that six run in the time of three.
    """
    inverse_cosine = 1.0 / block.cosine
    for n in range(order):
        w[TILT, n] = block.cosine * w[COSINE, n] + block.sine * w[SINE, n]
        cosine, sine, force = 0.0, 0.0, w[SINE, n] * inverse_cosine
        cosine2, sine2, force2 = 0.0, 0.0, 0.0
        for i in range(0, n, 2):
            cosine += w[COSINE, n - i] * w[VELOCITY, i]
            sine += w[SINE, n - i] * w[VELOCITY, i]
            force += w[PUSH, n - i] * w[TILT, i]
            cosine2 += w[COSINE, n - i - 1] * w[VELOCITY, i + 1]
            sine2 += w[SINE, n - i - 1] * w[VELOCITY, i + 1]
            force2 += w[PUSH, n - i - 1] * w[TILT, i + 1]
        if n % 2 == 0:
            cosine += w[COSINE, 0] * w[VELOCITY, n]
            sine += w[SINE, 0] * w[VELOCITY, n]
            force += w[PUSH, 0] * w[TILT, n]
        w[ROTATION, n + 1] = w[VELOCITY, n] * INVERSE[n + 1]
        w[SINE, n + 1] = (cosine + cosine2) * INVERSE[n + 1]
        w[COSINE, n + 1] = -(sine + sine2) * INVERSE[n + 1]
        w[VELOCITY, n + 1] = (force + force2) * INVERSE[n + 1]


@compiled(fastmath={"contract"})
def _expand_straight(w, order, block):
    """Both equations where q and G have two terms each."""
    inverse_cosine, weight, change = 1.0 / block.cosine, w[GRAVITY, 0], w[GRAVITY, 1]
    turned = ROTATION if block.linearised else SINE
    for n in range(order):
        force = weight * w[turned, n]
        if n > 0:
            force += change * w[turned, n - 1]
        if block.linearised:
            force += w[PUSH, n] if n < 2 else 0.0
        else:
            w[TILT, n] = block.cosine * w[COSINE, n] + block.sine * w[SINE, n]
            force = force * inverse_cosine + w[PUSH, 0] * w[TILT, n]
            if n > 0:
                force += w[PUSH, 1] * w[TILT, n - 1]
            cosine, sine = 0.0, 0.0
            for i in range(n + 1):
                cosine += w[COSINE, n - i] * w[VELOCITY, i]
                sine += w[SINE, n - i] * w[VELOCITY, i]
            w[SINE, n + 1] = cosine * INVERSE[n + 1]
            w[COSINE, n + 1] = -sine * INVERSE[n + 1]
        w[ROTATION, n + 1] = w[VELOCITY, n] * INVERSE[n + 1]
        w[VELOCITY, n + 1] = force * INVERSE[n + 1]


@compiled
def longest_step(w, order, bound, limit):
    """Return the step, at most `limit`, over which the last two terms of φ' are below `bound`.

    The terms left out are smaller again by the ratio of two terms. Two are looked at because
    every other one may vanish.
    """
    last, second = abs(w[VELOCITY, order - 1]), abs(w[VELOCITY, order - 2])
    power = 1.0
    for _ in range(order - 2):
        power *= limit
    if second * power <= bound and last * power * limit <= bound:
        return limit
    exponent = math.inf
    if last > 0.0:
        exponent = math.log(bound / last) * INVERSE[order - 1]
    if second > 0.0:
        exponent = min(exponent, math.log(bound / second) * INVERSE[order - 2])
    return min(math.exp(exponent), limit) if exponent < 50.0 else limit


@compiled(fastmath={"contract"})
def evaluate(w, method, block, start, step):
    """Return the `State` at `step` after the `start` of the series."""
    order = method.order
    rotation, velocity, sine, cosine = w[ROTATION, order], 0.0, 0.0, 0.0
    push, rate = 0.0, 0.0
    for n in range(order - 1, -1, -1):
        rotation = rotation * step + w[ROTATION, n]
        velocity = velocity * step + w[VELOCITY, n]
        sine = sine * step + w[SINE, n]
        cosine = cosine * step + w[COSINE, n]
        rate = rate * step + push
        push = push * step + w[PUSH, n]
    if method.is_straight:
        push, rate = w[PUSH, 0] + step * w[PUSH, 1], w[PUSH, 1]
    if block.linearised:
        sine, cosine = 0.0, 1.0
    weight, change = w[GRAVITY, 0] + step * w[GRAVITY, 1], w[GRAVITY, 1]
    time, side = start.time + step, start.side
    return State(time, side, rotation, velocity, sine, cosine, push, rate, weight, change)
