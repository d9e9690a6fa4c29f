"""Does what is printed follow? Every equation and formula of the paper, put to the test."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

import sympy as sp

from topheavy.derivation.equilibrium import column_motion
from topheavy.derivation.in_text import IN_TEXT, STEPS, UPLIFT
from topheavy.derivation.notation import (
    NEGATIVE,
    SIDES,
    Side,
    alpha,
    g,
    ground_acceleration,
    read,
    vanishes,
)
from topheavy.derivation.premises import Premises
from topheavy.derivation.printed import EQUATIONS, Statement


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
    fault
        "sign", "letter", "radical", "brackets", "condition", or "".
    remark
        What is wrong with the print, "" if nothing is.
    """

    id: str
    equation: int | None
    part: str
    printed: str
    follows: bool
    meant: str = ""
    meant_follows: bool | None = None
    fault: str = ""
    remark: str = ""


def check_printed() -> list[PrintedCheck]:
    """Test every numbered equation, and the formulas in the text, as they are printed."""
    checks = [check for statement in (*EQUATIONS, *IN_TEXT) for check in _checks(statement)]
    checks += [_check_step(*step) for step in STEPS]
    printed, meant = (_is_uplift(text) for text in (UPLIFT.printed, UPLIFT.meant))
    return [*checks, _verdict(UPLIFT, "", printed, meant)]


def residuals(equation: str, side: Side) -> list[sp.Expr]:
    """The differences between an equation's members, which vanish where it holds."""
    first, *others = read(equation, side)
    return [first - other for other in others]


def follows(equation: str, premises: Premises, sides: Iterable[Side]) -> bool:
    """Whether an equation is an identity on these sides, with the derived values put in."""
    return all(
        vanishes(residual.subs(premises(side)), side)
        for side in sides
        for residual in residuals(equation, side)
    )


def _checks(statement: Statement) -> Iterator[PrintedCheck]:
    parts = [(side,) for side in statement.sides] if statement.split else [statement.sides]
    for sides in parts:
        part = sides[0].label if len(sides) == 1 else ""
        printed = follows(statement.printed, statement.premises, sides)
        meant = bool(statement.meant) and follows(statement.meant, statement.premises, sides)
        yield _verdict(statement, part, printed, meant)


def _verdict(statement: Statement, part: str, printed: bool, meant: bool) -> PrintedCheck:
    name = statement.name
    if statement.split:
        name += "_negative" if part == NEGATIVE.label else "_positive"
    check = PrintedCheck(name, statement.number, part, statement.printed, printed)
    if printed:
        return check
    return replace(
        check,
        meant=statement.meant,
        meant_follows=meant,
        fault=statement.fault,
        remark=statement.remark,
    )


def _check_step(
    name: str, sources: tuple[str, ...], eliminated: tuple[sp.Symbol, ...], target: str
) -> PrintedCheck:
    """Whether printed equations, solved for what they share, yield the next one as printed."""
    printed = {statement.name: statement.printed for statement in EQUATIONS}
    system = [r for source in sources for r in residuals(printed[source], NEGATIVE)]
    (solution,) = sp.linsolve(system, eliminated)
    values = dict(zip(eliminated, solution, strict=True))
    result = all(vanishes(r.subs(values), NEGATIVE) for r in residuals(printed[target], NEGATIVE))
    title = ", ".join(f"({source[2:]})" for source in sources) + f" → ({target[2:]})"
    return PrintedCheck(name, None, NEGATIVE.label, title, result)


def _is_uplift(condition: str) -> bool:
    """Whether a condition on ü_g holds exactly when θ̈ turns a resting column to either side."""
    multiple, tangent = sp.Symbol("multiple", real=True), sp.Symbol("tangent", positive=True)
    threshold = {ground_acceleration: multiple * g * sp.tan(alpha)}
    (relation,) = read(condition, NEGATIVE)
    excess = (relation.lhs - relation.rhs).subs(threshold).subs(sp.tan(alpha), tangent)
    stated = sp.simplify(excess / (g * tangent)) > 0
    starts = []
    for side in SIDES:
        outward = side.sign * side.upright(column_motion(side))
        restoring = -outward.subs(ground_acceleration, 0)  # positive
        starts.append(sp.simplify(outward.subs(threshold) / restoring) > 0)
    return bool(stated.as_set() == sp.Or(*starts).as_set())
