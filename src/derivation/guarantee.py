"""Ground velocities below which nothing overturns: the identities of Theorem 4. Proofs by algebra.

Between two impacts φ = |θ| obeys Eq. (23) over ground with the horizontal velocity v, which stays
within V of the middle of its range. With u = −v sgn θ/V, κ = p̂² V/g, C = cos(α − φ),
S = sin(α − φ) and ζ = φ̇/C,

    Y = ζ + κ (1 − u),    F = Y² C²/2 + p̂² C.

The text that joins the identities is in the supplement, "Theorems".
"""

from __future__ import annotations

import sympy as sp

from derivation.mechanics import (
    equation_of_motion,
    frequency_ratio,
    restitution,
    squared_frequency,
)
from derivation.notation import (
    POSITIVE,
    SIDES,
    R,
    Side,
    alpha,
    g,
    gamma,
    ground_acceleration,
    is_identically_zero,
)

_p, _V, _root = sp.symbols("p V root", positive=True)
_Y, _zeta, _u, _u_dot = sp.symbols("Y zeta u u_dot", real=True)
_lean = sp.Symbol("lambda", real=True)  # α − φ
_kappa = _p**2 * _V / g
_excess = sp.Symbol("epsilon", positive=True)
_S, _C = sp.sin(_lean), sp.cos(_lean)
LEVEL = _Y**2 * _C**2 / 2 + _p**2 * _C
"""F."""


def outward_acceleration(side: Side) -> sp.Expr:
    """φ̈ of Eq. (23) in α − φ, with p̂² written p² and the ground velocity −s u V."""
    motion = equation_of_motion(side).rhs
    reduced = side.sign * motion / squared_frequency(motion, side)
    push = {ground_acceleration: -side.sign * _u_dot * _V}
    angle = side.sign * (alpha - _lean)
    return sp.simplify(_p**2 * reduced.subs(push).subs(side.rotation, angle))


def change_of_y(side: Side) -> sp.Expr:
    """Ẏ, with φ̇ = ζ C: ζ̇ = φ̈/C − ζ² S."""
    return outward_acceleration(side) / _C - _zeta**2 * _S - _kappa * _u_dot


def ground_acceleration_drops_out() -> bool:
    """Ẏ = −(S/C)(p̂² + ζ² C), in which no ground acceleration occurs: Y passes through its jumps."""
    stated = -_S / _C * (_p**2 + _zeta**2 * _C)
    return all(sp.simplify(change_of_y(side) - stated) == 0 for side in SIDES)


def level_does_not_rise_between_impacts() -> bool:
    """Ḟ = S C (Y − ζ)(Y ζ C − p̂²), and Y − ζ = κ (1 − u) ≥ 0: F falls where Y ζ C < p̂².

    For Y = ζ, that is u = 1, F is constant: the ground velocity that is held outward is the worst.
    """
    identities = []
    for side in SIDES:
        change = sp.diff(LEVEL, _Y) * change_of_y(side) - sp.diff(LEVEL, _lean) * _zeta * _C
        stated = _S * _C * (_Y - _zeta) * (_Y * _zeta * _C - _p**2)
        identities.append(sp.simplify(change - stated) == 0)
    return all(identities)


def level_at_alpha_is_the_limit() -> bool:
    """F = p̂² at φ = α with Y = 0 needs Y₀ cos α = 2 p̂ sin(α/2): Y* = 2 p̂ sin(α/2)/cos α.

    Below it the peak of φ obeys 1 − C ≥ (1 − cos α)(1 − (Y₀/Y*)²), and 1 − C = 2 sin²((α − φ)/2).
    """
    limit = 2 * _p * sp.sin(alpha / 2) / sp.cos(alpha)
    start = LEVEL.subs(_lean, alpha)
    at_alpha = sp.simplify(start.subs(_Y, limit) - _p**2)
    share = (1 - sp.cos(alpha)) * (1 - (_Y / limit) ** 2)
    peak = sp.simplify((1 - start / _p**2) - share)
    half = sp.simplify(1 - _C - 2 * sp.sin(_lean / 2) ** 2)
    return bool(at_alpha == 0 and peak == 0 and half == 0)


def slenderness_of_three_to_four_is_sufficient() -> bool:
    """(2 − √r) Y*² cos α ≤ p̂² if cos α ≥ (4 − 2√r)/(5 − 2√r).

    That is at most 4/5, so that b/h ≤ 3/4 is sufficient for every √r.
    """
    cosine = sp.Symbol("c", positive=True)
    square = 2 * _p**2 * (1 - cosine) / cosine**2  # Y*²
    limit = sp.simplify((2 * _p * sp.sin(alpha / 2) / sp.cos(alpha)) ** 2)
    same = sp.simplify(limit - square.subs(cosine, sp.cos(alpha))) == 0
    equal = sp.solve((2 - _root) * square * cosine - _p**2, cosine)
    stated = (4 - 2 * _root) / (5 - 2 * _root)
    share = sp.Symbol("share", positive=True)  # √r = share/(1 + share) < 1
    below = sp.factor((sp.Rational(4, 5) - stated).subs(_root, share / (1 + share)))
    return bool(
        same
        and [sp.simplify(one - stated) for one in equal] == [0]
        and below.is_positive
        and sp.tan(sp.acos(sp.Rational(4, 5))) == sp.Rational(3, 4)
    )


def impact_adds_twice_the_velocity_at_most() -> bool:
    """An impact turns Y₁ into −√r Y₁ + (1 + √r) κ + (1 − √r) κ u₁, at most √r |Y₁| + 2κ."""
    before = _zeta + _kappa * (1 - _u)
    after = -_root * _zeta + _kappa * (1 + _u)  # on the other side u has the other sign
    stated = -_root * _Y + (1 + _root) * _kappa + (1 - _root) * _kappa * _u
    most = stated.subs(_u, 1) - (-_root * _Y + 2 * _kappa)
    return bool(sp.expand(after - stated.subs(_Y, before)) == 0 and sp.expand(most) == 0)


def visits_add_up_to_a_limit() -> bool:
    """x(x + 1)/(1 + √r x)² rises with x up to 2 − √r at x = 1/(1 − √r) = 1 + √r + r + …."""
    x = sp.Symbol("x", positive=True)
    share = sp.Symbol("share", positive=True)
    root = share / (1 + share)
    fraction = x * (x + 1) / (1 + root * x) ** 2
    end = sp.simplify(fraction.subs(x, 1 / (1 - root)) - (2 - root))
    return bool(end == 0 and sp.factor(sp.diff(fraction, x)).is_positive)


def loss() -> sp.Expr:
    """1 − √r of Eq. (25), as it is stated."""
    return sp.Rational(3, 2) * sp.sin(alpha) ** 2 * (1 + 4 * gamma) / (1 + 3 * gamma)


def loss_per_impact_is_stated() -> bool:
    """1 − √r of Eq. (25) is (3/2) sin²α (1 + 4γ)/(1 + 3γ)."""
    return is_identically_zero(1 - restitution() - loss(), POSITIVE)


def guaranteed_velocity_rises_with_mass() -> bool:
    """V* of the frame is (1 + 4γ)/√((1 + 2γ)(1 + 3γ)) times its column's, rising to 4/√6 with γ."""
    ratio = loss() / loss().subs(gamma, 0) / frequency_ratio()
    stated = (1 + 4 * gamma) / sp.sqrt((1 + 2 * gamma) * (1 + 3 * gamma))
    same = sp.simplify(sp.cancel((ratio / stated) ** 2)) == 1
    rises = sp.factor(sp.simplify(sp.diff(sp.log(stated), gamma))).is_positive
    limit = sp.limit(stated, gamma, sp.oo) - 4 / sp.sqrt(6)
    return bool(same and rises and sp.simplify(limit) == 0)


def linearised_level_does_not_rise() -> bool:
    """Linearised, F = Y² − p̂² (α − φ)², Y = φ̇ + κ (1 − u), has Ḟ = −2 p̂² (α − φ) κ (1 − u)."""
    level = _Y**2 - _p**2 * _lean**2
    identities = []
    for side in SIDES:
        small = outward_acceleration(side).subs({_lean: _excess * _lean, _u_dot: _excess * _u_dot})
        motion = sp.diff(small, _excess).subs(_excess, 0)
        change = sp.diff(level, _Y) * (motion - _kappa * _u_dot)
        change -= sp.diff(level, _lean) * _zeta
        rate = {_zeta: _Y - _kappa * (1 - _u)}
        stated = -2 * _p**2 * _lean * _kappa * (1 - _u)
        identities.append(sp.expand(change.subs(rate) - stated) == 0)
    return all(identities)


def vertical_acceleration_changes_the_level() -> bool:
    """With g (1 + v) for g in the restoring moment, Ḟ = S C ((Y − ζ) Y ζ C − p̂² (1 + v) Y + q ζ).

    In F, q replaces p̂²; |v| ≤ ε. Ḟ is not positive for q = p̂² (1 − ε) while Y > 0, and for
    q = p̂² (1 + ε) while Y < 0. Y falls, so that it changes its sign once.
    """
    q, share = sp.symbols("q w", positive=True)  # w = 1 + v
    level = LEVEL.subs(_p**2, q)
    change = -_S / _C * (share * _p**2 + _zeta**2 * _C)
    rate = sp.diff(level, _Y) * change - sp.diff(level, _lean) * _zeta * _C
    stated = _S * _C * ((_Y - _zeta) * _Y * _zeta * _C - share * _p**2 * _Y + q * _zeta)
    return bool(sp.simplify(rate - stated) == 0)


def first_velocity_is_the_classical_one() -> bool:
    """(2 V₁)² of a column is (8/3) g R (1 − cos α)/cos²α, the formula of West."""
    first = g / sp.sqrt(3 * g / (4 * R)) * sp.sin(alpha / 2) / sp.cos(alpha)
    west = sp.Rational(8, 3) * g * R * (1 - sp.cos(alpha)) / sp.cos(alpha) ** 2
    return bool(sp.simplify((2 * first) ** 2 - west) == 0)
