"""The price of the portal: the forces at its joints and bases, over those in the frame's columns.

Nothing is said of a motion in which the ground would have to pull the base of the portal.

Also its alternative, a larger free-standing column that overturns at the same acceleration.
"""

import math
from collections.abc import Callable
from functools import partial
from typing import Any, get_args

import numpy as np
import pandas as pd

from replication.workbench import Finding, run, truth
from steps.shared.bearing import bearing, on_the_ground
from steps.shared.histories import History, history
from steps.shared.spectrum import progress
from steps.vase_searches import Minimum, minima, minimum
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
    resting_portal_forces,
    rocking_portal_forces,
    simulate,
)
from topheavy.forces.portal import Bases, ColumnEnds, Section
from topheavy.second import reference

Forces = dict[str, np.ndarray]

BASES = get_args(Bases)
STATES = ("rocks", *(f"rests_{bases}" for bases in BASES))
FORCES = ("joint_moment", "base_moment", "joint_shear", "base_shear")
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


def of_portal(portal: MonolithicPortal, course: History) -> Forces:
    """Return the moments and shears at the joints and bases of a portal that rocks."""
    return of_ends(rocking_portal_forces(portal, course.rotation, course.velocity, course.ground))


def of_ends(ends: ColumnEnds) -> Forces:
    """Return the moments and shears at the joints and bases."""
    joint, base = ends.joint, ends.base
    return dict(zip(FORCES, (joint.moment, base.moment, joint.shear, base.shear), strict=True))


def followed(
    structure: RockingFrame | MonolithicPortal,
    motion: Pulse | Record,
    samples: int,
    route: Callable[..., Response],
) -> tuple[str, History | None]:
    """Return the outcome, and the history unless the structure overturns."""
    whole = route(structure, motion, samples=2)
    if whole.overturned:
        return whole.outcome, None
    return whole.outcome, history(structure, motion, samples, route, whole)


def largest(
    course: History | None, forces: Callable[[History], Forces]
) -> tuple[dict[str, float], float]:
    """Return the largest forces while a structure rocks, and what half the samples change.

    The forces are 0 of a structure that does not uplift, and NaN of one that overturns.
    """
    if course is None:
        return dict.fromkeys(FORCES, math.nan), math.nan
    found = forces(course)
    fine, coarse = (
        {name: float(np.nanmax(np.abs(force[:, ::step]), initial=0.0)) for name, force in of}
        for step, of in ((1, found.items()), (2, found.items()))
    )
    error = max((1.0 - coarse[name] / fine[name] for name in FORCES if fine[name] > 0.0), default=0)
    return fine, error


def compare(
    column: Column,
    motion: Pulse | Record,
    labels: dict,
    vase: dict,
    samples: int,
    route: Callable[..., Response] = simulate,
) -> list[dict]:
    """Return the rows of each span: while the portal rocks, or rests on fixed or pinned bases.

    A portal that rocks has no forces where the ground would have to pull its base, and the
    friction that it requires. `resisted` is whether the ground can hold the bases.
    """
    gamma, depth, rows = vase["portals"]["mass_ratio"], vase["cap"]["depth"], []
    frame, peak = RockingFrame(column, gamma), labels["peak_acceleration"]
    of_motion = motion, samples, route
    freed, freely = followed(frame, *of_motion)  # whatever its span
    for span in vase["portals"]["spans"]:
        cap, portal = Cap(span, depth / 2.0), MonolithicPortal(column, gamma, span, depth)
        outcome, rocks = followed(portal, *of_motion)
        in_frame, changed = largest(freely, partial(of_frame, frame, cap))
        row = labels | {"span": span, "frame": freed, "portal": outcome}
        found = []
        if outcome == "no uplift":
            for bases in BASES:
                ends = resting_portal_forces(portal, bases, peak)
                forces = {name: float(np.abs(of).max()) for name, of in of_ends(ends).items()}
                how = {"state": f"rests_{bases}", "resisted": resisted(portal, ends.base)}
                found.append(how | forces | {"friction": math.nan, "error": changed})
        else:
            least, friction = on_the_ground(portal, rocks) if rocks else (math.nan, math.nan)
            rocking, change = largest(rocks if least > 0.0 else None, partial(of_portal, portal))
            how = {"state": "rocks", "resisted": least > 0.0, "friction": friction}
            found.append(how | rocking | {"error": np.fmax(changed, change)})
        for one in found:
            over = {f"{name}_over_frame": one[name] / in_frame[name] for name in FORCES}
            rows.append(row | one | over)
    return rows


def resisted(portal: MonolithicPortal, base: Section) -> bool:
    """Whether the axial forces act within the bases: ground without tension resists no others."""
    return bool(np.all(np.abs(base.moment) <= portal.column.half_width * base.axial))


def larger_columns(column: Column, pulse: Pulse, settings: dict, vase: dict) -> list[dict]:
    """Return the smallest similar columns that survive a pulse as a frame and portals do.

    Of portals those whose base is not pulled up to their minimum; `friction` is what they require.
    The column is one of sizes in equal ratios, then between two of them. It reaches the minimum
    overturning acceleration of the other if no acceleration below that is found to overturn it.
    `rises` is whether the minimum rises with each of these sizes up to there, and `by_scipy`
    whether SciPy finds that the column on the lower side overturns, and the other one survives.

    Raises
    ------
    ValueError
        When the sizes do not reach so far.
    """
    gamma, depth, rows = vase["portals"]["mass_ratio"], vase["cap"]["depth"], []
    spans = vase["portals"]["spans"]
    of_each = [RockingFrame(column, gamma)]
    of_each += [MonolithicPortal(column, gamma, span, depth) for span in spans]
    of_goals = minima(of_each, pulse, settings["highest"], vase["floor"])
    goals = [("frame", math.nan, math.nan, of_goals[0].acceleration)]
    for span, portal, one in zip(spans, of_each[1:], of_goals[1:], strict=True):
        borne = bearing(portal, pulse, one.lowest.bracket[0])
        if borne.pulled_from == math.inf:
            goals.append(("portal", span, borne.friction, one.acceleration))
    sizes = np.geomspace(*(settings["sizes"][key] for key in ("lowest", "highest", "points")))

    def similar(size: float) -> Column:
        return Column(size * column.half_width, size * column.half_height)

    def lowest(size: float, highest: float) -> Minimum:
        return minimum(similar(size), pulse, highest, vase["floor"])

    highest = max(target for *_, target in goals) * (1.0 + CLOSE)
    of_sizes = minima([similar(size) for size in sizes], pulse, highest, vase["floor"])
    rising = np.array([one.acceleration for one in of_sizes])
    for name, span, friction, target in goals:
        place = int(np.argmax(rising >= target))
        if place == 0:
            raise ValueError(
                f"portal.sizes: no size after {sizes[0]:g} and up to {sizes[-1]:g} is the first to "
                f"reach {target:.4g} g, as a {name} does under {pulse.shape}; expected one that is"
            )
        low, high = sizes[place - 1 : place + 1]
        for _ in range(HALVINGS):
            middle = math.sqrt(low * high)
            survives = lowest(middle, target).acceleration == math.inf
            low, high = (low, middle) if survives else (middle, high)
        survives = not reference.judge(similar(high), pulse.scaled(target)).overturned
        rows.append(
            {"structure": name, "span": span, "shape": pulse.shape, "minimum_overturning": target}
            | {"size_low": low, "size_high": high, "bracket": high / low - 1.0}
            | {"height": 2.0 * high * column.half_height}
            | {"mass_same_depth": high**2, "mass_similar": high**3}
            | {"mass_of_structure": 2.0 * (1.0 + gamma), "friction": friction}
            | {"rises": bool(np.all(np.diff(rising[: place + 1]) > 0.0))}
            | {"by_scipy": survives and math.isfinite(lowest(low, target).error)}
        )
    return rows


def unit_pulses(vase: dict) -> list[Pulse]:
    """Return the pulses of the vase and of their period, of unit amplitude."""
    return [Pulse(shape, 1.0, 2.0 * math.pi / vase["period"]) for shape in vase["shapes"]]


def motions(settings: dict, vase: dict, paths: list[str]) -> list[tuple[Pulse | Record, dict, int]]:
    """Return every motion with its labels and the samples of an arc."""
    unit: list[tuple[str, str, Pulse | Record]] = [
        ("pulse", one.shape, one) for one in unit_pulses(vase)
    ]
    for record in map(read_record, paths):
        unit.append(("record", record.name, record.scaled(1.0 / record.peak_acceleration)))
    return [
        (
            motion.scaled(peak),
            {"kind": kind, "motion": name, "peak_acceleration": peak},
            settings["points"][kind],
        )
        for kind, name, motion in unit
        for peak in settings["amplitudes"]
    ]


def second_route(
    table: pd.DataFrame, tried: list, column: Column, vase: dict, count: int
) -> Finding:
    """Return whether SciPy finds the same, in a seeded sample of motions that uplift a portal.

    Half as many samples have to change little, under every motion.
    """
    of, outcomes = [*FORCES, *(f"{name}_over_frame" for name in FORCES)], ["frame", "portal"]
    pairs = []
    for motion, labels, samples in tried:
        ours = table[(table[list(labels)] == pd.Series(labels)).all(axis=1)].reset_index()
        if (ours.state == "rocks").any():
            pairs.append((ours, motion, labels, samples))
    apart, differ = [], 0
    for place in np.random.default_rng(SEED).permutation(len(pairs))[:count]:
        ours, *given = pairs[place]
        theirs = pd.DataFrame(compare(column, *given[:2], vase, given[2], reference.simulate))
        differ += int((theirs[outcomes] != ours[outcomes]).to_numpy().sum())
        apart.append((theirs[of] / ours[of] - 1.0).abs().max(axis=None))
    worst, halved = float(np.nanmax(apart)), float(table.error.max())
    return truth(
        differ == 0 and worst < CLOSE and halved < HALVED,
        motions=len(apart),
        differ=differ,
        largest_relative=worst,
        largest_change_by_half_the_samples=halved,
    )


def findings(portal_forces: pd.DataFrame, portal_columns: pd.DataFrame) -> dict[str, Finding]:
    """Return what the joints and bases carry, and how large a column gains as much."""
    table, columns = portal_forces, portal_columns
    compared = table[table.joint_moment_over_frame.notna()]
    cases = {name: compared[compared.state == name] for name in STATES}
    held = {name: rows[rows.resisted] for name, rows in cases.items()}
    shared = held["rocks"].joint_moment.round(2).value_counts()
    least = min(rows.joint_moment_over_frame.min() for rows in held.values() if len(rows))
    frame, portal = (columns[columns.structure == name] for name in ("frame", "portal"))
    sure = columns.rises.all() and columns.by_scipy.all()
    return {
        "joints_carry_more": truth(
            least > 1.0,
            compared=sum(map(len, held.values())),
            resting=len(cases["rests_pinned"]),
            rocking=len(held["rocks"]),
            pulled=int((table.state.eq("rocks") & table.friction.notna() & ~table.resisted).sum()),
            resisted={name: len(rows) for name, rows in held.items()},
            largest_friction=float(held["rocks"].friction.max()),
            of_one_moment=int(shared.max()),
            one_moment=float(shared.idxmax()),
            **{
                name: {f"{span:g}": ranges(of) for span, of in rows.groupby("span")}
                for name, rows in held.items()
                if len(rows)
            },
        ),
        "larger_column_is_lighter_than_the_frame": truth(
            sure and (frame.mass_similar < frame.mass_of_structure).all(), **sizes(frame)
        ),
        "larger_column_is_heavier_than_the_portal": truth(
            sure and (portal.mass_same_depth > portal.mass_of_structure).all(),
            largest_friction=float(portal.friction.max()),
            **sizes(portal),
        ),
    }


def ranges(rows: pd.DataFrame) -> dict[str, list[float]]:
    """Return the range of each force over that of the frame."""
    over = {name: rows[f"{name}_over_frame"] for name in FORCES}
    return {name: [float(of.min()), float(of.max())] for name, of in over.items()}


def sizes(rows: pd.DataFrame) -> dict[str, Any]:
    """Return the range of the larger columns' sizes, heights and masses, as evidence."""
    names = ("size_high", "height", "mass_same_depth", "mass_similar")
    found = {name: [float(rows[name].min()), float(rows[name].max())] for name in names}
    return {"compared": len(rows), **found, "widest_bracket": float(rows.bracket.max())}


def main(settings: dict, vase: dict, paths: list[str]) -> tuple:
    column = Column(**settings["column"])
    tried = motions(settings, vase, paths)
    found = (compare(column, motion, labels, vase, count) for motion, labels, count in tried)
    table = pd.DataFrame(row for rows in progress(found, len(tried), "motions") for row in rows)
    larger = (larger_columns(column, pulse, settings, vase) for pulse in unit_pulses(vase))
    columns = pd.DataFrame(row for rows in larger for row in rows)
    checked = second_route(table, tried, column, vase, settings["checked_by_second_route"])
    return table, columns, findings(table, columns) | {"second_route": checked}


def work(job: Any) -> tuple:
    return main(job.params.settings, job.params.vase, job.input.records)


if __name__ == "__main__":
    run(snakemake, work)
