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

AGREE = 1e-3  # difference of the required friction of two solvers, times tan α


def compute(settings, structures):
    column = Column(**structures[settings["structure"]])
    ratios, amplitudes = grid(settings["frequency_ratios"]), geometric(settings["amplitudes"])
    pulses = [
        pulse_on(column, *labels) for labels in product(settings["shapes"], ratios, amplitudes)
    ]
    caps, rows = {bay: Cap(bay, settings["depth"] / 2.0) for bay in settings["bays"]}, []
    alone = {0.0: caps[settings["bays"][0]]}
    for gamma in [0.0, *settings["mass_ratios"]]:
        frame = RockingFrame(column, gamma)
        for pulse, arcs in survived(frame, pulses, settings["samples"]):
            for bay, cap in (caps if gamma else alone).items():
                row = required(frame, cap, pulse, arcs)
                rows.append({"bay": bay, "mass_ratio": gamma} | row)
    rows.sort(key=lambda row: [0.0, *caps].index(row["bay"]))
    table = pd.DataFrame(rows)
    for (bay, gamma), part in table[table.mass_ratio > 0.0].groupby(["bay", "mass_ratio"]):
        largest = part.loc[part.required.idxmax()]
        compare(RockingFrame(column, gamma), caps[bay], largest, settings)
    return {"pulses": table, "by_mass": by_mass(table)}


def survived(frame, pulses, samples):
    """Yield each pulse that does not overturn a frame, of any bay, and the history under it."""
    for pulse in pulses:
        response = simulate(frame, pulse, samples=2)
        if not response.overturned:
            yield pulse, history(frame, pulse, response, samples)


def required(frame, cap, shaking, arcs):
    """Return the required friction of a history with its impacts.

    The vertical reaction is the least of the four contacts over the weight, and at impacts the
    impulse over that of both bases.
    """
    forces = forces_at(frame, cap, arcs.rotation, arcs.velocity, arcs.ground)
    vertical = [np.nanmin(forces.vertical)]
    if arcs.impacts:
        impact = impact_impulses(frame, cap, 1.0)
        vertical.append(impact.vertical.min() / impact.vertical[:2].sum())
    column = frame.column
    return {
        "shape": shaking.shape,
        "frequency_ratio": shaking.angular_frequency / column.frequency_parameter,
        "amplitude": shaking.amplitude / column.uplift_acceleration,
        "required": float(np.nanmax(forces.friction_demand)),
        "least_vertical": float(min(vertical)),
    }


def compare(frame, cap, row, settings):
    """Check the required friction of a pulse against that of three bodies until the pulse ends."""
    labels = (row[name] for name in ("shape", "frequency_ratio", "amplitude"))
    shaking = pulse_on(frame.column, *labels)
    duration = shaking.duration
    times = np.linspace(0.0, duration, settings["check_samples"])
    motion, ground = simulate(frame, shaking, samples=times), shaking.excitation(times)
    forces = forces_at(frame, cap, motion.rotation, motion.velocity, ground)
    closed_form = np.fmax.reduce(forces.friction_demand)
    bodies = simulate_three_bodies(frame, cap, shaking, duration=duration, samples=times)
    by_bodies = np.max(np.abs(bodies.forces[..., 0]) / bodies.forces[..., 1], axis=1)
    apart = np.nanmax(np.abs(closed_form - by_bodies)) / frame.uplift_acceleration
    check(
        apart < AGREE,
        f"for γ = {frame.mass_ratio:g} in a bay of {cap.span:g} m the required friction differs by "
        f"{apart:.3g} tan α from that of three bodies; expected less than {AGREE:g}",
    )


def by_mass(pulses):
    """Return for each bay and γ the largest required coefficient of friction."""
    groups = pulses.groupby(["bay", "mass_ratio"], sort=False)
    largest = groups.agg(
        survived=("required", "size"),
        required=("required", "max"),
        least_vertical=("least_vertical", "min"),
    )
    return largest.reset_index()


def findings(friction_by_mass, settings):
    table, mu = friction_by_mass, settings["sufficient"]
    frames = table[table.mass_ratio > 0.0]
    lightest = {bay: _lightest(part, mu) for bay, part in frames.groupby("bay", sort=False)}
    return {
        "friction_is_enough": truth(
            (table.required <= mu).all(),
            holds_when=None not in lightest.values(),
            condition=" and ".join(
                f"γ ≥ {gamma:g} in the bay of {bay:g} m" for bay, gamma in lightest.items() if gamma
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
