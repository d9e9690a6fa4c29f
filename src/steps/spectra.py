"""Compare overturning spectra: what a heavier cap beam, or a larger column, prevents and causes.

Survival is not monotone in the amplitude. Between the amplitudes that overturn after an impact and
those that overturn without one there can be a survival region.
"""

import math
from collections.abc import Iterable, Iterator
from itertools import combinations, pairwise, product
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from replication.step import check, run, truth, value
from steps.shared import cycles, plain
from steps.shared.intervals import inside, length, overlap, without
from steps.shared.spectrum import (
    CHANGES,
    FRAME,
    KEYS,
    MODES,
    RESTITUTION,
    SIZE,
    line,
    rows_of,
    search,
)
from topheavy import judge, simulate

COLUMN = 0.0  # γ
LEAST_RISES = 20  # smallest rises of the minimum with γ: searched again, as a miss would show there
FINER = 20.0  # ratio of the resolutions of the first and the second search
NEAR = 1e-4, 1e-3  # relative distances from a minimum between which half of the sample lies
SHOWN, SAMPLES = 3.0, 751  # length of the drawn histories, over that of the pulse; points
LARGER = 2.0  # ratio of the frequencies that are compared: a column four times as large
MANY = 10.0  # ratio of the areas of two causes: chosen after we had seen both
ONE_CYCLE = "the pulse is a Ricker wavelet, or one cycle of a sine or cosine"
MINIMUM = f"judged by the minimum overturning acceleration; {ONE_CYCLE}"
AREAS = ["slenderness_deg", "shape", "change", "mass_ratio", "beside"]


class Band(NamedTuple):
    """Amplitudes that the first of two structures survives and that overturn the second."""

    place: tuple[float, str, float]
    survives: tuple[str, float, float]
    overturns: tuple[str, float, float]
    low: float
    high: float

    @property
    def width(self) -> float:
        return (self.high - self.low) / self.middle

    @property
    def middle(self) -> float:
        return 0.5 * (self.low + self.high)


class Spectra:
    """The table of intervals by line.

    A structure is the change that a cap beam makes, its γ, and a factor on the frequency; a place
    is slenderness, pulse shape and ω/p.
    """

    def __init__(self, table: pd.DataFrame, last: float):
        self.last, table = last, table.sort_values("lower")
        ends = table[["lower", "upper"]].fillna(last).to_numpy()
        self.intervals = {key: ends[rows] for key, rows in table.groupby(KEYS).indices.items()}
        self.slendernesses, self.shapes, self.ratios, self.gammas = (
            sorted(map(type_of, table[name].unique()))
            for name, type_of in zip(
                ("slenderness_deg", "shape", "frequency_ratio", "mass_ratio"),
                (float, str, float, float),
                strict=True,
            )
        )
        self.maps = [*product(self.slendernesses, self.shapes)]

    def at(self, structure: tuple, place: tuple) -> np.ndarray:
        (change, gamma, factor), (slenderness, shape, ratio) = structure, place
        key = (change, gamma, slenderness, shape, factor * ratio)
        return self.intervals.get(key, np.empty((0, 2)))

    def lowest(self, structure: tuple, place: tuple) -> float:
        intervals = self.at(structure, place)
        return float(intervals[0, 0]) if len(intervals) else math.inf

    def rises(self, pairs: Iterable[tuple]) -> list[tuple[float, tuple, tuple, tuple]]:
        """Return the ratio of the minima of each pair where one overturns, from the lowest on."""
        ratios = []
        for (weaker, stronger), place in product(pairs, self.places(pairs)):
            low, high = self.lowest(weaker, place), self.lowest(stronger, place)
            if low < math.inf or high < math.inf:
                ratios.append((high / low if low < math.inf else 0.0, place, weaker, stronger))
        return sorted(ratios, key=lambda row: row[0])

    def places(self, pairs: Iterable[tuple]) -> Iterator[tuple]:
        """Yield the places at which all structures of the pairs are in the table."""
        factor = max(structure[2] for pair in pairs for structure in pair)
        ratios = [ratio for ratio in self.ratios if factor * ratio in self.ratios]
        return ((*labels, ratio) for labels, ratio in product(self.maps, ratios))

    def bands(self, pairs: list[tuple]) -> list[Band]:
        """Return all amplitudes that overturn the second structure of a pair alone."""
        return [
            Band(place, weaker, stronger, *ends)
            for place in self.places(pairs)
            for weaker, stronger in pairs
            for ends in without(self.at(stronger, place), self.at(weaker, place))
        ]

    def shares(
        self, weaker: tuple, stronger: tuple, labels: tuple, every: int
    ) -> tuple[float, float]:
        """Return the shares of a map that overturn one of two structures alone, by every n-th ω."""
        ratios = self.ratios[::every]
        lengths = []
        for ratio in ratios:
            first, second = (
                self.at(structure, (*labels, ratio)) for structure in (weaker, stronger)
            )
            shared = overlap(first, second)
            lengths.append((length(first) - shared, length(second) - shared))
        whole = (ratios[-1] - ratios[0]) * (self.last - 1.0)
        areas = np.trapezoid(np.maximum(lengths, 0.0), ratios, axis=0) / whole
        return float(areas[0]), float(areas[1])


def frames(gammas: Iterable[float]) -> list[tuple[str, float, float]]:
    return [(FRAME, gamma, 1.0) for gamma in gammas]


def looked_again(table: pd.DataFrame, settings: dict) -> pd.DataFrame:
    """Add the intervals below a minimum that a finer search finds where it rises least.

    Where it adds some, other minima rise least, and the search is repeated for these.
    """
    first, last = settings["amplitudes"]["lowest"], settings["amplitudes"]["highest"]
    finest, done = settings["finer"]["resolution"] / FINER, set()
    while True:
        spectra, rows = Spectra(table, last), []
        closest = spectra.rises([*pairwise(frames(spectra.gammas))])[:LEAST_RISES]
        for case in {
            (place, structure) for _, place, *structures in closest for structure in structures
        } - done:
            place, structure = case
            done.add(case)
            lowest = min(spectra.lowest(structure, place), last)
            if lowest > first:
                item = line(*structure[:2], *place)
                (intervals,) = search([item], (first, lowest), min(finest, lowest - first))
                rows += rows_of(
                    item,
                    [
                        interval
                        for interval in intervals
                        if interval.upper and interval.upper[1] < lowest
                    ],
                )
        if not rows:
            return table
        table = pd.concat([table, pd.DataFrame(rows)])


def areas_of(spectra: Spectra) -> pd.DataFrame:
    """Return the shares of each map on which a structure prevents and causes overturning.

    It is compared with the solitary column; the heaviest frame also with its equivalent column. The
    columns `…_by_two` and `…_by_four` use every second and every fourth frequency only.
    """
    column, *others = frames(spectra.gammas)
    heaviest = [(change, spectra.gammas[-1], 1.0) for change in CHANGES]
    pairs = [(column, structure) for structure in (*others, *heaviest[1:])]
    pairs.append((heaviest[CHANGES.index(SIZE)], heaviest[0]))
    rows = []
    for labels, (weaker, stronger) in product(spectra.maps, pairs):
        beside = "column" if weaker == column else "equivalent column"
        row = dict(zip(AREAS, (*labels, *stronger[:2], beside), strict=True))
        for ending, every in (("", 1), ("_by_two", 2), ("_by_four", 4)):
            shares = spectra.shares(weaker, stronger, labels, every)
            row |= dict(zip((f"prevented{ending}", f"caused{ending}"), shares, strict=True))
        rows.append(row)
    return pd.DataFrame(rows)


def collapse_of(spectra: Spectra) -> pd.DataFrame:
    """Return the minima of the column and of the heaviest frame at the same ω over p̂ of each.

    There the frame is the column with its √r.
    """
    heaviest = spectra.gammas[-1]
    structures = {"column": (FRAME, COLUMN, 1.0), "frame": (RESTITUTION, heaviest, 1.0)}
    rows = []
    for slenderness, shape, ratio in spectra.places([tuple(structures.values())]):
        row = {"slenderness_deg": slenderness, "shape": shape, "ratio_to_p_hat": ratio}
        place = (slenderness, shape, ratio)
        rows.append(
            row | {name: spectra.lowest(structure, place) for name, structure in structures.items()}
        )
    return pd.DataFrame(rows)


def check_sample(spectra: Spectra, bands: list[Band], spec: dict, tightened: float) -> None:
    """Check outcomes by both solvers: in bands, and within 0.1 % of minima."""
    random = np.random.default_rng(spec["seed"])
    widths = np.array([band.high - band.low for band in bands])
    keys, cells = [*spectra.intervals], []
    for number in random.choice(len(bands), spec["points"] // 2, p=widths / widths.sum()):
        band = bands[number]
        amplitude = random.uniform(band.low, band.high)
        cells.append((band.survives, band.place, amplitude, False))
        cells.append((band.overturns, band.place, amplitude, True))
    for number in random.integers(len(keys), size=spec["points"] // 2):
        change, gamma, *place = keys[number]
        intervals = spectra.intervals[keys[number]]
        away = random.choice([-1.0, 1.0]) * 10.0 ** random.uniform(*np.log10(NEAR))
        amplitude = intervals[0, 0] * (1.0 + away)
        expected = bool(inside(intervals, np.array([amplitude]))[0])
        cells.append(((change, gamma), tuple(place), amplitude, expected))
    lines = [line(*structure[:2], *place) for structure, place, *_ in cells]
    pulses = [item.pulse.scaled(cell[2]) for item, cell in zip(lines, cells, strict=True)]
    judged = [(item.block, pulse) for item, pulse in zip(lines, pulses, strict=True)]
    ours = [judge(*case, tolerance=tightened) for case in judged]
    for cell, *outcomes in zip(cells, ours, plain.judge_pulses(judged), strict=True):
        fell = [item.overturned for item in outcomes]
        check(fell == [cell[-1]] * 2, f"the solvers say {fell}, expected of {cell}")


def histories(band: Band) -> pd.DataFrame:
    """Return the rotations of both structures in the middle of a band."""
    tables = []
    for structure in (band.survives, band.overturns):
        _, block, pulse = line(*structure[:2], *band.place)
        time = np.linspace(0.0, SHOWN * pulse.duration, SAMPLES)
        response = simulate(block, pulse.scaled(band.middle), samples=time)
        place = dict(zip(KEYS[2:], band.place, strict=True))
        rotation = response.rotation / block.slenderness
        tables.append(
            {**place, "amplitude_over_uplift": band.middle, "mass_ratio": structure[1]}
            | {"time_over_period": time / pulse.duration, "rotation_over_alpha": rotation}
        )
    return pd.concat(map(pd.DataFrame, tables))


def compute(
    shards: list[pd.DataFrame], several: list[str], settings: dict, tightened: float
) -> dict[str, Any]:
    """Return the spectra of the frames, the shares of their maps, and one pair of histories.

    Beside them the collapse over ω/p̂, the minima under a sine of several cycles with their falls,
    and those under two pulses.
    """
    table, last = pd.concat(shards), settings["amplitudes"]["highest"]
    table = looked_again(table, settings)
    table = table.sort_values([*KEYS, "lower"], ignore_index=True)
    spectra = Spectra(table, last)
    bands = spectra.bands([*combinations(frames(spectra.gammas), 2)])
    check_sample(spectra, bands, settings["sample"], tightened)
    parts = [pd.read_csv(path) for path in several]
    minima = pd.concat(parts).sort_values([*cycles.PLACE, "mass_ratio"], ignore_index=True)
    return {
        "spectra": table[table.change == FRAME].drop(columns="change"),
        "areas": areas_of(spectra),
        "histories": histories(max(bands, key=lambda band: band.width)),
        "collapse": collapse_of(spectra),
        "cycles": minima,
        "falls": cycles.falls(minima, settings),
        "two_pulses": cycles.two_pulses(settings),
    }


def mean(areas: pd.DataFrame, name: str) -> tuple[float, float]:
    """Return the mean of a share over maps, and its error by two coarser grids.

    The trapezoidal rule is of second order: a step n times as wide is off by n² times the error,
    so that a coarser grid shows n² − 1 times the error. Twice that is taken.
    """
    fine, two, four = (float(areas[name + end].mean()) for end in ("", "_by_two", "_by_four"))
    return fine, 2.0 * max(abs(fine - two) / 3.0, abs(fine - four) / 15.0)


def ranking(spectra: Spectra, pairs: list[tuple]) -> dict[str, Any]:
    """Return whether the second structure of each pair survives what the first one survives.

    The condition is that the minimum counts; the evidence is the widest exception.
    """
    rises, bands = spectra.rises(pairs), spectra.bands(pairs)
    widest = max(bands, key=lambda band: band.width, default=None)
    evidence = {
        "comparisons": len(rises),
        "pairs": len(pairs),
        "pairs_with_exceptions": len({band[1:3] for band in bands}),
    }
    if widest:
        slenderness, shape, ratio = widest.place
        evidence |= {"width": widest.width, "amplitude_over_uplift": widest.middle}
        evidence |= {"slenderness_deg": slenderness, "shape": shape, "frequency_ratio": ratio}
    higher = all(ratio > 1.0 for ratio, *_ in rises)
    return truth(not bands, holds_when=higher, condition=MINIMUM, **evidence)


def apart(spectra_collapse: pd.DataFrame, slow: float, covered: float) -> dict[str, Any]:
    """Return how far the minima at the same ω/p̂ are apart, up to a slow ω/p̂ and beyond it.

    `covered` is the difference that a share of the comparisons does not exceed.
    """
    table = spectra_collapse[np.isfinite(spectra_collapse[["column", "frame"]]).all(axis=1)]
    gap, is_slow = table.frame / table.column - 1.0, table.ratio_to_p_hat <= slow
    return {
        f"collapse_{name}": value(
            part.abs().median(),
            0.0,
            covered=part.abs().quantile(covered),
            most=part.abs().max(),
            comparisons=len(part),
        )
        for name, part in (("slow", gap[is_slow]), ("fast", gap[~is_slow]))
    }


def findings(
    spectra: pd.DataFrame,
    spectra_areas: pd.DataFrame,
    spectra_collapse: pd.DataFrame,
    spectra_cycles: pd.DataFrame,
    spectra_falls: pd.DataFrame,
    settings: dict,
) -> dict[str, Any]:
    """Return the rankings with their exceptions, and the shares of the maps."""
    table, last = spectra.assign(change=FRAME), settings["amplitudes"]["highest"]
    whole = Spectra(table, last)
    at_once = Spectra(table[table["mode"] == MODES[0]], last)
    pairs = [*combinations(frames(whole.gammas), 2)]
    larger = [((FRAME, COLUMN, 1.0), (FRAME, COLUMN, LARGER))]
    neighbours = whole.rises([*pairwise(frames(whole.gammas))])
    caused_at_once = [
        high - low
        for place in whole.places(pairs)
        for light, heavy in pairs
        for low, high in without(at_once.at(heavy, place), whole.at(light, place))
    ]
    beside_column = spectra_areas[spectra_areas.beside == "column"]
    heaviest = beside_column[beside_column.mass_ratio == whole.gammas[-1]]
    frame = heaviest[heaviest.change == FRAME]
    prevented, caused = (mean(frame, name) for name in ("prevented", "caused"))
    several = cycles.finding(spectra_cycles, spectra_falls, settings)
    rises = all(ratio > 1.0 for ratio, *_ in neighbours)
    results = several | apart(spectra_collapse, **settings["collapse"])
    results |= {
        "minimum_rises_with_mass": truth(
            rises and all(result["holds"] for result in several.values()),
            holds_when=rises,
            condition=ONE_CYCLE,
            comparisons=len(neighbours),
        ),
        "heavier_is_more_stable": ranking(whole, pairs),
        "heavier_or_larger_is_more_stable": ranking(whole, [*pairs, *larger]),
        "only_the_heavier_overturns": truth({band[1:3] for band in whole.bands(pairs)} == {*pairs}),
        "frame_is_more_stable_than_its_column": ranking(
            whole, [pair for pair in pairs if pair[0][1] == COLUMN]
        ),
        "larger_is_more_stable": ranking(whole, larger),
        "never_caused_without_impact": truth(sum(caused_at_once) < 1e-6),  # of g tan α: rounding
        "prevents_more_than_it_causes": truth((frame.prevented > frame.caused).all()),
        "prevented": value(*prevented),
        "caused": value(*caused),
        "prevented_over_caused": value(
            ratio := prevented[0] / caused[0],
            ratio * sum(error / share for share, error in (prevented, caused)),
        ),
    }
    for change in (SIZE, RESTITUTION):
        for name in ("prevented", "caused"):
            results[f"{name}_by_{change}"] = value(*mean(heaviest[heaviest.change == change], name))
    by_size, by_restitution = (
        results[f"caused_by_{change}"]["value"] for change in (SIZE, RESTITUTION)
    )
    results["caused_by_the_size"] = truth(by_size > MANY * by_restitution)
    twin = spectra_areas[spectra_areas.beside == "equivalent column"]
    differs = zip(*(mean(twin, name) for name in ("prevented", "caused")), strict=True)
    largest = (twin.prevented + twin.caused).max()
    return results | {"equivalent_column_differs": value(*map(sum, differs), largest=largest)}


if __name__ == "__main__":
    run(snakemake, compute, findings)
