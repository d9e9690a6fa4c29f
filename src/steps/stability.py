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

from replication.workbench import Finding, grid, run, truth
from topheavy import Column, Pulse, RockingFrame, judge
from topheavy.linear import simulate_linear_exact
from topheavy.structures import size_ratio

SCANNING = 1e-8  # of α: tolerance of a scan, of which what is quoted is made anew
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

    def ranking(self, order: list[list[Trial]]) -> Finding:
        """Test whether each trial survives all that earlier ones survive, or has a higher minimum.

        In the middle of the widest run of counterexamples, the outcome is computed again at the
        tightened tolerance. The closed-form solution of the linearised equation, whose boundaries
        differ, is also searched for counterexamples among the same two trials.
        """
        rises = all(
            self.first(weaker) <= self.first(stronger)
            for trials in order
            for weaker, stronger in pairwise(trials)
        )
        runs = [
            (run, weaker, stronger)
            for trials in order
            for weaker, stronger in combinations(trials, 2)
            for run in self.against(weaker, stronger)
        ]
        if not runs:
            return truth(True, first_fall_rises=rises)
        run, weaker, stronger = max(runs, key=lambda item: len(item[0]))
        amplitude = run[len(run) // 2]
        pair = (weaker, stronger)
        again = [
            judge(trial[0], self.pulse(trial, amplitude), tolerance=self.tightened).overturned
            for trial in pair
        ]
        linearised = [
            near
            for near in self.amplitudes
            if abs(near / amplitude - 1.0) < NEARBY
            and self.overturned_linearised(stronger, near)
            and not self.overturned_linearised(weaker, near)
        ]
        if again != [False, True]:
            raise ArithmeticError(f"{weaker}, {stronger} at {amplitude:.6g}: not a counterexample")
        return truth(
            False,
            holds_when=rises,
            condition="what counts is the lowest amplitude of the tested pulses that overturns",
            counterexamples=sum(len(item[0]) for item in runs),
            amplitude_over_uplift=amplitude,
            survives=describe(weaker),
            overturns=describe(stronger),
            closed_form_counterexamples=len(linearised),
        )


def describe(trial: Trial) -> dict:
    structure, frequency_ratio = trial
    alone = isinstance(structure, Column)
    gamma = 0.0 if alone else structure.mass_ratio
    return {
        "size": (structure if alone else structure.column).size,
        "mass_ratio": gamma if math.isfinite(gamma) else "infinite",
        "frequency_ratio": frequency_ratio,
    }


def orders(case: dict) -> dict[str, list[list[Trial]]]:
    """Return the rankings: rows of trials, each of which should survive what those before do."""
    column = Column(**case["column"])
    frames = [RockingFrame(column, gamma) for gamma in case["mass_ratios"]]
    b, h = column.half_width, column.half_height
    sizes = [Column(scale * b, scale * h) for scale in case["sizes"]]
    equivalent = [Column(s * b, s * h) for s in map(size_ratio, [0.0, *case["mass_ratios"]])]
    ratios = case["frequency_ratios"]
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


def main(case: dict, solver: dict) -> dict:
    amplitudes = tuple(map(float, grid(case["amplitudes"])))
    scan = Scan(Column(**case["column"]), case["shape"], amplitudes, solver["tightened"])
    return {name: scan.ranking(order) for name, order in orders(case).items()}


if __name__ == "__main__":
    run(snakemake, lambda job: main(job.params.case, job.params.solver))
