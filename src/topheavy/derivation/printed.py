"""The numbered equations of Makris & Vassiliou (2014), as printed.

Each equation is written as in our transcription of the paper, with round brackets for all brackets,
a function's argument in brackets, and a denominator after a solidus in brackets if the physics
requires it (3g/4R is 3g/(4R)). The letter a, which our transcription has for α in Eqs. (19), (22)
and (23), is read as α. If a printed equation does not follow, its corrected form is given
next to it. The error may be in the print or in the transcription.
"""

from __future__ import annotations

from dataclasses import dataclass

from topheavy.derivation import premises
from topheavy.derivation.notation import NEGATIVE, POSITIVE, SIDES, Side


@dataclass(frozen=True)
class Statement:
    """An equation as it is printed, and where it has to hold.

    Parameters
    ----------
    name
        "eq9", or "text_…" for a formula in the running text.
    printed
        The equation, as `topheavy.derivation.notation.read` takes it.
    premises
        The premises from which it has to follow.
    sides
        The sides of the motion that it is stated for.
    split
        Whether its two sides are two equations, by a double sign.
    meant, remark
        If it does not follow: the corrected form, and what is wrong in a sentence. The kind of
        fault is found by `topheavy.derivation.mends`.
    """

    name: str
    printed: str
    premises: premises.Premises
    sides: tuple[Side, ...] = SIDES
    split: bool = False
    meant: str = ""
    remark: str = ""

    @property
    def number(self) -> int | None:
        """The paper's number of the equation."""
        return int(self.name[2:]) if self.name.startswith("eq") else None


_LEFT, _RIGHT = (NEGATIVE,), (POSITIVE,)

EQUATIONS = (
    Statement(
        "eq1",
        "I_o θ̈ = m g R sin(α + θ) − m ü_g R cos(−α − θ)",
        premises.column,
        _LEFT,
    ),
    Statement(
        "eq2",
        "I_o θ̈ = −m g R sin(α − θ) − m ü_g R cos(α − θ)",
        premises.column,
        _RIGHT,
    ),
    Statement(
        "eq3",
        "θ̈ = −p² (sin(α sgn(θ) − θ) + ü_g/g cos(α sgn(θ) − θ))",
        premises.column,
    ),
    Statement("eq4", "u = ∓2R (sin(α) − sin(α ± θ))", premises.kinematics, split=True),
    Statement("eq5", "u̇ = 2R cos(α ± θ) θ̇", premises.kinematics, split=True),
    Statement("eq6", "ü = 2R (∓sin(α ± θ) θ̇² + cos(α ± θ) θ̈)", premises.kinematics, split=True),
    Statement("eq7", "v = 2R (cos(α ± θ) − cos(α))", premises.kinematics, split=True),
    Statement("eq8", "v̇ = ∓2R sin(α ± θ) θ̇", premises.kinematics, split=True),
    Statement(
        "eq9",
        "v̈ = −2R (cos(α ± θ) θ̇² + sin(α ± θ) θ̈)",
        premises.kinematics,
        split=True,
        meant="v̈ = −2R (cos(α ± θ) θ̇² ± sin(α ± θ) θ̈)",
        remark="The term in θ̈ lacks the double sign that Eq. (8) has: for θ > 0 its sign is wrong.",
    ),
    Statement(
        "eq10",
        "I_o θ̈ + m_c ü_g R cos(α + θ)"
        " = m_c g R sin(α + θ) − F_x1 2R cos(α + θ) + F_z1 2R sin(α + θ)",
        premises.frame,
        _LEFT,
    ),
    Statement(
        "eq11",
        "I_o θ̈ + m_c ü_g R cos(α + θ)"
        " = m_c g R sin(α + θ) − F_x2 2R cos(α + θ) + F_z2 2R sin(α + θ)",
        premises.frame,
        _LEFT,
    ),
    Statement("eq12", "F_x2 − F_x1 = −(F_z1 − F_z2) tan(α + θ)", premises.frame, _LEFT),
    Statement("eq13", "m_b (ü_g + ü) = F_x1 + F_x2", premises.frame),
    Statement(
        "eq14",
        "−2F_x1 = −(F_z1 − F_z2) tan(α + θ) − m_b (ü_g + ü)",
        premises.frame,
        _LEFT,
    ),
    Statement(
        "eq15",
        "I_o θ̈/R + m_c ü_g cos(α + θ)"
        " = m_c g sin(α + θ) + (F_z1 + F_z2) sin(α + θ) − m_b (ü_g + ü) cos(α + θ)",
        premises.frame,
        _LEFT,
    ),
    Statement("eq16", "m_b (g + v̈) = F_z1 + F_z2", premises.frame),
    Statement(
        "eq17",
        "I_o θ̈/R = −(m_c + m_b) ü_g cos(α + θ) + (m_c + m_b) g sin(α + θ)"
        " + m_b (v̈ sin(α + θ) − ü cos(α + θ))",
        premises.frame,
        _LEFT,
    ),
    Statement(
        "eq18",
        "(I_o/R + 2m_b R) θ̈/g = (m_c + m_b) sin(α + θ) − (m_c + m_b) ü_g/g cos(α + θ)",
        premises.frame,
        _LEFT,
    ),
    Statement(
        "eq19",
        "θ̈ = −(1 + 2γ)/(1 + 3γ) 3g/(4R) (sin(α + θ) − ü_g/g cos(α + θ))",
        premises.rectangular_frame,
        _LEFT,
        meant="θ̈ = −(1 + 2γ)/(1 + 3γ) 3g/(4R) (−sin(α + θ) + ü_g/g cos(α + θ))",
        remark="Both terms in the braces have the wrong sign, against Eq. (18). One leading minus"
        " too many explains it.",
    ),
    Statement(
        "eq20",
        "I_o θ̈ + m_c ü_g R cos(α − θ)"
        " = −m_c g R sin(α − θ) + F_x1 2R cos(α − θ) − F_z1 2R sin(α − θ)",
        premises.frame,
        _RIGHT,
        meant="I_o θ̈ + m_c ü_g R cos(α − θ)"
        " = −m_c g R sin(α − θ) − F_x1 2R cos(α − θ) − F_z1 2R sin(α − θ)",
        remark="Right for shears counted positive to the left when θ > 0. F_x1 of Eqs. (10) and"
        " (13) is positive to the right.",
    ),
    Statement(
        "eq21",
        "I_o θ̈ + m_c ü_g R cos(α − θ)"
        " = −m_c g R sin(α − θ) + F_x2 2R cos(α − θ) − F_z2 2R sin(α − θ)",
        premises.frame,
        _RIGHT,
        meant="I_o θ̈ + m_c ü_g R cos(α − θ)"
        " = −m_c g R sin(α − θ) − F_x2 2R cos(α − θ) − F_z2 2R sin(α − θ)",
        remark="Right for shears counted positive to the left when θ > 0. F_x2 of Eqs. (11) and"
        " (13) is positive to the right.",
    ),
    Statement(
        "eq22",
        "θ̈ = −(1 + 2γ)/(1 + 3γ) 3g/(4R) (−sin(α − θ) − ü_g/g cos(α − θ))",
        premises.rectangular_frame,
        _RIGHT,
        meant="θ̈ = −(1 + 2γ)/(1 + 3γ) 3g/(4R) (sin(α − θ) + ü_g/g cos(α − θ))",
        remark="Both terms in the braces have the wrong sign: the frame would move away from"
        " upright. One leading minus too many explains it.",
    ),
    Statement(
        "eq23",
        "θ̈ = −(1 + 2γ)/(1 + 3γ) p² (sin(α sgn(θ) − θ) + ü_g/g cos(α sgn(θ) − θ))",
        premises.rectangular_frame,
    ),
    Statement(
        "eq24",
        "R̂ = (1 + 3γ)/(1 + 2γ) R = (1 + γ/(1 + 2γ)) R",
        premises.rectangular_frame,
    ),
    Statement(
        "eq25",
        "r = (θ̇_2/θ̇_1)² = ((1 − 3/2 sin(α)² + 3γ cos(2α))/(1 + 3γ))²",
        premises.impact,
    ),
)
