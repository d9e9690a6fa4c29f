"""The paper's Fig. 2: the frame at θ < 0, by Eqs. (4) and (7), and the forces on its cap beam."""

import math

from matplotlib.patches import Arc, Polygon

from figures.palette import CAP, FORCE, STONE
from replication.drawing import DOUBLE, GREY, INK, letter, make_figure, note, sheet

SET_OFF = 0.14  # m, between the cap and what is drawn beside it
FORCES = {  # name; label and its place beside the arrow's free end, in points
    "F_x1": ("$F_{x1}$", (-15, -6)),
    "F_x2": ("$F_{x2}$", (9, 0)),
    "F_z1": ("$F_{z1}$", (0, -6)),
    "F_z2": ("$F_{z2}$", (0, -6)),
    "inertia": (r"$m_\mathrm{b}(\ddot{u}_g+\ddot{u})$", (-21, 0)),
    "weight": (r"$m_\mathrm{b}(g+\ddot{v})$", (18, 4)),
}


def outline(axis, corners, **look):
    axis.add_patch(Polygon(corners[["x", "y"]], **{"edgecolor": INK, "linewidth": 0.8} | look))


def arrow(axis, start, step, colour=FORCE, style="-|>"):
    """Draw an arrow at its true length, and return where it ends."""
    tip = (start[0] + step[0], start[1] + step[1])
    look = {"arrowstyle": f"{style},head_length=0.35,head_width=0.13", "color": colour}
    look |= {"linewidth": 1.0, "shrinkA": 0, "shrinkB": 0, "mutation_scale": 10}
    axis.annotate("", tip, start, arrowprops=look, zorder=4)
    return tip


def rotation(axis, outlines, lines):
    """Draw the frame at rest (dashed) and displaced, with u, v, the pivots and a diagonal."""
    aside = {"textcoords": "offset points"}
    faces = {"cap": CAP, "left column": STONE, "right column": STONE}
    for name, face in faces.items():
        for panel, look in (
            ("at rest", {"facecolor": "none", "edgecolor": GREY, "linestyle": (0, (3, 2))}),
            ("displaced", {"facecolor": face}),
        ):
            outline(axis, outlines[(outlines.panel == panel) & (outlines.body == name)], **look)
    axis.plot([-2.9, 2.5], [0, 0], color=INK, linewidth=1.2, zorder=0.5)
    for name in ("O_1", "O_2"):
        pivot = lines.loc[name]
        axis.plot(pivot.x, pivot.y, "o", color=FORCE, markersize=3.5, zorder=4)
        note(axis, f"${name}$", (pivot.x, pivot.y), xytext=(-2, -8), ha="center", **aside)
        axis.plot(
            pivot.x + pivot.dx, pivot.y + pivot.dy, "o", color=FORCE, markersize=3.5, zorder=4
        )
        axis.plot([pivot.x] * 2, [0, 1.55], color=GREY, linewidth=0.6, linestyle=(0, (2, 2)))
    axis.plot([pivot.x, pivot.x + pivot.dx], [0, pivot.dy], color=GREY, linewidth=0.8)
    note(axis, "$2R$", (pivot.x + 0.78 * pivot.dx, 0.78 * pivot.dy), xytext=(-13, 3), **aside)
    lean = math.degrees(math.atan2(pivot.dx, pivot.dy))
    axis.add_patch(Arc((pivot.x, 0), 2.0, 2.0, theta1=90 - lean, theta2=90, color=FORCE))
    note(
        axis,
        r"$\alpha+\theta$",
        (pivot.x + 0.4 * pivot.dx, 0.95),
        xytext=(2, -3),
        color=FORCE,
        **aside,
    )
    edge = outlines[(outlines.panel == "displaced") & (outlines.body == "left column")].iloc[[0, 3]]
    tilt = math.degrees(math.atan2(edge.x.iloc[0] - edge.x.iloc[1], edge.y.iloc[1]))
    pivot = lines.loc["O_1"]
    axis.add_patch(Arc((pivot.x, 0), 2.8, 2.8, theta1=90, theta2=90 + tilt, color=FORCE))
    note(axis, r"$\theta$", (pivot.x, 1.4), xytext=(-9, -5), color=FORCE, **aside)
    u, v = lines.loc["u"], lines.loc["v"]
    above, beside = v.y + v.dy + SET_OFF, v.x - SET_OFF
    for x, y in ((u.x, u.y), (v.x, v.y + v.dy)):
        axis.plot([x, x], [y, above + 0.08], color=GREY, linewidth=0.5)
    for y, x in ((v.y, u.x), (v.y + v.dy, v.x)):
        axis.plot([beside - 0.08, x], [y, y], color=GREY, linewidth=0.5)
    arrow(axis, (u.x, above), (u.dx, 0.0))
    arrow(axis, (beside, v.y), (0.0, v.dy))
    note(axis, "$u$", (u.x + u.dx / 2, above), xytext=(0, 6), ha="center", color=FORCE, **aside)
    note(axis, "$v$", (beside, v.y + v.dy / 2), xytext=(-9, 0), color=FORCE, **aside)
    arrow(axis, (0.9, -0.3), (0.7, 0.0), INK)
    note(axis, r"positive $\ddot{u}_g$", (1.67, -0.3))


def forces(axis, cap, lines, ground):
    """Draw the cap beam and the forces on it, to scale, over their values."""
    outline(axis, cap, facecolor=CAP)
    values = []
    for name, (text, aside) in FORCES.items():
        force = lines.loc[name]
        start, step = (force.x, force.y), (force.dx, force.dy)
        if name.startswith("F_x"):
            start = (start[0] + SET_OFF / 2, start[1] - SET_OFF)
        if name.startswith("F_z"):  # it pushes: its tip is where it acts
            axis.plot(*start, "o", color=FORCE, markersize=3.5, zorder=4)
            start = free = (start[0], start[1] - force.dy)
            arrow(axis, start, step)
        else:
            free = arrow(axis, start, step)
        how = {"ha": "center", "textcoords": "offset points", "color": FORCE}
        note(axis, text, free, xytext=aside, **how)
        values.append(f"{text} = {abs(force.value):.3f}")
    stretch = (lines.dx / lines.value)["F_x1"] / (lines.dy / lines.value)["F_z1"]
    shaken = f"$\\ddot{{u}}_g$ = {ground:g}$\\,g$".replace("-", "−")
    words = [f"At a turning point under {shaken}, in $m_\\mathrm{{b}}g$:"]
    words += ["    ".join(values[first : first + 2]) for first in (0, 2, 4)]
    words += [f"Arrows to scale, horizontal ones $\\times$ {stretch:g}."]
    note(axis, "\n".join(words), (cap.x.mean(), 0.62), ha="center", color=GREY, linespacing=1.5)


def draw(outlines, free_body):
    figure, (left, right) = sheet(DOUBLE, 64, ncols=2)
    lines = free_body.set_index("name")
    rotation(left, outlines, lines[lines.panel == "displaced"])
    cap = outlines[(outlines.panel == "displaced") & (outlines.body == "cap")]
    forces(right, cap, lines[lines.panel == "free body"], lines.loc["ground"].value)
    for axis, span in ((left, (-3.0, 2.6)), (right, (-3.4, 2.2))):
        axis.set(xlim=span, ylim=(-0.5, 3.5), aspect="equal")
        axis.axis("off")
    letter([left, right], [r"Frame at $\theta < 0$ and at rest (dashed)", "Cap beam, free body"])
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
