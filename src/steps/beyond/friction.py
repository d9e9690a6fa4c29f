"""Coefficient of friction with which columns and frames rock without sliding, under pulses."""

from itertools import product

import numpy as np
import pandas as pd

from replication.step import check, geometric, grid, run, truth
from steps.shared.cases import pulse_on
from steps.shared.histories import history
from steps.shared.three_bodies import simulate_three_bodies
from topheavy import Cap, Column, RockingFrame, impact_impulses, simulate
from topheavy.forces.contacts import forces_at

AGREE = 1e-3  # of tan α: required friction by the closed form and by Newton's and Euler's equations


def compute(settings, structures):
    column = Column(**structures[settings["structure"]])
    cases = [(0.0, 0.0)]  # the column alone
    cases += [(bay, gamma) for bay in settings["bays"] for gamma in settings["mass_ratios"]]
    rows = []
    for bay, gamma in cases:
        frame, cap = (
            RockingFrame(column, gamma),
            Cap(bay or settings["bays"][0], settings["depth"] / 2.0),
        )
        survived = [
            row
            for place in product(
                settings["shapes"],
                grid(settings["frequency_ratios"]),
                geometric(settings["amplitudes"]),
            )
            if (row := required(frame, cap, pulse_on(column, *place), settings))
        ]
        if gamma > 0.0:
            compare(frame, cap, max(survived, key=lambda row: row["required"]), settings)
        rows += [{"bay": bay, "mass_ratio": gamma} | row for row in survived]
    table = pd.DataFrame(rows)
    return {"pulses": table, "by_mass": by_mass(table)}


def required(frame, cap, shaking, settings):
    """Return the required friction of a history with its impacts; None if the frame overturns.

    The error is the change when every second sample is left out. The vertical reaction is the least
    of the four contacts over the weight, and at impacts the impulse over that of both bases.
    """
    whole = simulate(frame, shaking, samples=2)
    if whole.overturned:
        return None
    arcs = history(frame, shaking, settings["samples"], whole=whole)
    forces = forces_at(frame, cap, arcs.rotation, arcs.velocity, arcs.ground)
    friction, vertical = forces.friction_demand, [np.nanmin(forces.vertical)]
    largest, coarse = np.nanmax(friction), np.nanmax(friction[..., ::2])
    if arcs.impacts:
        impact = impact_impulses(frame, cap, 1.0)
        vertical.append(impact.vertical.min() / impact.vertical[:2].sum())
    column = frame.column
    return {
        "shape": shaking.shape,
        "frequency_ratio": shaking.angular_frequency / column.frequency_parameter,
        "amplitude": shaking.amplitude / column.uplift_acceleration,
        "required": float(largest),
        "error": float(largest - coarse),
        "least_vertical": float(min(vertical)),
    }


def compare(frame, cap, row, settings):
    """Check the required friction of a pulse against that of three bodies until the pulse ends."""
    place = (row[name] for name in ("shape", "frequency_ratio", "amplitude"))
    shaking = pulse_on(frame.column, *place)
    times = np.linspace(0.0, shaking.duration, settings["check_samples"])
    motion = simulate(frame, shaking, samples=times)
    ground = shaking.excitation(times)
    forces = forces_at(frame, cap, motion.rotation, motion.velocity, ground)
    first = np.fmax.reduce(forces.friction_demand)
    bodies = simulate_three_bodies(
        frame,
        shaking,
        span=cap.span,
        cap_depth=2.0 * cap.half_depth,
        duration=shaking.duration,
        samples=times,
    )
    second = np.max(np.abs(bodies.forces[..., 0]) / bodies.forces[..., 1], axis=1)
    apart = np.nanmax(np.abs(first - second)) / frame.uplift_acceleration
    check(
        apart < AGREE,
        f"for γ = {frame.mass_ratio:g} in a bay of {cap.span:g} m the required friction differs by "
        f"{apart:.3g} tan α from that of three bodies; expected less than {AGREE:g}",
    )


def by_mass(pulses):
    """Return for each bay and γ the largest required coefficient of friction."""
    return pd.DataFrame(
        {
            "bay": bay,
            "mass_ratio": gamma,
            "survived": len(part),
            "required": part.required.max(),
            "error": part.error.max(),
            "least_vertical": part.least_vertical.min(),
        }
        for (bay, gamma), part in pulses.groupby(["bay", "mass_ratio"], sort=False)
    )


def findings(friction_by_mass, settings):
    table, mu = friction_by_mass, settings["sufficient"]
    frames = table[table.mass_ratio > 0.0]
    lightest = {bay: _lightest(part, mu) for bay, part in frames.groupby("bay", sort=False)}
    return {
        "friction_is_enough": truth(
            (table.required <= mu).all(),
            holds_when=None not in lightest.values(),
            condition=" and ".join(
                f"γ ≥ {g:g} in the bay of {b:g} m" for b, g in lightest.items() if g
            ),
        ),
        "contacts_stay_closed": truth(
            (frames.least_vertical > 0.0).all(),
            survived=frames.survived.sum(),
            least=frames.least_vertical.min(),
        ),
    }


def _lightest(frames, mu):
    """Return the least γ from which on μ is enough, None if the heaviest frame requires more."""
    enough = frames.sort_values("mass_ratio", ascending=False)
    enough = enough[(enough.required <= mu).cummin()]
    return float(enough.mass_ratio.min()) if len(enough) else None


if __name__ == "__main__":
    run(snakemake, compute, findings)
