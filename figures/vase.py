"""Column, vase, frame and portal under the same motions, and their minima."""

import math

from matplotlib.offsetbox import AnnotationBbox, DrawingArea
from matplotlib.patches import Polygon, Rectangle

from figures.drawing import gamma
from figures.palette import FIXED, OVERTURNED, OVERTURNS, ROCKS, SURVIVES
from replication.drawing import (
    DARKEST,
    DOUBLE,
    GREY,
    INK,
    LIGHTEST,
    PAPER,
    letter,
    make_figure,
    note,
    sheet,
)

PLACES = {"bare": 0.0, "fixed": 8.4, "free": 19.3, "portal": 26.0}  # m: the middle of each
NAMES = {
    "bare": "Column",
    "fixed": "Vase: mass\nfixed to it",
    "free": "Frame: mass\ncarried freely",
    "portal": "Portal: mass\nfixed to both",
}
COLOURS = {"bare": LIGHTEST, "fixed": FIXED, "free": DARKEST, "portal": INK}
ROW = 10.2  # m between the rows
EDGES = (-5.4, 29.2)  # m: of the ground
WORDS = {"overturned": "overturns", "rocking": "survives", "no uplift": "stays at rest"}
TINTS = {OVERTURNS: OVERTURNED, SURVIVES: ROCKS}
LIMIT = 5.0  # the place of γ = ∞ on the axis
GLYPHS_AT = 3.0  # γ
LOWEST, HIGHEST = 0.13, 0.38  # g, of the axis


def scene(axis, poses, middle, ground):
    """Draw the poses of one structure, the last one filled; word and colour are its outcome."""
    outcome = poses.outcome.iloc[0]
    colour = OVERTURNS if outcome == "overturned" else SURVIVES
    for (last, _, body), part in poses.groupby(["last", "pose", "body"]):
        corners = list(zip(part.x + middle, part.y + ground, strict=True))
        heavy = body == "cap"
        if last:
            look = {"facecolor": colour if heavy else TINTS[colour], "zorder": 3}
        else:
            look = {"facecolor": "none", "alpha": 0.45, "zorder": 2}
        axis.add_patch(Polygon(corners, edgecolor=colour, linewidth=0.7, **look))
    note(axis, WORDS[outcome], (middle, ground - 1.0), color=colour, ha="center", fontsize=8)


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
        note(axis, NAMES[name], (middle, 8.5), ha="center", fontsize=8)
    bottom = -ROW * (len(amplitudes) - 1)
    axis.set(xlim=EDGES, ylim=(bottom - 1.8, 9.9), aspect="equal", anchor="W")
    axis.axis("off")


def glyph(axis, name, at):
    """Draw a structure at the size of a letter: its mass in colour, dark where it is fixed."""
    area, colour = DrawingArea(16, 15), COLOURS[name]
    two = name in ("free", "portal")
    for left in (1, 13) if two else (7,):
        how = {"facecolor": PAPER, "edgecolor": colour, "linewidth": 0.7}
        area.add_artist(Rectangle((left, 0), 2, 11, **how))
    if name != "bare":
        left, width = (0, 16) if two else (4, 8)
        area.add_artist(Rectangle((left, 11), width, 3, facecolor=colour, linewidth=0))
    axis.add_artist(AnnotationBbox(area, at, frameon=False, pad=0, box_alignment=(0.5, -0.15)))


def minima(axis, summary, poses):
    """Draw the minimum overturning acceleration over γ, and the pulses of the picture across it."""
    of = summary[summary["shape"] == "one-cosine"]
    bare = of[of.structure == "bare"].minimum_overturning.iloc[0]
    axis.plot([0.0, LIMIT], [bare, bare], color=COLOURS["bare"])
    glyph(axis, "bare", (GLYPHS_AT, bare))
    for name in ("fixed", "free"):
        line, colour = of[of.structure == name].sort_values("mass_ratio"), COLOURS[name]
        finite, limit = line[line.mass_ratio < math.inf], line.minimum_overturning.iloc[-1]
        x, y = [0.0, *finite.mass_ratio], [bare, *finite.minimum_overturning]
        axis.plot(x, y, "o-", color=colour, markersize=2.2)
        axis.plot(
            [x[-1], LIMIT], [y[-1], limit], color=colour, linewidth=0.8, linestyle=(0, (1, 2))
        )
        axis.plot(LIMIT, limit, "o", color=colour, markersize=3.2, clip_on=False)
        glyph(axis, name, (GLYPHS_AT, y[x.index(GLYPHS_AT)]))
    drawn = poses.mass_ratio.iloc[0]
    axis.axvline(drawn, color=GREY, linewidth=0.5)
    note(axis, f"{gamma(drawn)}, as drawn", (drawn + 0.08, LOWEST + 0.008), color=GREY)
    beyond(axis, of[(of.structure == "portal") & (of.mass_ratio == drawn)], poses)
    for amplitude in poses.amplitude.unique():
        axis.axhline(amplitude, color=GREY, linewidth=0.7, linestyle=(0, (4, 2)))
        how = {"ha": "right", "va": "bottom", "xytext": (0, 1), "textcoords": "offset points"}
        note(axis, f"{amplitude:g} g", (LIMIT, amplitude), color=GREY, **how)
    axis.set(xlim=(0, LIMIT), ylim=(LOWEST, HIGHEST), xticks=[0, 1, 2, 3, 4, LIMIT])
    axis.set_xticklabels(["0", "1", "2", "3", "4", "∞"])
    axis.set(xlabel=r"Mass ratio, $\gamma$ (–)", ylabel="Minimum overturning acceleration (g)")


def beyond(axis, portals, poses):
    """Write what is beyond the axis of the portal that is drawn: its minimum, or what ends it."""
    cap = poses[(poses.structure == "portal") & (poses.body == "cap")]
    column = poses[(poses.structure == "bare") & (poses.body == "column") & (poses.rotation == 0.0)]
    span = cap.x.max() - cap.x.min() - (column.x.max() - column.x.min())
    (drawn,) = portals[(portals.span - span).abs() < 1e-6].itertuples()
    arrow = {"arrowstyle": "-|>", "color": INK, "linewidth": 0.8, "shrinkA": 0, "shrinkB": 0}
    ends = [(drawn.mass_ratio, HIGHEST), (drawn.mass_ratio, HIGHEST - 0.02)]
    axis.annotate("", *ends, arrowprops=arrow | {"mutation_scale": 6})
    glyph(axis, "portal", (drawn.mass_ratio + 0.45, HIGHEST - 0.029))
    words = f"portal: {drawn.minimum_overturning:.1f} g, off the scale"
    if math.isnan(drawn.minimum_overturning):
        words = f"portal: off the ground from {drawn.pulled_from:.1f} g"
    note(axis, words, (drawn.mass_ratio + 0.85, HIGHEST - 0.017))


def draw(vase, vase_poses):
    figure, (left, right) = sheet(DOUBLE, 78, ncols=2, width_ratios=(2.25, 1))
    picture(left, vase_poses)
    minima(right, vase, vase_poses)
    ratio = vase_poses.mass_ratio.iloc[0]
    titles = [f"Outcomes under two pulses, {gamma(ratio)}", "Minimum for each mass ratio"]
    letter((left, right), titles)
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
