"""The rocking frame at rest and at a rotation, to scale, with the quantities that describe it."""

import math

from matplotlib.patches import Arc

from figures.free_body import arrow, outline
from figures.palette import CAP, FORCE, STONE
from replication.drawing import GREY, INK, PAPER, SINGLE, make_figure, note, sheet

FACES = {"cap": CAP, "left column": STONE, "right column": STONE}
REST = {"facecolor": "none", "edgecolor": GREY, "linestyle": (0, (3, 2))}
MASSES = {"cap": r"$m_\mathrm{b}$", "left column": r"$m_\mathrm{c}$"}
EXTENT = {"arrowstyle": "<|-|>", "color": INK, "linewidth": 0.7, "shrinkA": 0, "shrinkB": 0}
OFF = 0.22  # m between the frame and an extent beside it


def extent(axis, words, start, end, off):
    """Draw how far it is from one point to another, beside both, with its name in a gap."""
    ends = [(x + off[0], y + off[1]) for x, y in (start, end)]
    for point, other in zip((start, end), ends, strict=True):
        axis.plot(*zip(point, other, strict=True), color=GREY, linewidth=0.5)
    axis.annotate("", *ends, arrowprops=EXTENT | {"mutation_scale": 6})
    middle = [sum(parts) / 2 for parts in zip(*ends, strict=True)]
    note(axis, words, middle, ha="center", bbox={"facecolor": PAPER, "edgecolor": "none", "pad": 1})


def angle(axis, words, pivot, radius, first, last):
    """Draw an angle at a pivot, between two directions in degrees, with its name outside of it."""
    axis.add_patch(Arc(pivot, 2 * radius, 2 * radius, theta1=first, theta2=last, color=FORCE))
    toward = math.radians((first + last) / 2)
    out = [(radius + 0.15) * part for part in (math.cos(toward), math.sin(toward))]
    note(axis, words, (pivot[0] + out[0], pivot[1] + out[1]), ha="center", color=FORCE)


def draw(outlines, free_body):
    lines = free_body[free_body.panel == "displaced"].set_index("name")
    corners = {key: part[["x", "y"]] for key, part in outlines.groupby(["panel", "body"])}
    figure, axis = sheet(SINGLE, 66)
    for body, face in FACES.items():
        outline(axis, corners["at rest", body], **REST)
        outline(axis, corners["displaced", body], facecolor=face)
        if body in MASSES:
            middle = corners["displaced", body][:4].mean()
            note(axis, MASSES[body], middle, ha="center")
    axis.plot([-2.6, 2.5], [0, 0], color=INK, linewidth=1.2, zorder=0.5)
    for name in ("O_1", "O_2"):
        pivot = (lines.x[name], lines.y[name])
        axis.plot(*pivot, "o", color=FORCE, markersize=3.5, zorder=4)
    left = lines.x["O_1"]
    note(axis, "pivot", (left, -0.17), ha="center", color=FORCE)
    axis.plot([left, left], [0, 1.55], color=GREY, linewidth=0.6, linestyle=(0, (2, 2)))
    column = corners["displaced", "right column"][:4]
    middle, edge = column.mean(), column.iloc[3] - column.iloc[0]
    axis.plot([pivot[0], middle.x], [pivot[1], middle.y], color=INK, linewidth=0.8, zorder=3)
    axis.plot(*middle, "o", color=INK, markersize=2.5, zorder=4)
    note(axis, "$R$", (pivot[0] + 0.72 * (middle.x - pivot[0]) + 0.11, 0.8 * middle.y), ha="center")
    side = math.degrees(math.atan2(edge.y, edge.x))
    diagonal = math.degrees(math.atan2(middle.y - pivot[1], middle.x - pivot[0]))
    angle(axis, r"$\alpha$", pivot, 0.75, diagonal, side)
    angle(axis, r"$\theta$", (left, 0.0), 1.3, 90.0, side)
    rest = corners["at rest", "right column"]
    extent(axis, "$2h$", tuple(rest.iloc[1]), tuple(rest.iloc[2]), (2 * OFF, 0))
    extent(axis, "$2b$", tuple(rest.iloc[0]), tuple(rest.iloc[1]), (0, -OFF))
    arrow(axis, (-2.55, -0.42), (0.6, 0.0), INK)
    note(axis, r"acceleration $\ddot{u}_g$ of the ground", (-1.87, -0.42))
    axis.set(xlim=(-2.6, 2.5), ylim=(-0.5, 3.2), aspect="equal")
    axis.axis("off")
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
