"""Search for counterexamples to four stability rankings of the paper.

Survival is not monotone in the acceleration amplitude. Between the amplitudes that overturn after
an impact and those that overturn without an impact, there can be amplitudes that are survived.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from itertools import combinations, groupby, pairwise
from typing import TypeAlias

import pandas as pd

from replication.workbench import Finding, grid, run, truth
from steps.shared.spectra_compared import finite
from topheavy import Column, Pulse, RockingFrame, judge
from topheavy.bodies.structures import size_ratio
from topheavy.second.linear import simulate_linear_exact

SCANNING = 1e-8  # of α: tolerance of a scan, of which what is quoted is made anew
RATIO = "frequency_ratio"
NEARBY = 0.05  # of an amplitude: where the linearised equation is asked

Trial: TypeAlias = tuple[Column | RockingFrame, float]
"""A structure, and the frequency of the pulse that shakes it, over p of the reference column."""


@dataclass(frozen=True)
class Scan:
    """Which amplitudes of a pulse overturn a structure, all relative to one column."""

    column: Column
    shape: str
    amplitudes: tuple[float, ...]  # over g tan α
    tightened: float

    def pulse(self, trial: Trial, amplitude: float) -> Pulse:
        level, p = self.column.uplift_acceleration, self.column.frequency_parameter
        return Pulse(self.shape, amplitude * level, trial[1] * p)

    @cache  # noqa: B019, a scan lives as long as the step
    def overturned(self, trial: Trial) -> tuple[bool, ...]:
        return tuple(
            judge(trial[0], self.pulse(trial, amplitude), tolerance=SCANNING).overturned
            for amplitude in self.amplitudes
        )

    def overturned_linearised(self, trial: Trial, amplitude: float) -> bool:
        block, pulse = trial[0].block().linear(), self.pulse(trial, amplitude)
        return simulate_linear_exact(block, pulse, duration=pulse.duration, samples=2).overturned

    def first(self, trial: Trial) -> float:
        """The minimum overturning amplitude of the scan."""
        over = self.overturned(trial)
        return self.amplitudes[over.index(True)] if True in over else math.inf

    def against(self, weaker: Trial, stronger: Trial) -> Iterator[list[float]]:
        """Runs of amplitudes that overturn the stronger trial and not the weaker one."""
        cells = zip(
            self.amplitudes, self.overturned(weaker), self.overturned(stronger), strict=True
        )
        for counter, neighbours in groupby(cells, key=lambda cell: cell[2] and not cell[1]):
            if counter:
                yield [amplitude for amplitude, *_ in neighbours]

    def ranking(self, order: list[list[Trial]]) -> tuple[list[dict], list[dict]]:
        """Return the minimum of each trial, and the amplitudes that contradict the ranking.

        A row of the second list is a run of neighbouring amplitudes that an earlier trial of its
        line survives and a later one does not. In the middle of the widest run, the outcome is
        computed again at the tightened tolerance. The closed-form solution of the linearised
        equation, whose boundaries differ, is also searched for counterexamples among its trials.
        """
        minima = [
            {"line": number, **describe(trial), "lowest": self.first(trial)}
            for number, trials in enumerate(order)
            for trial in trials
        ]
        runs = [
            (run, weaker, stronger)
            for trials in order
            for weaker, stronger in combinations(trials, 2)
            for run in self.against(weaker, stronger)
        ]
        widest = max(runs, key=lambda item: len(item[0]), default=None)
        rows = [
            {
                "low": item[0][0],
                "high": item[0][-1],
                "amplitudes": len(item[0]),
                "middle": item[0][len(item[0]) // 2],
                **{f"survives_{name}": each for name, each in describe(item[1]).items()},
                **{f"overturns_{name}": each for name, each in describe(item[2]).items()},
                "closed_form": self.solved(*item) if item is widest else math.nan,
            }
            for item in runs
        ]
        return minima, rows

    def solved(self, run: list[float], weaker: Trial, stronger: Trial) -> int:
        """Count the amplitudes near the middle of a run at which the closed form agrees with it."""
        amplitude = run[len(run) // 2]
        again = [
            judge(trial[0], self.pulse(trial, amplitude), tolerance=self.tightened).overturned
            for trial in (weaker, stronger)
        ]
        if again != [False, True]:
            raise ArithmeticError(f"{weaker}, {stronger} at {amplitude:.6g}: not a counterexample")
        return sum(
            self.overturned_linearised(stronger, near)
            and not self.overturned_linearised(weaker, near)
            for near in self.amplitudes
            if abs(near / amplitude - 1.0) < NEARBY
        )


def describe(trial: Trial) -> dict:
    structure, frequency_ratio = trial
    alone = isinstance(structure, Column)
    return {
        "size": (structure if alone else structure.column).size,
        "mass_ratio": 0.0 if alone else structure.mass_ratio,
        RATIO: frequency_ratio,
    }


def orders(settings: dict) -> dict[str, list[list[Trial]]]:
    """Return the rankings: rows of trials, each of which should survive what those before do."""
    column = Column(**settings["column"])
    frames = [RockingFrame(column, gamma) for gamma in settings["mass_ratios"]]
    b, h = column.half_width, column.half_height
    sizes = [Column(scale * b, scale * h) for scale in settings["sizes"]]
    equivalent = [Column(s * b, s * h) for s in map(size_ratio, [0.0, *settings["mass_ratios"]])]
    ratios = settings["frequency_ratios"]
    return {
        "heavier_is_more_stable": [[(f, ratio) for f in frames] for ratio in ratios],
        "frame_is_more_stable_than_its_column": [
            [(column, ratio), (frame, ratio)] for ratio in ratios for frame in frames
        ],
        "larger_is_more_stable": [[(c, ratio) for c in sizes] for ratio in ratios],
        "larger_size_means_more_stable": [[(c, ratio) for c in equivalent] for ratio in ratios],
        # ratios ascend: from the longest pulse to the shortest
        "longer_pulse_overturns_first": [[(column, ratio) for ratio in ratios]],
    }


def main(settings: dict, solver: dict) -> tuple[pd.DataFrame, pd.DataFrame, dict]:
    amplitudes = tuple(map(float, grid(settings["amplitudes"])))
    scan = Scan(Column(**settings["column"]), settings["shape"], amplitudes, solver["tightened"])
    found = {name: scan.ranking(order) for name, order in orders(settings).items()}
    tables = [
        pd.DataFrame([{"ranking": name} | row for name in found for row in found[name][part]])
        for part in (0, 1)
    ]
    return *tables, findings(*tables)


def findings(stability_minima: pd.DataFrame, stability_runs: pd.DataFrame) -> dict[str, Finding]:
    """Test whether each trial survives all that earlier ones survive, or has a higher minimum."""
    found = {}
    for name, trials in stability_minima.groupby("ranking", sort=False):
        lines = [line.lowest.to_list() for _, line in trials.groupby("line")]
        rises = all(low <= high for line in lines for low, high in pairwise(line))
        runs = stability_runs.query("ranking == @name") if len(stability_runs) else stability_runs
        if runs.empty:
            found[name] = truth(True, first_fall_rises=rises)
            continue
        widest = runs.loc[runs.amplitudes.idxmax()]
        found[name] = truth(
            False,
            holds_when=rises,
            condition="what counts is the lowest amplitude of the tested pulses that overturns",
            counterexamples=int(runs.amplitudes.sum()),
            amplitude_over_uplift=widest.middle,
            survives=_trial(widest, "survives"),
            overturns=_trial(widest, "overturns"),
            closed_form_counterexamples=int(widest.closed_form),
        )
    return found


def _trial(run: pd.Series, which: str) -> dict:
    """Return the size, γ and frequency of one of the two trials of a run."""
    return {name: finite(run[f"{which}_{name}"]) for name in ("size", "mass_ratio", RATIO)}


if __name__ == "__main__":
    run(snakemake, lambda job: main(job.params.settings, job.params.solver))
