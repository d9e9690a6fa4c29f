"""Proven outcomes under one-cosine pulses: each number is a ball that contains the true one (Arb).

Time is τ = p t. With φ = |θ|, the side s and the ground acceleration a (g), Eq. (23) reads

    φ'' = −sin(α − φ) − s a cos(α − φ).

A step is a Taylor polynomial of φ about its beginning. Its last term, the remainder of Lagrange, is
taken over a range of φ and φ' that contains the motion during the step, by Picard's iteration. The
first term that is not zero is divided out, so that a motion that has just begun is known to rise.
"""

import math
from fractions import Fraction
from typing import NamedTuple

from flint import arb, arb_series, ctx, fmpq

from topheavy import STANDARD_GRAVITY

BITS, TERMS, STEPS = 160, 32, 40  # bits of a number, terms of a step, steps of a pulse
ITERATIONS, HALVINGS = 60, 40  # most iterations of Picard, and most halvings of a search for a sign
INFLATION = 0.1  # relative widening of a range that does not contain the motion yet
ctx.prec = BITS


class NotProvenError(ArithmeticError):
    """Balls of this precision do not decide; the message says why."""


class Block(NamedTuple):
    """α, √r, the amplitude of the pulse in g, and ω/p."""

    slenderness: arb
    restitution: arb
    amplitude: arb
    frequency: arb


class State(NamedTuple):
    """A motion at τ: the side, φ and φ', and how many of φ, φ', φ'' are zero."""

    time: arb
    side: int
    rotation: arb
    velocity: arb
    zeros: int


def exact(number: float | str) -> arb:
    """Return a decimal number as a ball; a float stands for its shortest decimal."""
    fraction = Fraction(str(number))
    return arb(fmpq(fraction.numerator, fraction.denominator))


def block_of(column: dict, mass_ratio: float, amplitude: float, period: float) -> Block:
    """Return a column, or a frame on it, under a pulse of an amplitude (g) and a period (s)."""
    b, h, g = (exact(x) for x in (column["half_width"], column["half_height"], STANDARD_GRAVITY))
    slenderness = (b / h).atan()
    p = (3 * g / (4 * (b**2 + h**2).sqrt())).sqrt()
    restitution = 1 - 3 * slenderness.sin() ** 2 / 2
    if mass_ratio == math.inf:
        p, restitution = p * exact("2/3").sqrt(), (2 * slenderness).cos()
    elif mass_ratio:
        gamma = exact(mass_ratio)
        p *= ((1 + 2 * gamma) / (1 + 3 * gamma)).sqrt()  # Eq. (23)
        restitution = (restitution + 3 * gamma * (2 * slenderness).cos()) / (1 + 3 * gamma)
    return Block(slenderness, restitution, exact(amplitude), 2 * arb.pi() / (exact(period) * p))


def outcome(block: Block) -> str:
    """Return "survives" or "overturns", or raise NotProvenError."""
    if block.amplitude < block.slenderness.tan():
        return "survives"  # at rest
    if not (block.amplitude > block.slenderness.tan() and block.restitution > 0):
        raise NotProvenError("the pulse may not lift the block, or its √r may not be positive")
    end = 2 * arb.pi() / block.frequency
    usual, state = (end / STEPS).mid(), State(arb(0), -1, arb(0), arb(0), 2)
    while not state.time.overlaps(end):
        is_last = not end - state.time > usual
        length = end - state.time if is_last else usual
        polynomial, longest = terms(block, state, length), length.upper()
        shape, to_flat = polynomial[state.zeros :], [-term for term in polynomial]
        to_flat[0] += arb.pi() / 2
        stands = is_positive(to_flat, arb(0), longest)
        if is_positive(shape, arb(0), longest):
            rotation = value(polynomial, length)
            if rotation > arb.pi() / 2:
                return "overturns"
            velocity = value(slope(polynomial), length)
            time = end if is_last else state.time + length
            state = State(time, state.side, rotation, velocity, 0)
        else:
            state = after_impact(block, state, polynomial, length.mid())
        if not stands:
            raise NotProvenError("the rotation comes close to π/2")
    return outcome_of_energy(block, state)


def after_impact(block: Block, state: State, polynomial: list[arb], length: arb) -> State:
    """Return the state after the first impact of a step, whose time is a ball."""
    shape, rate, low, high = polynomial[state.zeros :], slope(polynomial), arb(0), length
    if not value(shape, high) < 0:
        raise NotProvenError("no impact and no flight")
    for _ in range(BITS):
        middle = ((low + high) / 2).mid()
        sign = value(shape, middle)
        if sign > 0:
            low = middle
        elif sign < 0:
            high = middle
        else:
            break
    first = low / 2  # up to here φ is positive, and from here on it falls
    while not value(rate, first.union(high)) < 0:
        first = ((first + low) / 2).mid()
        if not low - first > length / 2**HALVINGS:
            raise NotProvenError("the motion grazes the upright")
    if not is_positive(shape, arb(0), first):
        raise NotProvenError("an impact may come earlier")
    step = low.union(high)
    velocity = -block.restitution * value(rate, step)
    return State(state.time + step, -state.side, arb(0), velocity, 1)


def outcome_of_energy(block: Block, state: State) -> str:
    """Return the outcome after the pulse by energies, as `topheavy.bodies.free_rocking` does."""
    alpha, phi, rate = block.slenderness, state.rotation, state.velocity
    energy, barrier = rate**2 / 2 + (alpha - phi).cos() - alpha.cos(), 1 - alpha.cos()
    if (rate > 0 and energy > barrier) or (phi > alpha and energy < barrier):
        return "overturns"
    if phi < alpha and energy < barrier:
        return "survives"
    if rate < 0 and energy > barrier:
        behind = block.restitution**2 * energy  # the impact that follows
        if behind > barrier or behind < barrier:
            return "overturns" if behind > barrier else "survives"
    raise NotProvenError("the energy comes close to that of the barrier")


# One step -----------------------------------------------------------------------------------------


def terms(block: Block, state: State, length: arb) -> list[arb]:
    """Return the terms of φ over a step; the last one is its remainder."""
    rotation, velocity = contained(block, state, length)
    during = state._replace(
        time=state.time + arb(0).union(length), rotation=rotation, velocity=velocity
    )
    return [*series(block, state, TERMS), series(block, during, TERMS + 1)[TERMS]]


def slope(polynomial: list[arb]) -> list[arb]:
    """Return the terms of φ' over a step; the last one is its remainder, of one order less."""
    return [order * term for order, term in enumerate(polynomial)][1:]


def contained(block: Block, state: State, length: arb) -> tuple[arb, arb]:
    """Return ranges that contain φ and φ' during a step."""
    span = arb(0).union(length)
    rotation, velocity = state.rotation + 2 * span * state.velocity, state.velocity
    for _ in range(ITERATIONS):
        lean, phase = block.slenderness - rotation, block.frequency * (state.time + span)
        force = -lean.sin() - state.side * block.amplitude * phase.cos() * lean.cos()
        next_velocity = state.velocity + span * force
        next_rotation = state.rotation + span * next_velocity
        if next_velocity in velocity and next_rotation in rotation:
            return next_rotation, next_velocity
        rotation, velocity = (
            old.union(new + INFLATION * (new - new))
            for old, new in ((rotation, next_rotation), (velocity, next_velocity))
        )
    raise NotProvenError("a step is too long")


def series(block: Block, state: State, count: int) -> list[arb]:
    """Return `count` Taylor coefficients of φ. Each pass adds two."""
    ctx.cap = count  # terms of a series: flint drops others without a word
    phase = arb_series([block.frequency * state.time, block.frequency], prec=count)
    push = state.side * block.amplitude * phase.cos()
    known = [state.rotation, state.velocity]
    while len(known) < count:
        lean = block.slenderness - arb_series(known, prec=len(known))
        force = -lean.sin() - push * lean.cos()
        more = [force[n] / ((n + 1) * (n + 2)) for n in range(len(known))]
        known = [state.rotation, state.velocity, *more]
    return [arb(0)] * state.zeros + known[state.zeros : count]


def value(coefficients: list[arb], x: arb) -> arb:
    """Return a polynomial, by Horner's rule."""
    total = arb(0)
    for coefficient in reversed(coefficients):
        total = total * x + coefficient
    return total


def is_positive(polynomial: list[arb], low: arb, high: arb, depth: int = HALVINGS) -> bool:
    """Return whether a polynomial is proven positive on [low, high], by halving it."""
    if value(polynomial, low.union(high)) > 0:
        return True
    middle = ((low + high) / 2).mid()
    halves = (low, middle), (middle, high)
    return depth > 0 and all(is_positive(polynomial, *ends, depth - 1) for ends in halves)
