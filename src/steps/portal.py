"""The price of the portal: the forces at its joints and feet, over those in the frame's columns.

Also its alternative, a larger free-standing column that overturns at the same acceleration.
"""

import math
from collections.abc import Callable
from typing import Any, get_args

import numpy as np
import pandas as pd

from replication.workbench import Finding, run, truth
from steps.shared.histories import History, history
from steps.shared.spectrum import progress
from steps.vase_searches import minimum
from topheavy import (
    Cap,
    Column,
    MonolithicPortal,
    Pulse,
    Record,
    Response,
    RockingFrame,
    contact_forces,
    frame_forces,
    read_record,
    reference,
    simulate,
)
from topheavy.portal_forces import (
    ColumnEnds,
    Feet,
    rocking_portal_forces,
    standing_portal_forces,
)

Forces = dict[str, np.ndarray]

FORCES = ("joint_moment", "foot_moment", "joint_shear", "foot_shear")
SEED = 2014  # of the sample that SciPy judges
CLOSE = 1e-3  # relative: what the peaks of two solvers may differ by
HALVED = 5e-3  # relative: what half as many samples may change a peak by
HALVINGS = 12  # of a step between two sizes, in ln size


def of_frame(frame: RockingFrame, cap: Cap, course: History) -> Forces:
    """Return the moments in a frame's columns, at any section, and the shears at their ends.

    Its contacts have no moment about themselves; they bend the columns as they are eccentric.
    """
    motion = course.rotation, course.velocity, course.ground
    moment = frame_forces(frame, cap, *motion).bending_moment
    cos, sin = np.cos(course.rotation), np.sin(course.rotation)
    base, top = (
        np.stack([one.horizontal * cos - one.vertical * sin for one in pair], axis=-1)
        for contacts in [contact_forces(frame, cap, *motion).contacts]
        for pair in (contacts[:2], contacts[2:])
    )
    return dict(zip(FORCES, (moment, moment, top, base), strict=True))


def of_portal(ends: ColumnEnds) -> Forces:
    """Return the moments and shears at the joints and feet of a portal."""
    joint, foot = ends.joint, ends.foot
    return dict(zip(FORCES, (joint.moment, foot.moment, joint.shear, foot.shear), strict=True))


def largest(
    structure: RockingFrame | MonolithicPortal,
    motion: Pulse | Record,
    forces: Callable[[History], Forces],
    samples: int,
    route: Callable[..., Response] = simulate,
) -> tuple[str, dict[str, float], float]:
    """Return the outcome, the largest forces while it rocks, and what half the samples change.

    The forces are 0 of a structure that does not uplift, and NaN of one that overturns.
    """
    course = history(structure, motion, samples, route)
    if course.outcome == "overturned":
        return course.outcome, dict.fromkeys(FORCES, math.nan), math.nan
    found = forces(course)
    fine, coarse = (
        {name: float(np.nanmax(np.abs(force[:, ::step]), initial=0.0)) for name, force in of}
        for step, of in ((1, found.items()), (2, found.items()))
    )
    error = max((1.0 - coarse[name] / fine[name] for name in FORCES if fine[name] > 0.0), default=0)
    return course.outcome, fine, error


def compare(
    column: Column,
    motion: Pulse | Record,
    labels: dict,
    vase: dict,
    samples: int,
    route: Callable[..., Response] = simulate,
) -> list[dict]:
    """Return a row for each span and for feet that are fixed or pinned while the portal stands.

    The standing portal has its largest forces at the largest acceleration that does not uplift it.
    """
    gamma, depth, rows = vase["portals"]["mass_ratio"], vase["cap"]["depth"], []
    frame, peak = RockingFrame(column, gamma), labels["peak_acceleration"]
    for span in vase["portals"]["spans"]:
        cap, portal = Cap(span, depth / 2.0), MonolithicPortal(column, gamma, span, depth)
        freely = largest(frame, motion, lambda at: of_frame(frame, cap, at), samples, route)
        rocks = largest(
            portal,
            motion,
            lambda at: of_portal(
                rocking_portal_forces(portal, at.rotation, at.velocity, at.ground)
            ),
            samples,
            route,
        )
        for feet in get_args(Feet):
            stands = of_portal(
                standing_portal_forces(portal, feet, min(peak, portal.uplift_acceleration))
            )
            row = labels | {"span": span, "feet": feet}
            row |= {"frame": freely[0], "portal": rocks[0]}
            for name in FORCES:
                row[name] = max(rocks[1][name], float(np.abs(stands[name]).max()))
                row[f"{name}_over_frame"] = row[name] / freely[1][name]
            rows.append(row | {"error": np.fmax(freely[2], rocks[2])})
    return rows


def larger_columns(column: Column, case: dict, vase: dict) -> list[dict]:
    """Return the smallest similar columns that survive what a frame or portal survives.

    The column is one of sizes in equal ratios, then between two of them. It reaches the minimum
    overturning acceleration of the other if no acceleration below that is found to overturn it.
    `rises` is whether the minimum rises with each of these sizes up to there.
    """
    gamma, depth, rows = vase["portals"]["mass_ratio"], vase["cap"]["depth"], []
    goals: list[tuple[str, float, Any]] = [("frame", math.nan, RockingFrame(column, gamma))]
    goals += [
        ("portal", span, MonolithicPortal(column, gamma, span, depth))
        for span in vase["portals"]["spans"]
    ]
    sizes = np.geomspace(*(case["sizes"][key] for key in ("lowest", "highest", "points")))

    def lowest(size: float, highest: float) -> float:
        similar = Column(size * column.half_width, size * column.half_height)
        return minimum(similar, pulse, highest, vase["floor"]).acceleration

    for shape in vase["shapes"]:
        pulse = Pulse(shape, 1.0, 2.0 * math.pi / vase["period"])
        targets = [
            minimum(one, pulse, case["highest"], vase["floor"]).acceleration for *_, one in goals
        ]
        minima = np.array([lowest(size, max(targets) * (1.0 + CLOSE)) for size in sizes])
        for (name, span, _), target in zip(goals, targets, strict=True):
            row = {"structure": name, "span": span, "shape": shape, "minimum_overturning": target}
            place = int(np.argmax(minima >= target)) if minima[-1] >= target else 0
            low, high = (sizes[place - 1], sizes[place]) if place else (sizes[-1], math.inf)
            for _ in range(HALVINGS if place else 0):
                middle = math.sqrt(low * high)
                low, high = (low, middle) if lowest(middle, target) == math.inf else (middle, high)
            rows.append(
                row
                | {"size_low": low, "size_high": high, "height": 2.0 * high * column.half_height}
                | {"mass_same_depth": high**2, "mass_similar": high**3}
                | {"rises": bool(np.all(np.diff(minima[: place + 1]) > 0.0))}
            )
    return rows


def motions(case: dict, vase: dict, paths: list[str]) -> list[tuple[Pulse | Record, dict, int]]:
    """Return every motion with its labels and the samples of an arc."""
    unit: list[tuple[str, str, Pulse | Record]] = [
        ("pulse", shape, Pulse(shape, 1.0, 2.0 * math.pi / vase["period"]))
        for shape in vase["shapes"]
    ]
    for record in map(read_record, paths):
        unit.append(("record", record.name, record.scaled(1.0 / record.peak_acceleration)))
    return [
        (
            motion.scaled(peak),
            {"kind": kind, "motion": name, "peak_acceleration": peak},
            case["points"][kind],
        )
        for kind, name, motion in unit
        for peak in case["amplitudes"]
    ]


def second_route(rows: list[dict], tried: list, column: Column, vase: dict, count: int) -> Finding:
    """Return whether SciPy finds the same outcomes and peaks in a seeded sample, as a finding."""
    whole, apart, same = pd.DataFrame(rows), [], True
    chosen = np.random.default_rng(SEED).permutation(len(tried))[:count]
    for motion, labels, samples in (tried[place] for place in chosen):
        ours = whole[(whole[list(labels)] == pd.Series(labels)).all(axis=1)].reset_index()
        theirs = pd.DataFrame(compare(column, motion, labels, vase, samples, reference.simulate))
        same &= bool((theirs[["frame", "portal"]] == ours[["frame", "portal"]]).all(axis=None))
        of = [one for name in FORCES for one in (name, f"{name}_over_frame")]
        apart.append((theirs[of] / ours[of] - 1.0).abs().max(axis=None))
    return truth(
        same and np.nanmax(apart) < CLOSE,
        motions=len(apart),
        largest_relative=float(np.nanmax(apart)),
    )


def findings(portal_forces: pd.DataFrame, portal_columns: pd.DataFrame) -> dict[str, Finding]:
    """Return what the joints and feet carry, and how large a column gains as much."""
    table, columns = portal_forces, portal_columns
    return {}


def main(case: dict, vase: dict, paths: list[str]) -> tuple:
    column = Column(**case["column"])
    tried = motions(case, vase, paths)
    found = (compare(column, motion, labels, vase, count) for motion, labels, count in tried)
    rows = [row for some in progress(found, len(tried), "motions") for row in some]
    tables = pd.DataFrame(rows), pd.DataFrame(larger_columns(column, case, vase))
    checked = second_route(rows, tried, column, vase, case["checked_by_second_route"])
    return *tables, findings(*tables) | {"second_route": checked}


def work(job: Any) -> tuple:
    return main(job.params.case, job.params.vase, job.input.records)


if __name__ == "__main__":
    run(snakemake, work)
