"""Why a heavier frame overturns without an impact only if a lighter one does. Proofs by algebra.

Frames 1 (lighter) and 2 (heavier) have the same α and p₁ > p₂. They uplift together, to the side s,
and feel the same ü_g = a g. Until an impact φ = |θ| obeys φ̈ = p² F(φ), with

    F = φ − α − s a  (linearised),    F = sin(φ − α) − s a cos(φ − α)  (exact),

so that y = φ/p² obeys ÿ = F(p² y), and z = y₁ − y₂ starts from z = ż = 0. So it does after every
common rest. Over ground with the vertical acceleration v g, v > −1, F becomes F_v. The text that
joins the proofs is in the supplement, "Theorems".
"""

from __future__ import annotations

from functools import cache

import sympy as sp

from derivation.mechanics import equation_of_motion, frequency_ratio, squared_frequency
from derivation.notation import SIDES, Side, alpha, g, gamma, ground_acceleration

p_1, p_2 = sp.symbols("p_1 p_2", positive=True)
_a, _z, _z_dot, _y_dot = sp.symbols("a z z_dot y_dot", real=True)
_phi, _y, _tau, _excess = sp.symbols("phi y tau epsilon", positive=True)
_rate = sp.Symbol("phi_dot", real=True)
_gravity = sp.Symbol("w", positive=True)  # 1 + v


@cache
def _reduced(side: Side) -> sp.Expr:
    """F of the frame: s θ̈/p̂², with θ = s φ and ü_g = a g."""
    motion = equation_of_motion(side).rhs
    reduced = side.sign * motion / squared_frequency(motion, side)
    return sp.simplify(reduced.subs({ground_acceleration: _a * g, side.rotation: side.sign * _phi}))


@cache
def linearised(side: Side) -> sp.Expr:
    """F to the first order in φ, α and a."""
    small = {symbol: _excess * symbol for symbol in (_phi, alpha, _a)}
    return sp.diff(_reduced(side).subs(small, simultaneous=True), _excess).subs(_excess, 0)


def exact(side: Side) -> sp.Expr:
    """sin(φ − α) − s a cos(φ − α)."""
    return sp.sin(_phi - alpha) - side.sign * _a * sp.cos(_phi - alpha)


def mass_ratio_leaves_only_the_time_scale() -> bool:
    """F does not contain γ, and p̂ falls with γ: of two frames the heavier has the lower p̂."""
    falls = sp.factor(sp.diff(frequency_ratio() ** 2, gamma)).is_negative
    same = all(
        not _reduced(side).has(gamma)
        and sp.simplify(sp.expand_trig(_reduced(side) - exact(side))) == 0
        for side in SIDES
    )
    return bool(falls) and same


def difference_is_driven_by_the_heavier_frame() -> bool:
    """Linearised, z̈ = p₁² z + (p₁² − p₂²) y₂: the ground motion drops out."""
    return all(
        sp.expand(
            linearised(side).subs(_phi, p_1**2 * (_y + _z))
            - linearised(side).subs(_phi, p_2**2 * _y)
            - (p_1**2 * _z + (p_1**2 - p_2**2) * _y)
        )
        == 0
        for side in SIDES
    )


def difference_never_falls() -> bool:
    """z̈ = p₁² z + w with z = ż = 0 at first: z and ż are integrals of w over positive kernels."""
    kernel = sp.sinh(p_1 * _tau) / p_1
    rate = sp.diff(kernel, _tau)
    solves = (
        kernel.subs(_tau, 0) == 0
        and rate.subs(_tau, 0) == 1
        and sp.simplify(sp.diff(rate, _tau) - p_1**2 * kernel) == 0
    )
    return solves and bool(kernel.is_positive) and bool(rate.is_positive)


def overturning_is_a_growing_term() -> bool:
    """Free and linearised, φ − α = A e^(pt) + B e^(−pt), with an energy of −2AB above that at α.

    A = (φ − α + φ̇/p)/2. A > 0 is moving outward with at least that energy, or being beyond α with
    less: the block overturns. For A < 0 it goes through an impact.
    """
    growing, fading = ((_phi - alpha + sign * _rate / p_1) / 2 for sign in (1, -1))
    course = growing * sp.exp(p_1 * _tau) + fading * sp.exp(-p_1 * _tau)
    starts = (course.subs(_tau, 0) - (_phi - alpha), sp.diff(course, _tau).subs(_tau, 0) - _rate)
    moves = sp.diff(course, _tau, 2) - p_1**2 * course
    excess = _rate**2 / (2 * p_1**2) + _phi * (alpha - _phi / 2) - alpha**2 / 2
    return all(sp.simplify(zero) == 0 for zero in (*starts, moves, excess + 2 * growing * fading))


def lighter_frame_has_the_larger_growing_term() -> bool:
    """2A₁ − 2A₂ = p₁² z + p₁ ż + (p₁ − p₂)(p₁ y₂ + α/p₂ + 2A₂/p₂), positive for A₂ > 0."""
    of_lighter = p_1**2 * (_y + _z) + p_1 * (_y_dot + _z_dot) - alpha
    of_heavier = p_2**2 * _y + p_2 * _y_dot - alpha
    terms = p_1**2 * _z + p_1 * _z_dot
    terms += (p_1 - p_2) * (p_1 * _y + (alpha + of_heavier) / p_2)
    return bool(sp.expand(of_lighter - of_heavier - terms) == 0)


def beyond_alpha_the_push_is_additive() -> bool:
    """Exact, beyond α, tanh x = sin(φ − α) and Y = (x + α)/p² obey Ÿ = sinh x − s a + p² tanh x Ẏ².

    There sinh x = tan(φ − α). At φ = α the coordinate x = φ − α joins it, with equal first and
    second derivatives. A jump D of the outward ground velocity over g adds D to Ẏ beyond α.
    """
    rate, p = sp.symbols("rate p", positive=True)
    beyond = sp.Symbol("mu", positive=True)
    stretched = sp.atanh(sp.sin(beyond))
    first, second = (sp.simplify(sp.diff(stretched, beyond, order)) for order in (1, 2))
    identities = [first.subs(beyond, 0) == 1, second.subs(beyond, 0) == 0]
    for side in SIDES:
        force = exact(side).subs(_phi, alpha + beyond)
        # p² Ÿ = ẍ = x' φ̈ + x'' φ̇², with φ̈ = p² F and x' φ̇ = ẋ = p² Ẏ
        change = first * force + second * (p * rate / first) ** 2
        stated = sp.tan(beyond) - side.sign * _a + p**2 * sp.sin(beyond) * rate**2
        jump = sp.diff(first * force, _a) + side.sign
        identities += [sp.simplify(change - stated) == 0, sp.simplify(jump) == 0]
    return all(identities)


def larger_rotation_feels_the_larger_push() -> bool:
    """Exact, H = F (x ≤ 0) and H = sinh x − s a (x ≥ 0) do not fall with x if s a ≤ cot(α − φ).

    Beyond α no bound is necessary. The bound rises with φ: s a ≤ cot(α − φ₂) is sufficient between
    φ₂ and any φ₁ > φ₂, and s a ≤ cot α everywhere.
    """
    within, x, slope = sp.symbols("lambda x slope", positive=True)
    push = sp.Symbol("push", real=True)
    rise_within = 1 - push * sp.tan(within)
    identities = []
    for side in SIDES:
        rise = sp.diff(exact(side), _phi).subs(_a, side.sign * push)
        up_to = sp.expand_trig(rise.subs(_phi, alpha - within)) / sp.cos(within)
        identities.append(sp.simplify(up_to - rise_within) == 0)
    # least at s a = cot(α − φ₂), where tan(α − φ₂) = x + slope > x = tan(α − φ)
    least = sp.factor(rise_within.subs({push: 1 / (x + slope), sp.tan(within): x}))
    beyond = sp.diff(sp.sinh(x) - push, x)
    return all(identities) and bool(least.is_positive) and bool(beyond.is_positive)


def difference_never_falls_in_the_exact_equation() -> bool:
    """Z = Y₁ − Y₂ obeys Z̈ − b Ż = H₁ − H₂ + (p₁² T₁ − p₂² T₂) Ẏ₁², b = p₂² T₂ (Ẏ₁ + Ẏ₂).

    T is tanh x beyond α and 0 up to it, and x₁ − x₂ = p₁² Z + (p₁² − p₂²) Y₂. With Z ≥ 0 the right
    side is not negative, as H and T = tanh x do not fall with x: so Ż exp(−∫ b dt) does not fall.
    """
    forces, terms, rates = (sp.symbols(f"{name}_1 {name}_2", real=True) for name in "HTY")
    squares = p_1**2, p_2**2
    one, two = (
        force + square * term * rate**2
        for force, square, term, rate in zip(forces, squares, terms, rates, strict=True)
    )
    b = p_2**2 * terms[1] * sum(rates)
    driven = forces[0] - forces[1]
    driven += (squares[0] * terms[0] - squares[1] * terms[1]) * rates[0] ** 2
    excess = p_1**2 * (_y + _z) - p_2**2 * _y - (p_1**2 * _z + (p_1**2 - p_2**2) * _y)
    same = sp.expand(one - two - b * (rates[0] - rates[1]) - driven) == 0
    return bool(same and sp.expand(excess) == 0)


def push_above_the_bound_reverses_the_order() -> bool:
    """After a small jump W of Ẏ and a constant inward push c > cot α, frame 1 has the first impact.

    To the leading order Y = W t − D t²/2 with D = sin α + c cos α, and at the common return
    T = 2 W/D the difference is Z = −(c sin α − cos α)(p₁² − p₂²) W T³/12.
    """
    jump, push, time, back = sp.symbols("W c t T", positive=True)
    force = exact(SIDES[1]).subs(_a, push)
    fall = -force.subs(_phi, 0)
    slope = sp.diff(force, _phi).subs(_phi, 0)  # of F with φ = p² Y
    course = jump * time - fall * time**2 / 2
    apart = (p_1**2 - p_2**2) * slope * sp.integrate((back - time) * course, (time, 0, back))
    stated = -(push * sp.sin(alpha) - sp.cos(alpha)) * (p_1**2 - p_2**2) * jump * back**3 / 12
    return bool(
        sp.simplify(apart.subs(back, 2 * jump / fall) - stated.subs(back, 2 * jump / fall)) == 0
    )


def difference_grows_under_vertical_acceleration() -> bool:
    """Linearised, z̈ = (1 + v)(p₁² z + (p₁² − p₂²) y₂): not negative while z and y₂ are not.

    F_v is 1 + v times F under a/(1 + v) (`extensions`), for every γ. So with 1 + v > 0 it
    does not fall with φ where F under a/(1 + v) does not.
    """
    identities = []
    for side in SIDES:
        force = _gravity * linearised(side).subs(_a, _a / _gravity)
        change = force.subs(_phi, p_1**2 * (_y + _z)) - force.subs(_phi, p_2**2 * _y)
        stated = _gravity * (p_1**2 * _z + (p_1**2 - p_2**2) * _y)
        identities.append(sp.expand(change - stated) == 0)
    return all(identities)


def push_in_one_direction_only_helps_that_side() -> bool:
    """With a ≥ 0 towards one side, F there rises with a, and with φ up to α.

    Over its free energy, the block gains ∫ a cos(α − φ) dφ on that side, and loses it on the other.
    """
    within, push = sp.symbols("lambda push", positive=True)
    identities = []
    for side in SIDES:
        toward = exact(side).subs(_a, -side.sign * push)
        in_push = sp.diff(toward, push).subs(_phi, alpha - within)
        in_angle = sp.expand_trig(sp.diff(toward, _phi).subs(_phi, alpha - within))
        identities += [
            sp.simplify(in_push - sp.cos(within)) == 0,
            sp.simplify(in_angle - (sp.cos(within) + push * sp.sin(within))) == 0,
        ]
        for sign, there in ((1, side), (-1, side.other)):
            force = exact(there).subs(_a, -side.sign * push)
            free = force.subs(push, 0)  # dw/dφ is −F of the free block
            identities.append(
                sp.simplify(_rate * (force - free) - sign * push * sp.cos(_phi - alpha) * _rate)
                == 0
            )
    return all(identities)
