"""Minima under a sine of several cycles, whose equal lobes can make a heavier frame weaker.

Under several lobes, many intervals of overturning amplitudes are narrower than any search resolves.
An exception counts if a whole interval of a `wide` width that overturns the heavier structure lies
below every amplitude that overturns the lighter one, by the search.
"""

import math
from collections.abc import Mapping, Sequence
from itertools import combinations, pairwise, product
from typing import Any

import pandas as pd

from replication.step import check, grid, truth
from steps.shared import plain
from steps.shared.spectrum import FRAME, line
from topheavy import judge
from topheavy.outcomes.search import intervals_of_many

SHAPE = "one-sine"
PLACE = ["cycles", "slenderness_deg", "frequency_ratio"]
TOGETHER = 100  # lines that are searched in the same calls of the kernel
ASIDE = 1e-4  # of an end of an interval: where the plain solver judges


def minima(settings: Mapping[str, Any]) -> pd.DataFrame:
    """Return for each structure and pulse the lowest amplitude, over g tan α, that overturns.

    `minimum` is that of all intervals that the search finds, `wide_minimum` and `wide_upper` are
    the ends of the lowest wide one; they are infinite where there is none. A search in steps as
    wide finds every wide interval. Where the minimum falls by it, all structures are searched in
    narrower steps.
    """
    spec = settings["cycles"]
    ratios = map(float, grid(spec["frequency_ratios"]))
    places = [*product(spec["numbers"], settings["slendernesses"], ratios)]
    pairs = [*combinations(settings["mass_ratios"], 2)]
    table = searched(places, settings, spec["wide"])
    fell = falls(table, pairs)[PLACE].drop_duplicates()
    finely = searched([*fell.itertuples(index=False, name=None)], settings, spec["resolution"])
    keys = [*PLACE, "mass_ratio"]
    table = pd.concat([table, finely.astype(table.dtypes)])
    table = table.drop_duplicates(keys, keep="last").sort_values(keys)
    check_falls(falls(table, pairs))
    return table


def searched(places: Sequence[tuple], settings: Mapping[str, Any], step: float) -> pd.DataFrame:
    """Return a row for each structure at each place, searched in steps of one width."""
    spec, rows = settings["cycles"], []
    labels = [(*place, gamma) for place in places for gamma in settings["mass_ratios"]]
    for begin in range(0, len(labels), TOGETHER):
        some = labels[begin : begin + TOGETHER]
        blocks, pulses = zip(*(one_line(*at) for at in some), strict=True)
        every = intervals_of_many(
            blocks, pulses, (1.0, spec["highest"]), resolution=step, most_impacts=0
        )
        for at, intervals in zip(some, every, strict=True):
            ends = [(one.lower[1], one.upper[0] if one.upper else math.inf) for one in intervals]
            wide = [(low, high) for low, high in ends if high - low >= spec["wide"]]
            lowest = min((low for low, _ in ends), default=math.inf)
            rows.append((*at, lowest, *(wide[0] if wide else (math.inf, math.inf))))
        print(f"{begin + len(some)} of {len(labels)} lines of several cycles", flush=True)
    names = [*PLACE, "mass_ratio", "minimum", "wide_minimum", "wide_upper"]
    return pd.DataFrame(rows, columns=names)


def one_line(cycles: int, slenderness: float, ratio: float, gamma: float) -> tuple:
    """Return the block and its pulse with the amplitude g tan α."""
    _, block, pulse = line(FRAME, gamma, slenderness, SHAPE, ratio, cycles)
    return block, pulse


def falls(table: pd.DataFrame, pairs: list[tuple[float, float]]) -> pd.DataFrame:
    """Return a row for each pair and pulse whose heavier structure has the lower minimum."""
    by_mass = table.pivot_table(
        index=PLACE, columns="mass_ratio", values=["minimum", "wide_minimum", "wide_upper"]
    )
    found = []
    for light, heavy in pairs:
        lower = by_mass["wide_minimum"][heavy] / by_mass["minimum"][light] - 1.0
        part = pd.DataFrame({"lighter": light, "heavier": heavy, "fall": -lower})
        part["minimum"], part["of_lighter"] = (
            by_mass["wide_minimum"][heavy],
            by_mass["minimum"][light],
        )
        part["upper"] = by_mass["wide_upper"][heavy]
        found.append(part[part.fall > 0.0])
    return pd.concat(found).reset_index()


def check_falls(exceptions: pd.DataFrame) -> None:
    """Check the largest exceptions by the plain solver, at both ends of each minimum."""
    for _, row in (
        exceptions.sort_values("fall").groupby(["cycles", "lighter", "heavier"]).tail(1).iterrows()
    ):
        for gamma, factor, expected in (
            (row.heavier, row.minimum * (1.0 + ASIDE), True),
            (row.heavier, min(row.upper, row.of_lighter) * (1.0 - ASIDE), True),
            (row.lighter, row.minimum * (1.0 + ASIDE), False),
            (row.lighter, row.of_lighter * (1.0 - ASIDE), False),
        ):
            block, pulse = one_line(
                int(row.cycles), row.slenderness_deg, row.frequency_ratio, gamma
            )
            both = {one(block, pulse.scaled(factor)).overturned for one in (judge, plain.judge)}
            check(both == {expected}, f"{dict(row)}: γ = {gamma:g} at {factor:.9g}: {both}")


def finding(table: pd.DataFrame, settings: Mapping[str, Any]) -> dict[str, Any]:
    """Return whether the minimum never falls between frames, and never below the column's."""
    gammas = sorted(settings["mass_ratios"])
    column, *frames = gammas
    return {
        name: truth(exceptions.empty, comparisons=compared(table, pairs), **largest(exceptions))
        for name, pairs in (
            ("cycles_rise_with_mass", [*pairwise(frames)]),
            ("cycles_frame_is_above_its_column", [(column, gamma) for gamma in frames]),
        )
        for exceptions in [falls(table, pairs)]
    }


def compared(table: pd.DataFrame, pairs: list[tuple[float, float]]) -> int:
    """Return in how many comparisons one of the two overturns."""
    known = table.pivot_table(index=PLACE, columns="mass_ratio", values="minimum") < math.inf
    return sum(int((known[light] | known[heavy]).sum()) for light, heavy in pairs)


def largest(exceptions: pd.DataFrame) -> dict[str, Any]:
    """Return the number of exceptions, their slendernesses, and the largest for each number."""
    more: dict[str, Any] = {
        "exceptions": len(exceptions),
        "slendernesses": exceptions.slenderness_deg.nunique(),
    }
    for number, rows in exceptions.groupby("cycles"):
        row = rows.loc[rows.fall.idxmax()]
        more |= {f"{name}_{number}": row[name] for name in ("fall", "frequency_ratio", "minimum")}
        more |= {f"{name}_{number}": f"{row[name]:g}" for name in ("lighter", "heavier")}
    return more
