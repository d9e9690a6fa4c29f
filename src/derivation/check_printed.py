"""Test whether every printed equation and formula of the paper follows from its premises."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

import sympy as sp

from derivation.mechanics import column_motion
from derivation.notation import (
    NEGATIVE,
    Side,
    alpha,
    g,
    ground_acceleration,
    is_identically_zero,
    read,
)
from derivation.printed import (
    EQUATIONS,
    IN_TEXT,
    STEPS,
    UPLIFT,
    Premises,
    Statement,
)


@dataclass(frozen=True)
class PrintedCheck:
    """Whether one printed equation follows from its premises, and what is meant if not.

    Parameters
    ----------
    id
        "eq9_positive", "eq23", "text_p_hat".
    equation
        The paper's number, None in the running text.
    part
        "θ < 0", "θ > 0", or "" where it holds for both at once.
    printed, meant
        As printed; as meant, "" if that is the same.
    follows, meant_follows
        What the algebra says of either.
    kind, remark
        Of which kind the discrepancy is, and what is wrong; "" if nothing is.
    """

    id: str
    equation: int | None
    part: str
    printed: str
    follows: bool
    meant: str = ""
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
    outward = -NEGATIVE.upright(column_motion(NEGATIVE))
    restoring = -outward.subs(ground_acceleration, 0)  # positive
    starts = sp.simplify(outward.subs(threshold) / restoring)
    return bool(sp.simplify(excess / (g * tangent) - starts) == 0)
