"""The trilith on contacts with gaps at the corners, shaken below its uplift acceleration."""

import math
from itertools import product

import numpy as np
import pandas as pd

from replication.step import check, run, truth
from steps.beyond.rigid_bodies import Bodies, checked_version, motion
from steps.shared.cases import cap_of
from topheavy import STANDARD_GRAVITY, Column

ROTATIONS = {"in_plane": (0, 2), "yaw": (1, 0)}  # places of their sines in a rotation matrix


def compute(settings, structures, trilith):
    """Return the largest rotations of a column (degrees) in the last two thirds of each draw."""
    column, rows, version = Column(**structures["trilith"]), [], checked_version()
    cap, omega = cap_of(settings["cap"]), 2.0 * math.pi * trilith["table_frequency"]
    peak = trilith["table_amplitude"] * omega**2 / STANDARD_GRAVITY

    def ground(time):
        return peak * np.minimum(time / settings["ramp"], 1.0) * np.sin(omega * time)

    cases = [*product(settings["depths"], settings["gaps"], [{}])]
    cases += [(*cases[-1][:2], changed) for changed in settings["checks"]]
    for depth, gap, changed in cases:
        solver = {name: settings[name] for name in ("time_step", "friction")} | changed
        for draw in range(settings["draws"] if gap else 1):
            random = np.random.default_rng([settings["seed"], draw])
            gaps = random.uniform(0, 1e-3 * gap, (2, 4, 2))
            bodies = Bodies(column, 0.5 * depth, trilith["mass_ratio"], cap, gaps=gaps, **solver)
            looks = [turned for _, turned in motion(bodies, ground, settings["duration"])]
            late = np.abs(looks[len(looks) // 3 :]).max(axis=(0, 1))
            largest = {n: math.degrees(math.asin(late[place])) for n, place in ROTATIONS.items()}
            rows.append({"depth": depth, "gap_mm": gap, **solver, "draw": draw} | largest)
    return pd.DataFrame(rows).assign(solver=version)


def findings(gaps, settings):
    """Return whether gaps make most draws rock and turn, and contacts without gaps none."""
    rocks = gaps.assign(rocks=gaps.in_plane > settings["rocking"])
    usual = (gaps.time_step == settings["time_step"]) & (gaps.friction == settings["friction"])
    again = rocks[~usual].groupby(["time_step", "friction"]).rocks.mean()
    check((again > 0.5).all(), f"another time step or friction: shares that rock are {[*again]}")
    by_gap = rocks[usual].pivot_table("rocks", "gap_mm", "depth")
    still, most = by_gap[(by_gap == 0.0).all(axis=1)], by_gap[(by_gap > 0.5).all(axis=1)]
    rocking = rocks[usual & rocks.rocks]
    return {
        "gaps_make_it_rock": truth(
            0.0 in still.index and len(most) > 0 and rocking.yaw.median() > settings["rocking"],
            still_up_to=still.index.max(),
            most_rock_from=most.index.min() if len(most) else 0.0,
            draws=settings["draws"],
        )
    }


if __name__ == "__main__":
    run(snakemake, compute, findings)
