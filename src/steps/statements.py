"""What the paper says in words and no other rule tests: a finding each, for the ledger."""

import math

import numpy as np
import sympy as sp

from replication.workbench import run, truth
from topheavy import Column, Pulse, RockingFrame, simulate
from topheavy.derivation import NEGATIVE, POSITIVE, cap_motion, premises
from topheavy.derivation.notation import acceleration, alpha, read, vanishes
from topheavy.derivation.printed import EQUATIONS
from topheavy.kinematics import cap_displacement, column_outline
from topheavy.moment_rotation import restoring_moment
from topheavy.structures import Structure

IDENTICAL = 1e-8  # of α, between histories that differ by rounding alone
SOLVED = 1e-6  # over α: the change of a history when the tolerance is tightened
TIMES = np.linspace(0.0, 6.0, 601)  # s
STEP_ASIDE = 1e-6  # of a threshold, to either side


def similar(column: Column, scale: float) -> Column:
    """Return the column of the same shape and `scale` times the size."""
    return Column(column.half_width * scale, column.half_height * scale)


def apart(one: Structure, other: Structure, excitation: Pulse, solver: dict) -> float:
    """Return the largest difference of two histories at the same times, over α."""
    first, second = (
        simulate(structure, excitation, samples=TIMES, tolerance=solver["tightened"])
        for structure in (one, other)
    )
    return float(np.abs(first.rotation - second.rotation).max() / one.block().slenderness)


# The oscillator ----------------------------------------------------------------------------------


def oscillator(frame: RockingFrame, pulse: Pulse, mass_ratios: list[float], solver: dict) -> dict:
    column, level = frame.column, frame.uplift_acceleration
    equivalent = similar(column, frame.equivalent_size / column.size)
    same = apart(frame, equivalent.block(frame.restitution), pulse, solver)
    own = apart(frame, equivalent, pulse, solver)

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
            raise ArithmeticError(f"γ = {gamma:g}: the outcome hangs on the tolerance")
        off = np.nanmax(np.abs(usual.rotation - tight.rotation)) / frame.slenderness
        errors[f"{gamma:g}"] = float(off)

    nearly, limit = (RockingFrame(column, gamma) for gamma in (1e9, math.inf))
    return {
        "identical_response": truth(
            same < IDENTICAL and own < IDENTICAL,
            holds_when=same < IDENTICAL,
            condition="the equivalent column is given the frame's √r in place of its own",
            apart_over_alpha=same,
            apart_with_its_own_restitution=own,
        ),
        "time_scales_with_p": truth(scaled < IDENTICAL, apart_over_alpha=scaled),
        "rigid_until_uplift": truth(lifts(1 + STEP_ASIDE) and not lifts(1 - STEP_ASIDE)),
        "rocks_left_then_right": truth(
            pulse.excitation(pulse.duration / 8) > 0.0
            and not response.overturned
            and before.min() < 0.0 >= before.max()
            and after.min() >= 0.0 < after.max(),
            first_impact=first,
        ),
        "solved_for_any_mass_ratio": truth(max(errors.values()) < SOLVED, error_over_alpha=errors),
        "massless_columns_are_a_limit": truth(
            math.isclose(nearly.frequency_parameter, limit.frequency_parameter, rel_tol=1e-8)
            and math.isclose(limit.frequency_parameter / column.frequency_parameter, (2 / 3) ** 0.5)
        ),
    }


# Geometry and algebra ----------------------------------------------------------------------------


def structure(frame: RockingFrame, mass_ratios: list[float]) -> dict:
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

    inside = np.linspace(0.0, 0.99 * column.slenderness, 100)
    ratio = restoring_moment(frame, inside) / restoring_moment(column, inside)

    # Column centres at h, the cap's weight at its seats, 2h.
    heights = [float(np.average([1.0, 2.0], weights=[1.0, gamma])) for gamma in mass_ratios]
    sizes = [RockingFrame(column, gamma).equivalent_size for gamma in mass_ratios]

    names = {equation.name: equation for equation in EQUATIONS}
    p = premises.rectangular_column(NEGATIVE)[sp.Symbol("p")]
    sides = {"eq19": NEGATIVE, "eq22": POSITIVE}
    compact = {
        version: all(
            vanishes(
                (
                    read(getattr(names[name], version), side)[1]
                    - read(getattr(names["eq23"], version), side)[1]
                ).subs({"a": alpha, "p": p}),
                side,
            )
            for name, side in sides.items()
        )
        for version in ("printed", "meant")
    }
    return {
        "cap_stays_on_its_seats": truth(gap < 1e-12, gap_over_size=gap),
        "frame_follows_the_columns_curve": truth(
            np.ptp(ratio) < 1e-12 * ratio[0], times_as_high=ratio[0]
        ),
        "centre_of_gravity_rises": truth(
            np.all(np.diff(heights) > 0.0) and np.all(np.diff(sizes) > 0.0),
            height_over_half_height=heights,
        ),
        "reactions_need_the_acceleration": truth(cap_motion(NEGATIVE).v_ddot.has(acceleration)),
        "compact_form": truth(compact["printed"], meant_holds=compact["meant"]),
    }


def main(case: dict, solver: dict) -> dict:
    frame = RockingFrame(Column(**case["column"]), case["mass_ratio"])
    pulse = Pulse(
        case["pulse"]["shape"], case["pulse"]["amplitude"], 2 * math.pi / case["pulse"]["period"]
    )
    return oscillator(frame, pulse, case["mass_ratios"], solver) | structure(
        frame, case["mass_ratios"]
    )


if __name__ == "__main__":
    run(snakemake, lambda job: main(job.params.case, job.params.solver))
