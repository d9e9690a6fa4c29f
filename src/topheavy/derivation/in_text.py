"""What is printed in the running text: formulas, conditions, and how one equation yields the next.

Written as `topheavy.derivation.printed` writes the numbered equations.
"""

from __future__ import annotations

import sympy as sp

from topheavy.derivation import premises
from topheavy.derivation.notation import NEGATIVE, F_x1, F_x2, F_z1, acceleration
from topheavy.derivation.printed import Statement

IN_TEXT = (
    Statement("text_size", "R = √(b² + h²)", premises.rectangle),
    Statement("text_slenderness", "α = atan(b/h)", premises.rectangle),
    Statement("text_frequency_parameter", "p = √(m R g/I_o)", premises.column),
    Statement("text_moment_of_inertia", "I_o = 4/3 m R²", premises.rectangle),
    Statement("text_frequency_parameter_rectangle", "p = √(3g/(4R))", premises.rectangular_column),
    Statement("text_mass_ratio", "γ = m_b/(2m_c)", premises.masses),
    Statement("text_lean", "α − |θ| = α + θ", premises.kinematics, (NEGATIVE,)),
    Statement("text_p_factor", "p̂² = (1 + 2γ)/(1 + 3γ) p²", premises.rectangular_frame),
    Statement(
        "text_p_hat",
        "p̂ = √(1 + 2γ)/(1 + 3γ) p",
        premises.rectangular_frame,
        meant="p̂ = √((1 + 2γ)/(1 + 3γ)) p",
        remark="The radical ends before the denominator, which it has to cover.",
    ),
    Statement(
        "text_p_hat_trilith",
        "p̂ = √(1 + 2γ/1 + 3γ) p",
        premises.rectangular_frame,
        meant="p̂ = √((1 + 2γ)/(1 + 3γ)) p",
        remark="Without brackets the radicand reads 1 + 5γ.",
    ),
    Statement("text_column_restitution", "√r = 1 − 3/2 sin(α)²", premises.column_impact),
    Statement("text_base_acceleration", "ü_go = u_o (2π f)²", premises.harmonic_base),
)

STEPS = (
    ("text_step_12", ("eq10", "eq11"), (F_x1, F_x2), "eq12"),
    ("text_step_14", ("eq12", "eq13"), (F_x1, F_x2), "eq14"),
    ("text_step_15", ("eq10", "eq14"), (F_x1, acceleration), "eq15"),
    ("text_step_17", ("eq15", "eq16"), (F_z1, acceleration), "eq17"),
    ("text_step_18", ("eq6", "eq9", "eq17"), (*sp.symbols("u_ddot v_ddot"), acceleration), "eq18"),
)
"""Which equations the text combines, solved for what, into which other, all for θ < 0."""

UPLIFT = Statement("text_uplift", "ü_g > g tan(α)", premises.column)
"""When a column starts to rock, an inequality, written for ground that accelerates to the right."""
