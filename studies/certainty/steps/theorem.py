"""No reversal without an impact: the proofs, and random motions that try to contradict them.

A motion is scaled to just above an amplitude at which the heavier frame begins, or ceases, to
overturn without an impact, where a contradiction is most likely.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import pandas as pd

from replication.workbench import Finding, run, truth
from steps.shared.spectrum import progress
from studies.certainty.shapes import motion
from topheavy import Column, Pulse, Record, RockingBlock, RockingFrame, judge, simulate
from topheavy.derivation import reversal_theorems
from topheavy.outcomes.overturning import halvings, outcomes_by
from topheavy.risk.gain import mass_ratio_of_share
from topheavy.second import reference

HALVINGS, AHEAD = 6, 3
BESIDE = 0.01  # of the factor: what lies between the boundary and the motion that is judged
STEPS = np.geomspace(0.9, 32.0, 9)  # factors between which boundaries are sought
CLOSE = 400  # times in the first 1/p after uplift
MEASURED = 401  # samples of a history in which both rotations are compared
ROUNDING = 1e-7  # of α


@dataclass(frozen=True)
class Trial:
    """Two blocks of one slenderness under one motion; the second is the heavier frame."""

    lighter: RockingBlock
    heavier: RockingBlock
    motion: Pulse | Record

    def scaled(self, factor: float) -> "Trial":
        return replace(self, motion=self.motion.scaled(factor))


def without_counted_impact(
    block: RockingBlock, excitation: Pulse | Record, factors: Sequence[float]
) -> list[bool]:
    """Return which factors on a motion overturn a block without an impact that is counted."""
    overturned, impacts = outcomes_by(block, excitation, factors)
    return (overturned & (impacts == 0)).tolist()


def at_once(block: RockingBlock, excitation: Pulse | Record) -> bool:
    """Return whether a block overturns without any impact, not even after a tiny bounce.

    The solvers do not count bounces below a millionth of α, after which the block rests. So it must
    not be upright at any of the times after uplift, of which the first are close together.
    """
    found = judge(block, excitation)
    if not found.overturned or found.impacts:
        return False
    time = instants(excitation)
    lifts = np.abs(excitation.excitation(time)) > block.uplift_acceleration
    start = time[np.argmax(lifts) - 1]
    time = np.union1d(time, start + np.linspace(0.0, 1.0, CLOSE) / block.frequency_parameter)
    rotation = simulate(block, excitation, samples=time).rotation
    rotation = rotation[np.flatnonzero(rotation)[0] :]
    rotation = rotation[np.isfinite(rotation)]
    return bool((rotation > 0.0).all() or (rotation < 0.0).all())


def instants(excitation: Pulse | Record) -> np.ndarray:
    """Return times over a motion: all samples of a record, and those halfway between."""
    samples = excitation.acceleration.size if isinstance(excitation, Record) else MEASURED
    return np.linspace(0.0, excitation.duration, 2 * samples - 1)


def trial(random: np.random.Generator, linearised: bool) -> Trial | None:
    """Return a random pair under a random motion near a boundary of overturning without an impact.

    The coefficients of restitution are drawn anew, for each block its own: the statement must not
    depend on them. None if the motion never overturns the heavier frame without an impact.
    """
    alpha = math.radians(random.uniform(2.0, 44.0))
    column = Column(math.sin(alpha), math.cos(alpha))
    # uniform in the share of the possible increase in size; 1 is γ → ∞
    light, heavy = np.sort(random.choice([*random.uniform(0.0, 1.0, 2), 0.0, 1.0], 2, False))
    pair = [
        RockingFrame(column, mass_ratio_of_share(x)).block(float(random.uniform(0.0, 1.0)))
        for x in (light, heavy)
    ]
    lighter, heavier = (block.linear() if linearised else block for block in pair)
    under = motion(random, column)
    falls = without_counted_impact(heavier, under, STEPS)
    changes = np.flatnonzero(np.diff(falls))
    if not changes.size:
        return None
    at = int(random.choice(changes))
    low, high = STEPS[at], STEPS[at + 1]
    known: dict[float, bool] = {}
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        if middle not in known:
            ahead = halvings(low, high, AHEAD)
            known = dict(zip(ahead, without_counted_impact(heavier, under, ahead), strict=True))
        if known[middle] == falls[at]:
            low = middle
        else:
            high = middle
    factor = low * (1.0 - BESIDE) if falls[at] else high * (1.0 + BESIDE)
    found = Trial(lighter, heavier, under.scaled(factor))
    return found if at_once(heavier, found.motion) else None


def peaks(trial: Trial) -> tuple[float, float]:
    """Return the largest accelerations (g) away from and towards the first side, after uplift."""
    history = simulate(trial.heavier, trial.motion, samples=MEASURED)
    moving = np.flatnonzero(np.abs(history.rotation) > 0.0)
    side = np.sign(history.rotation[moving[0]])
    ground = trial.motion.excitation(instants(trial.motion))
    return max(0.0, float((-side * ground).max())), max(0.0, float((side * ground).max()))


def is_proved(trial: Trial) -> bool:
    """Return whether the exact theorem covers a motion: inward ≤ cot α, outward · inward ≤ 1."""
    if trial.heavier.linearised:
        return True
    outward, inward = peaks(trial)
    return inward * math.tan(trial.heavier.slenderness) <= 1.0 and outward * inward <= 1.0


def is_ahead(trial: Trial) -> bool:
    """Return whether the lighter frame rotates (p₁/p₂)² times as far, up to an impact."""
    frequencies = trial.lighter.frequency_parameter, trial.heavier.frequency_parameter
    ratio = (frequencies[0] / frequencies[1]) ** 2
    time = np.linspace(0.0, 1.5 * trial.motion.duration, MEASURED)
    one, other = (
        simulate(block, trial.motion, samples=time) for block in (trial.lighter, trial.heavier)
    )
    until = other.impacts[0] if other.impacts.size else math.inf
    # a history ends where a block lies flat: the lighter one first
    both = (time < until) & np.isfinite(one.rotation) & np.isfinite(other.rotation)
    ahead = np.abs(one.rotation) - ratio * np.abs(other.rotation)
    return bool((ahead[both] > -ROUNDING * trial.heavier.slenderness).all())


def rows(settings: dict, linearised: bool) -> pd.DataFrame:
    """Judge the lighter frame of every trial."""
    random = np.random.default_rng([settings["seed"], int(linearised)])
    found, spec = [], settings["runs"][settings["run"]]
    every = max(1, spec["motions"] // spec["followed"])
    for number in progress(range(spec["motions"]), spec["motions"], "motions"):
        while (one := trial(random, linearised)) is None:
            pass
        row = {
            "linearised": linearised,
            "shape": one.motion.name if isinstance(one.motion, Record) else one.motion.shape,
            "slenderness_deg": math.degrees(one.heavier.slenderness),
            "size_ratio": (one.lighter.frequency_parameter / one.heavier.frequency_parameter) ** 2,
            "proved": is_proved(one),
            "contradicts": not at_once(one.lighter, one.motion),
        }
        if number % every == 0:
            pair = one.lighter, one.heavier
            row["confirmed"] = all(reference.judge(b, one.motion).overturned for b in pair)
            row["ahead"] = is_ahead(one)
        found.append(row)
    return pd.DataFrame(found)


def main(settings: dict) -> tuple[pd.DataFrame, dict]:
    table = pd.concat([rows(settings, True), rows(settings, False)], ignore_index=True)
    theorems = reversal_theorems()
    told = {"followed": table.ahead.notna()}
    told |= {name: table[name].eq(True) for name in ("ahead", "confirmed")}
    grouped = table.assign(**told).groupby(["linearised", "proved", "shape"], as_index=False)
    counts = grouped.agg(
        motions=("contradicts", "size"),
        contradictions=("contradicts", "sum"),
        followed=("followed", "sum"),
        ahead=("ahead", "sum"),
        by_scipy=("confirmed", "sum"),
    )
    return counts, {
        "proofs": truth(
            all(theorem.holds for theorem in theorems), theorems=[t.statement for t in theorems]
        ),
        **findings(counts),
    }


def findings(certainty_theorem: pd.DataFrame) -> dict[str, Finding]:
    """Return whether any motion contradicts the statements, from the table of counts."""
    proved = certainty_theorem[certainty_theorem.proved]
    return {
        "linearised": counted(proved[proved.linearised]),
        "exact": counted(proved[~proved.linearised]),
        "exact_open": counted(certainty_theorem[~certainty_theorem.proved]),
        "ahead": all_of_the_followed(proved, "ahead"),
        "second_route": all_of_the_followed(certainty_theorem, "by_scipy"),
    }


def all_of_the_followed(counts: pd.DataFrame, name: str) -> Finding:
    """Return whether each motion that was followed is one of those that a column counts."""
    followed = int(counts.followed.sum())
    return truth(0 < followed == counts[name].sum(), followed=followed)


def counted(counts: pd.DataFrame) -> Finding:
    """Return whether no motion contradicts the statement, and how many there are."""
    motions, found = int(counts.motions.sum()), int(counts.contradictions.sum())
    return truth(found == 0 and motions > 0, motions=motions, contradictions=found)


if __name__ == "__main__":
    run(snakemake, lambda job: main(job.params.settings))
