"""Compute the two drawings of the paper: structures to scale, and the cap beam's free body.

Every cap beam has the density and the breadth of its columns, so that its depth shows its mass.
"""

import math

import numpy as np

from replication.workbench import run
from topheavy import Column, RockingFrame
from topheavy.bodies.kinematics import cap_acceleration, cap_displacement, column_outline
from topheavy.bodies.structures import STANDARD_GRAVITY

SEAT, UPPER_LEFT = 2, 3  # corners of `column_outline`; for θ < 0 the cap rests on the upper right
CLOSENESS = 1e-12  # of the size of a column: how well cap and columns must meet


def cap_outline(frame: RockingFrame, span: float, overhang: float) -> np.ndarray:
    """Return the corners of the cap beam at rest, shape (5, 2), m, closed."""
    b, h = frame.column.half_width, frame.column.half_height
    half = span / 2.0 + b + overhang
    depth = frame.mass_ratio * 2.0 * (4.0 * b * h) / (2.0 * half)  # m_b = 2 γ m_c
    return np.array([[-half, 0], [half, 0], [half, depth], [-half, depth], [-half, 0]]) + [0, 2 * h]


def frame_outlines(
    frame: RockingFrame, rotation: float, span: float, overhang: float
) -> dict[str, np.ndarray]:
    """Return the outlines of both columns and of the cap beam on them, at θ ≤ 0."""
    column = frame.column
    moved = np.array(cap_displacement(column, rotation))  # Eqs. (4), (7)
    bodies = {"cap": cap_outline(frame, span, overhang) + moved}
    at_rest = column_outline(column, 0.0)
    for body, axis in (("left column", -span / 2.0), ("right column", span / 2.0)):
        bodies[body] = column_outline(column, rotation) + [axis, 0.0]
        gap = bodies[body][SEAT] - (at_rest[SEAT] + [axis, 0.0] + moved)
        if np.abs(gap).max() > CLOSENESS * column.size:
            raise ArithmeticError(f"the cap misses the corner of the {body} by {gap} m")
    return bodies


def forces_on_cap(frame: RockingFrame, rotation: float, ground: float, bodies: dict) -> dict:
    """Return the forces on the cap over m_b g at a turning point (θ̇ = 0, θ < 0).

    F_x and F_z, those of the columns on the cap, follow from Eqs. (12), (13), (16) and from the
    moments about the middle of the cap, which does not turn; m_b (ü_g + ü) and m_b (g + v̈) are
    drawn against them, as the paper has it.
    """
    lean = frame.slenderness + rotation
    turn = frame.frequency_parameter**2 * (math.sin(lean) - ground * math.cos(lean))  # Eq. (19)
    u, v = (float(a) for a in cap_acceleration(frame.column, rotation, 0.0, turn))
    across, along = ground + u / STANDARD_GRAVITY, 1.0 + v / STANDARD_GRAVITY
    middle = bodies["cap"][:4].mean(axis=0)
    arms = [bodies[body][SEAT] - middle for body in ("left column", "right column")]
    equations = [  # in F_x1, F_x2, F_z1, F_z2
        [-1.0, 1.0, math.tan(lean), -math.tan(lean)],  # Eq. (12)
        [1.0, 1.0, 0.0, 0.0],  # Eq. (13)
        [0.0, 0.0, 1.0, 1.0],  # Eq. (16)
        [-arms[0][1], -arms[1][1], arms[0][0], arms[1][0]],
    ]
    x1, x2, z1, z2 = np.linalg.solve(equations, [0.0, across, along, 0.0])
    if min(z1, z2) <= 0.0:
        raise ArithmeticError(f"F_z1 = {z1:.3g}, F_z2 = {z2:.3g} m_b g: the cap leaves a column")
    return {"F_x1": x1, "F_x2": x2, "F_z1": z1, "F_z2": z2, "inertia": -across, "weight": -along}


def centre_of_gravity(frame: RockingFrame, bodies: dict[str, np.ndarray]) -> np.ndarray:
    """Return the centre of gravity of columns and cap, shape (1, 2), m."""
    middles = {body: corners[:4].mean(axis=0) for body, corners in bodies.items()}
    cap = middles.pop("cap", np.zeros(2))
    columns = np.mean(list(middles.values()), axis=0)
    return np.array([columns + frame.mass_ratio * cap]) / (1.0 + frame.mass_ratio)


def rows(panel: str, frame: RockingFrame, bodies: dict[str, np.ndarray]) -> list[dict]:
    """Return the corners of every body as rows of the table, and the centre of gravity."""
    shown = bodies | {"centre of gravity": centre_of_gravity(frame, bodies)}
    return [
        {
            "panel": panel,
            "mass_ratio": frame.mass_ratio,
            "size": frame.column.size,
            "equivalent_size": frame.equivalent_size,
            "body": body,
            "x": x,
            "y": y,
        }
        for body, corners in shown.items()
        for x, y in corners
    ]


def structures(settings: dict) -> list[dict]:
    """Fig. 1: a column, a smaller similar column, and frames of that column with two cap beams."""
    column, scale = Column(**settings["column"]), settings["smaller"]
    small = Column(scale * column.half_width, scale * column.half_height)
    drawn = []
    for panel, alone in (("small column", small), ("column", column)):
        bodies = {"column": column_outline(alone, 0.0)}
        drawn += rows(panel, RockingFrame(alone, 0.0), bodies)
    for panel, gamma in settings["mass_ratios"].items():
        frame = RockingFrame(column, gamma)
        bodies = frame_outlines(frame, 0.0, settings["span"], settings["overhang"])
        drawn += rows(f"{panel} cap", frame, bodies)
    return drawn


def displaced(settings: dict) -> tuple[list[dict], list[dict]]:
    """Fig. 2: the frame at θ < 0 over the frame at rest, and the forces on its cap."""
    column = Column(settings["half_width"], settings["half_height"])
    frame = RockingFrame(column, settings["mass_ratio"])
    theta = settings["rotation"] * frame.slenderness
    if theta >= 0.0:
        raise ValueError(f"rotation is {settings['rotation']}; Fig. 2 shows θ < 0")
    at_rest = frame_outlines(frame, 0.0, settings["span"], settings["overhang"])
    bodies = frame_outlines(frame, theta, settings["span"], settings["overhang"])
    drawn = rows("at rest", frame, at_rest) + rows("displaced", frame, bodies)
    lines = []

    def arrow(panel: str, name: str, start: np.ndarray, step: tuple, value: float, unit: str):
        names = ("x", "y", "dx", "dy")
        places = dict(zip(names, (*start, *step), strict=True))
        lines.append({"panel": panel, "name": name, **places, "value": value, "unit": unit})

    u, v = (float(a) for a in cap_displacement(column, theta))
    corner = at_rest["cap"][UPPER_LEFT]
    arrow("displaced", "u", corner, (u, 0.0), u, "m")
    arrow("displaced", "v", corner + [u, 0.0], (0.0, v), v, "m")
    for body, number in (("left column", 1), ("right column", 2)):
        pivot, seat = bodies[body][0], bodies[body][SEAT]
        arrow("displaced", f"O_{number}", pivot, tuple(seat - pivot), 2.0 * column.size, "m")

    arrow("displaced", "ground", np.zeros(2), (0.0, 0.0), settings["ground_acceleration"], "g")

    # Forces in m per m_b g; the horizontal ones, being small, at a scale of their own.
    forces = forces_on_cap(frame, theta, settings["ground_acceleration"], bodies)
    up, right = settings["arrow_length"], settings["arrow_length"] * settings["horizontal_stretch"]
    seats = {"1": bodies["left column"][SEAT], "2": bodies["right column"][SEAT]}
    middle = bodies["cap"][:4].mean(axis=0)
    for name, force in forces.items():
        horizontal = name in ("F_x1", "F_x2", "inertia")
        step = (right * force, 0.0) if horizontal else (0.0, up * force)
        arrow("free body", name, seats.get(name[-1], middle), step, force, "m_b g")
    return drawn, lines


def main(settings: dict) -> tuple[list[dict], list[dict]]:
    outlines, free_body = displaced(settings["displaced"])
    return structures(settings) + outlines, free_body


if __name__ == "__main__":
    run(snakemake, lambda job: main(job.params.settings))
