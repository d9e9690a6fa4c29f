"""Probability of overturning by model of ground motion, and peak rotations under the four sets."""

import math

from palette import ALONE, EQUAL, FIXED

from replication.drawing import DARKEST, DOUBLE, gamma, letter, sheet

SHADES = {0.0: ALONE, 1.0: EQUAL, math.inf: DARKEST}  # a beam as heavy as both columns, and heavier
COLOURS = {"fixed": FIXED, "column": ALONE, "frame": EQUAL}


def probabilities(axis, motions):
    table = motions.iloc[::-1].reset_index(drop=True)
    for name, colour in COLOURS.items():
        axis.hlines(table.index, 100 * table[f"{name}_low"], 100 * table[f"{name}_high"], colour)
        axis.plot(100 * table[name], table.index, "o", color=colour, markersize=3.5)
    axis.set_yticks(table.index, table.model)
    axis.tick_params(axis="y", length=0)
    axis.set(xlim=(0, 100), ylim=(-0.6, len(table) - 0.4))
    axis.set_xlabel("Probability of overturning (%)")


def rotation(axis, rows, colour):
    for model, of in rows.groupby("model"):
        dash = "-" if model.startswith("near-fault") else "--"
        axis.plot(of.velocity, of.median_peak.clip(upper=2.0), dash, color=colour, linewidth=1.0)
    axis.set(xlim=(0.2, 1.0), ylim=(0, 1), xticks=(0.2, 0.6, 1.0), xlabel="PGV (m/s)")


def draw(motions, motions_rotations, config):
    figure, axes = sheet(DOUBLE, 66, "abcd", width_ratios=(2, 1, 1, 1))
    probabilities(axes["a"], motions)
    for mark, (ratio, colour) in zip("bcd", SHADES.items(), strict=True):
        of = motions_rotations[motions_rotations.mass_ratio == ratio]
        rotation(axes[mark], of, colour)
        axes[mark].set_yticks((0, 0.5, 1), ("0", "0.5", "1") if mark == "b" else ())
    axes["b"].set_ylabel(r"Median peak $|\theta|/\alpha$ (–)")
    titles = [f"Models, at {config['motions']['velocity']:g} m/s", *map(gamma, SHADES)]
    letter(list(axes.values()), titles)
    return figure
