"""Minima under several equal lobes, which can make a heavier frame weaker: see `falls`.

The lobes are those of a sine of several cycles, or two one-sine pulses with a pause.
"""

import math
from collections.abc import Mapping, Sequence
from itertools import combinations, pairwise, product
from typing import Any

import numpy as np
import pandas as pd

from replication.step import check, grid, truth
from steps.shared import plain, samples
from steps.shared.cases import column_of, pulse_on
from steps.shared.falls import Fall, Lowest, fall, lowest_of, searched_finely, share_that_stays
from steps.shared.lobes import record_of, sine
from topheavy import Record, RockingFrame, judge

SHAPE = "one-sine"
PLACE = ["cycles", "slenderness_deg", "frequency_ratio"]
FOUND = ["lowest_found", "lowest_upper", "wide_minimum", "wide_upper", "searched_step"]
TOGETHER = 100  # lines that are searched in the same calls of the kernel
PAIR = "lighter", "heavier"
ASIDE = 1e-4  # relative distance from the end of an interval at which both solvers judge
CLOSE = 0.005  # the same distance under two pulses, g tan α


def minima(settings: Mapping[str, Any], number: int = 1, shards: int = 1) -> pd.DataFrame:
    """Return for each structure and pulse of a shard the lowest amplitudes that overturn, g tan α.

    `lowest_found` and `lowest_upper` are the ends of the lowest interval that the search finds,
    `wide_minimum` and `wide_upper` those of the lowest wide one; they are infinite where there is
    none. A search in steps as wide finds every wide interval. Where a minimum falls by one of the
    counts of `falls`, both structures are searched below it by its grid, as `searched_step` says.
    """
    spec, gammas = settings["cycles"], settings["mass_ratios"]
    ratios = map(float, grid(spec["frequency_ratios"]))
    places = [*product(spec["numbers"], settings["slendernesses"], ratios)][number - 1 :: shards]
    labels = [(*place, gamma) for place in places for gamma in gammas]
    rows: dict[tuple, Lowest] = {}
    for begin in range(0, len(labels), TOGETHER):
        group = labels[begin : begin + TOGETHER]
        blocks, pulses = zip(*(one_line(*label) for label in group), strict=True)
        lowest = lowest_of(blocks, pulses, spec["highest"], spec["wide"])
        rows |= zip(group, lowest, strict=True)
        print(f"{len(rows)} of {len(labels)} lines of several cycles", flush=True)
    pairs = [((*place, a), (*place, b)) for place in places for a, b in combinations(gammas, 2)]
    while True:
        fell = {
            label for pair in pairs if any_falls(*(rows[label] for label in pair)) for label in pair
        }
        coarse = [
            label for label in labels if label in fell and rows[label].searched == spec["wide"]
        ]
        if not coarse:
            break
        for label in coarse:
            rows[label] = searched_finely(
                *one_line(*label), rows[label], spec["highest"], spec["wide"]
            )
        print(f"{len(coarse)} lines searched finely", flush=True)
    return pd.DataFrame(
        [(*label, *lowest) for label, lowest in rows.items()],
        columns=[*PLACE, "mass_ratio", *FOUND],
    )


def any_falls(lighter: Lowest, heavier: Lowest) -> bool:
    """Return whether the minimum falls by one of the three counts."""
    return any(share > 0.0 for share in fall(lighter, heavier))


def one_line(cycles: int, slenderness: float, ratio: float, gamma: float) -> tuple:
    """Return the block and its pulse with the amplitude g tan α."""
    column = column_of(slenderness)
    pulse = pulse_on(column, SHAPE, ratio, cycles=int(cycles))
    return RockingFrame(column, gamma).block(), pulse


def falls(table: pd.DataFrame, settings: Mapping[str, Any]) -> pd.DataFrame:
    """Return the falls of each pair and pulse by the three counts of `falls`, where one has one.

    The widths are those of the two intervals that the strict count compares. `stays` is the share
    of draws in which a quoted fall remains a strict one.
    """
    spec, rows = settings["cycles"], []
    for place, lines in table.groupby(PLACE):
        lowest = {row.mass_ratio: Lowest(*row[FOUND]) for _, row in lines.iterrows()}
        for light, heavy in combinations(sorted(lowest), 2):
            lighter, heavier = lowest[light], lowest[heavy]
            counts = fall(lighter, heavier)
            if any_falls(lighter, heavier):
                upper = min(heavier.wide_upper, spec["highest"])
                rows.append(
                    dict(zip(PLACE, place, strict=True))
                    | {"lighter": light, "lighter_from": lighter.lower}
                    | {"lighter_width": lighter.upper - lighter.lower}
                    | {"heavier": heavy, "heavier_from": heavier.wide_lower}
                    | {"heavier_width": upper - heavier.wide_lower}
                    | counts._asdict()
                )
    names = ["lighter", "lighter_from", "lighter_width", "heavier", "heavier_from", "heavier_width"]
    columns = [*PLACE, *names, *Fall._fields]
    result = pd.DataFrame(rows, columns=columns).assign(stays=math.nan)
    for pairs in kinds(settings["mass_ratios"]).values():
        for _, row in largest(result, pairs).iterrows():
            check_fall(row)
            result.loc[row.name, "stays"] = stays(row, spec)
    return result


def kinds(gammas: Sequence[float]) -> dict[str, list[tuple[float, float]]]:
    """Return the pairs of each finding: neighbouring frames, and the column and each frame."""
    column, *frames = sorted(gammas)
    return {
        "cycles_rise_with_mass": [*pairwise(frames)],
        "cycles_frame_is_above_its_column": [(column, gamma) for gamma in frames],
    }


def strict_falls(falls: pd.DataFrame, pairs: Sequence[tuple[float, float]]) -> pd.DataFrame:
    """Return the rows of the pairs that fall by the strict count."""
    return of_pairs(falls[falls.strict > 0.0], pairs)


def of_pairs(falls: pd.DataFrame, pairs: Sequence[tuple[float, float]]) -> pd.DataFrame:
    """Return the rows of the pairs."""
    is_one = [pair in pairs for pair in zip(falls.lighter, falls.heavier, strict=True)]
    return falls[np.array(is_one, dtype=bool)]


def largest(falls: pd.DataFrame, pairs: Sequence[tuple[float, float]]) -> pd.DataFrame:
    """Return the largest strict fall of the pairs for each number of cycles: those are quoted."""
    rows = strict_falls(falls, pairs)
    return rows.loc[rows.groupby("cycles").strict.idxmax()]


def stays(row: pd.Series, spec: Mapping[str, Any]) -> float:
    """Return the share of draws in which a fall remains a strict one."""
    blocks, pulses = zip(*(one_line(*row[PLACE], row[name]) for name in PAIR), strict=True)
    length = math.pi / pulses[0].angular_frequency
    lobes = sine(2 * pulses[0].cycles, length, pulses[0].amplitude)
    terms = (spec[name] for name in ("highest", "wide", "draws", "change", "seed"))
    return share_that_stays(lobes, *blocks, *terms)


def check_fall(row: pd.Series) -> None:
    """Check a fall by both solvers, at both ends of both intervals."""
    for name, factor, expected in (
        ("heavier", row.heavier_from * (1.0 + ASIDE), True),
        ("heavier", (row.heavier_from + row.heavier_width) * (1.0 - ASIDE), True),
        ("lighter", row.heavier_from * (1.0 + ASIDE), False),
        ("lighter", row.lighter_from * (1.0 - ASIDE), False),
    ):
        block, pulse = one_line(*row[PLACE], row[name])
        outcomes = {solve(block, pulse.scaled(factor)).overturned for solve in (judge, plain.judge)}
        check(outcomes == {expected}, f"{dict(row)}: the {name} at {factor:.9g}: {outcomes}")


def finding(
    table: pd.DataFrame, falls: pd.DataFrame, settings: Mapping[str, Any]
) -> dict[str, Any]:
    """Return whether the minimum never falls between frames, and never below the column's.

    `exceptions_by_wide` and `exceptions_by_any_width` are the numbers by the two looser counts.
    """
    results = {}
    for name, pairs in kinds(settings["mass_ratios"]).items():
        rows, looser = strict_falls(falls, pairs), of_pairs(falls, pairs)
        evidence = {"comparisons": compared(table, pairs), "exceptions": len(rows)}
        evidence |= {f"exceptions_{by}": int((looser[by] > 0.0).sum()) for by in Fall._fields[1:]}
        evidence |= {f"largest_{by}": max([0.0, *looser[by].dropna()]) for by in Fall._fields[1:]}
        evidence["slendernesses"] = rows.slenderness_deg.nunique()
        for _, row in largest(falls, pairs).iterrows():
            number = int(row.cycles)
            shown = {"fall": row.strict, "frequency_ratio": row.frequency_ratio, "stays": row.stays}
            shown |= {"width": row.heavier_width, "width_of_lighter": row.lighter_width}
            shown |= {"from": row.heavier_from, "from_of_lighter": row.lighter_from}
            shown |= {key: f"{row[key]:g}" for key in PAIR}
            evidence |= {f"{key}_{number}": content for key, content in shown.items()}
        results[name] = truth(rows.empty, **evidence)
    return results


def compared(table: pd.DataFrame, pairs: Sequence[tuple[float, float]]) -> int:
    """Return in how many comparisons one of the two overturns."""
    known = table.pivot_table(index=PLACE, columns="mass_ratio", values="lowest_found") < math.inf
    return sum(int((known[light] | known[heavy]).sum()) for light, heavy in pairs)


def two_pulses(settings: Mapping[str, Any]) -> pd.DataFrame:
    """Return the lowest amplitudes, over g tan α, of two equal one-sine pulses with a pause.

    The columns are those of `minima`; all structures are searched by the grid of `falls`. The plain
    solver judges on both sides of each minimum of a wide interval.
    """
    highest, wide = settings["cycles"]["highest"], settings["cycles"]["wide"]
    rows, sides = [], []
    for case in settings["two_pulses"]["cases"]:
        column, motion = column_of(case["slenderness"]), pair_of_pulses(case, settings)
        labels = {"slenderness_deg": case["slenderness"]}
        labels |= {name: case[name] for name in ("frequency_ratio", "pause", "sign")}
        for gamma in case["mass_ratios"]:
            block = RockingFrame(column, gamma).block()
            (lowest,) = lowest_of([block], [motion], highest, wide)
            lowest = searched_finely(block, motion, lowest, highest, wide)
            rows.append(labels | {"mass_ratio": gamma} | dict(zip(FOUND, lowest, strict=True)))
            for side, expected in ((-CLOSE, False), (CLOSE, True)):
                sides.append((block, motion, None, lowest.wide_lower + side, expected))
    samples.check_sample(sides)
    return pd.DataFrame(rows)


def pair_of_pulses(case: Mapping[str, Any], settings: Mapping[str, Any]) -> Record:
    """Return two equal one-sine pulses of g tan α; the pause is in their periods."""
    column = column_of(case["slenderness"])
    length = math.pi / (case["frequency_ratio"] * column.frequency_parameter)
    first = sine(2, length, column.uplift_acceleration)
    second = sine(2, length, column.uplift_acceleration, case["sign"])
    second[0] = second[0]._replace(pause=2.0 * length * case["pause"])
    return record_of([*first, *second], 2.0 * length / settings["two_pulses"]["samples"])
