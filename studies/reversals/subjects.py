"""What this study puts under its synthetic motions, at which levels of p PGV/(g tan α)."""

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from steps.shared.sweep import Asked, Subject
from steps.vase_searches import rivals
from topheavy import STANDARD_GRAVITY, Column, RockingFrame
from topheavy.bodies.structures import size_ratio

Settings = Mapping[str, Any]
VASE = "vase"


def unit(column: Column) -> float:
    """Return the PGV in m/s at p PGV/(g tan α) = 1."""
    return STANDARD_GRAVITY * column.uplift_acceleration / column.frequency_parameter


def intensities(settings: Settings) -> NDArray[np.float64]:
    """Return the levels of p PGV/(g tan α), in equal ratios."""
    spec = settings["intensities"]
    return np.geomspace(spec["lowest"], spec["highest"], spec["points"])


def frames_and_columns(settings: Settings, structures: Settings) -> dict[str, Asked]:
    """Return by structure its frames, and solitary columns as large as R̂ of some.

    The levels are those of the solitary column of the structure, for all. Some structures are put
    under a share of the motions: the first ones.
    """
    each, found = settings["runs"][settings["run"]]["motions"], {}
    for entry in settings["cases"]:
        name, column = entry["structure"], Column(**structures[entry["structure"]])
        alike = {"structure": name}
        subjects = [
            Subject(alike | {"mass_ratio": g, "as_large_as": 0.0}, RockingFrame(column, g).block())
            for g in entry["mass_ratios"]
        ]
        for gamma in settings["as_large_as"]:
            ratio = size_ratio(gamma)
            larger = Column(ratio * column.half_width, ratio * column.half_height)
            labels = alike | {"mass_ratio": 0.0, "as_large_as": gamma}
            subjects.append(Subject(labels, larger.block()))
        levels = unit(column) * intensities(settings)
        found[name] = Asked(subjects, levels, math.ceil(entry["share"] * each))
    return found


def vase_and_frame(settings: Settings) -> Asked:
    """Return the bare column, and with each mass fixed to it or carried freely."""
    column = Column(**settings["column"])
    subjects = [
        Subject({"structure": name, "mass_ratio": gamma}, structure.block())
        for name, gamma, structure in rivals(column, settings["mass_ratios"])
    ]
    return Asked(subjects, unit(column) * intensities(settings), settings["motions"])


def questions(motions: Settings, structures: Settings, vase: Settings) -> dict[str, Asked]:
    """Return all that this study asks of the ensemble, by name."""
    return frames_and_columns(motions, structures) | {VASE: vase_and_frame(vase)}
