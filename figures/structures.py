"""The paper's Fig. 1: four structures to scale in order of stability, and their moment."""

from matplotlib.patches import Polygon

from figures.drawing import gamma
from figures.palette import CAP, FORCE, STONE
from replication.drawing import DOUBLE, GREY, INK, PAPER, letter, make_figure, note, shades, sheet

GAP = 2.6  # m between the structures


def structure(axis, parts, middle):
    """Draw the bodies of one structure about a place on the ground, and its centre of gravity."""
    for body, part in parts.groupby("body"):
        x, y = part.x + middle, part.y
        if body == "centre of gravity":
            axis.plot(x, y, "o", color=PAPER, markeredgecolor=FORCE, markersize=4.5)
            axis.plot(x, y, ".", color=FORCE, markersize=2)
        else:
            face = CAP if body == "cap" else STONE
            corners = list(zip(x, y, strict=True))
            axis.add_patch(Polygon(corners, facecolor=face, edgecolor=INK, linewidth=0.8))


def name(panel, first, whole):
    """Return what is written under a structure."""
    if first.mass_ratio == 0.0:
        size = first["size"] / whole
        return f"{panel}\n" + ("size $R$" if size == 1.0 else f"{size:g}$\\,R$")
    enlarged = first.equivalent_size / whole
    return f"{panel}, {gamma(first.mass_ratio)}\nrocks as a column of {enlarged:.2f}$\\,R$"


def draw(outlines, moment_rotation):
    figure, (left, right) = sheet(DOUBLE, 60, ncols=2, width_ratios=(2.1, 1))
    column = outlines[outlines.panel == "column"]
    edge, whole = 0.0, column["size"].iloc[0]
    for panel in ("small column", "column", "light cap", "heavy cap"):
        parts = outlines[outlines.panel == panel]
        middle = edge - parts.x.min()
        structure(left, parts, middle)
        note(left, name(panel, parts.iloc[0], whole), (middle, -0.5), ha="center", va="top")
        if panel == "column":
            left.plot(
                [edge, middle], [0, column.y.max() / 2], color=GREY, linewidth=0.8, zorder=1.5
            )
            note(left, "$R$", (middle + 0.05, 0.8), color=GREY)
        edge = middle + parts.x.max() + GAP
    left.plot([-GAP, edge], [0, 0], color=INK, linewidth=1.2)
    left.plot(0, 8.2, "o", color=PAPER, markeredgecolor=FORCE, markersize=4.5)
    left.plot(0, 8.2, ".", color=FORCE, markersize=2)
    note(left, "centre of gravity", (0.45, 8.2), color=FORCE)
    left.set(xlim=(-GAP, edge), aspect="equal", anchor="N")
    left.axis("off")

    right.axhline(0, color=GREY, linewidth=0.6)
    curves = moment_rotation.groupby("mass_ratio")
    for (mass_ratio, curve), colour in zip(curves, shades(len(curves)), strict=True):
        right.plot(curve.rotation_fraction, curve.moment, color=colour)
        text = r"column, $\sin\alpha$" if mass_ratio == 0.0 else gamma(mass_ratio)
        note(right, text, (-0.05, curve.moment.max()), ha="right")
    right.set(xlabel=r"Rotation, $\theta/\alpha$ (–)", ylabel=r"Moment, $M/m_\mathrm{c}gR$ (–)")
    letter(
        [left, right],
        ["Drawn to scale; ranking claimed in the paper", "Restoring moment of one column"],
    )
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
