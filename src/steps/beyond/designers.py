"""Table for designers: effects of a cap beam of each γ on a column.

Geometry, and ranges over the tables of the rules motions, uplift and friction. Under γ = ∞ the
force of a column acts along its diagonal: the required friction is tan α, that of uplift.
"""

import math

from replication.step import run, truth
from topheavy import Cap, Column, RockingFrame
from topheavy.bodies.kinematics import cap_displacement
from topheavy.forces.members import base_shear_slope, centre_height


def compute(
    settings, friction, structures, motions_gains, motions_rotations, uplift, friction_by_mass
):
    column = Column(**structures[settings["structure"]])
    cap = Cap(friction["bays"][0], friction["depth"] / 2.0)
    required = friction_by_mass.set_index(["bay", "mass_ratio"]).required
    near = motions_rotations[motions_rotations.velocity.isin(settings["velocities"])]
    peaks = near.pivot(index=["model", "velocity"], columns="mass_ratio", values="median_peak")
    peaks = peaks[(peaks < 1.0).all(axis=1)]
    travels = peaks.map(lambda peak: travel(column, peak * column.slenderness))
    rows = []
    for gamma in settings["mass_ratios"]:
        frame = RockingFrame(column, gamma)
        size = frame.equivalent_size / column.size
        gains = motions_gains.gain[motions_gains.mass_ratio == gamma]
        row = {"mass_ratio": gamma, "uplift_acceleration": frame.uplift_acceleration}
        row |= {"size_ratio": size, "velocity_scale": math.sqrt(size) - 1.0}
        row |= {"gain_least": gains.min(), "gain_most": gains.max()}
        rotations = motions_rotations[motions_rotations.mass_ratio == gamma]
        for velocity in settings["velocities"]:
            models = rotations[rotations.velocity == velocity]
            ends = {"low": models.median_peak_low.min(), "high": models.median_peak_high.max()}
            for name, peak in ends.items():
                moved = travel(column, peak * column.slenderness)
                row[f"{name}_{velocity:g}"] = moved / (2.0 * column.half_width)
        of_column = travels[gamma] / travels[0.0]
        row |= {"moved_least": of_column.min(), "moved_most": of_column.max()}
        row["base_shear_slope"] = base_shear_slope(frame)
        row["base_shear_largest"] = uplift.base_shear[uplift.mass_ratio == gamma].max()
        row["depth_over_width"] = centre_height(frame, cap) / column.half_height
        for bay in friction["bays"]:
            case, limit = (bay if gamma else 0.0, gamma), frame.uplift_acceleration
            row[f"friction_{bay:g}"] = limit if math.isinf(gamma) else required[case]
        rows.append(row)
    return rows


def travel(column, rotation):
    """Return how far the cap beam moves to the side, m; infinite where the column overturns."""
    return float(cap_displacement(column, rotation)[0]) if math.isfinite(rotation) else math.inf


def findings(designers):
    gains = designers[designers.mass_ratio > 0.0]
    # A block as large as the frame's equivalent column moves R̂/R times as far as the beam.
    least, most = (gains[name] * gains.size_ratio for name in ("moved_least", "moved_most"))
    return {
        "larger_block_moves_no_farther": truth(
            (most <= 1.0).all(), least=least.min(), most=most.max()
        ),
    }


if __name__ == "__main__":
    run(snakemake, compute, findings)
