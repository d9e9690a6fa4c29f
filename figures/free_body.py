"""The paper's Fig. 2: the frame at θ < 0, by Eqs. (4) and (7), and the forces on its cap beam."""

import math

import numpy as np
from matplotlib.patches import Arc, Polygon
from palette import CAP, FORCE, GREY, INK, STONE

from replication.drawing import SINGLE, letter, note, sheet
from topheavy import STANDARD_GRAVITY, Column, RockingFrame
from topheavy.bodies.kinematics import cap_acceleration, cap_displacement, column_outline

FRAME = RockingFrame(Column(0.45, 1.20), 0.5)  # m; stocky, so that the lift v can be seen
SPAN, OVERHANG = 2.4, 0.2  # m
THETA = -0.6 * FRAME.slenderness
GROUND = -0.1  # g, at the turning point that is drawn
SEAT, UPPER_LEFT = 2, 3  # corners of `column_outline`; for θ < 0 the cap rests on the upper right
UP, RIGHT = 1.0, 5.0  # m in the drawing for a vertical and a horizontal force of the cap's weight
SET_OFF = 0.14  # m, between the cap and what is drawn beside it
AXES = (-SPAN / 2, SPAN / 2)
LABELS = {  # text of a force, and its place beside the free end of the arrow, points
    "F_x1": ("$F_{x1}$", (-12, -6)),
    "F_x2": ("$F_{x2}$", (9, 0)),
    "F_z1": ("$F_{z1}$", (0, -6)),
    "F_z2": ("$F_{z2}$", (0, -6)),
    "inertia": (r"$m_\mathrm{b}(\ddot{u}_g+\ddot{u})$", (-58, 0)),
    "weight": (r"$m_\mathrm{b}(g+\ddot{v})$", (18, 4)),
}


def outlines(theta):
    """Return the corners of both columns and of the cap beam on them, m."""
    b, h = FRAME.column.half_width, FRAME.column.half_height
    half = SPAN / 2 + b + OVERHANG
    depth = (
        FRAME.mass_ratio * 2 * (4 * b * h) / (2 * half)
    )  # the beam has the density of the columns
    cap = np.array([[-half, 0], [half, 0], [half, depth], [-half, depth]]) + [0, 2 * h]
    columns = [column_outline(FRAME.column, theta) + [axis, 0.0] for axis in AXES]
    return [cap + np.array(cap_displacement(FRAME.column, theta)), *columns]


def forces_on_cap(cap, columns):
    """Return where each force acts and its size over m_b g, at a turning point (θ̇ = 0, θ < 0)."""
    lean = FRAME.slenderness + THETA
    turn = FRAME.frequency_parameter**2 * (math.sin(lean) - GROUND * math.cos(lean))  # Eq. (19)
    u, v = (float(a) for a in cap_acceleration(FRAME.column, THETA, 0.0, turn))
    across, along = GROUND + u / STANDARD_GRAVITY, 1.0 + v / STANDARD_GRAVITY
    middle, seats = cap.mean(axis=0), [column[SEAT] for column in columns]
    arms = [seat - middle for seat in seats]
    equations = [  # in F_x1, F_x2, F_z1, F_z2
        [-1.0, 1.0, math.tan(lean), -math.tan(lean)],  # Eq. (12)
        [1.0, 1.0, 0.0, 0.0],  # Eq. (13)
        [0.0, 0.0, 1.0, 1.0],  # Eq. (16)
        [-arms[0][1], -arms[1][1], arms[0][0], arms[1][0]],  # moments: the cap beam does not turn
    ]
    x1, x2, z1, z2 = np.linalg.solve(equations, [0.0, across, along, 0.0])
    return {
        "F_x1": (seats[0], x1),
        "F_x2": (seats[1], x2),
        "F_z1": (seats[0], z1),
        "F_z2": (seats[1], z2),
        "inertia": (middle, -across),
        "weight": (middle, -along),
    }


def arrow(axis, start, step, colour=FORCE):
    """Draw an arrow at its true length, and return where it ends."""
    tip = (start[0] + step[0], start[1] + step[1])
    look = {"arrowstyle": "-|>,head_length=0.35,head_width=0.13", "color": colour}
    look |= {"linewidth": 1.0, "shrinkA": 0, "shrinkB": 0, "mutation_scale": 10}
    axis.annotate("", tip, start, arrowprops=look, zorder=4)
    return tip


def draw_body(axis, corners, **look):
    axis.add_patch(Polygon(corners, **{"edgecolor": INK, "linewidth": 0.8} | look))


def angle(axis, pivot, radius, first, last, words, place, aside):
    axis.add_patch(Arc(pivot, 2 * radius, 2 * radius, theta1=first, theta2=last, color=FORCE))
    note(axis, words, place, aside, color=FORCE)


def rotation(axis, at_rest, moved):
    """Draw the frame at rest (dashed) and displaced, with u, v, the pivots and a diagonal."""
    for before, after, face in zip(at_rest, moved, (CAP, STONE, STONE), strict=True):
        draw_body(axis, before, facecolor="none", edgecolor=GREY, linestyle=(0, (3, 2)))
        draw_body(axis, after, facecolor=face)
    axis.plot([-2.9, 2.5], [0, 0], color=INK, linewidth=1.2, zorder=0.5)
    for number, column in enumerate(moved[1:], start=1):
        pivot, seat = column[0], column[SEAT]
        for point in (pivot, seat):
            axis.plot(*point, "o", color=FORCE, markersize=3.5, zorder=4)
        note(axis, f"$O_{number}$", tuple(pivot), (-2, -8), ha="center")
        axis.plot([pivot[0]] * 2, [0, 1.55], color=GREY, linewidth=0.6, linestyle=(0, (2, 2)))
    dx, dy = seat - pivot
    axis.plot([pivot[0], seat[0]], [0, seat[1]], color=GREY, linewidth=0.8)
    note(axis, "$2R$", (pivot[0] + 0.78 * dx, 0.78 * dy), (-13, 3))
    lean, tilt = math.degrees(math.atan2(dx, dy)), math.degrees(-THETA)
    beside = (pivot[0] + 0.4 * dx, 0.95)
    angle(axis, tuple(pivot), 1.0, 90 - lean, 90, r"$\alpha+\theta$", beside, (2, -3))
    left = moved[1][0]
    angle(axis, tuple(left), 1.4, 90, 90 + tilt, r"$\theta$", (left[0], 1.4), (-9, -5))

    (x, y), (right, top) = at_rest[0][UPPER_LEFT], moved[0][UPPER_LEFT]
    above, beside = top + SET_OFF, right - SET_OFF
    for place, low in ((x, y), (right, top)):
        axis.plot([place, place], [low, above + 0.08], color=GREY, linewidth=0.5)
    for level, end in ((y, x), (top, right)):
        axis.plot([beside - 0.08, end], [level, level], color=GREY, linewidth=0.5)
    arrow(axis, (x, above), (right - x, 0.0))
    arrow(axis, (beside, y), (0.0, top - y))
    note(axis, "$u$", ((x + right) / 2, above), (0, 6), ha="center", color=FORCE)
    note(axis, "$v$", (beside, (y + top) / 2), (-9, 0), color=FORCE)
    arrow(axis, (0.9, -0.3), (0.7, 0.0), INK)
    note(axis, r"positive $\ddot{u}_g$", (1.67, -0.3))


def forces(axis, cap, columns):
    """Draw the cap beam and the forces on it, to scale."""
    draw_body(axis, cap, facecolor=CAP)
    for name, (place, size) in forces_on_cap(cap, columns).items():
        text, aside = LABELS[name]
        start = tuple(place)
        if name.startswith("F_z"):  # it pushes: its tip is where it acts
            axis.plot(*start, "o", color=FORCE, markersize=3.5, zorder=4)
            free = (start[0], start[1] - UP * size)
            arrow(axis, free, (0.0, UP * size))
        elif name == "weight":
            free = arrow(axis, start, (0.0, UP * size))
        else:
            if name.startswith("F_x"):
                start = (start[0] + SET_OFF / 2, start[1] - SET_OFF)
            free = arrow(axis, start, (RIGHT * size, 0.0))
        note(axis, text, free, aside, ha="center", color=FORCE)
    shaken = f"$\\ddot{{u}}_g$ = {GROUND:g}$\\,g$".replace("-", "−")
    words = f"{shaken}; horizontal arrows $\\times$ {RIGHT / UP:g}"
    note(axis, words, (cap[:, 0].mean(), 1.1), ha="center", color=GREY)


def draw():
    figure, (left, right) = sheet(1.6 * SINGLE, 50, ncols=2)  # printed in one column
    at_rest, moved = outlines(0.0), outlines(THETA)
    rotation(left, at_rest, moved)
    forces(right, moved[0], moved[1:])
    for axis, span in ((left, (-3.0, 2.6)), (right, (-3.4, 2.2))):
        axis.set(xlim=span, ylim=(-0.5, 3.5), aspect="equal")
        axis.axis("off")
    letter([left, right], [r"Frame at $\theta < 0$ and at rest (dashed)", "Cap beam, free body"])
    return figure
