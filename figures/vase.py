"""Column, vase and frame under the same motions, and their minimum overturning accelerations."""

import math

from matplotlib.offsetbox import AnnotationBbox, DrawingArea
from matplotlib.patches import Polygon, Rectangle

from figures.drawing import gamma
from figures.palette import OVERTURNED, OVERTURNS, ROCKS, SURVIVES
from replication.drawing import DOUBLE, GREY, INK, PAPER, letter, make_figure, note, sheet

PLACES = {"bare": 0.0, "fixed": 10.2, "free": 22.6}  # m: the middle of each structure
NAMES = {"bare": "Column", "fixed": "Vase: mass fixed to it", "free": "Frame: mass carried freely"}
ROW = 10.0  # m between the rows
EDGES = (-7.6, 27.0)  # m: of the ground
OUTCOMES = {OVERTURNS: "overturns", SURVIVES: "survives"}
TINTS = {OVERTURNS: OVERTURNED, SURVIVES: ROCKS}
LIMIT = 5.0  # the place of γ = ∞ on the axis
GLYPHS_AT = 3.0  # γ
LOWEST = 0.13  # g, of the axis


def scene(axis, poses, middle, ground):
    """Draw the poses of one structure, the last one filled; word and colour are its outcome."""
    colour = OVERTURNS if poses.outcome.iloc[0] == "overturned" else SURVIVES
    for (last, _, body), part in poses.groupby(["last", "pose", "body"]):
        corners = list(zip(part.x + middle, part.y + ground, strict=True))
        heavy = body == "cap"
        if last:
            look = {"facecolor": colour if heavy else TINTS[colour], "zorder": 3}
        else:
            look = {"facecolor": "none", "alpha": 0.45, "zorder": 2}
        axis.add_patch(Polygon(corners, edgecolor=colour, linewidth=0.7, **look))
    note(axis, OUTCOMES[colour], (middle, ground - 1.0), color=colour, ha="center", fontsize=8)


def motion(axis, amplitude, largest, ground):
    """Draw the ground with the acceleration that it has, one cosine, and its amplitude."""
    axis.plot(EDGES, [ground, ground], color=INK, linewidth=1.0, zorder=1)
    x = [EDGES[0] + 0.3 + 2.7 * step / 60 for step in range(61)]
    y = [
        ground + 3.3 + 1.6 * amplitude / largest * math.cos(2 * math.pi * step / 60)
        for step in range(61)
    ]
    axis.plot([x[0], x[-1]], [ground + 3.3] * 2, color=GREY, linewidth=0.5)
    axis.plot([x[0], *x, x[-1]], [ground + 3.3, *y, ground + 3.3], color=INK, linewidth=1.0)
    note(axis, f"{amplitude:g} g", (x[30], ground + 5.7), ha="center", fontsize=8)
    arrow = {"arrowstyle": "<->", "color": INK, "linewidth": 0.8, "shrinkA": 0, "shrinkB": 0}
    ends = [(x[12], ground + 0.7), (x[48], ground + 0.7)]
    axis.annotate("", *ends, arrowprops=arrow)


def picture(axis, poses):
    amplitudes = sorted(poses.amplitude.unique())
    for row, amplitude in enumerate(amplitudes):
        ground = -ROW * row
        motion(axis, amplitude, amplitudes[-1], ground)
        for name, middle in PLACES.items():
            of = poses[(poses.amplitude == amplitude) & (poses.structure == name)]
            scene(axis, of, middle, ground)
    for name, middle in PLACES.items():
        note(axis, NAMES[name], (middle, 8.1), ha="center", fontsize=8)
    bottom = -ROW * (len(amplitudes) - 1)
    axis.set(xlim=EDGES, ylim=(bottom - 1.8, 8.9), aspect="equal", anchor="W")
    axis.axis("off")


def glyph(axis, name, at):
    """Draw a structure at the size of a letter."""
    area = DrawingArea(16, 15)
    columns = {"bare": [7], "fixed": [7], "free": [1, 13]}[name]
    caps = {"bare": [], "fixed": [(4, 8)], "free": [(0, 16)]}[name]
    for left in columns:
        area.add_artist(Rectangle((left, 0), 2, 11, facecolor=PAPER, edgecolor=INK, linewidth=0.6))
    for left, width in caps:
        area.add_artist(Rectangle((left, 11), width, 3, facecolor=INK, linewidth=0))
    axis.add_artist(AnnotationBbox(area, at, frameon=False, pad=0, box_alignment=(0.5, -0.15)))


def minima(axis, summary, poses):
    """Draw the minimum overturning acceleration over γ, and the pulses of the picture across it."""
    of = summary[summary["shape"] == "one-cosine"]
    bare = of[of.structure == "bare"].minimum_overturning.iloc[0]
    axis.plot([0.0, LIMIT], [bare, bare], color=INK)
    glyph(axis, "bare", (GLYPHS_AT, bare))
    for name in ("fixed", "free"):
        line = of[of.structure == name].sort_values("mass_ratio")
        finite, limit = line[line.mass_ratio < math.inf], line.minimum_overturning.iloc[-1]
        x, y = [0.0, *finite.mass_ratio], [bare, *finite.minimum_overturning]
        axis.plot(x, y, "o-", color=INK, markersize=2.2)
        axis.plot([x[-1], LIMIT], [y[-1], limit], color=INK, linewidth=0.8, linestyle=(0, (1, 2)))
        axis.plot(LIMIT, limit, "o", color=INK, markersize=3.2, clip_on=False)
        glyph(axis, name, (GLYPHS_AT, y[x.index(GLYPHS_AT)]))
    drawn = poses.mass_ratio.iloc[0]
    axis.axvline(drawn, color=GREY, linewidth=0.5)
    note(axis, f"{gamma(drawn)}, as drawn", (drawn + 0.08, LOWEST + 0.008), color=GREY)
    for amplitude in poses.amplitude.unique():
        axis.axhline(amplitude, color=GREY, linewidth=0.7, linestyle=(0, (4, 2)))
        how = {"ha": "right", "va": "bottom", "xytext": (0, 1), "textcoords": "offset points"}
        note(axis, f"{amplitude:g} g", (LIMIT, amplitude), color=GREY, **how)
    axis.set(xlim=(0, LIMIT), ylim=(LOWEST, 0.36), xticks=[0, 1, 2, 3, 4, LIMIT])
    axis.set_xticklabels(["0", "1", "2", "3", "4", "∞"])
    axis.set(xlabel=r"Mass ratio, $\gamma$ (–)", ylabel="Minimum overturning acceleration (g)")


def draw(vase, vase_poses):
    figure, (left, right) = sheet(DOUBLE, 74, ncols=2, width_ratios=(2.25, 1))
    picture(left, vase_poses)
    minima(right, vase, vase_poses)
    ratio = vase_poses.mass_ratio.iloc[0]
    titles = [f"Outcomes under two pulses, {gamma(ratio)}", "Minimum for each mass ratio"]
    letter((left, right), titles)
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
