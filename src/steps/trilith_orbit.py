"""Prove the steady rocking of the trilith on the shake table, and what becomes of some starts.

The harmonic is that of the table, with its amplitude in g and its frequency as decimals.
"""

import math
from typing import Any

import pandas as pd

from replication.workbench import Finding, run, truth
from steps.orbit.steady import SteadyRocking, settles, steady_rocking
from topheavy import Column, RockingFrame
from topheavy.ground.shaking_table import abrupt_start, table_motion

SEED, EACH = 28, 12  # starts of each outcome of the solver
NAMES = {"rocking": "steady", "rests": "rests", "overturned": "overturns"}
ALIKE = 1e-6  # of α: the solver reads the steady rotation from samples


def orbit(settings: dict) -> SteadyRocking:
    """Return the steady rocking that an abrupt start of the table leads to, proven."""
    frame = RockingFrame(Column(**settings["column"]), settings["mass_ratio"])
    table = settings["table_amplitude"], settings["table_frequency"]
    motion = table_motion(*table)
    speed = abs(abrupt_start(frame, *table)) / motion.angular_frequency
    return steady_rocking(frame, motion, (math.pi, speed))


def starts(found: SteadyRocking, table: pd.DataFrame) -> pd.DataFrame:
    """Return a sample of the starts of each outcome of the solver, with what is proven of them."""
    mixed = table.sample(frac=1.0, random_state=SEED)
    picked = mixed.groupby("outcome").head(EACH).sort_values(["quarters", "rotation", "velocity"])
    picked = picked[["quarters", "rotation", "velocity", "outcome"]].reset_index(drop=True)
    states = picked[["quarters", "rotation", "velocity"]].itertuples(index=False)
    return picked.assign(proven=[settles(found, *state) for state in states])


def findings(trilith_orbit: pd.DataFrame) -> dict[str, Finding]:
    """Return whether every start that is decided ends as by the solver, and each end is proven."""
    expected, proven = trilith_orbit.outcome.map(NAMES), trilith_orbit.proven
    undecided = proven == "undecided"
    counts = {name: int((proven == name).sum()) for name in NAMES.values()}
    differ = int((~undecided & (proven != expected)).sum())
    return {
        "starts": truth(
            differ == 0 and min(counts.values()) > 0,
            starts=len(proven),
            **counts,
            undecided=int(undecided.sum()),
            differ=differ,
        )
    }


def main(settings: dict, states: pd.DataFrame) -> tuple[pd.DataFrame, dict[str, Finding]]:
    found = orbit(settings)
    table = starts(found, states)
    alpha = Column(**settings["column"]).slenderness
    peak = [end / alpha for end in found.peak]
    apart = float((states[states.outcome == "rocking"].steady - peak[0]).abs().max())
    in_velocity = found.radius * math.hypot(*map(float, found.frame.tolist()[1]))
    return table, findings(table) | {
        "steady_rocking": truth(
            apart < ALIKE,
            peak_over_alpha=peak[0],
            width_of_peak=peak[1] - peak[0],
            phase=found.phase[0],
            velocity=found.velocity[0],
            radius=found.radius,
            share_of_velocity=in_velocity / found.velocity[0],
            contraction=found.contraction,
            apart_from_the_solver=apart,
        )
    }


def work(job: Any) -> tuple:
    return main(job.params.settings, pd.read_csv(job.input.states))


if __name__ == "__main__":
    run(snakemake, work)
