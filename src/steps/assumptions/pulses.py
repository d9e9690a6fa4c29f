"""Single pulses: outcome, minimum overturning amplitude, and peak rotation of survivors."""

import math
from dataclasses import replace
from functools import partial
from itertools import pairwise

import numpy as np

from replication.workbench import truth
from steps.assumptions.choices import Choices, Structure
from steps.assumptions.quantity import Answer, Quantity, Sections
from topheavy import Column, Pulse, RockingFrame, judge, simulate

STEP = 0.05  # of the pulse's amplitude: of the factors among which the lowest is sought
HALVINGS = 14  # of STEP
MOST = 12.0  # g tan α: of the amplitudes of one pulse
APART = 1e-4  # of an amplitude: what is closer is not told apart
ALIKE = 1e-3  # of α: histories that are this close are called identical


def a_pulse(settings: dict) -> Pulse:
    spec = settings["pulse"]
    return Pulse(spec["shape"], spec["amplitude"], 2.0 * math.pi / spec["period"])


def similar(column: Column, scale: float) -> Column:
    return Column(scale * column.half_width, scale * column.half_height)


def peak(choices: Choices, structure: Structure, pulse: Pulse) -> float:
    """Return the largest |θ|/α, NaN if it overturns."""
    block = choices.block(structure)
    ending = judge(block, choices.motion(pulse), tolerance=choices.tolerance)
    return ending.peak / block.slenderness


def lowest(choices: Choices, structure: Structure, pulse: Pulse, most: float) -> float:
    """Return the lowest factor on a pulse of 1 g tan α that overturns, or infinity up to `most`.

    The search uses a grid and then bisection; it misses intervals narrower than the step.
    """

    def falls(factor: float) -> bool:
        return choices.falls(structure, pulse.scaled(factor))

    high = next((float(f) for f in np.arange(0.95, most, STEP) if falls(f)), math.inf)
    low = high - STEP
    for _ in range(HALVINGS if high < math.inf else 0):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if falls(middle) else (middle, high)
    return high


def heavier_survives_more(choices: Choices, sections: Sections) -> Answer:
    settings = sections["heavier"]
    column = Column(**settings["column"])
    pulse = replace(a_pulse(settings), amplitude=column.uplift_acceleration)
    frames = [RockingFrame(column, gamma) for gamma in settings["mass_ratios"]]
    found = [lowest(choices, frame, pulse, MOST) for frame in frames]
    rises = all(low < high for low, high in pairwise(found))
    return Answer(found[-1] / found[0] - 1.0, truth(rises))


def column_falls(choices: Choices, sections: Sections) -> Answer:
    """The minimum overturning amplitude of the column, in g, and whether the pulse overturns it."""
    column, pulse = Column(**sections["heavier"]["column"]), a_pulse(sections["heavier"])
    level = column.uplift_acceleration
    found = lowest(choices, column, replace(pulse, amplitude=level), MOST)
    return Answer(found * level, truth(choices.falls(column, pulse)))


def heaviest_stands(choices: Choices, sections: Sections) -> Answer:
    settings = sections["heavier"]
    frame, pulse = (
        RockingFrame(Column(**settings["column"]), settings["mass_ratios"][-1]),
        a_pulse(settings),
    )
    return Answer(peak(choices, frame, pulse), truth(not choices.falls(frame, pulse)))


def scale_effect(choices: Choices, sections: Sections, larger: bool) -> Answer:
    """The peak of a larger column, or under a shorter pulse, if the first column overturns."""
    settings = sections["scale_effects"]
    small, short = Column(**settings["column"]), a_pulse(settings)
    long = replace(short, angular_frequency=short.angular_frequency / settings["longer"])
    survivor, pulse = (similar(small, settings["larger"]), long) if larger else (small, short)
    holds = choices.falls(small, long) and not choices.falls(survivor, pulse)
    return Answer(peak(choices, survivor, pulse), truth(holds))


def lowest_rises(choices: Choices, sections: Sections) -> Answer:
    """Count the steps of γ over which the minimum overturning amplitude falls."""
    settings = sections["assumptions"]["spectra"]
    column = Column(**sections["stability"]["column"])
    p = choices.block(column).frequency_parameter
    frames = [RockingFrame(column, gamma) for gamma in settings["mass_ratios"]]
    exceptions = 0
    for shape in settings["shapes"]:
        for ratio in settings["frequency_ratios"]:
            pulse = Pulse(shape, column.uplift_acceleration, ratio * p)
            found = [lowest(choices, frame, pulse, settings["most"]) for frame in frames]
            exceptions += sum(high < low * (1.0 - APART) for low, high in pairwise(found))
    return Answer(exceptions, truth(exceptions == 0))


def identical_response(choices: Choices, sections: Sections) -> Answer:
    """How far the frame is from the equivalent column with that column's own √r, over α.

    The equivalent column has the size that gives it the frame's p̂: of Eq. (24) for rectangles.
    """
    settings = sections["statements"]
    frame, pulse = (
        RockingFrame(Column(**settings["column"]), settings["mass_ratio"]),
        a_pulse(settings),
    )
    block, alone = choices.block(frame), choices.block(frame.column)
    scale = (alone.frequency_parameter / block.frequency_parameter) ** 2
    own = choices.block(similar(frame.column, scale))
    motion, times = choices.motion(pulse), np.linspace(0.0, 6.0, 601)
    histories = [
        simulate(item, motion, samples=times, tolerance=choices.tolerance).rotation
        for item in (block, own, own.with_restitution(block.restitution))
    ]
    apart, given = (
        float(np.nanmax(np.abs(histories[0] - other))) / block.slenderness
        for other in histories[1:]
    )
    return Answer(apart, truth(apart < ALIKE, holds_when=given < ALIKE))


QUANTITIES = {
    "one pulse: gain of the heaviest": Quantity(
        "one_pulse_heavier_survives_more", "", heavier_survives_more
    ),
    "one pulse: lowest of the column": Quantity("fig1_structures", "g", column_falls),
    "one pulse: peak of the heaviest": Quantity("fig1_heaviest_frame", "α", heaviest_stands),
    "size effect: peak of the larger": Quantity(
        "size_effect", "α", partial(scale_effect, larger=True)
    ),
    "duration effect: peak": Quantity(
        "duration_effect_by_example", "α", partial(scale_effect, larger=False)
    ),
    "lowest amplitude falls with γ": Quantity(
        "lowest_amplitude_rises_with_mass", "sections", lowest_rises
    ),
    "frame and equivalent column": Quantity("identical_response", "α", identical_response),
}
