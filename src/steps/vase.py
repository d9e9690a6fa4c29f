"""A mass fixed to the top of one column, against the same mass carried freely by two.

The minimum overturning acceleration of both is compared with that of the bare column: under pulses
of one period, and under pulses over their frequency. Under records it is the capacity.
"""

import math
from collections.abc import Iterator, Sequence
from itertools import product
from typing import Any

import numpy as np
import pandas as pd

from replication.step import check, grid, run, truth, value
from steps.shared.poses import bodies, lying, structures
from topheavy import (
    STANDARD_GRAVITY,
    Column,
    FixedMassColumn,
    LowestOverturning,
    Pulse,
    Record,
    RockingFrame,
    capacity,
    lowest_overturning,
    overturned_by,
    read_record,
    simulate,
)
from topheavy.bodies.structures import Structure
from topheavy.second import reference

STEP = 0.001  # between the factors on a record, relative
DISTANCES = (1e-7, 1e-5, 1e-3)  # from a minimum, over it: where SciPy judges, from near to far
AT_A_TIME = 512  # factors that are tried in one call where a wide interval is sought
SEED = 2014  # of the minima that SciPy judges
FALL = (0.0, 0.15, 0.4, 0.7, 1.0)  # of the last rotation: poses of a structure that overturns
BARE, FIXED, FREE = "bare", "fixed", "free"
Motion = Pulse | Record


def rivals(column: Column, gammas: Sequence[float]) -> Iterator[tuple[str, float, Structure]]:
    """Yield the bare column, then for each γ > 0 the same mass fixed to it, and carried freely."""
    yield BARE, 0.0, column
    for gamma in gammas:
        if gamma > 0.0:
            yield FIXED, gamma, FixedMassColumn(column, gamma)
            yield FREE, gamma, RockingFrame(column, gamma)


def minima(
    under: Sequence[Structure], motion: Motion, highest: float, floor: float
) -> list[LowestOverturning | None]:
    """Return the lowest interval of each structure, g; None if it does not uplift up to `highest`.

    The motion has a unit peak. The floor is over the uplift acceleration of each structure.
    """
    levels = [structure.block().uplift_acceleration for structure in under]
    found: list[LowestOverturning | None] = []
    for structure, level in zip(under, levels, strict=True):
        one = None
        if level < highest:
            ends = (level, highest)
            one = lowest_overturning(structure, motion, ends, floor=floor * level)
        found.append(one if one and one.bracket else None)
    return found


def capacities(under: Sequence[Structure], record: Record, highest: float) -> list[float]:
    """Return the capacity of each structure under a record of unit peak, g; infinite if none."""
    lowest = min(structure.block().uplift_acceleration for structure in under)
    factors = lowest * (1.0 + STEP) ** np.arange(math.log(highest / lowest) / math.log1p(STEP))
    found = [capacity(structure, record, factors).factor for structure in under]
    return np.nan_to_num(found, nan=math.inf).tolist()


def lowest_wide(
    structure: Structure, motion: Motion, begin: float, highest: float, step: float, width: float
) -> float:
    """Return the lowest acceleration from which all steps of a width overturn, g; infinite if none.

    They are tried from the minimum on.
    """
    run_of = 0
    while begin <= highest:
        factors = begin + step * np.arange(AT_A_TIME)
        factors = factors[factors <= highest]
        for factor, overturned in zip(
            factors, overturned_by(structure, motion, factors), strict=True
        ):
            run_of = run_of + 1 if overturned else 0
            if run_of > round(width / step):
                return float(factor - (run_of - 1) * step)
        begin += step * AT_A_TIME
    return math.inf


def error_of(structure: Structure, motion: Motion, one: LowestOverturning) -> float:
    """Return how far a minimum may be off by SciPy, g; stop where it finds none within 1e-3."""
    low, high = one.bracket
    last = one.upper[0] if one.upper else one.scale_range[1]

    def overturns(factor: float) -> bool:
        return reference.judge(structure, motion.scaled(factor)).overturned

    for distance in DISTANCES:
        above = min(high * (1.0 + distance), 0.5 * (high + last))
        if overturns(above) and not overturns(low * (1.0 - distance)):
            return distance * high + high - low
    check(False, f"SciPy finds no minimum of {structure} near {high:.9g} g under {motion}")
    return math.nan


def of_one_period(column: Column, settings: dict) -> list[dict]:
    """Return each structure's three parameters, and its minimum under each pulse of the period."""
    rows, highest = [], settings["highest"] * column.uplift_acceleration
    of_each = product(rivals(column, settings["mass_ratios"]), settings["shapes"])
    for (name, gamma, structure), shape in of_each:
        block = structure.block()
        pulse = Pulse(shape, 1.0, 2.0 * math.pi / settings["period"])
        (found,) = minima([structure], pulse, highest, settings["floor"])
        rows.append(
            {
                "structure": name,
                "mass_ratio": gamma,
                "slenderness_deg": math.degrees(block.slenderness),
                "frequency_parameter": block.frequency_parameter,
                "restitution": block.restitution,
                "equivalent_size": 3.0 * STANDARD_GRAVITY / (4.0 * block.frequency_parameter**2),
                "uplift_acceleration": block.uplift_acceleration,
                "shape": shape,
                "minimum_overturning": found.factor,
                "error": error_of(structure, pulse, found),
            }
        )
    return rows


def motions(
    column: Column, settings: dict, paths: list[str]
) -> Iterator[tuple[Motion, list[float], dict]]:
    """Yield every motion, of unit peak, with the γ that it is applied to and its labels."""
    for spec in settings["grids"]:
        for shape, ratio in product(spec["shapes"], map(float, grid(spec["frequency_ratios"]))):
            pulse = Pulse(shape, 1.0, ratio * column.frequency_parameter)
            yield pulse, spec["mass_ratios"], {"motion": shape, "frequency_ratio": ratio}
    for record in map(read_record, paths):
        labels = {"motion": record.name, "frequency_ratio": math.nan}
        scaled = record.scaled(1.0 / record.peak_acceleration)
        yield scaled, settings["record_mass_ratios"], labels


def under_motions(column: Column, settings: dict, paths: list[str]) -> list[dict]:
    """Return the minima of all structures under each motion, infinite where nothing overturns.

    Under a record both minima are the capacity. SciPy judges a sample of the minima under pulses,
    and every exception there: the structure with the higher minimum has to survive the lower one.
    """
    highest, floor = settings["highest"] * column.uplift_acceleration, settings["floor"]
    rows, of_pulses = [], []
    for motion, gammas, labels in motions(column, settings, paths):
        names, ratios, under = zip(*rivals(column, gammas), strict=True)
        if isinstance(motion, Record):
            of_all = zip(names, ratios, capacities(under, motion, highest), strict=True)
            rows += [
                labels
                | {"structure": name, "mass_ratio": gamma, "minimum": one, "wide_minimum": one}
                for name, gamma, one in of_all
            ]
            continue
        found = minima(under, motion, highest, floor)
        for name, gamma, structure, one in zip(names, ratios, under, found, strict=True):
            step = floor * structure.block().uplift_acceleration
            width = settings["wide"] / floor * step
            minimum, wide = math.inf, math.inf
            if one:
                minimum = one.factor
                wide = lowest_wide(structure, motion, minimum, highest, step, width)
            rows.append(
                labels
                | {"structure": name, "mass_ratio": gamma, "minimum": minimum, "wide_minimum": wide}
            )
            if one:
                of_pulses.append((structure, motion, one))
            bare = found[0].factor if found[0] else math.inf
            if is_exception(name, minimum, bare):
                later, earlier = (column, minimum) if name == FREE else (structure, bare)
                falls = reference.judge(later, motion.scaled(earlier)).overturned
                check(not falls, f"{later} overturns at {earlier:.9g} g under {motion}, by SciPy")
                for of, interval in ((structure, one), (column, found[0])):
                    if interval:
                        error_of(of, motion, interval)
    picked = np.random.default_rng(SEED).permutation(len(of_pulses))[: settings["sample"]]
    for place in picked:
        error_of(*of_pulses[place])
    return rows


def is_exception(structure: str, minimum: float, bare: float) -> bool:
    """Whether a fixed mass overturns later than the bare column, or a frame earlier."""
    return {BARE: False, FIXED: minimum > bare, FREE: minimum < bare}[structure]


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
    shown = structures(column, picture["mass_ratio"], picture["cap"])
    for amplitude, (name, structure) in product(picture["amplitudes"], shown.items()):
        pulse = Pulse("one-cosine", amplitude, 2.0 * math.pi / settings["period"])
        outcome, angles = rotations(structure, pulse, picture["cap"])
        for pose, rotation in enumerate(angles):
            labels = {
                "amplitude": amplitude,
                "mass_ratio": picture["mass_ratio"],
                "structure": name,
            }
            labels |= {"outcome": outcome, "pose": pose, "last": pose == len(angles) - 1}
            for body, outline in bodies(structure, rotation, picture["cap"]).items():
                for x, y in outline:
                    yield labels | {"body": body, "x": x, "y": y}


def compute(settings: dict, column: dict, records: list[str]) -> dict[str, Any]:
    """Return minima under the pulses of one period and under all motions, and the poses."""
    of = Column(**column)
    return {
        "vase": of_one_period(of, settings),
        "motions": under_motions(of, settings, list(records)),
        "poses": [*poses(of, settings)],
    }


def compared(vase_motions: pd.DataFrame) -> pd.DataFrame:
    """Return each fixed mass and frame beside the bare column, where one of the two overturns."""
    at = ["motion", "frequency_ratio"]
    table = vase_motions.fillna({"frequency_ratio": -1.0})
    bare = table[table.structure == BARE].drop_duplicates(at).set_index(at)
    table = table[table.structure != BARE].join(
        bare[["minimum", "wide_minimum"]].add_suffix("_bare"), at
    )
    table = table[np.isfinite(table[["minimum", "minimum_bare"]].min(axis=1))]
    for name in ("minimum", "wide_minimum"):
        ranks = zip(table.structure, table[name], table[f"{name}_bare"], strict=True)
        table[f"{name}_reversed"] = [is_exception(*rank) for rank in ranks]
    return table


def ranked(table: pd.DataFrame, longest: float) -> dict[str, Any]:
    """Return whether all structures keep their ranks, on the condition of long pulses."""
    record = table.frequency_ratio < 0.0
    long = table[~record & (table.frequency_ratio <= longest)]
    exceptions = table[table.minimum_reversed]
    return truth(
        exceptions.empty,
        holds_when=len(long) > 0 and not long.minimum_reversed.any(),
        condition=f"the ground motion is a pulse of ω at most {longest:g} p",
        comparisons=len(table),
        exceptions=len(exceptions),
        records=record.sum(),
        exceptions_under_records=(record & table.minimum_reversed).sum(),
    )


def findings(vase: pd.DataFrame, vase_motions: pd.DataFrame, settings: dict) -> dict[str, Any]:
    """Return the quoted minima, and whether the ranks of the structures hold everywhere."""
    table = compared(vase_motions)
    free, longest = table[table.structure == FREE], settings["longest"]
    wide = int(free.wide_minimum_reversed.sum())
    under = vase.set_index(["structure", "mass_ratio", "shape"]).minimum_overturning
    raised = [under[FREE, math.inf, s] / under[BARE, 0.0, s] - 1.0 for s in settings["shapes"]]
    ranks = [
        under.loc[FIXED, :, s].max() < under[BARE, 0.0, s] < under.loc[FREE, :, s].min()
        for s in settings["shapes"]
    ]
    found = {
        "fixed_mass_always_lowers": ranked(table[table.structure == FIXED], longest),
        "frame_always_raises": truth(
            not free.minimum_reversed.any() and wide == 0,
            holds_when=not free.minimum_reversed.any(),
            condition="the lowest interval of overturning accelerations counts, however narrow",
            comparisons=len(free),
            records=(free.frequency_ratio < 0.0).sum(),
            exceptions=free.minimum_reversed.sum(),
            exceptions_of_wide_intervals=wide,
        ),
        "support_decides": ranked(table, longest) | {"under_the_pulses_of_one_period": all(ranks)},
        "least_raise": value(min(raised), 1e-6),
        "largest_raise": value(max(raised), 1e-6),
    }
    quoted = vase[vase["shape"] == "one-cosine"].set_index(["structure", "mass_ratio"])
    for name, at in {
        "minimum_of_the_column": (BARE, 0.0),
        "minimum_at_mass_ratio_one": (FREE, 1.0),
        "minimum_of_the_heaviest": (FREE, math.inf),
    }.items():
        found[name] = value(*quoted.loc[at, ["minimum_overturning", "error"]], "g")
    return found


if __name__ == "__main__":
    run(snakemake, compute, findings)
