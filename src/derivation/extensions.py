"""N columns, vertical ground motion, short and long pulses, the frame across its plane.

Makris & Vassiliou (2013) give the equation of N columns by Lagrange.
"""

from __future__ import annotations

import sympy as sp

from derivation.fixed_mass import fixed_tangent
from derivation.mechanics import (
    RECTANGULAR,
    cap_contact,
    column_motion,
    equation_of_motion,
    moment,
    motion_of_columns,
    restitution,
    restitution_of_columns,
    size_ratio,
)
from derivation.notation import (
    SIDES,
    R,
    Side,
    alpha,
    b,
    g,
    gamma,
    ground_acceleration,
    h,
    half_depth,
    is_identically_zero,
    m_b,
    m_c,
    vanishes,
    velocity,
    vertical_acceleration,
)

_k = sp.Symbol("k", positive=True)


def frame_of_columns(side: Side) -> sp.Expr:
    """θ̈ of a cap beam on N rectangular columns, in γ = m_b/(N m_c)."""
    return motion_of_columns(side).subs(RECTANGULAR)


def printed_motion(side: Side) -> sp.Expr:
    """Eq. (23) with its p̂² and p², and g + v̈_g in place of g in the restoring moment."""
    p_squared = (1 + 2 * gamma) / (1 + 3 * gamma) * 3 * g / (4 * R)
    restoring = side.sign * sp.sin(side.lean) * (1 + vertical_acceleration / g)
    return -p_squared * (restoring + ground_acceleration / g * sp.cos(side.lean))


def size_only_slows_time() -> bool:
    """A similar column k times as large moves as the small one does in time stretched by √k.

    θ(t) of the one under ü_g(t) is θ(t/√k) of the other under ü_g(t√k), at the same √r; so is
    that of a frame with k = R̂/R. A larger R̂ implies this similarity and nothing else.
    """
    slowed = {R: _k * R}
    return all(
        is_identically_zero(_k * motion.subs(slowed) - motion, side) and not motion.has(velocity)
        for side in SIDES
        for motion in (column_motion(side).subs(RECTANGULAR), equation_of_motion(side).rhs)
    )


def columns_count_only_in_the_mass_ratio() -> bool:
    """A cap beam on N columns obeys Eqs. (23) and (24), in which N does not occur."""
    return vanishes(lambda side: frame_of_columns(side) - printed_motion(side))


def impacts_do_not_count_the_columns() -> bool:
    """√r of a cap beam on N columns is that of Eq. (25), with γ = m_b/(N m_c)."""
    return vanishes(lambda side: restitution_of_columns(side).subs(RECTANGULAR) - restitution())


def vertical_acceleration_is_a_change_of_gravity_and_push() -> bool:
    """θ̈ = (1 + v̈_g/g) times that over ground with ü_g/(1 + v̈_g/g) and no vertical motion."""
    share = 1 + vertical_acceleration / g
    push = {ground_acceleration: ground_acceleration / share}
    return vanishes(
        lambda side: frame_of_columns(side) - share * equation_of_motion(side).rhs.subs(push)
    )


# Short and long pulses ----------------------------------------------------------------------------
# Linearised, before any impact: with φ = |θ|, a block that uplifts at the time t₀ obeys
# φ̈ = p² (φ − α + a), where a g is the ground's acceleration towards the other side.

_x, _p, _omega, _s = sp.symbols("x p omega s", positive=True)  # x = p/ω, s = ω t
PULSES = (  # a over its amplitude, its length, and what its minimum over g tan α tends to
    (sp.sin(_s), sp.pi, _omega / _p / 2),
    (sp.sin(_s), 2 * sp.pi, (_omega / _p) ** 2 / (2 * sp.pi)),
    (sp.cos(_s), 2 * sp.pi, (_omega / _p) ** 3 / (2 * sp.pi)),
)


def growing_term_is_a_weighted_mean_of_the_pulse() -> bool:
    """Without an impact a pulse overturns exactly if ∫ p e^(−pt) a dt > α e^(−p t₀), from t₀ on.

    w = φ − α + φ̇/p obeys ẇ = p (w + a) and starts from −α. After the pulse it grows as e^(pt), and
    its sign decides.
    """
    rate, acceleration, angle, push = sp.symbols("v c phi a", real=True)
    motion = {acceleration: _p**2 * (angle - alpha + push)}
    growing = angle - alpha + rate / _p
    change = (rate + acceleration / _p).subs(motion)
    start = growing.subs({angle: 0, rate: 0})
    return bool(sp.expand(change - _p * (growing + push)) == 0 and start == -alpha)


def short_pulses_gain_by_the_order_of_their_moment() -> bool:
    """Without an impact, short pulses gain √(R̂/R) − 1, R̂/R − 1 and (R̂/R)^(3/2) − 1.

    A half-sine leaves the ground a velocity, one sine a displacement, and one cosine neither. As
    ω/p → ∞ their minima over g tan α tend to (ω/p)/2, (ω/p)²/2π and (ω/p)³/2π. At one ω the frame
    has p̂² = p² R/R̂. For γ → ∞ the gains are 22.5, 50 and 83.7 %.
    """
    limit, identities = sp.limit(size_ratio(), gamma, sp.oo), []
    for order, (shape, end, stated) in enumerate(PULSES, 1):
        mean = sp.integrate(_x * sp.exp(-_x * _s) * shape, (_s, 0, end))  # t₀ → 0
        least = (1 / mean).subs(_x, _p / _omega)
        tends = sp.limit(sp.simplify((least / stated).subs(_omega, _p / _x)), _x, 0, "+")
        gain = sp.simplify(stated.subs(_p, _p / sp.sqrt(limit)) / stated)
        identities += [tends == 1, sp.simplify(gain - limit ** sp.Rational(order, 2)) == 0]
    return all(identities)


def long_pulses_leave_no_gain() -> bool:
    """As ω/p → 0, any amplitude above uplift overturns column and frame: the gain tends to 0.

    With a(t₀) = α the integral of a − α, weighted by p e^(−p(t − t₀)), tends to a'(t₀)/p. It is
    positive for a pulse that is still rising at t₀.
    """
    slope, time = sp.symbols("k t", positive=True)
    rising = sp.integrate(_p * sp.exp(-_p * time) * slope * time, (time, 0, sp.oo))
    return bool(sp.simplify(rising - slope / _p) == 0)


# Across the plane ---------------------------------------------------------------------------------
# Two columns in line under a cap beam; b_y is half their dimension across, written R sin α below.

_FROM_ANGLE = {sp.tan(alpha): b / h, sp.sin(alpha): b / R, sp.cos(alpha): h / R}
_HEIGHT = h * (1 + gamma * (2 + half_depth / h)) / (1 + gamma)


def level_cap_has_no_balance_across() -> bool:
    """A cap beam that stayed level across the plane would need a couple m_b g (b_y + d b_y/h).

    The columns would rock at b_y/h, and carry it at one edge each, b_y beside its centre of gravity
    and d below it. Weight and inertia turn it to the same side, and nothing resists.
    """
    identities = []
    for side in SIDES:
        contact = side.upright(sp.Matrix(cap_contact(side)))
        axis = sp.Matrix([side.sign * -R * sp.sin(alpha), contact[1]])
        arm = axis + sp.Matrix([0, half_depth]) - contact  # from the contact to the centre
        load = -m_b * g * sp.Matrix([-side.sign * sp.tan(alpha), 1])
        stated = m_b * g * (R * sp.sin(alpha) + half_depth * sp.tan(alpha))
        identities.append(is_identically_zero(moment(arm, load) - side.sign * stated, side))
    return all(identities)


def frame_across_its_plane_is_a_fixed_mass() -> bool:
    """Across the plane columns and cap turn as one body that uplifts at b_y/H, like a fixed mass.

    H is the height of the common centre of gravity, H/h = (1 + γ(2 + d/h))/(1 + γ), with d half
    the depth of the cap. The cap does not tip first: it would at b_y/d, and d < h < H.
    """
    mass = 2 * m_c + m_b
    height = (2 * m_c * h + m_b * (2 * h + half_depth)) / mass
    tangent = sp.simplify(fixed_tangent().subs(_FROM_ANGLE))
    higher = sp.factor(_HEIGHT - h)
    return bool(
        sp.simplify(height.subs(m_b, 2 * gamma * m_c) - _HEIGHT) == 0
        and sp.simplify(tangent - b / _HEIGHT) == 0
        and higher.is_positive
    )


def deep_columns_uplift_in_the_plane_first() -> bool:
    """b_y/H ≥ b/h if and only if b_y/b ≥ H/h, which rises with γ from 1 to 2 + d/h."""
    ratio = _HEIGHT / h
    return bool(
        sp.factor(sp.diff(ratio, gamma)).is_positive
        and ratio.subs(gamma, 0) == 1
        and sp.simplify(sp.limit(ratio, gamma, sp.oo) - 2 - half_depth / h) == 0
    )
