"""What one pulse does to column, vase, frame and portal: outlines of the bodies, to scale."""

import math
from collections.abc import Iterator

import numpy as np

from topheavy import Column, FixedMassColumn, MonolithicPortal, Pulse, RockingFrame, simulate
from topheavy.bodies.kinematics import outlines
from topheavy.bodies.structures import Structure

FALL = (0.0, 0.15, 0.4, 0.7, 1.0)  # of the last rotation: poses of what overturns
CLOSENESS = 1e-9  # m: how far a body may be in the ground


def lying(column: Column, corners: np.ndarray) -> float:
    """Return the rotation (rad) at which a corner of an overturning body meets the ground.

    The corners turn with the column about its right corner.
    """
    raised = corners[corners[:, 1] > 0.0]
    return float(np.min(math.pi / 2.0 - np.arctan2(raised[:, 0] - column.half_width, raised[:, 1])))


def bodies(structure: Structure, rotation: float, settings: dict) -> dict[str, np.ndarray]:
    """Return the outlines of the bodies of a structure that has rocked by θ."""
    columns = 2.0 if isinstance(structure, RockingFrame | MonolithicPortal) else 1.0
    width = settings["cap"]["width"] * columns
    return outlines(structure, rotation, width, settings["cap"]["depth"])


def rotations(structure: Structure, pulse: Pulse, settings: dict) -> tuple[str, list[float]]:
    """Return the outcome, and the rotations that are drawn, the last one last.

    Of a structure that survives these are its largest rotations to both sides, if any, and 0.
    """
    times = np.linspace(0.0, 6.0 * pulse.duration, 4001)
    response = simulate(structure, pulse, samples=times)
    if not response.overturned:
        theta = response.rotation
        return response.outcome, [*sorted({float(theta.min()), float(theta.max())} - {0.0}), 0.0]
    if isinstance(structure, RockingFrame | MonolithicPortal):
        kind = "frame" if isinstance(structure, RockingFrame) else "portal"
        raise ValueError(
            f"vase.picture: the {kind} overturns at {pulse.amplitude:.6g} g; expected amplitudes "
            "that it survives, since its bodies part when it falls"
        )
    seen = response.rotation[~np.isnan(response.rotation)]
    column = structure if isinstance(structure, Column) else structure.column
    corners = np.concatenate(list(bodies(structure, 0.0, settings).values()))
    last = math.copysign(lying(column, corners), seen[-1])
    return response.outcome, [last * share for share in FALL]


def poses(column: Column, settings: dict) -> Iterator[dict]:
    """Yield a row for each corner of each body of each pose."""
    gamma, cap = settings["picture"]["mass_ratio"], settings["cap"]
    structures = {
        "bare": column,
        "fixed": FixedMassColumn(column, gamma, cap["width"], cap["depth"]),
        "free": RockingFrame(column, gamma),
        "portal": MonolithicPortal(
            column, gamma, 2.0 * (cap["width"] - column.half_width), cap["depth"]
        ),
    }
    for amplitude in settings["picture"]["amplitudes"]:
        pulse = Pulse("one-cosine", amplitude, 2.0 * math.pi / settings["period"])
        for name, structure in structures.items():
            outcome, drawn = rotations(structure, pulse, settings)
            for pose, rotation in enumerate(drawn):
                for body, outline in bodies(structure, rotation, settings).items():
                    if outline[:, 1].min() < -CLOSENESS:
                        raise ArithmeticError(f"{name}: the {body} is in the ground")
                    for x, y in outline:
                        yield {
                            "amplitude": amplitude,
                            "mass_ratio": gamma,
                            "structure": name,
                            "outcome": outcome,
                            "pose": pose,
                            "rotation": rotation,
                            "last": pose == len(drawn) - 1,
                            "body": body,
                            "x": x,
                            "y": y,
                        }
