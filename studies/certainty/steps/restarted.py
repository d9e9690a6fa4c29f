"""No reversal without an impact, from a common rest and over ground that also moves vertically.

A first shock makes both frames rock until they rest. Then a random horizontal and a random vertical
motion begin together. The factor on the horizontal one is just beyond a boundary at which the
heavier frame begins, or ceases, to overturn without an impact since that rest.
"""

import math
from dataclasses import dataclass

import numpy as np
import pandas as pd

from replication.workbench import Finding, run, truth
from steps.shared.spectrum import progress
from studies.certainty.shapes import motion
from topheavy import Column, Record, RockingBlock, RockingFrame, reference, simulate
from topheavy.fragility.gain import mass_ratio_of_share

SAMPLES = 200  # of each motion
SHOCK = 8  # samples of the first shock
FACTORS = np.geomspace(0.9, 32.0, 9)  # between which boundaries are sought
HALVINGS = 6
BESIDE = 0.01  # of the factor: what lies between the boundary and the motion that is judged
LOSSY = 0.6  # the largest √r; with more, rest takes long
LEAST, MOST = -0.8, 1.5  # vertical acceleration, g


@dataclass(frozen=True)
class Case:
    """Two blocks, the heavier second, under a shock, rest, and two components from `begins` on."""

    pair: tuple[RockingBlock, RockingBlock]
    before: np.ndarray
    after: np.ndarray
    vertical: np.ndarray
    time_step: float

    @property
    def begins(self) -> float:
        """When the motion after the rest begins, s."""
        return self.time_step * self.before.size

    def records(self, factor: float) -> tuple[Record, Record]:
        """Return the horizontal record, its second part times a factor, and the vertical one."""
        still = np.zeros_like(self.before)
        horizontal = np.concatenate([self.before, factor * self.after])
        vertical = np.concatenate([still, self.vertical])
        return Record(self.time_step, horizontal, unit="g"), Record(
            self.time_step, vertical, unit="g"
        )

    def overturns(self, block: RockingBlock, factor: float, solver=simulate) -> bool:
        """Return whether a block overturns without any impact since the rest."""
        horizontal, vertical = self.records(factor)
        found = solver(block, horizontal, vertical=vertical, samples=8 * SAMPLES)
        since = found.rotation[(found.time > self.begins) & np.isfinite(found.rotation)]
        moved = np.trim_zeros(since, "f")
        one_side = bool((moved > 0.0).all() or (moved < 0.0).all())
        return found.overturned and not (found.impacts > self.begins).any() and one_side

    def rests(self) -> bool:
        """Return whether both blocks have uplifted and rest when the second part begins."""
        shock = Record(self.time_step, self.before, unit="g")
        ends = [simulate(block, shock, samples=[self.begins]) for block in self.pair]
        return all(end.impacts.size > 0 and end.rotation[-1] == 0.0 for end in ends)

    def covered(self, factor: float) -> bool:
        """Return whether Theorem 2 covers the motion: of a/(1 + v), as it does of a."""
        if self.pair[0].linearised:
            return True
        push = factor * self.after / (1.0 + self.vertical)
        lifted = np.flatnonzero(np.abs(push) > self.pair[0].uplift_acceleration)
        side = -np.sign(push[lifted[0]])
        inward = max(0.0, float((side * push[lifted[0] :]).max()))
        outward = max(0.0, float((-side * push[lifted[0] :]).max()))
        return inward * math.tan(self.pair[0].slenderness) <= 1.0 and outward * inward <= 1.0


def case_of(random: np.random.Generator, linearised: bool) -> Case | None:
    """Return a random case; None if the frames do not rest before the second part."""
    alpha = math.radians(random.uniform(2.0, 44.0))
    column = Column(math.sin(alpha), math.cos(alpha))
    shares = np.sort(random.choice([*random.uniform(0.0, 1.0, 2), 0.0, 1.0], 2, False))
    blocks = [
        RockingFrame(column, mass_ratio_of_share(x)).block(float(random.uniform(0.0, LOSSY)))
        for x in shares
    ]
    light, heavy = (block.linear() if linearised else block for block in blocks)
    under = motion(random, column)
    time_step = under.duration / SAMPLES
    before = np.zeros(SHOCK + math.ceil(20.0 / heavy.frequency_parameter / time_step))
    before[1:SHOCK] = random.uniform(1.1, 2.0) * heavy.uplift_acceleration
    after = under.excitation(time_step * np.arange(SAMPLES))
    knots = np.array([0.0, *random.uniform(LEAST, MOST, random.integers(1, 12)), 0.0])
    vertical = np.interp(np.linspace(0.0, 1.0, SAMPLES), np.linspace(0.0, 1.0, knots.size), knots)
    made = Case((light, heavy), before, after, vertical, time_step)
    return made if made.rests() else None


def factor_beside_a_boundary(case: Case, random: np.random.Generator) -> float | None:
    """Return a factor with which the heavier frame overturns, 1 % beyond a boundary, or None."""
    heavier = case.pair[1]
    falls = np.array([case.overturns(heavier, factor) for factor in FACTORS])
    changes = np.flatnonzero(falls[1:] != falls[:-1])
    if not changes.size:
        return None
    at = int(random.choice(changes))
    ends = {bool(falls[at]): FACTORS[at], bool(falls[at + 1]): FACTORS[at + 1]}
    for _ in range(HALVINGS):
        middle = 0.5 * (ends[False] + ends[True])
        ends[case.overturns(heavier, middle)] = middle
    factor = ends[True] + math.copysign(BESIDE * ends[True], ends[True] - ends[False])
    return float(factor) if case.overturns(heavier, factor) else None


def main(settings: dict) -> tuple[pd.DataFrame, dict[str, Finding]]:
    random, rows = np.random.default_rng(settings["seed"]), []
    for number in progress(range(settings["motions"]), settings["motions"], "motions"):
        factor = None
        while factor is None:
            while (one := case_of(random, linearised=number % 2 == 0)) is None:
                pass
            factor = factor_beside_a_boundary(one, random)
        lighter = one.pair[0]
        row = {
            "linearised": lighter.linearised,
            "covered": one.covered(factor),
            "contradicts": not one.overturns(lighter, factor),
        }
        if number % (settings["motions"] // settings["confirmed"]) == 0:
            row["by_scipy"] = all(
                one.overturns(block, factor, reference.simulate) for block in one.pair
            )
        rows.append(row)
    table = pd.DataFrame(rows)
    return table, findings(table)


def findings(certainty_restarted: pd.DataFrame) -> dict[str, Finding]:
    """Return whether a motion contradicts the theorems, from the table of motions."""
    table = certainty_restarted
    covered = table[table.covered.astype(bool)]
    asked = covered[covered.by_scipy.notna()]
    found = int(covered.contradicts.sum())
    linear = covered.linearised.astype(bool)
    agree = len(asked) > 0 and bool((asked.by_scipy.astype(bool) != asked.contradicts).all())
    return {
        "restarted": truth(
            found == 0 and linear.any() and not linear.all() and agree,
            motions=len(covered),
            linearised=int(linear.sum()),
            contradictions=found,
            open=len(table) - len(covered),
            open_contradictions=int(table.contradicts.sum()) - found,
            by_scipy=len(asked),
        ),
    }


if __name__ == "__main__":
    run(snakemake, lambda job: main(job.params.settings))
