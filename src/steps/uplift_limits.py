"""What uplift limits: the largest forces of frames that rock, and of those held against uplift.

The columns of a held frame are pinned or guided at their tops; a column alone is a cantilever.
"""

import math
from collections.abc import Sequence
from itertools import product
from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import Finding, grid, run, truth
from steps.shared.peak_forces import (
    FORCES,
    GUIDED,
    MARGIN,
    PINNED,
    RIGID,
    bending,
    held,
    held_peaks,
    ratio_of,
    rocking_peaks,
    shear_after_uplift,
    tops,
)
from steps.shared.spectrum import progress
from topheavy import (
    STANDARD_GRAVITY,
    Cap,
    Column,
    FixedFrame,
    Pulse,
    Record,
    RockingFrame,
    base_shear_slope,
    frame_forces,
    peak_elastic,
    peak_elastic_by_scipy,
    read_record,
)
from topheavy.second import reference
from topheavy.second.newton_euler import ThreeBodies, accelerations
from topheavy.second.three_bodies import simulate_three_bodies

SEED = 2014  # of the samples that the second solvers judge
CLOSE = 1e-3  # relative: what the peaks of two solvers may differ by
HALVED = 5e-3  # relative: what half as many samples may change a peak by
SAME = 1e-6  # of the weight and of weight times height: for the three bodies
STEPS = {"pulse": 200, "record": 60}  # in a period of the held frame; (π/60)²/2 is 1.4e-3
BESIDE = 1e-3  # over p̂: how far from an impact the forces of the three bodies are compared
ROUNDING = 1e-9


def motions(column: Column, settings: dict, paths: list[str]) -> list[tuple[Pulse | Record, dict]]:
    """Return every motion, of unit peak, with its labels."""
    p = column.frequency_parameter
    pulses = [
        (
            Pulse(shape, 1.0, ratio * p),
            {"kind": "pulse", "motion": shape, "frequency_ratio": ratio},
        )
        for shape in settings["shapes"]
        for ratio in grid(settings["frequency_ratios"])
    ]
    return pulses + [
        (
            record.scaled(1.0 / record.peak_acceleration),
            {"kind": "record", "motion": record.name, "frequency_ratio": math.nan},
        )
        for record in map(read_record, paths)
    ]


def compare(
    frames: Sequence[RockingFrame],
    cap: Cap,
    motion: Pulse | Record,
    labels: dict,
    settings: dict,
) -> list[dict]:
    """Return a row for each frame and amplitude: the peaks, and their ratios to the held frame's.

    The forces of a frame held against uplift are proportional to the amplitude.
    """
    spec, rows = settings[{"pulse": "pulses", "record": "recorded"}[labels["kind"]]], []
    beside = held_peaks(frames, cap, motion, settings["periods"], STEPS[labels["kind"]])
    for frame, fixed in zip(frames, beside, strict=True):
        for ratio in spec["amplitudes"]:
            peak = ratio * frame.uplift_acceleration
            found = rocking_peaks(frame, cap, motion.scaled(peak), spec["points"])
            row = labels | {
                "mass_ratio": frame.mass_ratio,
                "amplitude": ratio,
                "peak_acceleration": peak,
                "shear_after_uplift": shear_after_uplift(frame, peak),
                "outcome": found.outcome,
                "rotation": found.rotation,
                "impulse": found.impulse,
                "error": found.error,
            }
            for name in FORCES:
                row[name] = found.forces[name]
                for one, forces in fixed.items():
                    row[ratio_of(name, *one)] = found.forces[name] / (forces[name] * peak)
            rows.append(row)
    return rows


def summary(table: pd.DataFrame, settings: dict) -> pd.DataFrame:
    """Return, for each kind, γ, force and held frame, the range of the ratio among survivors."""
    rows = []
    for (kind, gamma), cells in table.groupby(["kind", "mass_ratio"]):
        for name in FORCES:
            for top, one in held(gamma, settings["periods"]):
                ratio = cells[ratio_of(name, top, one)].dropna()
                rows.append(
                    {
                        "kind": kind,
                        "mass_ratio": gamma,
                        "force": name,
                        "top": top,
                        "held": one,
                        "histories": len(cells),
                        "overturned": int((cells.outcome == "overturned").sum()),
                        "least": ratio.min(),
                        "median": ratio.median(),
                        "largest": ratio.max(),
                        "lower": float((ratio < 1.0).mean()),
                    }
                )
    return pd.DataFrame(rows)


def slopes(settings: dict) -> pd.DataFrame:
    """Return the slope of the base shear just after uplift by formula and by three bodies."""
    rows = []
    for degrees in settings["slope"]["slendernesses"]:
        alpha = math.radians(degrees)
        for gamma in settings["slope"]["mass_ratios"]:
            frame = RockingFrame(Column(math.sin(alpha), math.cos(alpha)), gamma)
            row = {"slenderness_deg": degrees, "mass_ratio": gamma}
            row |= {"slope": base_shear_slope(frame), "three_bodies": math.nan}
            if 0.0 < gamma < math.inf:
                shears = [_shear_at_rest(frame, factor) for factor in (1.0, 2.0)]
                row["three_bodies"] = (shears[1] - shears[0]) / frame.uplift_acceleration
            rows.append(row)
    return pd.DataFrame(rows)


def sliding_shear(peak: pd.Series, friction: pd.Series | float) -> pd.Series:
    """Return the largest V/W of a rigid block on dry friction under a peak acceleration (g).

    A block that sticks has V/W = |ü_g|/g, at most μ; one that slides has V/W = μ. A block with
    μ = tan α slides when a column of slenderness α would uplift.
    """
    return np.minimum(peak, friction)


def _shear_at_rest(frame: RockingFrame, factor: float) -> float:
    """Return V/W of three bodies at rest that ü_g = factor · g tan α turns to the left."""
    bodies = ThreeBodies(frame, span=5.0 * frame.column.size, cap_depth=frame.column.size)
    still = np.zeros(9)
    ground = factor * frame.uplift_acceleration
    _, forces = accelerations(bodies, (-1, -1), still, still, ground)
    return float(forces[:2, 0].sum() / (2.0 * (1.0 + frame.mass_ratio) * STANDARD_GRAVITY))


def by_three_bodies(frame: RockingFrame, cap: Cap, pulse: Pulse, samples: int) -> float:
    """Return how far base shear, overturning and end moments of two descriptions are apart.

    The three bodies have their own motion and forces; the moments are those of their forces.
    """
    lasting = 2.0 * pulse.duration
    course = simulate_three_bodies(
        frame,
        pulse,
        span=cap.span,
        cap_depth=2.0 * cap.half_depth,
        duration=lasting,
        samples=samples,
    )
    weight = 2.0 * (1.0 + frame.mass_ratio) * STANDARD_GRAVITY
    foot, seat = course.forces[:, :2] / weight, course.forces[:, 2:] / weight
    theta, b = course.rotation, frame.column.half_width
    side, axis = np.sign(theta[:, 0]), np.array([-0.5, 0.5]) * cap.span
    moment = -((side[:, None] * b + axis) * foot[..., 1]).sum(axis=1)
    # Of the column at its own base and top: the axial force times half the width.
    ends = [
        sign * side[:, None] * b * (part[..., 0] * np.sin(theta) + part[..., 1] * np.cos(theta))
        for sign, part in ((1.0, foot), (-1.0, seat))
    ]
    ground = np.asarray(pulse.excitation(course.time))
    ours = frame_forces(frame, cap, theta[:, 0], course.velocity[:, 2], ground)
    gap = np.abs(course.time[:, None] - course.impacts).min(axis=1, initial=math.inf)
    moving = (gap > BESIDE / frame.frequency_parameter) & np.isfinite(foot[:, 0, 0])
    height = 2.0 * frame.column.half_height
    apart = [
        foot[..., 0].sum(axis=1) - ours.base_shear,
        (moment - ours.overturning_moment) / height,
        *((ends[0] - ours.bending_moment[..., 0]) / height).T,
        *((ends[1] - ours.bending_moment[..., -1]) / height).T,
    ]
    return float(max(np.abs(one[moving]).max() for one in apart))


def second_route(
    table: pd.DataFrame, frames: list, cap: Cap, settings: dict, tried: list
) -> pd.DataFrame:
    """Return how far SciPy and three bodies are from the library, for a sample, a row each."""
    column, random = frames[0].column, np.random.default_rng(SEED)
    stands = table[(table.outcome == "rests") & (table.kind == "pulse")]
    apart = []
    chosen = random.permutation(len(stands))[: settings["sample"]["points"]]
    for _, row in stands.iloc[chosen].iterrows():
        frame = RockingFrame(column, row.mass_ratio)
        pulse = Pulse(
            row.motion,
            row.amplitude * column.uplift_acceleration,
            row.frequency_ratio * column.frequency_parameter,
        )
        other = rocking_peaks(frame, cap, pulse, settings["pulses"]["points"], reference.simulate)
        apart += [abs(other.forces[name] / row[name] - 1.0) for name in FORCES]
    fixed_apart = []
    for motion, labels in tried[:: max(1, len(tried) // settings["checked_by_second_route"])]:
        if labels["kind"] == "record":
            motion = Record(
                motion.time_step,
                motion.acceleration[: settings["sample"]["record_steps"]],
                unit="g",
            )
        for top, period in product(tops(frames[-2].mass_ratio), settings["periods"]):
            fixed = FixedFrame(frames[-2], cap, top)
            (one,), other = (
                peak_elastic([fixed], motion, period),
                peak_elastic_by_scipy(fixed, motion, period),
            )
            fixed_apart += [abs(a / b - 1.0) for a, b in zip(one, other, strict=True)]
    bodies = [
        by_three_bodies(RockingFrame(column, gamma), cap, _pulse(column, spec), 400)
        for spec in settings["three_bodies"]["pulses"]
        for gamma in settings["three_bodies"]["mass_ratios"]
    ]
    found = {"rocking": apart, "held": fixed_apart, "three bodies": bodies}
    rows = [(route, one) for route, differences in found.items() for one in differences]
    return pd.DataFrame(rows, columns=["route", "apart"])


def _agreement(routes: pd.DataFrame, table: pd.DataFrame) -> Finding:
    """Return whether the second routes agree, and half as many samples change little."""
    apart, fixed_apart, bodies = (
        routes.apart[routes.route == route] for route in ("rocking", "held", "three bodies")
    )
    worst = [float(np.max(found)) for found in (apart, fixed_apart, bodies, table.error.dropna())]
    return truth(
        max(worst[:2]) < CLOSE and worst[2] < SAME and worst[3] < HALVED,
        peaks_rocking=len(apart),
        largest_relative_rocking=worst[0],
        peaks_held=len(fixed_apart),
        largest_relative_held=worst[1],
        histories_of_three_bodies=len(bodies),
        largest_over_weight=worst[2],
        largest_change_by_half_the_samples=worst[3],
    )


def _pulse(column: Column, spec: dict) -> Pulse:
    peak = spec["amplitude"] * column.uplift_acceleration
    return Pulse(spec["shape"], peak, spec["frequency_ratio"] * column.frequency_parameter)


def main(settings: dict, paths: list[str]) -> tuple:
    column = Column(**settings["column"])
    cap = Cap(settings["cap"]["span"], settings["cap"]["depth"] / 2.0)
    frames = [RockingFrame(column, gamma) for gamma in settings["mass_ratios"]]
    tried = motions(column, settings, paths)
    found = (compare(frames, cap, motion, labels, settings) for motion, labels in tried)
    table = pd.DataFrame(row for rows in progress(found, len(tried), "motions") for row in rows)
    ratios, of_slope = summary(table, settings), slopes(settings)
    apart = float((of_slope.slope - of_slope.three_bodies).abs().max())
    routes = second_route(table, frames, cap, settings, tried)
    drawn = findings(table, ratios, of_slope, routes)
    return (
        table,
        ratios,
        of_slope,
        routes,
        drawn
        | {
            "slope_by_three_bodies": truth(
                largest_apart=apart,  # less than the digits of the table
                **drawn["slope_by_three_bodies"],
            ),
        },
    )


def findings(
    uplift_limits: pd.DataFrame,
    uplift_ratios: pd.DataFrame,
    uplift_slopes: pd.DataFrame,
    uplift_routes: pd.DataFrame,
) -> dict[str, Any]:
    """Return what uplift limits, from the tables of histories, ratios, slopes and second routes."""
    table, ratios, bodies = uplift_limits, uplift_ratios, uplift_slopes.dropna()
    stands = table[table.outcome != "overturned"]
    uplift = table.peak_acceleration / table.amplitude
    slid = sliding_shear(table.peak_acceleration, uplift) / table.peak_acceleration
    over_uplift = stands.base_shear / stands.shear_after_uplift
    rigid = ratios[ratios.held == RIGID]
    totals = rigid[rigid.force != "bending_moment"]
    cantilevers = rigid[rigid.top == PINNED]
    fell = int((table.outcome == "overturned").sum())
    counted = {"histories": len(table), "overturned": fell}
    return {
        "slope_by_three_bodies": {
            "holds": len(bodies) > 0
            and np.allclose(bodies.slope, bodies.three_bodies, rtol=0.0, atol=ROUNDING),
            "frames": len(bodies),
        },
        "uplift_limits_forces": truth(
            ratios.largest.max() < 1.0,
            holds_when=max(totals.largest.max(), cantilevers.largest.max()) < 1.0,
            condition="the frame survives, and the held one is rigid; for the bending moments, the "
            "columns of the held one are pinned at their tops",
            **counted,
            **{
                f"{name}_{end}": totals[totals.force == name][end].agg(
                    {"least": "min", "largest": "max"}[end]
                )
                for name in FORCES
                if name != "bending_moment"
                for end in ("least", "largest")
            },
            bending_moments={
                top: bending(stands[ratio_of("bending_moment", top, RIGID)].dropna())
                for top in (PINNED, GUIDED)
            },
            longest_period_that_is_limited=_longest(ratios[ratios.force != "bending_moment"]),
            longest_period_of_bending_in_cantilevers=_longest(
                ratios[(ratios.force == "bending_moment") & (ratios.top == PINNED)]
            ),
        ),
        "uplift_is_beneficial": truth(
            fell == 0 and ratios.largest.max() < 1.0 and slid.max() < 1.0,
            holds_when=totals[totals.force == "base_shear"].largest.max() < 1.0
            and slid.max() < 1.0,
            condition="the frame survives; it means the base shear, beside a held rigid frame",
            **counted,
            sliding_least=slid.min(),
            sliding_largest=slid.max(),
            largest_shear_over_sliding=(stands.base_shear / uplift[stands.index]).max(),
            largest_rotation_over_alpha=stands.rotation.max(),
            largest_impulse=stands.impulse.max(),
        ),
        "largest_shear_is_that_of_uplift": truth(
            over_uplift.max() < 1.0 + MARGIN, margin=MARGIN, largest=over_uplift.max()
        ),
        "forces_by_second_routes": _agreement(uplift_routes, table),
    }


def _longest(ratios: pd.DataFrame) -> float:
    """Return the longest tested period up to which all of these forces are lower, s."""
    longest = 0.0
    for period, rows in ratios[ratios.held != RIGID].groupby("held", sort=False):
        if rows.largest.max() >= 1.0:
            break
        longest = float(period.removesuffix(" s"))
    return longest


def work(job: Any) -> tuple:
    return main(job.params.settings, job.input.records)


if __name__ == "__main__":
    run(snakemake, work)
