"""A larger R̂ under short and long pulses. Each function proves what its docstring states.

Linearised, before any impact: with φ = |θ|, a block that uplifts at the time t₀ obeys
φ̈ = p² (φ − α + a), where a g is the ground's acceleration towards the other side.
"""

from __future__ import annotations

import sympy as sp

from topheavy.derivation.motion import size_ratio
from topheavy.derivation.notation import alpha, gamma

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


PROOFS = (
    growing_term_is_a_weighted_mean_of_the_pulse,
    short_pulses_gain_by_the_order_of_their_moment,
    long_pulses_leave_no_gain,
)
