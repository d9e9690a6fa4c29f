"""The paper's Fig. 1: four structures with their minima, their restoring moment and inertia."""

from matplotlib.patches import Rectangle
from palette import CAP, FIXED, FORCE, STONE

from replication.drawing import DOUBLE, GREY, INK, PAPER, gamma, letter, note, shades, sheet

# m: between structures, between axes of columns, of the cap beam
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
    """Return what is written below a structure."""
    height, width = 2 * row.half_height, 2 * row.half_width
    name = (
        f"column\n{height:g} m × {width:g} m"
        if row.mass_ratio == 0.0
        else f"frame\n{gamma(row.mass_ratio)}"
    )
    ratio = row.equivalent_size / whole
    size = r"$\hat{R}$" if row.mass_ratio else "size"
    minimum = f"$\\mathbf{{{row.minimum_overturning:.3f}}}\\,g$"
    return f"{name}\n{size} = {ratio:.3g}$\\,R$\n{minimum}"


def structures(axis, table, top):
    edge, whole = 0.0, table.equivalent_size[table.structure == "column"].iloc[0]
    for row in table.itertuples():
        parts = bodies(row)
        middle = edge - min(left for left, *_ in parts)
        for left, bottom, width, height, face in parts:
            where = (middle + left, bottom)
            axis.add_patch(
                Rectangle(where, width, height, facecolor=face, edgecolor=INK, linewidth=0.8)
            )
        areas = [width * height for *_, width, height, _ in parts]
        levels = [bottom + height / 2 for _, bottom, _, height, _ in parts]
        centre = sum(a * y for a, y in zip(areas, levels, strict=True)) / sum(areas)
        axis.plot(middle, centre, "o", color=PAPER, markeredgecolor=FORCE, markersize=4.5)
        axis.plot(middle, centre, ".", color=FORCE, markersize=2)
        note(axis, words(row, whole), (middle, -0.6), ha="center", va="top")
        edge = middle - min(left for left, *_ in parts) + GAP
    axis.plot([-GAP, edge], [0, 0], color=INK, linewidth=1.2)
    level = table.uplift_acceleration.iloc[0]
    text = "minimum overturning acceleration; all uplift at $g\\,\\tan\\alpha$"
    text = f"{text} = {level:.3f}$\\,g$"
    note(axis, text, ((edge - GAP) / 2, -9.0), ha="center", color=GREY)
    axis.plot(0, 11.5, "o", color=PAPER, markeredgecolor=FORCE, markersize=4.5)
    axis.plot(0, 11.5, ".", color=FORCE, markersize=2)
    note(axis, "centre of gravity", (0.7, 11.5), color=FORCE)
    axis.set(xlim=(-GAP, edge), ylim=(-10, top + 0.6), aspect="equal", anchor="N")
    axis.axis("off")


def curves(axis, table, column):
    """Draw a column of the table against the rotation, over its value for the column at uplift."""
    loose = table[table.mass == "loose"].groupby("mass_ratio")
    unit = loose.get_group(0.0)[column].max()
    every = [*zip(loose, shades(len(loose)), strict=True)]
    every += [(one, FIXED) for one in table[table.mass == "fixed"].groupby("mass_ratio")]
    for (mass_ratio, curve), colour in sorted(every, key=lambda one: -one[0][1][column].max()):
        height = curve[column] / unit
        name = "column" if mass_ratio == 0.0 else gamma(mass_ratio)
        name += ", fixed" if colour == FIXED else ""
        line = [0.0, *curve.rotation_over_alpha], [0.0, *height]
        axis.plot(*line, color=colour, label=f"{height.max():.2g}: {name}", clip_on=False)
    axis.set(xlim=(0, 1.05), ylim=(0, None), xticks=(0, 0.5, 1))
    axis.legend(loc="upper right", bbox_to_anchor=(1.02, 1.06), labelspacing=0.1, handlelength=1)


def draw(four_structures, moment_rotation):
    every = [part for row in four_structures.itertuples() for part in bodies(row)]
    top = max(11.5, *(bottom + height for _, bottom, _, height, _ in every))
    tall = 66 * max(1.0, (top + 10) / 23)  # mm, so that words below a high beam keep their places
    figure, axes = sheet(DOUBLE, tall, "ab;ac", width_ratios=(2.1, 1))
    structures(axes["a"], four_structures, top)
    curves(axes["b"], moment_rotation, "moment")
    axes["b"].set_ylabel(r"$M/m_\mathrm{c}gR\,\sin\alpha$ (–)")
    curves(axes["c"], moment_rotation, "moment_over_inertia")
    axes["c"].set(xlabel=r"Rotation, $\theta/\alpha$ (–)", ylabel=r"$M/I\,p^2\sin\alpha$ (–)")
    letter(
        axes.values(),
        [
            "Order of stability in the paper, and minima",
            "Restoring moment per column",
            "Moment over inertia",
        ],
    )
    return figure
