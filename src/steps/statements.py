"""Test statements of the paper that no other rule tests; each gives one finding.

What is measured for each goes into a table, from which `findings` judges it.
"""

import math
from collections.abc import Callable, Mapping
from typing import TypeAlias

import numpy as np
import pandas as pd
import sympy as sp

from replication.workbench import Finding, run, truth
from topheavy import STANDARD_GRAVITY, Column, Pulse, RockingFrame, simulate
from topheavy.bodies.kinematics import cap_acceleration, cap_displacement, column_outline
from topheavy.bodies.massless_columns import simplified
from topheavy.derivation import NEGATIVE, POSITIVE, cap_motion, premises
from topheavy.derivation.notation import acceleration, read, vanishes
from topheavy.derivation.printed import EQUATIONS
from topheavy.second.three_bodies import simulate_three_bodies

IDENTICAL = 1e-8  # of α, between histories that differ by rounding alone
BODIES = 1e-6  # of α, or of the cap's weight: what two integrations may differ by
SMALLEST = 1e-3  # of α: forces are looked at beyond this rotation, away from impacts
SOLVED = 1e-6  # over α: the change of a history when the tolerance is tightened
TIMES = np.linspace(0.0, 6.0, 601)  # s
STEP_ASIDE = 1e-6  # of a threshold, to either side
ERROR, PRINTED = "error at γ = ", "printed: "

Measured: TypeAlias = dict[str, Mapping[str, float | bool]]
"""What was measured, by the statement and its own name."""


def similar(column: Column, scale: float) -> Column:
    """Return the column of the same shape and `scale` times the size."""
    return Column(column.half_width * scale, column.half_height * scale)


# The oscillator ----------------------------------------------------------------------------------


def from_below(frame: RockingFrame, cap: dict, pulse: Pulse) -> Measured:
    """Compare three rigid bodies with the equivalent column, and the forces on their cap.

    The bodies use neither Eq. (23) nor Eq. (25). The column has the size R̂ and the frame's √r.
    """
    column = frame.column
    equivalent = similar(column, frame.equivalent_size / column.size)
    bodies = simulate_three_bodies(
        frame, pulse, span=cap["span"], cap_depth=cap["depth"], duration=TIMES[-1], samples=TIMES
    )
    histories = [
        simulate(block, pulse, samples=TIMES).rotation
        for block in (equivalent.block(frame.restitution), equivalent.block())
    ]
    same, own = (
        float(np.abs(bodies.rotation - other[:, None]).max()) / frame.slenderness
        for other in histories
    )
    theta, rate = bodies.rotation[:, 0], bodies.velocity[:, 2]
    ground = pulse.excitation(TIMES)
    left = (theta < -SMALLEST * frame.slenderness) & np.isfinite(bodies.forces).all(axis=(1, 2))
    lean = frame.slenderness + theta
    turning = frame.frequency_parameter**2 * (np.sin(lean) - ground * np.cos(lean))
    across, up = cap_acceleration(column, theta, rate, turning)
    mass = 2.0 * frame.mass_ratio  # columns of 1 kg
    g = STANDARD_GRAVITY
    needed = mass * np.stack([across + ground * g, up + g], axis=1)
    off = np.abs(bodies.forces[:, 2:].sum(axis=1) - needed)[left]
    return {
        "identical_response": {"given the frame's √r": same, "with its own √r": own},
        "forces_on_the_cap_balance": {
            "instants": len(off),
            "apart": off.max(initial=0.0),
            "weight": mass * g,
        },
    }


def oscillator(
    frame: RockingFrame, pulse: Pulse, mass_ratios: list[float], solver: dict
) -> Measured:
    column, level = frame.column, frame.uplift_acceleration

    large, start = similar(column, 4.0), {"rotation": 0.6 * column.slenderness}
    times = np.linspace(0.0, 5.0, 501)
    in_its_time = [
        simulate(
            c.block(),
            **start,
            samples=times / c.frequency_parameter,
            tolerance=solver["tightened"],
        )
        for c in (column, large)
    ]
    scaled = np.abs(in_its_time[0].rotation - in_its_time[1].rotation).max() / column.slenderness

    def lifts(share: float) -> bool:
        motion = Pulse(pulse.shape, share * level, pulse.angular_frequency)
        return simulate(column, motion, samples=2).outcome != "no uplift"

    response = simulate(frame, pulse, samples=4001)
    first, second, *_ = response.impacts
    before = response.rotation[response.time < first]
    after = response.rotation[(response.time > first) & (response.time < second)]

    errors = {}
    for gamma in mass_ratios:
        usual, tight = (
            simulate(RockingFrame(column, gamma), pulse, samples=TIMES, **options)
            for options in ({}, {"tolerance": solver["tightened"]})
        )
        if usual.outcome != tight.outcome:
            raise ArithmeticError(f"γ = {gamma:g}: the outcome depends on the tolerance")
        off = np.nanmax(np.abs(usual.rotation - tight.rotation)) / frame.slenderness
        errors[f"{ERROR}{gamma:g}"] = float(off)

    offered = [one.name for one in EQUATIONS if "γ" in one.printed and len(one.sides) == 2]
    nearly, limit = RockingFrame(column, 1e9).block().linear(), simplified(frame, "all")
    return {
        "time_scales_with_p": {"apart": scaled},
        "rigid_until_uplift": {
            "lifts above": lifts(1 + STEP_ASIDE),
            "lifts below": lifts(1 - STEP_ASIDE),
        },
        "rocks_left_then_right": {
            "overturned": response.overturned,
            "ground": pulse.excitation(pulse.duration / 8),
            "first impact": first,
            "least before": before.min(),
            "largest before": before.max(),
            "least after": after.min(),
            "largest after": after.max(),
        },
        "solved_for_any_mass_ratio": errors | {f"{PRINTED}{name}": 1.0 for name in offered},
        "massless_columns_are_a_limit": {
            "p̂": abs(nearly.frequency_parameter / limit.frequency_parameter - 1.0),
            "√r": abs(nearly.restitution / limit.restitution - 1.0),
        },
    }


# Geometry and algebra ----------------------------------------------------------------------------


def structure(frame: RockingFrame, mass_ratios: list[float]) -> Measured:
    column = frame.column
    rotations = np.linspace(-column.slenderness, column.slenderness, 101)
    moved = np.transpose(cap_displacement(column, rotations))
    seats = [2 if theta < 0.0 else 3 for theta in rotations]  # the corner that carries the cap
    corners = np.array(
        [
            column_outline(column, theta)[seat] - column_outline(column, 0.0)[seat]
            for theta, seat in zip(rotations, seats, strict=True)
        ]
    )
    gap = np.abs(corners - moved).max() / column.size

    # The cap's weight acts where its underside lies, on the upper corners of the columns.
    corners_at_rest = column_outline(column, 0.0)[:4, 1]
    levels = [corners_at_rest.mean(), corners_at_rest.max()]
    heights = [float(np.average(levels, weights=[1.0, gamma])) for gamma in mass_ratios]
    sizes = [RockingFrame(column, gamma).equivalent_size for gamma in mass_ratios]

    names = {equation.name: equation for equation in EQUATIONS}
    p = premises.rectangular_column(NEGATIVE)[sp.Symbol("p")]
    sides = {"eq19": NEGATIVE, "eq22": POSITIVE}
    compact = {
        version: all(
            vanishes(
                (
                    read(getattr(names[name], version), side)[1]
                    - read(names["eq23"].printed, side)[1]
                ).subs({"p": p}),
                side,
            )
            for name, side in sides.items()
        )
        for version in ("printed", "meant")
    }
    return {
        "cap_stays_on_its_seats": {"gap": gap},
        "centre_of_gravity_rises": {
            f"{name} {number}": found
            for name, values in (("height", heights), ("size", sizes))
            for number, found in enumerate(values)
        },
        "reactions_need_the_acceleration": {
            "has it": cap_motion(NEGATIVE).v_ddot.has(acceleration)
        },
        "compact_form": compact,
    }


# What holds --------------------------------------------------------------------------------------


def table_of(measured: Measured) -> pd.DataFrame:
    """Return a row for each number that was measured; a truth is 1 or 0."""
    rows = [
        (statement, quantity, float(number))
        for statement, numbers in measured.items()
        for quantity, number in numbers.items()
    ]
    return pd.DataFrame(rows, columns=["statement", "quantity", "value"])


def findings(statements: pd.DataFrame) -> dict[str, Finding]:
    """Return which statements hold, from the table of what was measured for each."""
    rows = {
        name: of.set_index("quantity").value
        for name, of in statements.groupby("statement", sort=False)
    }
    return {name: JUDGED[name](of) for name, of in rows.items()}


def _identical(of: pd.Series) -> Finding:
    same, own = of["given the frame's √r"], of["with its own √r"]
    return truth(
        same < BODIES and own < BODIES,
        holds_when=bool(same < BODIES),
        condition="the equivalent column is given the frame's √r in place of its own",
        apart_over_alpha=same,
        apart_with_its_own_restitution=own,
    )


def _solved(of: pd.Series) -> Finding:
    errors = of[of.index.str.startswith(ERROR)]
    offered = {one.removeprefix(PRINTED) for one in of.index.drop(errors.index)}
    return truth(
        bool(errors.max() < SOLVED) and offered == {"eq23", "eq24", "eq25"},
        error_over_alpha={name.removeprefix(ERROR): error for name, error in errors.items()},
    )


def _rises(of: pd.Series) -> Finding:
    heights, sizes = (of[of.index.str.startswith(name)] for name in ("height", "size"))
    rise = np.all(np.diff(heights) > 0.0) and np.all(np.diff(sizes) > 0.0)
    return truth(rise, heights=heights.to_list())


JUDGED: dict[str, Callable[[pd.Series], Finding]] = {
    "identical_response": _identical,
    "forces_on_the_cap_balance": lambda of: truth(
        of.instants > 0 and of.apart < BODIES * of.weight,
        instants=int(of.instants),
        apart=of.apart,
    ),
    "time_scales_with_p": lambda of: truth(of.apart < IDENTICAL, apart_over_alpha=of.apart),
    "rigid_until_uplift": lambda of: truth(of["lifts above"] and not of["lifts below"]),
    "rocks_left_then_right": lambda of: truth(
        of.ground > 0.0
        and not of.overturned
        and of["least before"] < 0.0 >= of["largest before"]
        and of["least after"] >= 0.0 < of["largest after"],
        first_impact=of["first impact"],
    ),
    "solved_for_any_mass_ratio": _solved,
    "massless_columns_are_a_limit": lambda of: truth((of < 1e-8).all()),
    "cap_stays_on_its_seats": lambda of: truth(of.gap < 1e-12, gap_over_size=of.gap),
    "centre_of_gravity_rises": _rises,
    "reactions_need_the_acceleration": lambda of: truth(of["has it"]),
    "compact_form": lambda of: truth(of.meant, holds_as_printed=bool(of.printed)),
}


def main(settings: dict, solver: dict) -> tuple[pd.DataFrame, dict]:
    frame = RockingFrame(Column(**settings["column"]), settings["mass_ratio"])
    pulse = Pulse(
        settings["pulse"]["shape"],
        settings["pulse"]["amplitude"],
        2 * math.pi / settings["pulse"]["period"],
    )
    table = table_of(
        from_below(frame, settings["cap"], pulse)
        | oscillator(frame, pulse, settings["mass_ratios"], solver)
        | structure(frame, settings["mass_ratios"])
    )
    return table, findings(table)


if __name__ == "__main__":
    run(snakemake, lambda job: main(job.params.settings, job.params.solver))
