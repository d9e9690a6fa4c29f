"""Moment–rotation curve, the area that it encloses, and the period against rotation amplitude."""

import math

import numpy as np
import pandas as pd
import sympy as sp

from replication.workbench import Finding, run, truth
from topheavy import Column, RockingBlock, RockingFrame, simulate
from topheavy.bodies.free_rocking import energy_drift, quarter_period
from topheavy.bodies.moment_rotation import restoring_moment
from topheavy.derivation import POSITIVE, potential_energy
from topheavy.derivation.equilibrium import RECTANGULAR
from topheavy.derivation.notation import R, alpha, g, m_c
from topheavy.derivation.notation import gamma as mass_ratio

ROUNDING = 1e-12  # of m_c g R


def quarter_periods(settings: dict) -> list[dict]:
    """Quarter periods by quadrature of the energy integral and by simulation, both times p."""
    rows = []
    for degrees in settings["quarter_period_slendernesses"]:
        exact = RockingBlock(1.0, math.radians(degrees), 1.0)
        for block in (exact, exact.linear()):
            for fraction in settings["start_fractions"]:
                start = fraction * block.slenderness
                by_energy, _ = quarter_period(block, start)
                simulated = simulate(block, rotation=start, duration=10.0, samples=2).impacts[0]
                rows.append(
                    {
                        "slenderness_deg": degrees,
                        "linearised": block.linearised,
                        "start_fraction": fraction,
                        "quarter_period": by_energy,
                        "difference_of_routes": abs(simulated - by_energy),
                    }
                )
    return rows


def moment_by_energy(gamma: float, slenderness: float, rotations: np.ndarray) -> np.ndarray:
    """Return −dV/dθ per column over m_c g R at positive rotations, V that of the three bodies."""
    height = potential_energy(POSITIVE).subs(RECTANGULAR) / (2 * m_c * g * R)
    moment = -sp.simplify(height.diff(POSITIVE.rotation))
    by_energy = sp.lambdify((alpha, mass_ratio, POSITIVE.rotation), moment)
    return np.asarray(by_energy(slenderness, gamma, rotations), dtype=float)


def agrees_with_energy(frame: RockingFrame, rotations: np.ndarray) -> float:
    """Return how far the restoring moment is from −dV/dθ, over m_c g R; both oppose θ."""
    by_energy = moment_by_energy(frame.mass_ratio, frame.slenderness, rotations)
    return float(np.abs(restoring_moment(frame, rotations) + by_energy).max())


def main(settings: dict) -> tuple[dict, list[dict], dict]:
    column = Column(**settings["column"])
    slenderness = column.slenderness
    fractions = np.linspace(-1.0, 1.0, 2 * settings["points"] - 1)
    fractions = np.sort(np.append(fractions, -1e-12))  # the jump at θ = 0, from both sides
    moments = [
        {
            "mass_ratio": gamma,
            "rotation_fraction": fraction,
            "moment": moment,
        }
        for gamma in settings["mass_ratios"]
        for fraction, moment in zip(
            fractions,
            restoring_moment(RockingFrame(column, gamma), fractions * slenderness),
            strict=True,
        )
    ]
    rows = quarter_periods(settings)
    blocks = [RockingFrame(column, gamma).block() for gamma in settings["mass_ratios"]]
    drift = max(
        energy_drift(block, simulate(block, rotation=0.6 * slenderness, samples=4000), flights=5)
        for block in blocks
    )
    positive = np.linspace(0.0, slenderness, settings["points"])
    solitary = -moment_by_energy(0.0, slenderness, positive)
    heaviest = RockingFrame(column, max(settings["mass_ratios"]))
    apart = max(
        agrees_with_energy(RockingFrame(column, gamma), positive)
        for gamma in settings["mass_ratios"]
    )
    shape = -moment_by_energy(heaviest.mass_ratio, slenderness, positive)[:-1] / solitary[:-1]
    return (
        moments,
        rows,
        {
            "moment_at_uplift": truth(
                math.isclose(solitary[0], math.sin(slenderness), rel_tol=ROUNDING)
                and apart < ROUNDING,
                moment=solitary[0],
                apart_from_energy=apart,
            ),
            "moment_decreases_to_zero": truth(
                np.all(np.diff(solitary) < 0.0) and abs(solitary[-1]) < ROUNDING,
                at_alpha=solitary[-1],
            ),
            "frame_follows_the_columns_curve": truth(
                np.ptp(shape) < ROUNDING * shape[0] and apart < ROUNDING,
                times_as_high=shape[0],
                apart_from_energy=apart,
            ),
            "no_area_enclosed": truth(drift < 1e-8, largest_relative_drift=drift),
            **findings(pd.DataFrame(rows)),
        },
    )


def findings(quarter_period: pd.DataFrame) -> dict[str, Finding]:
    """Return whether the period grows with the amplitude, from the table of quarter periods."""
    exact = quarter_period[~quarter_period.linearised]
    periods = exact.groupby("slenderness_deg").quarter_period
    return {
        "period_depends_on_amplitude": truth(
            all(np.all(np.diff(of_column) > 0.0) for _, of_column in periods),
            least=exact.quarter_period.min(),
            largest=exact.quarter_period.max(),
            difference_of_routes=quarter_period.difference_of_routes.max(),
        ),
    }


if __name__ == "__main__":
    run(snakemake, lambda job: main(job.params.settings))
