"""One Taylor step of a rocking block, with proven events.

A step is as long as the truncation allows. Within it the solution is a polynomial, and the signs
of its Bernstein coefficients prove that the block neither lands nor turns, or isolate where it
does (`bernstein`).
"""

import math

import numpy as np

from topheavy.bodies.free_rocking import potential
from topheavy.kernel.bernstein import MAX_DEGREE, MAX_DEPTH, isolated_root, roots, to_bernstein
from topheavy.kernel.compiled import compiled
from topheavy.kernel.forcing import bounds_after, equation, impulse_after
from topheavy.kernel.taylor import ROTATION, State, expand, longest_step

#: Terms of φ in a step of a pulse.
PULSE_ORDER = 16
#: Bound on the last two terms of φ' in a step, normalised by α.
TOLERANCE = 3e-10
#: A history with more steps than this (and ten a sample) is given up as not resolved.
#:
#: A step ends at a landing or the end of a piece, or it is as long as the series allows: a tenth or
#: more of the time scale of the motion, 1/(1 + ω/p + √|a|). A pulse lasts 9π p/ω
#: at most, and one that is slow or strong has overturned the block, or lets it come to rest, within
#: a thousand such times. Hence only landings can be so many: of a block that loses next to nothing
#: at an impact (√r → 1). If √r < 1, a train of bounces dies out: above the level it ends by a
#: rotation, below by rest (`rest`), even if it is over before the clock ticks.
MAX_STEPS = 200_000
#: The events that end a step.
NOTHING, LANDING, FLAT = range(3)
#: Rows of the working array after those of `taylor`: the step polynomial and its derivative on
#: [0, 1], their Bernstein coefficients, the roots found, and the stack of `bernstein.roots`.
POLYNOMIAL, SLOPE, HULL, SLOPE_HULL, ROOTS, STACK = range(7, 13)
#: The row that begins with 1 when a history is to be given up: see `bernstein.roots` and
#: `grid.in_threads`.
HALT = STACK + MAX_DEPTH


def working_array():
    """Return the array that a history works in; a thread needs one for all its histories."""
    return np.zeros((HALT + 1, MAX_DEGREE + 3))


@compiled
def is_certain_to_overturn(block, forcing, state):
    """Return whether no forcing of the strength that is left can bring the block back.

    With |a| ≤ A G from now on, φ'' ≥ −G √(1 + A²) sin(φ* − φ) with φ* = α + atan A < π/2;
    linearised, φ'' ≥ −G (φ* − φ) with φ* = α + A. A block moving outward with φ' above the square
    root of the largest such factor times φ* − φ reaches φ*, from where nothing holds it.
    """
    if state.rotation <= block.slenderness or state.velocity <= 0.0:
        return False
    strength, heaviest = bounds_after(forcing, state.time)
    if block.linearised:
        distance = block.slenderness + strength - state.rotation
        return state.velocity > math.sqrt(heaviest) * distance
    balance = block.slenderness + math.atan(strength)
    factor = math.sqrt(math.sqrt(1.0 + strength * strength) * heaviest)
    return balance < block.flat and state.velocity > factor * (balance - state.rotation)


@compiled
def is_certain_to_survive(block, forcing, state, piece, peak):
    """Return whether what is left of the forcing takes the block neither to φ = α nor to `peak`.

    Let S = √(φ'² + 2w), with the w(φ) of `bodies.free_rocking`: the speed at which a block without
    forcing would pass φ = 0. With w' = sin(α − φ), Eq. (23) is
    φ'' = −s a cos(α − φ) − (1 + v) sin(α − φ). Hence, for φ ≤ α, where |φ'| ≤ S,

        S S' = φ' (φ'' + w') = −φ' (s a cos(α − φ) + v sin(α − φ)),    S' ≤ |a| + |v| α;

    linearised, with 1 for the cosine and α − φ for the sine. An impact multiplies S by √r ≤ 1, and
    a block at rest has S = 0. At a rotation φ, S is at least √(2w(φ)), which grows up to φ = α. So
    no rotation is reached whose √(2w) exceeds S + ∫(|a| + α |v|) dτ over all that is left.
    """
    alpha = block.slenderness
    push, weight = impulse_after(forcing, state.time, piece)
    impulse = push + alpha * weight
    if state.rotation > alpha or impulse >= alpha:  # √(2w(α)) ≤ α
        return False
    speed = math.sqrt(state.velocity * state.velocity + 2.0 * potential(block, state.rotation))
    return speed + impulse < math.sqrt(2.0 * potential(block, min(peak, alpha)))


@compiled(fastmath={"contract"})
def advance(w, method, block, forcing, state, zero_order, longest, peak):
    """Find a step of at most `longest`.

    Parameters
    ----------
    zero_order : int
        How many of φ, φ', φ'' are zero at the start: 1 after an impact, 2 after an uplift by a
        jump of the forcing, 3 after an uplift where |a| passes the level, 0 else.
    peak : float
        The largest φ so far.

    Returns
    -------
    step : float
        The length of the step, up to the event if there is one.
    event : int
        `NOTHING`, `LANDING` or `FLAT`.
    peak : float
        The largest φ so far, this step included.
    """
    order = method.order
    expand(w, method, block, state, equation(forcing, state.time))
    bound = method.tolerance * max(block.slenderness, state.rotation)
    step = longest_step(w, order, bound, longest)

    power = 1.0
    for k in range(order + 1):
        w[POLYNOMIAL, k] = w[ROTATION, k] * power
        power *= step
    if zero_order >= 2:
        final, rises = _plain_rise(w, order, zero_order)
        if rises and final <= block.flat:
            return step, NOTHING, max(peak, final)
    else:
        low, high, final, rises, falls = _plain_range(w, order)
        if rises and final <= block.flat:
            return step, NOTHING, max(peak, final)
        if low > 0.0 and high <= min(peak, block.flat):
            return step, NOTHING, peak
        if falls:
            highest = max(peak, w[POLYNOMIAL, 0])
            if final > 0.0:
                return step, NOTHING, highest
            landing = isolated_root(w, POLYNOMIAL, 0, order, 0.0, 1.0, 1.0)
            return step * landing, LANDING, highest
    end, event, peak = proven(w, order, zero_order, block.flat, peak)
    return step * end, event, peak


@compiled
def proven(w, order, zero_order, flat, peak):
    """Return where the step polynomial ends on [0, 1], its event, and the largest φ so far."""
    to_bernstein(w, POLYNOMIAL, order, HULL)
    least, largest = w[HULL, zero_order], 0.0
    for k in range(zero_order, order + 1):
        least = min(least, w[HULL, k])
        largest = max(largest, w[HULL, k])

    end, event = 1.0, NOTHING
    if least <= 0.0 and roots(w, POLYNOMIAL, zero_order, order, HULL, STACK, ROOTS, 1) > 0:
        end, event = w[ROOTS, 0], LANDING
    if largest > flat:
        for k in range(order + 1):
            w[SLOPE, k], w[SLOPE_HULL, k] = -w[POLYNOMIAL, k], flat - w[HULL, k]
        w[SLOPE, 0] += flat
        if roots(w, SLOPE, 0, order, SLOPE_HULL, STACK, ROOTS, 1) > 0 and w[ROOTS, 0] < end:
            end, event = w[ROOTS, 0], FLAT
    if largest > peak:
        peak = _largest_rotation(w, order, zero_order, end, peak)
    return end, event, peak


@compiled(fastmath={"contract"})
def _plain_range(w, order):
    """Return bounds of the step polynomial on [0, 1], its last value, whether it rises or falls.

    The first five terms lie within their Bernstein coefficients, and so does their derivative. The
    other terms are no larger than the sum of their moduli.
    This settles most steps at a tenth of the price of a proof.
    """
    c0, c1, c2, c3 = w[POLYNOMIAL, 0], w[POLYNOMIAL, 1], w[POLYNOMIAL, 2], w[POLYNOMIAL, 3]
    c4 = w[POLYNOMIAL, 4]
    others, final, bend = 0.0, 0.0, 0.0
    for k in range(5, order + 1):
        size = abs(w[POLYNOMIAL, k])
        final += w[POLYNOMIAL, k]
        others += size
        bend += k * size
    last = c0 + c1 + c2 + c3 + c4
    s1, s2, s3 = c1 + 2 * c2 / 3, c1 + 4 * c2 / 3 + c3, c1 + 2 * c2 + 3 * c3 + 4 * c4
    rises = min(min(c1, s1), min(s2, s3)) > bend
    falls = max(max(c1, s1), max(s2, s3)) < -bend
    b1, b2, b3 = c0 + c1 / 4, c0 + c1 / 2 + c2 / 6, c0 + 0.75 * c1 + 0.5 * c2 + 0.25 * c3
    low = min(min(c0, b1), min(b2, min(b3, last))) - others
    high = max(max(c0, b1), max(b2, max(b3, last))) + others
    return low, high, last + final, rises, falls


@compiled(fastmath={"contract"})
def _plain_rise(w, order, zero_order):
    """Return the last value of the step polynomial after an uplift and whether it surely rises.

    As `_plain_range`, with the first four terms of the derivative over x to its zeros at 0.
    """
    a, b = zero_order * w[POLYNOMIAL, zero_order], (zero_order + 1) * w[POLYNOMIAL, zero_order + 1]
    c, d = (
        (zero_order + 2) * w[POLYNOMIAL, zero_order + 2],
        (zero_order + 3) * w[POLYNOMIAL, zero_order + 3],
    )
    final, bend = 0.0, 0.0
    for k in range(zero_order, order + 1):
        final += w[POLYNOMIAL, k]
    for k in range(zero_order + 4, order + 1):
        bend += k * abs(w[POLYNOMIAL, k])
    least = min(min(a, a + b / 3), min(a + (2 * b + c) / 3, a + b + c + d))
    return final, least > bend


@compiled
def _largest_rotation(w, order, zero_order, end, peak):
    """Return the larger of `peak` and the largest value of the step polynomial on [0, end]."""
    for k in range(order):
        w[SLOPE, k] = (k + 1) * w[POLYNOMIAL, k + 1]
        w[SLOPE_HULL, k] = w[HULL, k + 1] - w[HULL, k]
    first = max(zero_order - 1, 0)
    turns = roots(w, SLOPE, first, order - 1, SLOPE_HULL, STACK, ROOTS, order)
    peak = max(peak, _value(w, order, end))
    for k in range(turns):
        if w[ROOTS, k] < end:
            peak = max(peak, _value(w, order, w[ROOTS, k]))
    return peak


@compiled
def _value(w, order, x):
    value = w[POLYNOMIAL, order]
    for k in range(order - 1, -1, -1):
        value = value * x + w[POLYNOMIAL, k]
    return value


@compiled
def after_impact(block, state):
    """Return the state on the other side: φ' times √r, the push as that side feels it."""
    velocity = max(-state.velocity, 0.0) * block.restitution
    push = -state.push - 2 * block.uplift_level * state.gravity
    rate = -state.rate - 2 * block.uplift_level * state.gravity_rate
    gravity, change = state.gravity, state.gravity_rate
    return State(state.time, -state.side, 0.0, velocity, 0.0, 1.0, push, rate, gravity, change)


@compiled
def with_ground(block, state, time, ground_motion):
    """Return the state at `time`, its push and gravity from a, a', G and G'."""
    (value, rate, gravity, change), side = ground_motion, state.side
    rotation, velocity, sine, cosine = state.rotation, state.velocity, state.sine, state.cosine
    push, push_rate = (
        -side * value - block.uplift_level * gravity,
        -side * rate - block.uplift_level * change,
    )
    return State(time, side, rotation, velocity, sine, cosine, push, push_rate, gravity, change)
