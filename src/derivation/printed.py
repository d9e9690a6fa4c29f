"""The equations of Makris & Vassiliou (2014), as printed, and whether each follows from premises.

Each equation is written as in our transcription of the paper, with round brackets for all brackets,
a function's argument in brackets, and a denominator after a solidus in brackets if the physics
requires it (3g/4R is 3g/(4R)). The letter a, which our transcription has for α in Eqs. (19), (22)
and (23), is read as α. If a printed equation does not follow, its corrected form and the kind of
the discrepancy are given next to it. It may be in the print or in the transcription.

The premises of an equation are the derived values of all its quantities. It follows from them if
the difference of its members vanishes identically with these values put in.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from functools import cache
from typing import TypeAlias

import sympy as sp

from derivation import mechanics
from derivation.notation import (
    NEGATIVE,
    POSITIVE,
    SIDES,
    F_x1,
    F_x2,
    F_z1,
    I_o,
    R,
    Side,
    acceleration,
    alpha,
    g,
    gamma,
    ground_acceleration,
    ground_velocity,
    is_identically_zero,
    m,
    m_b,
    m_c,
    read,
    velocity,
    velocity_after,
    velocity_before,
)

Values: TypeAlias = dict[sp.Symbol, sp.Expr]
Premises: TypeAlias = Callable[[Side], Values]


@cache
def rectangle(side: Side) -> Values:
    """The column's size, slenderness and moment of inertia, from its half-width and half-height."""
    return {R: mechanics.size(), alpha: mechanics.slenderness(), I_o: mechanics.moment_of_inertia()}


@cache
def column(side: Side) -> Values:
    """The solitary column's equation of motion, and p² for what multiplies the restoring sine."""
    squared = mechanics.squared_frequency(mechanics.column_motion(NEGATIVE), NEGATIVE)
    return {m: m_c, acceleration: mechanics.column_motion(side), sp.Symbol("p"): sp.sqrt(squared)}


@cache
def rectangular_column(side: Side) -> Values:
    """p of a rectangular column."""
    return {name: value.subs(mechanics.RECTANGULAR) for name, value in column(side).items()}


@cache
def kinematics(side: Side) -> Values:
    """The cap beam's displacements, velocities and accelerations, from the geometry."""
    return {sp.Symbol(x): value for x, value in mechanics.cap_motion(side)._asdict().items()}


@cache
def frame(side: Side) -> Values:
    """θ̈, the forces on the cap beam and its accelerations, on every motion of the three bodies."""
    moves = mechanics.frame_motion(side)
    return moves | {name: value.subs(moves) for name, value in kinematics(side).items()}


@cache
def rectangular_frame(side: Side) -> Values:
    """θ̈ of the frame of rectangular columns, with p of its columns and its own p̂ and R̂."""
    p = rectangular_column(side)[sp.Symbol("p")]
    return {
        acceleration: mechanics.equation_of_motion(side).rhs,
        sp.Symbol("p"): p,
        sp.Symbol("p_hat"): mechanics.frequency_ratio() * p,
        sp.Symbol("R_hat"): mechanics.size_ratio() * R,
    }


@cache
def impact(side: Side) -> Values:
    """Velocities and the ratio of kinetic energies as the frame changes over to the side."""
    after = side.upright(mechanics.kinetic_energy(side)).subs(velocity, velocity_after)
    before = side.other.upright(mechanics.kinetic_energy(side.other)).subs(
        velocity, velocity_before
    )
    change = {velocity_after: mechanics.restitution(side) * velocity_before}
    return change | {sp.Symbol("r"): (after / before).subs(ground_velocity, 0).subs(change)}


@cache
def column_impact(side: Side) -> Values:
    """Velocities as the solitary column changes over to the side."""
    return {velocity_after: mechanics.column_restitution(side) * velocity_before}


@cache
def masses(side: Side) -> Values:
    """γ, the mass of the cap beam over that of both columns."""
    return {gamma: m_b / (m_c + m_c)}


@cache
def harmonic_base(side: Side) -> Values:
    """The largest acceleration of a base that moves by u_o sin 2πft."""
    u_o, f, t = sp.symbols("u_o f t")
    displacement = u_o * sp.sin(2 * sp.pi * f * t)
    return {sp.Symbol("amplitude"): -sp.diff(displacement, t, 2).subs(t, 1 / (4 * f))}


@dataclass(frozen=True)
class Statement:
    """An equation as it is printed, and where it has to hold."""

    name: str
    """The paper's number as "eq9", or "text_…" for a formula in the running text."""
    printed: str
    premises: Premises
    sides: tuple[Side, ...] = SIDES
    split: bool = False
    """Whether its two sides are two equations, by a double sign."""
    meant: str = ""
    """If it does not follow: the corrected form, the kind of discrepancy, and what is wrong."""
    kind: str = ""
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
        column,
        _LEFT,
    ),
    Statement(
        "eq2",
        "I_o θ̈ = −m g R sin(α − θ) − m ü_g R cos(α − θ)",
        column,
        _RIGHT,
    ),
    Statement(
        "eq3",
        "θ̈ = −p² (sin(α sgn(θ) − θ) + ü_g/g cos(α sgn(θ) − θ))",
        column,
    ),
    Statement("eq4", "u = ∓2R (sin(α) − sin(α ± θ))", kinematics, split=True),
    Statement("eq5", "u̇ = 2R cos(α ± θ) θ̇", kinematics, split=True),
    Statement("eq6", "ü = 2R (∓sin(α ± θ) θ̇² + cos(α ± θ) θ̈)", kinematics, split=True),
    Statement("eq7", "v = 2R (cos(α ± θ) − cos(α))", kinematics, split=True),
    Statement("eq8", "v̇ = ∓2R sin(α ± θ) θ̇", kinematics, split=True),
    Statement(
        "eq9",
        "v̈ = −2R (cos(α ± θ) θ̇² + sin(α ± θ) θ̈)",
        kinematics,
        split=True,
        meant="v̈ = −2R (cos(α ± θ) θ̇² ± sin(α ± θ) θ̈)",
        kind="sign",
        remark="The term in θ̈ lacks the double sign that Eq. (8) has: for θ > 0 its sign is wrong.",
    ),
    Statement(
        "eq10",
        "I_o θ̈ + m_c ü_g R cos(α + θ)"
        " = m_c g R sin(α + θ) − F_x1 2R cos(α + θ) + F_z1 2R sin(α + θ)",
        frame,
        _LEFT,
    ),
    Statement(
        "eq11",
        "I_o θ̈ + m_c ü_g R cos(α + θ)"
        " = m_c g R sin(α + θ) − F_x2 2R cos(α + θ) + F_z2 2R sin(α + θ)",
        frame,
        _LEFT,
    ),
    Statement("eq12", "F_x2 − F_x1 = −(F_z1 − F_z2) tan(α + θ)", frame, _LEFT),
    Statement("eq13", "m_b (ü_g + ü) = F_x1 + F_x2", frame),
    Statement(
        "eq14",
        "−2F_x1 = −(F_z1 − F_z2) tan(α + θ) − m_b (ü_g + ü)",
        frame,
        _LEFT,
    ),
    Statement(
        "eq15",
        "I_o θ̈/R + m_c ü_g cos(α + θ)"
        " = m_c g sin(α + θ) + (F_z1 + F_z2) sin(α + θ) − m_b (ü_g + ü) cos(α + θ)",
        frame,
        _LEFT,
    ),
    Statement("eq16", "m_b (g + v̈) = F_z1 + F_z2", frame),
    Statement(
        "eq17",
        "I_o θ̈/R = −(m_c + m_b) ü_g cos(α + θ) + (m_c + m_b) g sin(α + θ)"
        " + m_b (v̈ sin(α + θ) − ü cos(α + θ))",
        frame,
        _LEFT,
    ),
    Statement(
        "eq18",
        "(I_o/R + 2m_b R) θ̈/g = (m_c + m_b) sin(α + θ) − (m_c + m_b) ü_g/g cos(α + θ)",
        frame,
        _LEFT,
    ),
    Statement(
        "eq19",
        "θ̈ = −(1 + 2γ)/(1 + 3γ) 3g/(4R) (sin(α + θ) − ü_g/g cos(α + θ))",
        rectangular_frame,
        _LEFT,
        meant="θ̈ = −(1 + 2γ)/(1 + 3γ) 3g/(4R) (−sin(α + θ) + ü_g/g cos(α + θ))",
        kind="sign",
        remark="Both terms in the braces have the wrong sign, against Eq. (18). One leading minus"
        " too many explains it.",
    ),
    Statement(
        "eq20",
        "I_o θ̈ + m_c ü_g R cos(α − θ)"
        " = −m_c g R sin(α − θ) + F_x1 2R cos(α − θ) − F_z1 2R sin(α − θ)",
        frame,
        _RIGHT,
        meant="I_o θ̈ + m_c ü_g R cos(α − θ)"
        " = −m_c g R sin(α − θ) − F_x1 2R cos(α − θ) − F_z1 2R sin(α − θ)",
        kind="sign",
        remark="Right for shears counted positive to the left when θ > 0. F_x1 of Eqs. (10) and"
        " (13) is positive to the right.",
    ),
    Statement(
        "eq21",
        "I_o θ̈ + m_c ü_g R cos(α − θ)"
        " = −m_c g R sin(α − θ) + F_x2 2R cos(α − θ) − F_z2 2R sin(α − θ)",
        frame,
        _RIGHT,
        meant="I_o θ̈ + m_c ü_g R cos(α − θ)"
        " = −m_c g R sin(α − θ) − F_x2 2R cos(α − θ) − F_z2 2R sin(α − θ)",
        kind="sign",
        remark="Right for shears counted positive to the left when θ > 0. F_x2 of Eqs. (11) and"
        " (13) is positive to the right.",
    ),
    Statement(
        "eq22",
        "θ̈ = −(1 + 2γ)/(1 + 3γ) 3g/(4R) (−sin(α − θ) − ü_g/g cos(α − θ))",
        rectangular_frame,
        _RIGHT,
        meant="θ̈ = −(1 + 2γ)/(1 + 3γ) 3g/(4R) (sin(α − θ) + ü_g/g cos(α − θ))",
        kind="sign",
        remark="Both terms in the braces have the wrong sign: the frame would move away from"
        " upright. One leading minus too many explains it.",
    ),
    Statement(
        "eq23",
        "θ̈ = −(1 + 2γ)/(1 + 3γ) p² (sin(α sgn(θ) − θ) + ü_g/g cos(α sgn(θ) − θ))",
        rectangular_frame,
    ),
    Statement(
        "eq24",
        "R̂ = (1 + 3γ)/(1 + 2γ) R = (1 + γ/(1 + 2γ)) R",
        rectangular_frame,
    ),
    Statement(
        "eq25",
        "r = (θ̇_2/θ̇_1)² = ((1 − 3/2 sin(α)² + 3γ cos(2α))/(1 + 3γ))²",
        impact,
    ),
)

IN_TEXT = (
    Statement("text_size", "R = √(b² + h²)", rectangle),
    Statement("text_slenderness", "α = atan(b/h)", rectangle),
    Statement("text_frequency_parameter", "p = √(m R g/I_o)", column),
    Statement("text_moment_of_inertia", "I_o = 4/3 m R²", rectangle),
    Statement("text_frequency_parameter_rectangle", "p = √(3g/(4R))", rectangular_column),
    Statement("text_mass_ratio", "γ = m_b/(2m_c)", masses),
    Statement("text_lean", "α − |θ| = α + θ", kinematics, (NEGATIVE,)),
    Statement("text_p_factor", "p̂² = (1 + 2γ)/(1 + 3γ) p²", rectangular_frame),
    Statement(
        "text_p_hat",
        "p̂ = √(1 + 2γ)/(1 + 3γ) p",
        rectangular_frame,
        meant="p̂ = √((1 + 2γ)/(1 + 3γ)) p",
        kind="radical",
        remark="The radical ends before the denominator, which it has to cover.",
    ),
    Statement(
        "text_p_hat_trilith",
        "p̂ = √(1 + 2γ/1 + 3γ) p",
        rectangular_frame,
        meant="p̂ = √((1 + 2γ)/(1 + 3γ)) p",
        kind="bracket",
        remark="Without brackets the radicand reads 1 + 5γ.",
    ),
    Statement("text_column_restitution", "√r = 1 − 3/2 sin(α)²", column_impact),
    Statement("text_base_acceleration", "ü_go = u_o (2π f)²", harmonic_base),
)

STEPS = (
    ("text_step_12", ("eq10", "eq11"), (F_x1, F_x2), "eq12"),
    ("text_step_14", ("eq12", "eq13"), (F_x1, F_x2), "eq14"),
    ("text_step_15", ("eq10", "eq14"), (F_x1, acceleration), "eq15"),
    ("text_step_17", ("eq15", "eq16"), (F_z1, acceleration), "eq17"),
    ("text_step_18", ("eq6", "eq9", "eq17"), (*sp.symbols("u_ddot v_ddot"), acceleration), "eq18"),
)
"""Which equations the text combines, solved for what, into which other, all for θ < 0."""

UPLIFT = Statement("text_uplift", "ü_g > g tan(α)", column)
"""When a column starts to rock, an inequality, written for ground that accelerates to the right."""


@dataclass(frozen=True)
class PrintedCheck:
    """Whether one printed equation follows from its premises, and what is meant if not."""

    id: str
    """For instance eq9_positive, eq23, text_p_hat."""
    equation: int | None
    """The paper's number, None in the running text."""
    part: str
    """θ < 0, θ > 0, or nothing where it holds for both at once."""
    printed: str
    follows: bool
    meant: str = ""  # empty, as all below, where nothing is wrong
    meant_follows: bool | None = None
    kind: str = ""
    remark: str = ""


def check_printed() -> list[PrintedCheck]:
    """Test every numbered equation, and the formulas in the text, as they are printed."""
    checks = [check for statement in (*EQUATIONS, *IN_TEXT) for check in _checks(statement)]
    checks += [_check_step(*step) for step in STEPS]
    return [*checks, PrintedCheck(UPLIFT.name, None, "", UPLIFT.printed, is_uplift(UPLIFT.printed))]


def residuals(equation: str, side: Side) -> list[sp.Expr]:
    """The differences between an equation's members, which vanish where it holds."""
    first, *others = read(equation, side)
    return [first - other for other in others]


def follows(equation: str, premises: Premises, sides: Iterable[Side]) -> bool:
    """Whether an equation is an identity on these sides, with the derived values substituted."""
    return all(
        is_identically_zero(residual.subs(premises(side)), side)
        for side in sides
        for residual in residuals(equation, side)
    )


def _checks(statement: Statement) -> Iterator[PrintedCheck]:
    parts = [(side,) for side in statement.sides] if statement.split else [statement.sides]
    for sides in parts:
        part = sides[0].label if len(sides) == 1 else ""
        name = statement.name
        if statement.split:
            name += "_negative" if part == NEGATIVE.label else "_positive"
        holds = follows(statement.printed, statement.premises, sides)
        check = PrintedCheck(name, statement.number, part, statement.printed, holds)
        if not holds:
            check = replace(
                check,
                meant=statement.meant,
                meant_follows=bool(statement.meant)
                and follows(statement.meant, statement.premises, sides),
                kind=statement.kind,
                remark=statement.remark,
            )
        yield check


def _check_step(
    name: str, sources: tuple[str, ...], eliminated: tuple[sp.Symbol, ...], target: str
) -> PrintedCheck:
    """Whether eliminating common unknowns from printed equations yields the next printed one."""
    printed = {statement.name: statement.printed for statement in EQUATIONS}
    system = [r for source in sources for r in residuals(printed[source], NEGATIVE)]
    (solution,) = sp.linsolve(system, eliminated)
    values = dict(zip(eliminated, solution, strict=True))
    result = all(
        is_identically_zero(r.subs(values), NEGATIVE) for r in residuals(printed[target], NEGATIVE)
    )
    title = ", ".join(f"({source[2:]})" for source in sources) + f" → ({target[2:]})"
    return PrintedCheck(name, None, NEGATIVE.label, title, result)


def is_uplift(condition: str) -> bool:
    """Whether a condition on ü_g > 0 holds exactly when θ̈ turns a resting column to θ < 0.

    The text speaks of ground that accelerates to the right, here as beside Fig. 2.
    """
    multiple, tangent = sp.symbols("multiple tangent", positive=True)
    threshold = {ground_acceleration: multiple * g * sp.tan(alpha)}
    (relation,) = read(condition, NEGATIVE)
    excess = (relation.gts - relation.lts).subs(threshold).subs(sp.tan(alpha), tangent)
    outward = -NEGATIVE.upright(mechanics.column_motion(NEGATIVE))
    restoring = -outward.subs(ground_acceleration, 0)  # positive
    starts = sp.simplify(outward.subs(threshold) / restoring)
    return bool(sp.simplify(excess / (g * tangent) - starts) == 0)
