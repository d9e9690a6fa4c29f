"""Lines of overturning spectra: all amplitudes at a frequency that overturn a block.

As a script it is the rule of a shard of them.
"""

from collections.abc import Iterator, Mapping, Sequence
from itertools import accumulate, product
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from replication.step import grid, run
from steps.shared import cycles
from steps.shared.cases import column_of, pulse_on
from topheavy import FactorInterval, Pulse, RockingBlock, RockingFrame
from topheavy.outcomes.search import intervals_of_many

FRAME, SIZE, RESTITUTION = CHANGES = "frame", "size", "restitution"
"""What a cap beam changes of the column: p and √r, p alone (the equivalent column), √r alone."""
MODES = "without impact", "with impact"
KEYS = ["change", "mass_ratio", "slenderness_deg", "shape", "frequency_ratio"]
SAME = 1e-8  # relative difference of the ends of two equal intervals
TOGETHER = 400  # lines that are searched in the same calls of the kernel


class Line(NamedTuple):
    """A block under pulses of one frequency; `pulse` has the amplitude g tan α of the column."""

    labels: dict[str, Any]
    block: RockingBlock
    pulse: Pulse


def line(change: str, gamma: float, slenderness: float, shape: str, ratio: float) -> Line:
    """Return the line of the `KEYS`: slenderness in degrees, frequency over p of the column."""
    column = column_of(slenderness)
    frame, solitary = RockingFrame(column, gamma).block(), column.block()
    block = {
        FRAME: frame,
        SIZE: frame.with_restitution(solitary.restitution),
        RESTITUTION: solitary.with_restitution(frame.restitution),
    }[change]
    pulse = pulse_on(column, shape, ratio)
    labels = dict(zip(KEYS, (change, gamma, slenderness, shape, ratio), strict=True))
    return Line(labels, block, pulse)


def solve(spectra: Sequence[Sequence[Line]], settings: Mapping[str, Any]) -> pd.DataFrame:
    """Return the intervals of amplitudes, over g tan α, that overturn the block of each line.

    A spectrum has a line for each frequency, of which some are searched again in narrower steps.
    Where these find other intervals, they replace those of the line and of both beside it.
    """
    amplitudes, again = settings["amplitudes"], settings["again"]
    ends = (amplitudes["lowest"], amplitudes["highest"])
    lines = [item for spectrum in spectra for item in spectrum]

    def searched(places: Sequence[int], resolution: float) -> list[list[FactorInterval]]:
        intervals: list[list[FactorInterval]] = []
        for begin in range(0, len(places), TOGETHER):
            group = [lines[place] for place in places[begin : begin + TOGETHER]]
            intervals += search_finely(group, ends, resolution, settings)
            print(f"{len(intervals)} of {len(places)} lines", flush=True)
        return intervals

    def search_again(places: Sequence[int]) -> list[int]:
        """Return at which places this finds other intervals, and replace them."""
        pairs = zip(places, searched(places, again["resolution"]), strict=True)
        changed = {
            place: intervals
            for place, intervals in pairs
            if not same(intervals, intervals_of[place])
        }
        for place, intervals in changed.items():
            intervals_of[place] = intervals
        return [*changed]

    intervals_of = searched(range(len(lines)), amplitudes["resolution"])
    ends_in_lines = accumulate(map(len, spectra))
    places = [
        range(end - len(spectrum), end)
        for spectrum, end in zip(spectra, ends_in_lines, strict=True)
    ]
    sample = [place for group in places for place in group[:: again["every"]]]
    different, beside = {*search_again(sample)}, set()
    for group in places:
        for place in different & {*group}:
            beside |= {place - 1, place + 1} & {*group}
    search_again(sorted(beside - {*sample}))
    print(f"{len(different)} of {len(sample)} lines have other intervals in narrower steps")
    rows = (
        row
        for item, intervals in zip(lines, intervals_of, strict=True)
        for row in rows_of(item, intervals)
    )
    return pd.DataFrame(rows, columns=[*KEYS, "lower", "upper", "mode"])


def same(first: Sequence[FactorInterval], second: Sequence[FactorInterval]) -> bool:
    """Return whether two searches find the same intervals, but for the width of their brackets."""
    ends = [
        [
            (*interval.lower, *(interval.upper or ()), interval.number_of_impacts)
            for interval in intervals
        ]
        for intervals in (first, second)
    ]
    return len(first) == len(second) and all(
        len(interval) == len(twin) and np.allclose(interval, twin, rtol=SAME, atol=0.0)
        for interval, twin in zip(*ends, strict=True)
    )


def search(
    lines: Sequence[Line],
    ends: tuple[float, float],
    resolution: float,
    finer: tuple[float, float] | None = None,
) -> list[list[FactorInterval]]:
    """Return the intervals of each line in a range, none wider than the resolution missed."""
    blocks, pulses = [item.block for item in lines], [item.pulse for item in lines]
    return intervals_of_many(
        blocks, pulses, ends, resolution=resolution, most_impacts=1, finer=finer
    )


def search_finely(
    lines: Sequence[Line], ends: tuple[float, float], resolution: float, settings: Mapping[str, Any]
) -> list[list[FactorInterval]]:
    """Return the intervals of each line, also narrower ones close to uplift and below a minimum."""
    finer, near = settings["finer"], settings["near"]
    below, finest = finer["below"], finer["resolution"]
    results = search(lines, ends, resolution, (below, finest))

    def add(
        places: Sequence[int], scales: Sequence[float], more: list[list[FactorInterval]]
    ) -> None:
        """Put intervals before those of their lines that begin higher."""
        for place, scale, intervals in zip(places, scales, more, strict=True):
            results[place] = [
                FactorInterval(
                    (scale * interval.lower[0], scale * interval.lower[1]),
                    (scale * interval.upper[0], scale * interval.upper[1]),
                    interval.number_of_impacts,
                )
                for interval in intervals
                if interval.upper and scale * interval.upper[1] < results[place][0].lower[0]
            ] + results[place]

    minima = {place: intervals[0].lower[1] for place, intervals in enumerate(results) if intervals}
    places = [place for place, minimum in minima.items() if minimum >= below]
    scaled = [
        lines[place]._replace(pulse=lines[place].pulse.scaled(minima[place])) for place in places
    ]
    more = search(scaled, (1.0 - near["share"], 1.0), near["resolution"])
    add(places, [minima[place] for place in places], more)
    places = [place for place in places if results[place][0].lower[1] < below]
    more = search([lines[place] for place in places], (ends[0], below), finest)
    add(places, [1.0] * len(places), more)
    return results


def rows_of(item: Line, intervals: Sequence[FactorInterval]) -> Iterator[dict[str, Any]]:
    """Yield a row for each interval; it has no upper end where the range ends first."""
    for interval in intervals:
        upper = sum(interval.upper) / 2.0 if interval.upper else None
        yield item.labels | {
            "lower": sum(interval.lower) / 2.0,
            "upper": upper,
            "mode": MODES[interval.number_of_impacts],
        }


def compute(settings: dict, shard: str) -> dict[str, Any]:
    """Return the part of a shard, "2-of-8", of the spectra, and of the minima of several cycles.

    The spectra are those of frames, and of columns with the p̂ or the √r of the heaviest. The minima
    are a text with all digits, as differences of them are taken.
    """
    structures = [(FRAME, gamma) for gamma in settings["mass_ratios"]]
    structures += [(change, max(settings["mass_ratios"])) for change in CHANGES[1:]]
    ratios = [*map(float, grid(settings["frequency_ratios"]))]
    labels = [*product(structures, settings["slendernesses"], settings["shapes"])]
    number, shards = map(int, shard.split("-of-"))
    spectra = [
        [line(*structure, *place, ratio) for ratio in ratios]
        for structure, *place in labels[number - 1 :: shards]
    ]
    minima = cycles.minima(settings, number, shards)
    return {"spectra": solve(spectra, settings), "cycles": minima.to_csv(index=False)}


if __name__ == "__main__":
    run(snakemake, compute)
