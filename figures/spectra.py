"""Minimum overturning acceleration against frequency, and the frame's over its column's."""

import numpy as np
from palette import DARKEST, GREY

from replication.drawing import (
    DOUBLE,
    PULSES,
    STROKES,
    gamma,
    letter,
    logarithmic,
    note,
    ring,
    shaded,
    sheet,
)

HIGHEST = 12.0  # a/(g tan α) of the axes
MASS_RATIOS = [0.0, 1.0, np.inf]  # 1: as heavy as both columns
SHOWN = {  # frequencies at which the names of lines are written, and places in points
    "one-sine": ((8.0, 8.0, 6.0), ((4, 0), (4, 0), (-4, 6))),
    "one-cosine": ((4.5, 3.875, 3.625), ((6, 0), (3, 8), (-6, 0))),
}


def minima(axis, cells, places, asides):
    """Draw a line for each γ, with an open circle where it ends within the axes."""
    for (ratio, colour), stroke, place, aside in zip(
        shaded(MASS_RATIOS), STROKES, places, asides, strict=False
    ):
        lowest = cells[cells.mass_ratio == ratio].groupby("frequency_ratio").lower.min()
        axis.plot(lowest.index, lowest, color=colour, linestyle=stroke)
        if lowest.iloc[-1] < 0.9 * HIGHEST and lowest.index[-1] < 8:
            ring(axis, lowest.index[-1], lowest.iloc[-1], colour)
        level = np.interp(place, lowest.index, lowest)
        side = "left" if aside[0] > 0 else "right"
        note(axis, gamma(ratio), (place, level), aside, ha=side, color=colour)
    logarithmic(axis, (1, 2, 3, 5, 10), "y")
    axis.set(xlim=(0.5, 8), ylim=(0.93, HIGHEST), xlabel=r"Frequency, $\omega/p$ (–)")
    axis.set_ylabel("Minimum overturning\n" + r"acceleration, $a/(g\,\tan\alpha)$ (–)")
    axis.axhline(1.0, color=GREY, linewidth=0.6)


def ratios(axis, table, frequency):
    """Draw the minimum of the frame with γ → ∞ over that of its column, for each pulse."""
    axis.axhline(1.0, color=GREY, linewidth=0.6)
    for (shape, words), stroke in zip(PULSES.items(), STROKES, strict=True):
        rows = table[table["shape"] == shape].sort_values(frequency)
        ratio = (rows.frame / rows.column).replace(np.inf, np.nan)
        axis.plot(rows[frequency], ratio, color=DARKEST, linestyle=stroke, label=words)
    axis.set(xlim=(0.5, 8), ylim=(0.8, 3), yticks=(1, 1.5, 2, 2.5, 3))
    axis.set_ylabel("Minimum, $\\gamma=\\infty$\nover column (–)")


def draw(spectra, spectra_collapse, config):
    slenderness = config["spectra"]["slendernesses"][1]
    cells, collapse = (
        table[np.isclose(table.slenderness_deg, slenderness)]
        for table in (spectra, spectra_collapse)
    )
    figure, axes = sheet(DOUBLE, 88, nrows=2, ncols=2)
    for axis, (shape, places) in zip(axes[0], SHOWN.items(), strict=True):
        minima(axis, cells[cells["shape"] == shape], *places)
    note(axes[0, 0], "uplift", (7.9, 1.1), color=GREY, ha="right")
    lowest = cells.groupby(["shape", "frequency_ratio", "mass_ratio"]).lower.min().unstack()
    pairs = lowest.rename(columns={0.0: "column", np.inf: "frame"}).reset_index()
    ratios(axes[1, 0], pairs, "frequency_ratio")
    axes[1, 0].set_xlabel(r"Frequency, $\omega/p$ (–)")
    ratios(axes[1, 1], collapse, "ratio_to_p_hat")
    axes[1, 1].set_xlabel(r"Frequency, $\omega/p$ of the column, $\omega/\hat{p}$ of the frame (–)")
    axes[1, 1].legend(loc="upper left", ncols=2)
    titles = [PULSES[shape] for shape in SHOWN]
    letter(axes.flat, [*titles, r"Ratio at equal $\omega$", r"Ratio at equal $\omega/\hat{p}$"])
    return figure
