"""A mass fixed to the top of one column, against the same mass carried freely by two.

The minimum overturning acceleration of both is compared with that of the column: under pulses
of one period, and under pulses over their frequency. Under the former also with that of a portal,
two columns and a beam in one piece, which is free to rock.
"""

import math
from collections.abc import Iterator, Sequence
from itertools import product
from typing import Any

import numpy as np
import pandas as pd

from replication.step import check, grid, run, truth, value
from steps.shared import plain
from steps.shared.cases import lowest
from steps.shared.poses import bodies, lying, structures
from topheavy import (
    Column,
    FixedMassColumn,
    LowestOverturning,
    MonolithicPortal,
    Pulse,
    RockingFrame,
    overturned_by,
    simulate,
)
from topheavy.bodies.structures import Structure
from topheavy.outcomes.minimum import lowest_of_many

DISTANCES = (1e-7, 1e-5, 1e-3)  # relative distances from a minimum at which the plain solver judges
CHUNK = 64  # factors in one call of a search for a wide interval
SEED = 2014  # seed of the sample of minima that the plain solver judges
FALL = (0.0, 0.15, 0.4, 0.7, 1.0)  # poses of a structure that overturns, times its last rotation
COLUMN, FIXED, FRAME, PORTAL = "column", "fixed mass", "frame", "portal"


def rivals(column: Column, gammas: Sequence[float]) -> Iterator[tuple[str, float, Structure]]:
    """Yield the column, then for each γ > 0 a mass fixed to it, and the mass carried freely."""
    yield COLUMN, 0.0, column
    for gamma in gammas:
        if gamma > 0.0:
            yield FIXED, gamma, FixedMassColumn(column, gamma)
            yield FRAME, gamma, RockingFrame(column, gamma)


def lowest_by_two_floors(
    cases: Sequence[tuple[Structure, Pulse]], highest: float, settings: dict
) -> list[LowestOverturning | None]:
    """Return `lowest` of all cases, by a search in wide steps and one in narrow steps below it.

    The second begins at uplift where the first minimum is close to it, and near it elsewhere.
    """
    spec = settings["search"]
    levels = [structure.block().uplift_acceleration for structure, _ in cases]
    minima: list[LowestOverturning | None] = [None] * len(cases)

    def search(ends: dict[int, tuple[float, float]], floor: float) -> None:
        floors = [floor * levels[case] for case in ends]
        pairs = zip(*(cases[case] for case in ends), strict=True)
        intervals = lowest_of_many(*pairs, [*ends.values()], floors)
        for case, interval in zip(ends, intervals, strict=True):
            if interval.bracket and interval.bracket[1] < ends[case][1]:
                minima[case] = interval

    first = {case: (level, highest) for case, level in enumerate(levels) if level < highest}
    search(first, spec["floor"])
    below = {}
    for case, (level, interval) in enumerate(zip(levels, minima, strict=True)):
        if interval and interval.factor > level:
            is_close = interval.factor < spec["below"] * level
            begin = level if is_close else (1.0 - spec["near"]) * interval.factor
            below[case] = (max(begin, level), interval.factor)
    search(below, settings["floor"])
    return minima


def lowest_wide(
    structure: Structure, pulse: Pulse, begin: float, highest: float, step: float, width: float
) -> float:
    """Return where the lowest overturning interval of at least a width begins, g.

    The search moves up from the minimum in equal steps; the result is infinite if there is none.
    """
    length = 0
    while begin <= highest:
        factors = begin + step * np.arange(CHUNK)
        factors = factors[factors <= highest]
        outcomes = overturned_by(structure, pulse, factors)
        for factor, overturned in zip(factors, outcomes, strict=True):
            length = length + 1 if overturned else 0
            if length > round(width / step):
                return float(factor - (length - 1) * step)
        begin += step * CHUNK
    return math.inf


def errors_of(minima: Sequence[tuple[Structure, Pulse, LowestOverturning]]) -> list[float]:
    """Return the error (g) within which the plain solver confirms each minimum.

    The step stops at a minimum that it does not confirm within 0.1 %.
    """
    errors = [math.nan] * len(minima)
    for distance in DISTANCES:
        left = [case for case, error in enumerate(errors) if math.isnan(error)]
        cells = []
        for structure, pulse, interval in (minima[case] for case in left):
            low, high = interval.bracket
            last = interval.upper[0] if interval.upper else interval.scale_range[1]
            above = min(high * (1.0 + distance), 0.5 * (high + last))
            cells += [(structure, pulse.scaled(f)) for f in (low * (1.0 - distance), above)]
        fell = [end.overturned for end in plain.judge_pulses(cells)]
        for case, below, beyond in zip(left, fell[::2], fell[1::2], strict=True):
            if beyond and not below:
                low, high = minima[case][2].bracket
                errors[case] = distance * high + high - low
    for error, (structure, pulse, _) in zip(errors, minima, strict=True):
        message = f"the plain solver does not find the minimum of {structure}, {pulse}"
        check(not math.isnan(error), message)
    return errors


def of_one_period(column: Column, settings: dict) -> list[dict]:
    """Return each structure's three parameters, and its minimum under each pulse of the period."""
    rows, minima, highest = [], [], settings["highest"] * column.uplift_acceleration
    spec, gamma = settings["portal"], settings["picture"]["mass_ratio"]
    portal = MonolithicPortal(column, gamma, spec["span"], spec["depth"])
    structures = [*rivals(column, settings["mass_ratios"]), (PORTAL, gamma, portal)]
    for (name, gamma, structure), shape in product(structures, settings["shapes"]):
        block = structure.block()
        pulse = Pulse(shape, 1.0, period=settings["period"])
        interval = lowest(structure, pulse, highest, settings["floor"])
        minima.append((structure, pulse, interval))
        rows.append(
            {
                "structure": name,
                "mass_ratio": gamma,
                "slenderness_deg": math.degrees(block.slenderness),
                "frequency_parameter": block.frequency_parameter,
                "restitution": block.restitution,
                "uplift_acceleration": block.uplift_acceleration,
                "shape": shape,
                "minimum_overturning": interval.factor,
            }
        )
    errors = errors_of(minima)
    return [row | {"error": error} for row, error in zip(rows, errors, strict=True)]


def over_frequency(column: Column, settings: dict) -> list[dict]:
    """Return the minima of all structures under each pulse, infinite where nothing overturns.

    The plain solver judges a sample of the minima, and every exception: there the structure with
    the higher minimum has to survive the lower one.
    """
    highest, floor = settings["highest"] * column.uplift_acceleration, settings["floor"]
    rows, sample, exceptions = [], [], []
    cases = [
        (shape, float(ratio), *rival)
        for spec in settings["grids"]
        for shape, ratio in product(spec["shapes"], grid(spec["frequency_ratios"]))
        for rival in rivals(column, spec["mass_ratios"])
    ]
    pairs = [
        (structure, Pulse(shape, 1.0, angular_frequency=ratio * column.frequency_parameter))
        for shape, ratio, *_, structure in cases
    ]
    intervals = lowest_by_two_floors(pairs, highest, settings)
    column_minimum = math.inf
    for case, (structure, pulse), interval in zip(cases, pairs, intervals, strict=True):
        shape, ratio, name, gamma, _ = case
        minimum = wide = math.inf
        if interval:
            step = floor * structure.block().uplift_acceleration
            width, minimum = settings["wide"] / floor * step, interval.factor
            wide = lowest_wide(structure, pulse, minimum, highest, step, width)
            sample.append((structure, pulse, interval))
        column_minimum = minimum if name == COLUMN else column_minimum
        rows.append(
            {"motion": shape, "frequency_ratio": ratio, "structure": name}
            | {"mass_ratio": gamma, "minimum": minimum, "wide_minimum": wide}
        )
        if is_exception(name, minimum, column_minimum):
            stronger, lower = (column, minimum) if name == FRAME else (structure, column_minimum)
            exceptions.append((stronger, pulse.scaled(lower)))
    ends = plain.judge_pulses(exceptions)
    for (structure, pulse), end in zip(exceptions, ends, strict=True):
        check(not end.overturned, f"{structure} overturns under {pulse} by the plain solver")
    chosen = np.random.default_rng(SEED).permutation(len(sample))[: settings["sample"]]
    errors_of([sample[number] for number in chosen])
    return rows


def is_exception(structure: str, minimum: float, column_minimum: float) -> bool:
    """Return whether a fixed mass has a higher minimum than the column, or a frame a lower one."""
    return minimum > column_minimum if structure == FIXED else minimum < column_minimum


def rotations(structure: Structure, pulse: Pulse, cap: dict[str, float]) -> tuple[str, list[float]]:
    """Return the outcome, and the rotations that are drawn, the last one last.

    A structure that survives is drawn at its largest rotations to both sides, if any, and at 0.
    """
    response = simulate(structure, pulse, samples=np.linspace(0.0, 6.0 * pulse.duration, 4001))
    theta = response.rotation
    if not response.overturned:
        return response.outcome, [*sorted({float(theta.min()), float(theta.max())} - {0.0}), 0.0]
    check(
        not isinstance(structure, RockingFrame),
        f"the frame of vase.picture overturns at {pulse.amplitude:.6g} g; expected an amplitude "
        "that it survives, since its bodies part when it falls",
    )
    last = math.copysign(lying(structure, cap), theta[~np.isnan(theta)][-1])
    return response.outcome, [last * share for share in FALL]


def poses(column: Column, settings: dict) -> Iterator[dict]:
    """Yield a row for each corner of each body of each pose."""
    picture = settings["picture"]
    gamma, cap = picture["mass_ratio"], picture["cap"]
    shown = structures(column, gamma, cap).items()
    for amplitude, (name, structure) in product(picture["amplitudes"], shown):
        pulse = Pulse("one-cosine", amplitude, period=settings["period"])
        outcome, angles = rotations(structure, pulse, cap)
        for pose, rotation in enumerate(angles):
            labels = {"amplitude": amplitude, "mass_ratio": gamma, "structure": name}
            labels |= {"outcome": outcome, "pose": pose, "last": pose == len(angles) - 1}
            for body, outline in bodies(structure, rotation, cap).items():
                for x, y in outline:
                    yield labels | {"body": body, "x": x, "y": y}


def compute(settings: dict, column: dict) -> dict[str, Any]:
    """Return minima under the pulses of one period and over their frequency, and the poses."""
    solitary = Column(**column)
    return {
        "vase": of_one_period(solitary, settings),
        "motions": over_frequency(solitary, settings),
        "poses": [*poses(solitary, settings)],
    }


def compared(vase_motions: pd.DataFrame) -> pd.DataFrame:
    """Return each fixed mass and frame beside the column, where one of the two overturns."""
    pulse, is_column = ["motion", "frequency_ratio"], vase_motions.structure == COLUMN
    columns = vase_motions[is_column].drop_duplicates(pulse).set_index(pulse)
    minima = columns[["minimum", "wide_minimum"]].add_suffix("_column")
    table = vase_motions[~is_column].join(minima, pulse)
    table = table[np.isfinite(table[["minimum", "minimum_column"]].min(axis=1))]
    for name in ("minimum", "wide_minimum"):
        ranks = zip(table.structure, table[name], table[f"{name}_column"], strict=True)
        table[f"{name}_reversed"] = [is_exception(*rank) for rank in ranks]
    return table


def findings(vase: pd.DataFrame, vase_motions: pd.DataFrame, settings: dict) -> dict[str, Any]:
    """Return the quoted minima, and whether the ranks of the structures hold everywhere."""
    table = compared(vase_motions)
    frames, longest = table[table.structure == FRAME], settings["longest"]
    long = table[table.frequency_ratio <= longest]
    wide = int(frames.wide_minimum_reversed.sum())
    under = vase.set_index(["structure", "mass_ratio", "shape"]).minimum_overturning
    raised = [under[FRAME, math.inf, s] / under[COLUMN, 0.0, s] - 1.0 for s in settings["shapes"]]
    quoted = vase[vase["shape"] == "one-cosine"].set_index(["structure", "mass_ratio"])
    gamma = settings["picture"]["mass_ratio"]
    wider = [under[PORTAL, gamma, s] > under[FRAME, gamma, s] for s in settings["shapes"]]
    cases = {
        "minimum_of_the_column": (COLUMN, 0.0),
        "minimum_at_mass_ratio_one": (FRAME, 1.0),
        "minimum_of_the_heaviest": (FRAME, math.inf),
        "minimum_of_the_portal": (PORTAL, gamma),
    }
    return {
        "frame_always_raises": truth(
            not frames.minimum_reversed.any() and wide == 0,
            holds_when=not frames.minimum_reversed.any(),
            condition="the lowest interval of overturning accelerations counts, however narrow",
            comparisons=len(frames),
            exceptions=frames.minimum_reversed.sum(),
            exceptions_of_wide_intervals=wide,
        ),
        "support_decides": truth(
            not table.minimum_reversed.any(),
            holds_when=len(long) > 0 and not long.minimum_reversed.any(),
            condition=f"the ground motion is a pulse of ω at most {longest:g} p",
            comparisons=len(table),
            exceptions=table.minimum_reversed.sum(),
        ),
        "portal_is_harder_to_overturn": truth(all(wider), shapes=len(wider)),
        "least_raise": value(min(raised), 1e-6),
        "largest_raise": value(max(raised), 1e-6),
    } | {
        name: value(*quoted.loc[case, ["minimum_overturning", "error"]], "g")
        for name, case in cases.items()
        if case in quoted.index
    }


if __name__ == "__main__":
    run(snakemake, compute, findings)
