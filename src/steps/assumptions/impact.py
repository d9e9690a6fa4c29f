"""Quantities of the impact: √r, the energy loss, the error of Allen et al. (1986)."""

import math
from collections.abc import Iterator

import numpy as np

from replication.workbench import grid, truth
from steps.assumptions.choices import Choices
from steps.assumptions.quantity import Answer, Quantity, Sections
from topheavy import Column, Pulse, RockingFrame, judge
from topheavy.bodies.massless_columns import SIMPLIFICATIONS, simplified


def slender(degrees: float) -> Column:
    alpha = math.radians(degrees)
    return Column(math.sin(alpha), math.cos(alpha))


def restitutions(choices: Choices, sections: Sections) -> Iterator[tuple[float, float]]:
    """√r of column and frame, over slenderness and γ > 0; negative if they do not keep rocking."""
    settings = sections["restitution"]
    for column in map(slender, np.linspace(1.0, settings["largest_slenderness"], 60)):
        for gamma in settings["mass_ratios"]:
            if gamma > 0.0:
                frame = RockingFrame(column, gamma)
                yield choices.factors(column)[1], choices.factors(frame)[1]


def restitution_is_smaller(choices: Choices, sections: Sections) -> Answer:
    """The smallest difference between √r of the column and √r of its frame."""
    least = min(column - frame for column, frame in restitutions(choices, sections))
    return Answer(least, truth(least > 0.0))


def more_energy_is_dissipated(choices: Choices, sections: Sections) -> Answer:
    """The number of frames that keep rocking and lose no more energy than their column."""
    rocking = [pair for pair in restitutions(choices, sections) if min(pair) >= 0.0]
    against = [(column, frame) for column, frame in rocking if not frame**2 < column**2]
    return Answer(len(against), truth(not against))


def allen_error(choices: Choices, sections: Sections) -> Answer:
    """The median error of their model's peak, and whether p̂ for γ → ∞ causes most of it."""
    settings = sections["allen_errors"]
    errors: dict[str, list[float]] = {name: [] for name in SIMPLIFICATIONS}
    for column in map(slender, grid(settings["slendernesses"])):
        omega = settings["frequency_ratio"] * column.frequency_parameter
        for gamma in settings["mass_ratios"]:
            frame = RockingFrame(column, gamma)
            models = {name: simplified(frame, name) for name in SIMPLIFICATIONS}
            for name in ("massless restitution", "all"):
                models[name] = models[name].with_restitution(choices.massless_restitution(frame))
            for ratio in grid(settings["amplitudes"]):
                pulse = Pulse(settings["shape"], ratio * column.uplift_acceleration, omega)
                peak = judge(frame, pulse, tolerance=choices.tolerance).peak
                for name, model in models.items():
                    other = judge(model, pulse, tolerance=choices.tolerance).peak
                    errors[name].append(other / peak - 1.0)
    median = {name: float(np.nanmedian(np.abs(found))) for name, found in errors.items()}
    lesser = max(median["linearised"], median["massless restitution"])
    return Answer(median["all"], truth(median["massless frequency"] > lesser))


QUANTITIES = {
    "least deficit of √r": Quantity("restitution_is_smaller", "", restitution_is_smaller),
    "frames that lose no more": Quantity(
        "more_energy_is_dissipated", "sections", more_energy_is_dissipated
    ),
    "Allen et al.: median error": Quantity(None, "of the peak", allen_error),
}
