"""The forces of rocking frames beside those of frames that are held against uplift."""

import math

import pandas as pd

from replication.workbench import truth
from steps.assumptions.choices import Choices
from steps.assumptions.quantity import Cases, Found, Quantity
from steps.peak_forces import FORCES, PINNED, RIGID, held, ratio_of
from steps.uplift_limits import compare
from topheavy import Cap, Column, Pulse, RockingFrame


def limits(choices: Choices, cases: Cases) -> Found:
    """The largest ratio of the bending moments of survivors, and whether all forces are smaller.

    The condition is that of the claim: a rigid held frame and, for bending moments, pinned tops.
    The error is estimated from twice as many samples.
    """
    case, few = cases["uplift_limits"], cases["assumptions"]["held"]
    column = Column(**case["column"])
    frames = [RockingFrame(column, gamma) for gamma in few["mass_ratios"]]
    cap = Cap(case["cap"]["span"], case["cap"]["depth"] / 2.0)
    points = case["pulses"]["points"] * (1 if choices.samples == Choices.samples else 2)
    given = case | {"pulses": {"amplitudes": few["amplitudes"], "points": points}}
    rows = [
        row
        for shape in few["shapes"]
        for ratio in few["frequency_ratios"]
        for row in compare(
            frames,
            cap,
            Pulse(shape, 1.0, ratio * column.frequency_parameter),
            {"kind": "pulse"},
            given,
        )
    ]
    largest = pd.DataFrame(rows).max(numeric_only=True)
    beside = [one for one in held(math.inf, case["periods"]) if choices.held in (None, one)]
    ratios = {(name, *one): largest[ratio_of(name, *one)] for name in FORCES for one in beside}
    on_condition = [
        ratio
        for (name, top, stiffness), ratio in ratios.items()
        if stiffness == RIGID and (top == PINNED or name != "bending_moment")
    ]
    bending = max(ratio for (name, *_), ratio in ratios.items() if name == "bending_moment")
    return Found(
        bending,
        truth(
            max(ratios.values()) < 1.0,
            holds_when=bool(on_condition) and max(on_condition) < 1.0,
        ),
    )


QUANTITIES = {"held frame: bending moment": Quantity("uplift_limits_forces", "", limits)}
