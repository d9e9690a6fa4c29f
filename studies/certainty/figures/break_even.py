"""Deficits of the column's √r at which the estimated benefit of the cap beam ends."""

import numpy as np

from figures.palette import tint
from replication.drawing import DOUBLE, GREY, letter, make_figure, note, shades, sheet

FAMILIES = ("near-fault", "broadband")
MEASURE = "p PGV/(g tan α)"
APART = 0.17  # of the distance of two intensities: between the points of two γ


def draw(certainty_break_even, certainty_measured):
    table = certainty_break_even
    table = table[table.measure == MEASURE]
    (measured,) = certainty_measured.itertuples()
    heights, ratios = sorted(table.height.unique()), sorted(table.mass_ratio.unique())
    colours = shades(len(ratios))
    figure, axes = sheet(DOUBLE, 86, nrows=len(heights), ncols=2, sharey=True, squeeze=False)
    titles = []
    for row, height in zip(axes, heights, strict=True):
        for axis, family in zip(row, FAMILIES, strict=True):
            here = table[(table.height == height) & (table.family == family)]
            levels = sorted(here.level.unique())
            axis.axhspan(100 * measured.least, 100 * measured.largest, color=tint(GREY, 0.25), lw=0)
            for place, (gamma, colour) in enumerate(zip(ratios, colours, strict=True)):
                of = here[here.mass_ratio == gamma].set_index("level").reindex(levels)
                x = np.arange(len(levels)) + (place - (len(ratios) - 1) / 2) * APART
                low, high = 100 * (of.end - of.end_low), 100 * (of.end_high - of.end)
                how = {"color": colour, "markersize": 3.2, "elinewidth": 1.0}
                axis.errorbar(x, 100 * of.end, yerr=np.array([low, high]), fmt="o", **how)
            column = here.groupby("level").column.first().loc[levels]
            words = [f"{level:g}\n({100 * share:.0f} %)" for level, share in column.items()]
            axis.set_xticks(range(len(levels)), words)
            axis.set(xlim=(-0.5, len(levels) - 0.5), ylim=(0.0, 20.0))
            axis.set_yticks([0, 5, 10, 15, 20])
            axis.tick_params(axis="x", length=0)
            titles.append(f"{family.capitalize()} motions, {height:g} m")
        row[0].set_ylabel("Deficit of the column's √r (%)")
    for axis in axes[-1]:
        axis.set_xlabel(r"$p\,\mathrm{PGV}/(g\,\tan\alpha)$ (–); motions that overturn the column")
    for place, (gamma, colour) in enumerate(zip(ratios, colours, strict=True)):
        at = (0.31 + 0.1 * place, 0.06)
        how = {"color": colour, "ha": "center", "xycoords": "axes fraction"}
        note(axes[0][0], rf"$\gamma$ = {gamma:g}" if place == 0 else f"{gamma:g}", at, **how)
    how = {"ha": "center", "fontsize": 7}
    note(axes[0][0], "measured on concrete", (3.9, 50 * (measured.least + measured.largest)), **how)
    note(axes[0][1], "above a point: column safer", (1.5, 17.5), **how)
    note(axes[0][1], "below: frame safer", (2.5, 1.0), **how)
    letter(axes.ravel(), titles)
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
