"""Column, fixed mass and frame under the same pulses, and their minima."""

import math

from matplotlib.patches import Polygon
from palette import DARKEST, FIXED, GREY, INK, LIGHTEST, OVERTURNED, OVERTURNS, ROCKS, SURVIVES

from replication.drawing import DASHED, DOUBLE, beside, gamma, letter, note

PLACES = {"column": 0.0, "fixed mass": 8.2, "frame": 19.0}  # middle of each, m
COLOURS = {"column": LIGHTEST, "fixed mass": FIXED, "frame": DARKEST}
LABELS = {"column": (0, -6), "fixed mass": (0, -7), "frame": (0, 7)}  # points, from the ends
ROW = 8.9  # distance of the rows, m
EDGES = (-5.2, 22.8)  # ends of the ground, m
TINTS = {OVERTURNS: OVERTURNED, SURVIVES: ROCKS}


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
    note(axis, words, (middle, ground - 0.9), color=colour, ha="center", fontsize=8)


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
            part = poses[(poses.amplitude == amplitude) & (poses.structure == name)]
            scene(axis, part, middle, -ROW * row)
    for name, middle in PLACES.items():
        note(axis, name, (middle, 7.6), color=COLOURS[name], ha="center", fontsize=8)
    caps = poses[poses.last & (poses.body == "cap") & (poses.structure == "frame")]
    middle, top, left = PLACES["fixed mass"], caps.y.max(), PLACES["frame"] + caps.x.min()
    arrow = {"arrowstyle": "<->", "color": GREY, "linewidth": 0.6, "shrinkA": 0, "shrinkB": 0}
    axis.annotate("", (middle + 3.0, top), (left - 0.3, top), arrowprops=arrow)
    words = "same mass\nper column"
    note(axis, words, ((middle + 2.7 + left) / 2, top + 0.2), color=GREY, ha="center", va="bottom")
    axis.set(xlim=EDGES, ylim=(-ROW * (len(amplitudes) - 1) - 1.5, 8.5), aspect="equal", anchor="W")
    axis.axis("off")


def minima(axis, vase, poses):
    """Draw the minimum overturning acceleration over γ, and the pulses of the picture across it."""
    rows = vase[vase["shape"] == "one-cosine"]
    end = math.ceil(rows.mass_ratio[rows.mass_ratio < math.inf].max()) + 1  # the place of γ → ∞
    start = rows[rows.structure == "column"].minimum_overturning.iloc[0]
    for name, colour in COLOURS.items():
        line = rows[rows.structure == name].sort_values("mass_ratio")
        finite, limit = line[line.mass_ratio < math.inf], line.minimum_overturning.iloc[-1]
        x, y = [0.0, *finite.mass_ratio], [start, *finite.minimum_overturning]
        if name == "column":
            axis.plot([0.0, end], [start, start], color=colour)
        else:
            axis.plot(x, y, "o-", color=colour, markersize=2.2)
            dotted = {"color": colour, "linewidth": 0.8, "linestyle": (0, (1, 2))}
            axis.plot([x[-1], end], [y[-1], limit], **dotted)
            axis.plot(end, limit, "o", color=colour, markersize=3.2, clip_on=False)
        note(axis, name, (end, limit), LABELS[name], ha="right", color=colour)
    ratio = poses.mass_ratio.iloc[0]
    axis.axvline(ratio, color=GREY, linewidth=0.5)
    note(axis, f"{gamma(ratio)}, as drawn", (ratio + 0.08, 0.02), color=GREY)
    for amplitude in poses.amplitude.unique():
        axis.axhline(amplitude, color=GREY, linewidth=0.7, linestyle=DASHED)
        note(axis, f"{amplitude:g} g", (end / 2, amplitude), (0, 5), ha="center", color=GREY)
    axis.set(xlim=(0, end), ylim=(0, 0.36), xticks=range(end + 1), yticks=(0, 0.1, 0.2, 0.3))
    axis.set_xticklabels([*range(end), "∞"])
    axis.set(xlabel=r"Mass ratio, $\gamma$ (–)", ylabel="Minimum overturning acceleration (g)")


def draw(vase, vase_poses):
    figure, (left, right) = beside(DOUBLE, 74, (1.6, 1))
    picture(left, vase_poses)
    minima(right, vase, vase_poses)
    ratio = vase_poses.mass_ratio.iloc[0]
    titles = [f"Outcomes under two pulses, {gamma(ratio)}", "Minimum for each mass ratio"]
    letter((left, right), titles)
    return figure
