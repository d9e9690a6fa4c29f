"""The contact forces: what is proved of them, their known limits, and one history to look at."""

import math

import numpy as np
import pandas as pd

from replication.workbench import Finding, run, truth, value
from steps.shared.histories import History, history
from studies.mechanism.steps.setting import cap_of, pulse_on
from topheavy import (
    STANDARD_GRAVITY,
    Cap,
    Column,
    Pulse,
    RockingFrame,
    column_forces,
    contact_forces,
)
from topheavy.bodies.kinematics import cap_acceleration
from topheavy.derivation.theorem import contact_theorems

CONTACTS = ("base_left", "base_right", "seat_left", "seat_right")
ROUNDING = 1e-12  # of the weight of the frame: what double precision leaves
NEARLY_NONE = 1e-9  # γ of a cap that weighs next to nothing

UNDRAWN = "theorems, and differences that are no more than rounding"


def proved() -> Finding:
    found = contact_theorems()
    return truth(all(theorem.holds for theorem in found), theorems=[t.statement for t in found])


def solitary(column: Column, cap: Cap, course: History) -> Finding:
    """Return whether, for a massless cap beam, the base forces equal those of a solitary column."""
    motion = course.rotation, course.velocity, course.ground
    alone = column_forces(column, *motion)
    frame = contact_forces(RockingFrame(column, NEARLY_NONE), cap, *motion)
    apart = max(
        np.nanmax(np.abs(2.0 * getattr(foot, part) - getattr(alone, part)))
        for foot in (frame.base_left, frame.base_right)
        for part in ("horizontal", "vertical")
    )
    return truth(apart < 10.0 * NEARLY_NONE, apart_over_weight=float(apart))


def balanced(frame: RockingFrame, cap: Cap, course: History) -> Finding:
    """Return whether the base contacts carry the weight and inertia forces of all three bodies."""
    motion = course.rotation, course.velocity
    forces = contact_forces(frame, cap, *motion, course.ground)
    s, lean = np.sign(course.rotation), frame.slenderness - np.abs(course.rotation)
    second = -(frame.frequency_parameter**2) * (s * np.sin(lean) + course.ground * np.cos(lean))
    across, up = cap_acceleration(frame.column, *motion, second)
    # The columns' centres move half as far as the cap (Fig. 2).
    share = (0.5 + frame.mass_ratio) / (1.0 + frame.mass_ratio) / STANDARD_GRAVITY
    feet = (forces.base_left, forces.base_right)
    moved = course.rotation != 0.0
    apart = max(
        np.nanmax(np.abs(sum(foot.vertical for foot in feet) - 1.0 - share * up)[moved]),
        np.nanmax(
            np.abs(sum(foot.horizontal for foot in feet) - course.ground - share * across)[moved]
        ),
    )
    return truth(apart < ROUNDING, apart_over_weight=float(apart))


def start(spec: dict) -> Finding:
    """Return |F_x/F_z| tan α⁻¹ of a solitary column as a one-cosine pulse begins."""
    alpha = spec["slenderness"]
    column = Column(math.sin(alpha), math.cos(alpha))
    force = column_forces(column, 0.0, 0.0, spec["amplitude"] * alpha)
    return value(force.friction_demand / math.tan(alpha), ROUNDING)


def table_of(frame: RockingFrame, cap: Cap, course: History) -> pd.DataFrame:
    forces = contact_forces(frame, cap, course.rotation, course.velocity, course.ground)
    p = frame.column.frequency_parameter
    columns = {
        "time": p * course.time,
        "rotation": course.rotation / frame.slenderness,
        "ground": course.ground / frame.uplift_acceleration,
    }
    for name in CONTACTS:
        contact = getattr(forces, name)
        columns[f"{name}_horizontal"] = contact.horizontal
        columns[f"{name}_vertical"] = contact.vertical
        columns[f"{name}_demand"] = contact.friction_demand / frame.uplift_acceleration
    return pd.DataFrame({name: values.ravel() for name, values in columns.items()})


def main(settings: dict, cap: Cap) -> tuple[pd.DataFrame, dict]:
    frame = RockingFrame(Column(**settings["column"]), settings["mass_ratio"])
    pulse: Pulse = pulse_on(frame.column, settings["pulse"])
    course = history(frame, pulse, settings["samples"])
    findings = {
        "theorems": proved(),
        "solitary_column_recovered": solitary(frame.column, cap, course),
        "weight_and_inertia": balanced(frame, cap, course),
        "start_of_one_cosine": start(settings["start"]),
    }
    table = table_of(frame, cap, course)
    shown = table.time < frame.column.frequency_parameter * pulse.duration * 3.0
    return table[shown], findings


if __name__ == "__main__":
    run(snakemake, lambda job: main(job.params.settings, cap_of(job.params.cap)))
