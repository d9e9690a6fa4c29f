"""Column, fixed mass and frame under the same pulses, and their minima."""

import math

from matplotlib.offsetbox import AnnotationBbox, DrawingArea
from matplotlib.patches import Polygon, Rectangle
from palette import FIXED, OVERTURNED, OVERTURNS, ROCKS, SURVIVES

from replication.drawing import (
    DARKEST,
    DOUBLE,
    GREY,
    INK,
    LIGHTEST,
    PAPER,
    gamma,
    letter,
    note,
    sheet,
)

PLACES = {"column": 0.0, "fixed mass": 8.4, "frame": 19.3}  # m: the middle of each
NAMES = {
    "column": "Column",
    "fixed mass": "Mass fixed\nto the column",
    "frame": "Frame: mass\ncarried freely",
}
COLOURS = {"column": LIGHTEST, "fixed mass": FIXED, "frame": DARKEST}
ROW = 10.2  # m between the rows
EDGES = (-5.4, 25.0)  # m: of the ground
TINTS = {OVERTURNS: OVERTURNED, SURVIVES: ROCKS}
LOWEST, HIGHEST = 0.13, 0.36  # g, of the axis


def scene(axis, poses, middle, ground):
    """Draw the poses of one structure, the last one filled; word and colour are its outcome."""
    overturns = poses.outcome.iloc[0] == "overturned"
    colour = OVERTURNS if overturns else SURVIVES
    for (last, _, body), part in poses.groupby(["last", "pose", "body"]):
        corners = list(zip(part.x + middle, part.y + ground, strict=True))
        look = {"facecolor": "none", "alpha": 0.45, "zorder": 2}
        if last:
            look = {"facecolor": colour if body == "cap" else TINTS[colour], "zorder": 3}
        axis.add_patch(Polygon(corners, edgecolor=colour, linewidth=0.7, **look))
    words = "overturns" if overturns else "survives"
    note(axis, words, (middle, ground - 1.0), color=colour, ha="center", fontsize=8)


def motion(axis, amplitude, largest, ground):
    """Draw the ground with its acceleration, one cosine, and its amplitude."""
    axis.plot(EDGES, [ground, ground], color=INK, linewidth=1.0, zorder=1)
    x = [EDGES[0] + 0.3 + 2.7 * step / 60 for step in range(61)]
    level, height = ground + 3.3, 1.6 * amplitude / largest
    y = [level + height * math.cos(2 * math.pi * step / 60) for step in range(61)]
    axis.plot([x[0], x[-1]], [level, level], color=GREY, linewidth=0.5)
    axis.plot([x[0], *x, x[-1]], [level, *y, level], color=INK, linewidth=1.0)
    note(axis, f"{amplitude:g} g", (x[30], ground + 5.7), ha="center", fontsize=8)
    arrow = {"arrowstyle": "<->", "color": INK, "linewidth": 0.8, "shrinkA": 0, "shrinkB": 0}
    axis.annotate("", (x[12], ground + 0.7), (x[48], ground + 0.7), arrowprops=arrow)


def picture(axis, poses):
    amplitudes = sorted(poses.amplitude.unique())
    for row, amplitude in enumerate(amplitudes):
        motion(axis, amplitude, amplitudes[-1], -ROW * row)
        for name, middle in PLACES.items():
            of = poses[(poses.amplitude == amplitude) & (poses.structure == name)]
            scene(axis, of, middle, -ROW * row)
    for name, middle in PLACES.items():
        note(axis, NAMES[name], (middle, 8.5), ha="center", fontsize=8)
    bottom = -ROW * (len(amplitudes) - 1)
    axis.set(xlim=EDGES, ylim=(bottom - 1.8, 9.9), aspect="equal", anchor="W")
    axis.axis("off")


def glyph(axis, name, at):
    """Draw a structure at the size of a letter, its mass in colour."""
    area, colour = DrawingArea(16, 15), COLOURS[name]
    for left in (1, 13) if name == "frame" else (7,):
        how = {"facecolor": PAPER, "edgecolor": colour, "linewidth": 0.7}
        area.add_artist(Rectangle((left, 0), 2, 11, **how))
    if name != "column":
        left, width = (0, 16) if name == "frame" else (4, 8)
        area.add_artist(Rectangle((left, 11), width, 3, facecolor=colour, linewidth=0))
    axis.add_artist(AnnotationBbox(area, at, frameon=False, pad=0, box_alignment=(0.5, -0.15)))


def minima(axis, vase, poses):
    """Draw the minimum overturning acceleration over γ, and the pulses of the picture across it."""
    of = vase[vase["shape"] == "one-cosine"]
    drawn_at = sorted(of.mass_ratio[of.mass_ratio < math.inf].unique())
    limit_at, glyphs_at = math.ceil(drawn_at[-1]) + 1, drawn_at[-2]  # the place of γ → ∞; γ
    alone = of[of.structure == "column"].minimum_overturning.iloc[0]
    axis.plot([0.0, limit_at], [alone, alone], color=COLOURS["column"])
    glyph(axis, "column", (glyphs_at, alone))
    for name in ("fixed mass", "frame"):
        line, colour = of[of.structure == name].sort_values("mass_ratio"), COLOURS[name]
        finite, limit = line[line.mass_ratio < math.inf], line.minimum_overturning.iloc[-1]
        x, y = [0.0, *finite.mass_ratio], [alone, *finite.minimum_overturning]
        axis.plot(x, y, "o-", color=colour, markersize=2.2)
        dotted = {"color": colour, "linewidth": 0.8, "linestyle": (0, (1, 2))}
        axis.plot([x[-1], limit_at], [y[-1], limit], **dotted)
        axis.plot(limit_at, limit, "o", color=colour, markersize=3.2, clip_on=False)
        glyph(axis, name, (glyphs_at, y[x.index(glyphs_at)]))
    drawn = poses.mass_ratio.iloc[0]
    axis.axvline(drawn, color=GREY, linewidth=0.5)
    note(axis, f"{gamma(drawn)}, as drawn", (drawn + 0.08, LOWEST + 0.008), color=GREY)
    for amplitude in poses.amplitude.unique():
        axis.axhline(amplitude, color=GREY, linewidth=0.7, linestyle=(0, (4, 2)))
        how = {"ha": "right", "va": "bottom", "xytext": (0, 1), "textcoords": "offset points"}
        note(axis, f"{amplitude:g} g", (limit_at, amplitude), color=GREY, **how)
    axis.set(xlim=(0, limit_at), ylim=(LOWEST, HIGHEST), xticks=range(limit_at + 1))
    axis.set_xticklabels([*range(limit_at), "∞"])
    axis.set(xlabel=r"Mass ratio, $\gamma$ (–)", ylabel="Minimum overturning acceleration (g)")


def draw(vase, vase_poses):
    figure, (left, right) = sheet(DOUBLE, 68, ncols=2, width_ratios=(1.6, 1))
    picture(left, vase_poses)
    minima(right, vase, vase_poses)
    ratio = vase_poses.mass_ratio.iloc[0]
    titles = [f"Outcomes under two pulses, {gamma(ratio)}", "Minimum for each mass ratio"]
    letter((left, right), titles)
    return figure
