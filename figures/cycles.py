"""Minima under three cycles of a sine, which can fall as the cap beam becomes heavier."""

import math
from itertools import pairwise

import numpy as np
from palette import CAUSED, INK

from replication.drawing import DOUBLE, gamma, letter, note, ring, shaded, sheet

RANGE = 1.4, 2.6  # a/(g tan α) at the ends of the axis


def lines(axis, table, colours):
    """Draw the minimum of each γ over ω, and a ring where it is below that of the next lighter."""
    lowest = table.pivot_table(index="frequency_ratio", columns="mass_ratio", values="lowest_found")
    wide = table.pivot_table(index="frequency_ratio", columns="mass_ratio", values="wide_minimum")
    shown = lowest.where(lowest < RANGE[1])
    for mass_ratio, colour in colours.items():
        axis.plot(shown.index, shown[mass_ratio], color=colour, label=gamma(mass_ratio))
    for lighter, heavier in pairwise(colours):
        fell = wide[heavier][wide[heavier] < lowest[lighter]]
        ring(axis, fell.index, fell, CAUSED, 4, linewidth=0, zorder=3)
    axis.set(xlim=(3.25, 4.55), xlabel=r"Frequency, $\omega/p$ (–)")
    axis.set_ylabel(r"Amplitude, $a/(g\,\tan\alpha)$ (–)")
    axis.legend(ncols=2, handlelength=1.2, columnspacing=1.0, labelspacing=0.2, loc="upper left")


def bars(axis, table, colours, ratio):
    """Draw the lowest wide interval of overturning amplitudes of each γ."""
    rows = table[np.isclose(table.frequency_ratio, ratio)].set_index("mass_ratio")
    before = math.inf
    for place, (mass_ratio, colour) in enumerate(colours.items()):
        low, high = rows.loc[mass_ratio, ["wide_minimum", "wide_upper"]]
        look = {"color": CAUSED if low < before and place else INK, "ha": "center", "fontsize": 7}
        if low < RANGE[1]:
            axis.bar(place, high - low, bottom=low, color=colour, width=0.62)
            note(axis, f"{low:.3f}", (place, low - 0.02), va="top", **look)
        else:
            note(axis, f"{low:.2f}\n" + r"$\uparrow$", (place, 2.51), linespacing=1.3, **look)
        before = rows.lowest_found[mass_ratio]
    names = [r"$\infty$" if np.isinf(ratio) else f"{ratio:g}" for ratio in colours]
    axis.set_xticks(range(len(names)), names)
    axis.set(xlabel=r"Mass ratio, $\gamma$ (–)", xlim=(-0.6, len(names) - 0.4))
    axis.tick_params(axis="x", length=0)


def farthest(table, pairs):
    """Return the row of the heavier structure that falls farthest below the lighter of a pair."""
    rows = table.set_index(["slenderness_deg", "frequency_ratio", "mass_ratio"])
    ratios = [
        rows.wide_minimum.xs(heavier, level=2) / rows.lowest_found.xs(lighter, level=2)
        for lighter, heavier in pairs
    ]
    return min(ratios, key=min).idxmin()


def draw(spectra_cycles):
    table = spectra_cycles[spectra_cycles.cycles == spectra_cycles.cycles.min()]
    gammas = sorted(table.mass_ratio.unique())
    slenderness, between = farthest(table, [*pairwise(gammas[1:])])
    table = table[table.slenderness_deg == slenderness]
    _, below = farthest(table, [(gammas[0], heavier) for heavier in gammas[1:]])
    colours = dict(shaded(gammas))
    figure, axes = sheet(DOUBLE, 56, ncols=3, sharey=True, width_ratios=(1.35, 1, 1))
    lines(axes[0], table, colours)
    for axis, ratio in zip(axes[1:], (between, below), strict=True):
        bars(axis, table, colours, ratio)
    axes[0].set_ylim(RANGE)
    titles = (f"Lowest interval, $\\omega$ = {ratio:.3g}$\\,p$" for ratio in (between, below))
    letter(axes, ["Minimum overturning acceleration", *titles])
    return figure
