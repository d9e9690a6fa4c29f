"""p̂, R̂ and √r of the frame over γ and α, its moment–rotation curve, and the paper's Fig. 1."""

import math

import numpy as np
import pandas as pd
import sympy as sp

from derivation.mechanics import RECTANGULAR_OF_TWO, potential_energy
from derivation.notation import POSITIVE, R, alpha, g, gamma, m_c
from replication.step import check, run, truth, value
from steps.shared import plain
from steps.shared.cases import column_of, lowest
from topheavy import Column, FixedMassColumn, Pulse, RockingFrame
from topheavy.bodies.free_rocking import restoring_moment

ROUNDING = 1e-12  # difference of moments, times m_c g R
DIGITS = 1e-8  # relative error of a number in a table
ASIDE = 1e-6  # relative distance from a minimum, to either side


def moment_by_energy(mass_ratio, slenderness, rotations):
    """Return dV/dθ per column over m_c g R at positive rotations, V that of the three bodies."""
    height = potential_energy(POSITIVE).subs(RECTANGULAR_OF_TWO) / (2 * m_c * g * R)
    moment = sp.simplify(height.diff(POSITIVE.rotation))
    return sp.lambdify((alpha, gamma, POSITIVE.rotation), moment)(
        slenderness, mass_ratio, rotations
    )


def minimum(frame, shape, period):
    """Return the minimum overturning acceleration of a pulse, g, by both solvers."""
    pulse = Pulse(shape, 1.0, period=period)
    low, high = lowest(frame, pulse).bracket
    sides = [low * (1 - ASIDE), high * (1 + ASIDE)]
    outcomes = [plain.judge(frame, pulse.scaled(side)).overturned for side in sides]
    check(
        outcomes == [False, True],
        f"overturning just below and above the minimum of {high:.6g} g is {outcomes} by the plain "
        "solver; expected [False, True]",
    )
    return high


def moments(column, settings):
    """Return moments of frames, and of a column with a fixed mass, over rotations up to α."""
    frames = [RockingFrame(column, gamma) for gamma in (0.0, *settings["frames"])]
    fixed, curves = FixedMassColumn(column, settings["frames"][0]), []
    for structure in (*frames, fixed):
        gamma, alpha = structure.mass_ratio, structure.slenderness
        rotations = np.linspace(0.0, 1.0, settings["rotations"]) * alpha
        if structure is fixed:
            arm = math.hypot(fixed.half_base, fixed.centre_height)
            moment = (1.0 + gamma) * arm / column.size * np.sin(alpha - rotations)
        else:
            moment = moment_by_energy(gamma, alpha, rotations)
            apart = np.abs(restoring_moment(structure, rotations) - moment).max()
            check(apart < ROUNDING, f"γ = {gamma:g}: the moment is {apart:.1g} m_c g R from dV/dθ")
        stiffness = (structure.frequency_parameter / column.frequency_parameter) ** 2
        curve = {
            "mass": "fixed" if structure is fixed else "loose",
            "mass_ratio": gamma,
            "rotation_over_alpha": rotations / column.slenderness,
            "moment": moment,
            "moment_over_inertia": stiffness * np.sin(alpha - rotations),
        }
        curves.append(pd.DataFrame(curve))
    return pd.concat(curves)


def compute(settings, structures):
    column = Column(**structures["temple"])
    small = Column(column.half_width / 2, column.half_height / 2)

    gammas = [*np.linspace(0.0, settings["largest"], settings["points"]), math.inf]
    frames = [RockingFrame(column, gamma) for gamma in gammas]  # of any column: ratios are the same
    angles = np.linspace(0.0, settings["largest_slenderness"], settings["slendernesses"])[1:]
    shown = [("small column", RockingFrame(small, 0.0)), ("column", RockingFrame(column, 0.0))]
    shown += [(f"frame {gamma:g}", RockingFrame(column, gamma)) for gamma in settings["frames"]]
    return {
        "mass_ratio": {
            "mass_ratio": gammas,
            "frequency_ratio": [f.frequency_parameter / column.frequency_parameter for f in frames],
            "size_ratio": [frame.equivalent_size / column.size for frame in frames],
        },
        "restitution": [
            {
                "slenderness_deg": angle,
                "mass_ratio": gamma,
                "restitution": RockingFrame(column_of(angle), gamma).restitution,
                "restitution_of_column": column_of(angle).restitution,
            }
            for gamma in settings["mass_ratios"]
            for angle in angles
        ],
        "moment_rotation": moments(column, settings),
        "four_structures": [
            {
                "structure": name,
                "mass_ratio": frame.mass_ratio,
                "half_width": frame.column.half_width,
                "half_height": frame.column.half_height,
                "equivalent_size": frame.equivalent_size,
                "uplift_acceleration": frame.uplift_acceleration,
                "minimum_overturning": minimum(frame, settings["shape"], settings["period"]),
            }
            for name, frame in shown
        ],
    }


def findings(mass_ratio, restitution, moment_rotation, four_structures):
    last = mass_ratio.iloc[-1]
    equal = np.interp(1.0, mass_ratio.mass_ratio[:-1], mass_ratio.size_ratio[:-1])
    gain = (equal - 1.0) / (last.size_ratio - 1.0)
    loss = restitution.restitution_of_column - restitution.restitution
    heavy = restitution.mass_ratio > 0.0
    rocks = restitution[heavy & (restitution.restitution >= 0.0)]
    moments = moment_rotation[moment_rotation.mass == "loose"].pivot_table(
        "moment", "rotation_over_alpha", "mass_ratio"
    )
    shapes = moments.iloc[:-1].div(moments[0.0].iloc[:-1], axis=0)  # all vanish at α
    minima = four_structures.minimum_overturning
    return {
        "limit_of_frequency_ratio": value(last.frequency_ratio, DIGITS),
        "limit_of_size_ratio": value(last.size_ratio, DIGITS),
        "gain_at_mass_ratio_one": value(gain, DIGITS),
        "heavier_is_larger": truth(
            (np.diff(mass_ratio.frequency_ratio) < 0.0).all()
            and (np.diff(mass_ratio.size_ratio) > 0.0).all()
        ),
        "smaller_than_solitary": truth((loss[heavy] > 0.0).all(), frames=int(heavy.sum())),
        "solitary_column_recovered": truth((loss[~heavy] == 0.0).all()),
        "energy_loss": truth(
            (rocks.restitution**2 < rocks.restitution_of_column**2).all(), frames=len(rocks)
        ),
        "frame_follows_the_columns_curve": truth(
            all(
                abs(shape - (1.0 + 2.0 * gamma)).max() < DIGITS * shape.max()
                for gamma, shape in shapes.items()
            )
        ),
        "order_of_the_four_structures": truth((np.diff(minima) > 0.0).all(), minima=minima),
    }


if __name__ == "__main__":
    run(snakemake, compute, findings)
