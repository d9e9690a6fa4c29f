"""Test whether every printed equation and formula of the paper follows from its premises."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

import numpy as np
import sympy as sp

from topheavy.derivation.equilibrium import column_motion
from topheavy.derivation.in_text import IN_TEXT, STEPS, UPLIFT
from topheavy.derivation.mends import CONVENTIONS, Mend, smallest_mend
from topheavy.derivation.notation import (
    NEGATIVE,
    SYMBOLS,
    Side,
    alpha,
    g,
    ground_acceleration,
    read,
    vanishes,
)
from topheavy.derivation.premises import Premises, Values
from topheavy.derivation.printed import EQUATIONS, Statement

ROUNDING = 1e-9
"""A residual, of terms of the order of one, that is farther from zero does not vanish."""


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
        The kind of the smallest mend of `topheavy.derivation.mends` under which the print follows,
        "" if the printed form follows, or no corrected form does.
    mended
        The print with that mend made.
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
    mended: str = ""
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
    """Whether an equation is an identity on these sides, with the derived values put in."""
    return all(
        vanishes(residual.subs(premises(side)), side)
        for side in sides
        for residual in residuals(equation, side)
    )


def find_mend(printed: str, premises: Premises, sides: tuple[Side, ...]) -> Mend | None:
    """Return the smallest mend under which an equation follows on these sides, None if none does.

    Numbers put in for all symbols rule out what does not follow; the algebra decides the rest.
    """
    meanings = {name: _counted_otherwise(premises, name) for name in ("", *CONVENTIONS)}
    points = {
        (name, side): _point(meaning, side) for name, meaning in meanings.items() for side in sides
    }

    def holds(mend: Mend) -> bool:
        try:
            likely = all(
                _vanishes_at(points[mend.convention, side], mend.text, side) for side in sides
            )
        except (SyntaxError, TypeError):
            return False  # a bracket where no equation can have one
        return likely and follows(mend.text, meanings[mend.convention], sides)

    return smallest_mend(printed, holds)


def _counted_otherwise(premises: Premises, convention: str) -> Premises:
    """Return the premises with some forces counted positive in the other direction."""
    turned = CONVENTIONS.get(convention, {})

    def values(side: Side) -> Values:
        true = premises(side)
        return dict(true) | {force: other.subs(true) for force, other in turned.items()}

    return values


def _point(premises: Premises, side: Side) -> dict[str, float]:
    """Return numbers for all symbols, by their names: drawn, or derived from those drawn."""
    values = premises(side)
    free = {name for value in values.values() for name in value.free_symbols}
    free |= {symbol for symbol in SYMBOLS if symbol not in values} | {side.rotation}
    names = sorted(free, key=str)
    drawn = dict(zip(names, np.random.default_rng(7).uniform(0.2, 0.6, len(names)), strict=True))
    slenderness = values[alpha].subs(drawn) if alpha in values else drawn[alpha]
    drawn[side.rotation] = side.sign * float(slenderness) / 2.0
    numbers = {name: sp.Float(number) for name, number in drawn.items()}
    known = {name: complex(value.xreplace(numbers)) for name, value in values.items()}
    return {str(name): number for name, number in (drawn | known).items()}


def _vanishes_at(point: dict[str, float], equation: str, side: Side) -> bool:
    """Whether the members of an equation agree at a point; no, if it has an unknown symbol."""
    for residual in residuals(equation, side):
        if any(str(name) not in point for name in residual.free_symbols):
            return False
        values = {name: sp.sympify(point[str(name)]) for name in residual.free_symbols}
        if abs(complex(residual.xreplace(values))) > ROUNDING:
            return False
    return True


def _checks(statement: Statement) -> Iterator[PrintedCheck]:
    parts = [(side,) for side in statement.sides] if statement.split else [statement.sides]
    for sides in parts:
        part = sides[0].label if len(sides) == 1 else ""
        name = statement.name
        if statement.split:
            name += "_negative" if part == NEGATIVE.label else "_positive"
        printed = follows(statement.printed, statement.premises, sides)
        check = PrintedCheck(name, statement.number, part, statement.printed, printed)
        if not printed:
            mend = find_mend(statement.printed, statement.premises, sides)
            check = replace(
                check,
                meant=statement.meant,
                meant_follows=bool(statement.meant)
                and follows(statement.meant, statement.premises, sides),
                fault=mend.kind if mend else "",
                mended=(mend.convention or mend.text) if mend else "",
                remark=statement.remark,
            )
        yield check


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
