"""The paper's Fig. 1: four structures with their minima, their restoring moment and inertia."""

from itertools import cycle

from matplotlib.patches import Rectangle
from palette import CAP, FIXED, FORCE, GREY, INK, STONE

from replication.drawing import DOUBLE, STROKES, beside, gamma, letter, note, ring, shaded

# Distances between structures and between axes of columns, and overhang of the cap beam, m
GAP, SPAN, OVERHANG = 6.4, 5.0, 0.5


def bodies(row):
    """Return the rectangles of a structure about its middle: left, bottom, width, height, colour.

    The cap beam has the density and breadth of its columns, so that its depth shows its mass.
    """
    b, h = row.half_width, row.half_height
    if row.mass_ratio == 0.0:
        return [(-b, 0.0, 2 * b, 2 * h, STONE)]
    half = SPAN / 2 + b + OVERHANG
    depth = row.mass_ratio * 2 * (4 * b * h) / (2 * half)  # m_b = 2 γ m_c
    columns = [(axis - b, 0.0, 2 * b, 2 * h, STONE) for axis in (-SPAN / 2, SPAN / 2)]
    return [*columns, (-half, 2 * h, 2 * half, depth, CAP)]


def words(row, whole):
    """Return the text below a structure."""
    height, width = 2 * row.half_height, 2 * row.half_width
    name = f"column\n{height:g} m × {width:g} m"
    if row.mass_ratio:
        name = f"frame\n{gamma(row.mass_ratio)}"
    size = r"$\hat{R}$" if row.mass_ratio else "size"
    minimum = f"$\\mathbf{{{row.minimum_overturning:.3f}}}\\,g$"
    return f"{name}\n{size} = {row.equivalent_size / whole:.3g}$\\,R$\n{minimum}"


def centre_of_gravity(axis, x, y):
    ring(axis, x, y, FORCE, 4.5)
    axis.plot(x, y, ".", color=FORCE, markersize=2)


def structures(axis, table, top):
    edge, whole = 0.0, table.equivalent_size[table.structure == "column"].iloc[0]
    for row in table.itertuples():
        parts = bodies(row)
        half = -min(left for left, *_ in parts)
        middle = edge + half
        for left, bottom, width, height, face in parts:
            look = {"facecolor": face, "edgecolor": INK, "linewidth": 0.8}
            axis.add_patch(Rectangle((middle + left, bottom), width, height, **look))
        areas = [width * height for *_, width, height, _ in parts]
        levels = [bottom + height / 2 for _, bottom, _, height, _ in parts]
        moments = (area * level for area, level in zip(areas, levels, strict=True))
        centre_of_gravity(axis, middle, sum(moments) / sum(areas))
        note(axis, words(row, whole), (middle, -0.6), ha="center", va="top")
        edge = middle + half + GAP
    ends = -GAP / 2, edge - GAP / 2
    axis.plot(ends, [0, 0], color=INK, linewidth=1.2)
    level = table.uplift_acceleration.iloc[0]
    text = f"minimum overturning acceleration; all uplift at $g\\,\\tan\\alpha$ = {level:.3f}$\\,g$"
    note(axis, text, (sum(ends) / 2, -10.6), ha="center", color=GREY)
    centre_of_gravity(axis, 0, 11.5)
    note(axis, "centre of gravity", (0.7, 11.5), color=FORCE)
    axis.set(xlim=ends, ylim=(-11.5, top + 0.6), aspect="equal", anchor="NW")
    axis.axis("off")


def curves(axis, table, column):
    """Draw a column of the table against the rotation, over its value for the column at uplift.

    The value of each structure at uplift is a tick, with the name of the structure.
    """
    groups = table.groupby(["mass", "mass_ratio"])
    unit = groups.get_group(("loose", 0.0))[column].max()
    colours = dict(shaded(sorted(table.mass_ratio[table.mass == "loose"].unique())))
    starts = []
    for ((mass, ratio), curve), stroke in zip(groups, cycle(STROKES[-1:] + STROKES[:-1])):
        colour = FIXED if mass == "fixed" else colours[ratio]
        name = gamma(ratio) if ratio else "column"
        heights = curve[column] / unit
        axis.plot(curve.rotation_over_alpha, heights, color=colour, linestyle=stroke)
        starts.append((heights.max(), colour, f"fixed, {name}" if mass == "fixed" else name))
    axis.set_yticks([0, *(start for start, *_ in starts)])
    axis.set_yticklabels(["0", *(f"{name}:  {start:.2g}" for start, _, name in starts)])
    for label, (_, colour, _) in zip(axis.get_yticklabels()[1:], starts, strict=True):
        label.set_color(colour)
    axis.set(xlim=(0, 1.03), ylim=(0, None), xticks=(0, 0.5, 1))
    axis.set_xlabel(r"Rotation, $\theta/\alpha$ (–)")


def draw(four_structures, moment_rotation):
    every = [part for row in four_structures.itertuples() for part in bodies(row)]
    top = max(11.5, *(bottom + height for _, bottom, _, height, _ in every))
    tall = 62 * max(1.0, (top + 10) / 23)  # mm, so that words below a high beam keep their places
    figure, axes = beside(DOUBLE, tall, (1.75, 0.8, 1.2))
    structures(axes[0], four_structures, top)
    curves(axes[1], moment_rotation, "moment")
    axes[1].set_ylabel(r"$M/m_\mathrm{c}gR\,\sin\alpha$ (–)")
    curves(axes[2], moment_rotation, "moment_over_inertia")
    axes[2].set_ylabel(r"$M/I\,p^2\sin\alpha$ (–)")
    letter(axes, ["Order in the paper, and minima", "Moment per column", "Moment over inertia"])
    return figure
