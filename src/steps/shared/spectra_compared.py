"""Compare overturning spectra: amplitudes that overturn one frame and not another.

The table of a spectrum contains the intervals of every line. A set of amplitudes is an array of
disjoint intervals, shape (n, 2).
"""

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from itertools import pairwise, product
from typing import NamedTuple

import numpy as np
import pandas as pd

from replication.workbench import Finding, grid, truth
from steps.shared.spectrum import line, search
from topheavy import judge
from topheavy.outcomes.overturning import Interval
from topheavy.second import reference

SPECTRUM = ["slenderness_deg", "shape", "mass_ratio", "linearised"]
ORDER = [*SPECTRUM, "frequency_ratio", "lower"]
PRINTED = 1e-8  # of an amplitude: the rounding of the shards' tables, with room to spare
SECOND_LOOK = 20.0  # times finer: the resolution for an apparent exception
LEAST_RISES = 20  # comparisons with the least rise, looked at again
NEAR = 0.01  # of an amplitude: how close to a boundary half of the sample is


ROUTES = ("at_the_tightened_tolerance", "by_scipy")


class Place(NamedTuple):
    """A spectrum with γ left open, and a frequency on it."""

    slenderness: float
    shape: str
    linearised: bool
    frequency_ratio: float

    def line(self, gamma: float):
        return line(self.slenderness, self.shape, gamma, self.linearised, self.frequency_ratio)

    def described(self) -> dict:
        return {
            "slenderness_deg": self.slenderness,
            "shape": self.shape,
            "linearised": self.linearised,
            "frequency_ratio": self.frequency_ratio,
        }


class Spectra:
    """The table of intervals, by line."""

    def __init__(self, settings: Mapping, table: pd.DataFrame):
        self.settings, self.table = settings, table
        self.models = [bool(linearised) for linearised in np.unique(table.linearised)]
        self.first, self.last = settings["amplitudes"]["lowest"], settings["amplitudes"]["highest"]
        self.ratios = [float(ratio) for ratio in grid(settings["frequency_ratios"])]

    def coarser(self, every: int) -> "Spectra":
        """The same spectra at every n-th frequency."""
        spec = self.settings["frequency_ratios"]
        points = (spec["points"] - 1) // every + 1
        return Spectra(
            {**self.settings, "frequency_ratios": {**spec, "points": points}}, self.table
        )

    @cached_property
    def intervals(self) -> dict[tuple, np.ndarray]:
        keys = self.table[SPECTRUM].assign(ratio=self.table.frequency_ratio.round(9))
        ends = self.table[["lower", "upper"]].fillna(self.last).to_numpy()
        groups = keys.groupby([*SPECTRUM, "ratio"]).indices
        return {key: ends[rows] for key, rows in groups.items()}

    def at(self, place: Place, gamma: float) -> np.ndarray:
        """The intervals of a line, shape (n, 2)."""
        slenderness, shape, linearised, ratio = place
        key = (slenderness, shape, gamma, linearised, round(ratio, 9))
        return self.intervals.get(key, np.empty((0, 2)))

    def lowest(self, place: Place, gamma: float) -> float:
        found = self.at(place, gamma)
        return float(found[0, 0]) if len(found) else math.inf

    def places(self) -> Iterator[Place]:
        settings = self.settings
        for key in product(settings["slendernesses"], settings["shapes"], self.models, self.ratios):
            yield Place(*key)

    def reversals(self, place: Place, light: float, heavy: float) -> np.ndarray:
        """The amplitudes that overturn the heavier frame and not the lighter, shape (n, 2)."""
        return without(self.at(place, heavy), self.at(place, light))

    def lowest_rises(self) -> dict:
        """Compare the minimum overturning amplitudes of neighbouring γ; refine where one falls.

        The smallest rises are refined too, since a missed interval would first appear there.
        """
        compared, apparent, proven, rising = 0, [], [], []
        for place in self.places():
            for light, heavy in pairwise(self.settings["mass_ratios"]):
                low, high = self.lowest(place, light), self.lowest(place, heavy)
                compared += min(low, high) < math.inf
                if high < low - PRINTED * low:
                    apparent.append((place, light, heavy, low, high))
                elif high < math.inf:
                    rising.append((place, light, heavy, low, high))
        closest = sorted(rising, key=lambda found: found[4] / found[3])[:LEAST_RISES]
        for place, light, heavy, low, high in (*apparent, *closest):
            lighter, heavier = (
                self.again(place, gamma, min(lowest, self.last))
                for gamma, lowest in ((light, low), (heavy, high))
            )
            if heavier[1] < lighter[0]:
                proven.append((lighter[0] / heavier[1] - 1.0, place, light, heavy))
        largest = max(proven, default=None, key=lambda found: found[0])
        evidence = {
            "compared": compared,
            "apparent": len(apparent),
            "closest_looked_at_again": len(closest),
            "largest_apparent": max((low / high - 1.0 for *_, low, high in apparent), default=0.0),
            "exceptions": len(proven),
            "resolution_of_the_second_look": self.settings["finer"]["resolution"] / SECOND_LOOK,
        }
        if largest:
            evidence |= largest[1].described() | {
                "largest_exception": largest[0],
                "lighter": finite(largest[2]),
                "heavier": finite(largest[3]),
            }
        return truth(not proven, **evidence)

    def again(self, place: Place, gamma: float, lowest: float) -> tuple[float, float]:
        """Bracket the minimum overturning amplitude at the finest resolution."""
        top = min(self.last, lowest * (1.0 + NEAR))
        finest = self.settings["finer"]["resolution"] / SECOND_LOOK
        found: list[Interval] = search(place.line(gamma), (self.first, top), finest)
        return found[0].lower if found else (top, math.inf)

    def areas(self, light: float, heavy: float) -> list[dict]:
        """The shares of each map on which only one of two frames overturns."""
        uplift = 1.0
        whole = (self.ratios[-1] - self.ratios[0]) * (self.last - uplift)
        rows = []
        for slenderness, shape, linearised in product(
            self.settings["slendernesses"], self.settings["shapes"], self.models
        ):
            places = [Place(slenderness, shape, linearised, ratio) for ratio in self.ratios]
            pairs = [(self.at(place, light), self.at(place, heavy)) for place in places]
            shared = np.array([overlap(first, second) for first, second in pairs])
            lengths = np.array([[length(first), length(second)] for first, second in pairs])
            shares = np.trapezoid(
                np.column_stack([lengths - shared[:, None], lengths]), self.ratios, axis=0
            )
            shares = np.maximum(shares, 0.0) / whole
            rows.append(
                {
                    "slenderness_deg": slenderness,
                    "shape": shape,
                    "linearised": linearised,
                    "lighter": finite(light),
                    "heavier": finite(heavy),
                    "only_lighter_overturns": shares[0],
                    "only_heavier_overturns": shares[1],
                    "lighter_overturns": shares[2],
                    "heavier_overturns": shares[3],
                }
            )
        return rows

    def counterexample(
        self, pairs: Iterable[tuple[float, float]], linearised: bool = False
    ) -> tuple[float, Place, float, float, float]:
        """The widest interval that the lighter frame survives and that overturns the heavier one.

        Returns its width over its middle, the place, both γ and the middle.
        """
        widest = (0.0, None, 0.0, 0.0, 0.0)
        for place, (light, heavy) in product(self.places(), pairs):
            if place.linearised != linearised:
                continue
            for start, end in self.reversals(place, light, heavy):
                middle = 0.5 * (start + end)
                if (end - start) / middle > widest[0]:
                    widest = ((end - start) / middle, place, light, heavy, middle)
        return widest

    def sample(self, points: int, seed: int, tightened: float) -> pd.DataFrame:
        """Judge points of the map again: half of them anywhere, half close to a boundary."""
        random = np.random.default_rng(seed)
        rows = self.table.iloc[random.integers(len(self.table), size=points)]
        judged = []
        for number, row in enumerate(rows.itertuples()):
            place = Place(row.slenderness_deg, row.shape, row.linearised, row.frequency_ratio)
            if number % 2:
                away = random.choice([-1.0, 1.0]) * 10.0 ** random.uniform(-6.0, math.log10(NEAR))
                amplitude = row.lower * (1.0 + away)
            else:
                amplitude = random.uniform(1.0, self.last)
            found = self.judged(place, row.mass_ratio, amplitude, tightened)
            point = {**place.described(), "mass_ratio": row.mass_ratio, "amplitude": amplitude}
            point |= {"overturned": inside(self.at(place, row.mass_ratio), amplitude)}
            judged.append(point | dict(zip(ROUTES, found, strict=True)))
        return pd.DataFrame(judged)

    def judged(self, place: Place, gamma: float, amplitude: float, tightened: float) -> list[bool]:
        """Whether a frame overturns, at the tightened tolerance and by the second solver."""
        block, pulse = place.line(gamma)[1:]
        pulse = pulse.scaled(amplitude)
        return [
            judge(block, pulse, tolerance=tightened).overturned,
            reference.judge(block, pulse).overturned,
        ]


def of_sample(sample: pd.DataFrame) -> Finding:
    """Return whether both routes confirm every point of a sample."""
    differ = int(sample[[*ROUTES]].ne(sample.overturned, axis=0).any(axis=1).sum())
    return truth(differ == 0, points=len(sample), differ=differ)


def ends_of(found: Sequence[Interval], last: float) -> np.ndarray:
    """Return the amplitudes of intervals, shape (n, 2); of one that goes on, up to the last."""
    ends = [(one.lower[1], one.upper[0] if one.upper else last) for one in found]
    return np.array(ends).reshape(-1, 2)


def length(intervals: np.ndarray) -> float:
    return float(np.sum(intervals[:, 1] - intervals[:, 0]))


def overlap(first: np.ndarray, second: np.ndarray) -> float:
    """Return the length that two lists of disjoint intervals have in common."""
    low = np.maximum(first[:, None, 0], second[None, :, 0])
    high = np.minimum(first[:, None, 1], second[None, :, 1])
    return float(np.maximum(high - low, 0.0).sum())


def without(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Return the part of a set that is not in another; adjacent pieces are not merged."""
    if not len(first):
        return first
    ends = np.unique(np.concatenate([first.ravel(), second.ravel()]))
    pieces = np.column_stack([ends[:-1], ends[1:]])
    middles = pieces.mean(axis=1)
    return pieces[_inside(first, middles) & ~_inside(second, middles)]


def inside(intervals: np.ndarray, amplitude: float) -> bool:
    return bool(_inside(intervals, np.array([amplitude]))[0])


def _inside(intervals: np.ndarray, amplitudes: np.ndarray) -> np.ndarray:
    low, high = intervals[:, 0, None], intervals[:, 1, None]
    return np.any((low <= amplitudes) & (amplitudes <= high), axis=0)


def finite(gamma: float) -> float | str:
    """Return γ as findings have it, which are JSON."""
    return gamma if math.isfinite(gamma) else "infinite"
