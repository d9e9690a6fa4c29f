"""Rankings of stability: pulses and records that overturn only the supposedly more stable one."""

import math
from dataclasses import replace
from functools import cache, partial
from itertools import combinations, pairwise

import numpy as np

from replication.workbench import grid, truth
from steps.assumptions.choices import Choices, beyond_slenderness, by_energy
from steps.assumptions.pulses import similar
from steps.assumptions.quantity import Answer, Quantity, Sections
from steps.stability import Trial, orders
from topheavy import Column, Pulse, RockingFrame, judge, overturning_map

FINER = 0.001  # g tan α: between amplitudes on the map, where a band may be narrow


@cache
def overturned(
    choices: Choices, column: Column, shape: str, amplitudes: tuple[float, ...], trial: Trial
) -> np.ndarray:
    """Which amplitudes (over g tan α) of a pulse overturn a trial."""
    structure, ratio = trial
    # p in the chosen g, so that ω/p is what it is said to be
    omega = ratio * choices.block(column).frequency_parameter
    pulse = Pulse(shape, column.uplift_acceleration, omega)
    return np.array([choices.falls(structure, pulse.scaled(factor)) for factor in amplitudes])


def ranking(choices: Choices, sections: Sections, name: str) -> Answer:
    """Count the amplitudes that overturn only the trial that should be more stable."""
    settings = sections["stability"]
    column, amplitudes = (
        Column(**settings["column"]),
        tuple(map(float, grid(settings["amplitudes"]))),
    )
    order = orders(settings)[name]
    # The sense is a matter of reading the scan, not of making it.
    over = partial(
        overturned, replace(choices, sense="both"), column, settings["shape"], amplitudes
    )

    def first(trial: Trial) -> float:
        return amplitudes[int(over(trial).argmax())] if over(trial).any() else math.inf

    against = sum(
        int((over(stronger) & ~over(weaker)).sum())
        for trials in order
        for weaker, stronger in combinations(trials, 2)
    )
    rises = all(first(a) <= first(b) for trials in order for a, b in pairwise(trials))
    finding = {
        "both": truth(against == 0, holds_when=rises),
        "pulse": truth(against == 0),
        "lowest": truth(rises),
    }[choices.sense]
    return Answer(against, finding)


def heavier_falls_alone_on_the_map(choices: Choices, sections: Sections) -> Answer:
    """Count the pulses of a dense map that overturn only the heavier of two neighbouring frames.

    The map uses two criteria; each pulse that it finds is judged again.
    """
    if choices.overturned not in (by_energy, beyond_slenderness):
        raise ValueError(
            f"overturned is {choices.overturned}; expected by_energy or beyond_slenderness"
        )
    settings = sections["assumptions"]["map"]
    column = Column(**sections["stability"]["column"])
    p, level = column.frequency_parameter, column.uplift_acceleration
    limit = column.slenderness if choices.overturned is beyond_slenderness else math.inf
    omegas, amplitudes = (
        grid(settings["frequency_ratios"]) * p,
        grid(settings["amplitudes"]) * level,
    )
    frames = [RockingFrame(column, gamma) for gamma in settings["mass_ratios"]]
    count, rises = 0, True
    for shape in settings["shapes"]:
        maps = [overturning_map(choices.block(f), shape, omegas, amplitudes) for f in frames]
        falls = [(found.overturned | (found.peak_rotation > limit)).values for found in maps]
        for (light, stands), (heavy, fallen) in pairwise(zip(frames, falls, strict=True)):
            for i, j in np.argwhere(fallen & ~stands):
                pulse = Pulse(shape, amplitudes[j], omegas[i])
                count += choices.falls(heavy, pulse) and not choices.falls(light, pulse)
            before, after = (
                np.where(over.any(axis=1), over.argmax(axis=1), len(amplitudes))
                for over in (stands, fallen)
            )
            for i in np.flatnonzero(after < before):  # so it seems: bands near uplift are narrow
                finer = np.arange(amplitudes[0], amplitudes[after[i]], FINER * level)
                rises &= any(choices.falls(light, Pulse(shape, a, omegas[i])) for a in finer)
    return Answer(count, truth(count == 0, holds_when=rises))


def heavier_falls_alone_under_records(choices: Choices, sections: Sections) -> Answer:
    """Count the sizes and records for which only the heavier frame overturns."""
    settings, spec = sections["rocking_spectra"], sections["assumptions"]["record_sizes"]
    column = Column(**settings["column"])
    count = 0
    for record in map(choices.resampled, sections["records"]):
        for size in np.geomspace(spec["lowest"], spec["highest"], spec["points"]):
            scaled = similar(column, size / column.size)
            falls = [
                judge(choices.block(frame), record, tolerance=choices.tolerance).overturned
                for frame in (RockingFrame(scaled, gamma) for gamma in settings["mass_ratios"])
            ]
            count += sum(heavy and not light for light, heavy in pairwise(falls))
    return Answer(count, truth(count == 0))


def _ranked(claim: str, name: str) -> Quantity:
    return Quantity(claim, "pulses", partial(ranking, name=name))


QUANTITIES = {
    "heavier falls alone": _ranked("heavier_is_more_stable", "heavier_is_more_stable"),
    "frame falls alone": _ranked(
        "frame_is_more_stable_than_its_column", "frame_is_more_stable_than_its_column"
    ),
    "larger falls alone": _ranked("larger_is_more_stable", "larger_is_more_stable"),
    "shorter overturns alone": _ranked("duration_effect", "longer_pulse_overturns_first"),
    "map: heavier falls alone": Quantity(
        "heavier_is_more_stable", "pulses", heavier_falls_alone_on_the_map
    ),
    "records: heavier falls alone": Quantity(None, "sections", heavier_falls_alone_under_records),
}
