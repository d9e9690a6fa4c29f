"""Outcomes and histories of a rule that another solver computes again.

A sample of outcomes lies beside changes of the outcome, and where the Taylor solver is sure.
"""

import math
from collections.abc import Callable, Iterable
from itertools import groupby

import numpy as np

from replication.step import check
from steps.shared import plain
from topheavy import Record, Response, RockingBlock, judge

NEAR = 1e-3  # largest relative distance of a factor from a change of outcome
NUDGE = 1e-9  # relative change of a motion, smaller than any measurement resolves

Cell = tuple[RockingBlock, Record, Record | None, float, bool]
"""A structure, a motion and its vertical component, the factor on both, whether it overturns."""


def overturns(block: RockingBlock, record: Record, up: Record | None, factor: float) -> bool:
    """Return whether a motion times a factor overturns a structure, by the Taylor solver."""
    return judge(block, record.scaled(factor), vertical=up and up.scaled(factor)).overturned


def beside_a_boundary(overturns: Callable[[float], bool], factor: float) -> float:
    """Return a factor with the same outcome, within NEAR of a factor with the other outcome."""
    outcome, beyond = overturns(factor), factor
    while overturns(beyond) == outcome:
        factor, beyond = beyond, beyond * (0.9 if outcome else 1.1)
    while abs(beyond / factor - 1.0) > NEAR:
        middle = math.sqrt(factor * beyond)
        factor, beyond = (middle, beyond) if overturns(middle) == outcome else (factor, middle)
    return factor


def is_known(block: RockingBlock, record: Record, up: Record | None, factor: float) -> bool:
    """Return whether the Taylor solver has the same outcome under a motion nudged up and down."""
    nudges = (-NUDGE, 0.0, NUDGE)
    outcomes = {overturns(block, record, up, factor * (1.0 + nudge)) for nudge in nudges}
    return len(outcomes) == 1


def motion_of(cell: Cell) -> tuple[Record, Record | None, float]:
    """Return the motion of a cell, by which structures may be followed together.

    Factors on horizontal motions are amplitudes of one motion; with a vertical component, each
    factor makes another motion.
    """
    _, record, up, factor, _ = cell
    return record, up, factor if up else 1.0


def check_sample(cells: Iterable[Cell]) -> None:
    """Stop the step unless the plain solver has the same outcomes.

    Outcomes that a nudge of the motion changes are not compared. The plain solver follows
    successive cells together that share a motion.
    """
    compared = differ = 0
    known = (cell for cell in cells if is_known(*cell[:4]))
    for (record, up, scale), group in groupby(known, motion_of):
        blocks, *_, factors, fell = zip(*group, strict=True)
        ground, *_ = plain.ground_of(record.scaled(scale), up and up.scaled(scale))
        ends = plain.judge_together(blocks, np.array(factors) / scale, ground, 1.0)
        compared += len(fell)
        differ += sum(end.overturned != ours for end, ours in zip(ends, fell, strict=True))
    text = f"the plain solver has {differ} of {compared} outcomes otherwise"
    print(text, flush=True)
    check(compared > 0 and differ == 0, text)


def check_histories(
    response: Response, repeated: Iterable[Response], agree: float, case: str
) -> None:
    """Stop the step unless other solvers agree with a response, in rotations (times α) and outcome.

    Rotations are compared up to |θ| = 2α, as differences grow beyond.
    """
    upright = np.abs(response.rotation) <= 2.0 * response.slenderness
    for history in repeated:
        apart = np.abs(history.rotation - response.rotation)[upright].max() / response.slenderness
        check(
            apart < agree and history.outcome == response.outcome,
            f"{case}: two solvers are {apart:.1g} α apart, or differ in outcome",
        )
