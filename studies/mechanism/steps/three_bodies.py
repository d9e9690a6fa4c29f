"""Compare three rigid bodies (Newton and Euler) with one degree of freedom, for many γ.

Both give motion, impacts, √r, contact forces and impulses. One uses Eqs. (23) and (25) and the
closed form of the forces; the other uses nine coordinates and none of these equations.
"""

from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import Finding, run, truth
from steps.shared.histories import ASIDE
from studies.mechanism.steps.setting import cap_of, pulse_on
from topheavy import (
    STANDARD_GRAVITY,
    Cap,
    Column,
    ContactForces,
    Pulse,
    Record,
    RockingFrame,
    contact_forces,
    impact_impulses,
    read_record,
    simulate,
)
from topheavy.second.three_bodies import simulate_three_bodies

AGREE = 1e-6  # of α, of √r and of the weight: what the two integrations may differ by
SAME_IMPACT = 1e-3  # over p̂: impacts nearer than this are the same one
SMALLEST_BOUNCE = 1e-5  # of p̂ α: the last bounces before rest, which both cut off, are left out


def stacked(forces: ContactForces) -> np.ndarray:
    """Return the forces as (…, contact, component)."""
    return np.stack([np.stack([c.horizontal, c.vertical], -1) for c in forces.contacts], -2)


def compare(
    frame: RockingFrame, cap: Cap, shaking: Pulse | Record, duration: float, samples: int
) -> dict:
    """Return how far the two descriptions of one history are apart."""
    shape = {"span": cap.span, "cap_depth": 2.0 * cap.half_depth, "duration": duration}
    bodies = simulate_three_bodies(frame, shaking, **shape, samples=samples)
    block = simulate(frame, shaking, duration=duration, samples=bodies.time)
    alpha, p = frame.slenderness, frame.frequency_parameter
    both = np.isfinite(block.rotation) & np.isfinite(bodies.rotation[:, 0])
    off = np.abs(bodies.rotation - block.rotation[:, None])[both].max() / alpha

    # Impacts: all but the last bounces, which end where rest is declared.
    aside = ASIDE / p
    before = simulate(frame, shaking, samples=block.impacts - aside).velocity
    large = np.abs(before) > SMALLEST_BOUNCE * p * alpha
    times, before = block.impacts[large], before[large]
    row = {"impacts": times.size, "impact_apart": 0.0, "ratio_apart": 0.0, "impulse_apart": 0.0}
    weight = 2.0 * (1.0 + frame.mass_ratio)  # columns of 1 kg
    if times.size:
        nearest = np.abs(bodies.impacts[None, :] - times[:, None]).argmin(axis=1)
        row["impact_apart"] = np.abs(bodies.impacts[nearest] - times).max() * p
        row["ratio_apart"] = np.abs(bodies.velocity_ratios[nearest] - frame.restitution).max()
        expected = stacked(impact_impulses(frame, cap, before))
        apart = np.abs(bodies.impulses[nearest] / weight - expected).max(axis=(1, 2))
        row["impulse_apart"] = (apart / np.abs(expected).sum(axis=(1, 2))).max()

    # Forces away from impacts, where they jump.
    gap = np.abs(bodies.time[:, None] - block.impacts).min(axis=1, initial=np.inf)
    flying = both & (gap > SAME_IMPACT / p) & (np.abs(block.rotation) > SMALLEST_BOUNCE * alpha)
    ground = shaking.excitation(bodies.time)
    closed = stacked(contact_forces(frame, cap, block.rotation, block.velocity, ground))
    found = bodies.forces / (weight * STANDARD_GRAVITY)
    return row | {
        "mass_ratio": frame.mass_ratio,
        "excitation": shaking.name if isinstance(shaking, Record) else shaking.shape,
        "rotation_apart": off,
        "force_apart": np.abs(found - closed)[flying].max(),
        "least_vertical": found[flying][:, :, 1].min(),
        "cap_tilt": np.nanmax(np.abs(bodies.cap_angle)) / alpha,
        "drift": np.nanmax(bodies.drift) / frame.column.size,
        "forces_compared": int(flying.sum()),
        "same_outcome": (bodies.outcome == "overturned") == bool(np.isnan(block.rotation[-1])),
    }


def main(settings: dict, cap: Cap, records: list[Record]) -> tuple[pd.DataFrame, dict]:
    column = Column(**settings["column"])
    rows = [
        compare(
            RockingFrame(column, gamma),
            cap,
            pulse_on(column, pulse),
            settings["duration"],
            settings["samples"],
        )
        for pulse in settings["pulses"]
        for gamma in settings["mass_ratios"]
    ]
    rows += [
        compare(
            RockingFrame(column, gamma),
            cap,
            record,
            settings["record_duration"],
            settings["samples"],
        )
        for record in records
        for gamma in settings["record_mass_ratios"]
    ]
    table = pd.DataFrame(rows)
    return table, findings(table)


def findings(mechanism_three_bodies: pd.DataFrame) -> dict[str, Finding]:
    """Return how far the two descriptions are apart, from the table of histories."""
    table = mechanism_three_bodies
    worst = table[[name for name in table if name.endswith(("_apart", "tilt", "drift"))]].max()
    counted = {"histories": len(table), "impacts": int(table.impacts.sum())}
    return {
        "one_degree_of_freedom": truth(
            worst.rotation_apart < AGREE and table.same_outcome.all(),
            largest_over_alpha=worst.rotation_apart,
            cap_tilt_over_alpha=worst.cap_tilt,
            drift_over_size=worst.drift,
            largest_impact_time=worst.impact_apart,
            **counted,
        ),
        "velocity_ratio": truth(worst.ratio_apart < AGREE, largest=worst.ratio_apart, **counted),
        "same_forces": truth(
            max(worst.force_apart, worst.impulse_apart) < AGREE,
            largest_over_weight=worst.force_apart,
            largest_impulse=worst.impulse_apart,
            forces_compared=int(table.forces_compared.sum()),
        ),
    }


def work(job: Any) -> tuple:
    records = [read_record(path) for path in job.input.records]
    return main(job.params.settings, cap_of(job.params.cap), records)


if __name__ == "__main__":
    run(snakemake, work)
