"""The forces of rocking frames beside those of frames that are held against uplift."""

import math
from functools import partial
from itertools import product

import numpy as np

from replication.workbench import truth
from steps.assumptions.choices import Choices
from steps.assumptions.quantity import Answer, Quantity, Sections
from steps.shared.peak_forces import FORCES, PINNED, RIGID, held, held_peaks, rocking_peaks
from topheavy import Cap, Column, Pulse, RockingFrame, simulate


def limits(choices: Choices, sections: Sections) -> Answer:
    """The largest ratio of the bending moments of survivors, and whether all forces are smaller.

    The condition is that of the claim: a rigid held frame and, for bending moments, pinned tops.
    """
    settings, few = sections["uplift_limits"], sections["assumptions"]["held"]
    column = Column(**settings["column"])
    frames = [RockingFrame(column, gamma) for gamma in few["mass_ratios"]]
    cap = Cap(settings["cap"]["span"], settings["cap"]["depth"] / 2.0)
    points = settings["pulses"]["points"] * (1 if choices.samples == Choices.samples else 2)
    route = partial(simulate, tolerance=choices.tolerance)
    compared = [one for one in held(math.inf, settings["periods"]) if choices.held in (None, one)]
    ratios: dict[tuple[str, str, str], list[float]] = {}
    for shape, ratio, peak in product(few["shapes"], few["frequency_ratios"], few["amplitudes"]):
        pulse = Pulse(shape, peak * column.uplift_acceleration, ratio * column.frequency_parameter)
        beside = held_peaks(frames, cap, pulse, settings["periods"])
        for frame, fixed in zip(frames, beside, strict=True):
            rocking = rocking_peaks(frame, cap, pulse, points, route).forces
            for name, one in product(FORCES, [one for one in compared if one in fixed]):
                found = rocking[name] / fixed[one][name]  # NaN if it overturns
                ratios.setdefault((name, *one), []).append(found)
    largest = {key: float(np.nanmax(found)) for key, found in ratios.items()}
    on_condition = [
        ratio
        for (name, top, stiffness), ratio in largest.items()
        if stiffness == RIGID and (top == PINNED or name != "bending_moment")
    ]
    return Answer(
        max(ratio for (name, *_), ratio in largest.items() if name == "bending_moment"),
        truth(
            max(largest.values()) < 1.0,
            holds_when=bool(on_condition) and max(on_condition) < 1.0,
        ),
    )


QUANTITIES = {"held frame: bending moment": Quantity("uplift_limits_forces", "", limits)}
