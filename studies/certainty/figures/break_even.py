"""Deficits of the column's √r at which the sign of the gain is undecided."""

import numpy as np

from figures.palette import tint
from replication.drawing import DOUBLE, GREY, INK, letter, make_figure, note, shades, sheet

FAMILIES = ("near-fault", "broadband")
MEASURE, WAY = "p PGV/(g tan α)", "column lowered"
APART = 0.17  # of the distance of two intensities: between the bars of two γ


def draw(certainty_break_even, certainty_measured):
    table = certainty_break_even
    table = table[(table.measure == MEASURE) & (table.way == WAY)]
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
                of = here[here.mass_ratio == gamma].set_index("level").loc[levels]
                x = np.arange(len(levels)) + (place - (len(ratios) - 1) / 2) * APART
                ends = 100 * of.lowest.to_numpy(), 100 * of.highest.to_numpy()
                axis.vlines(x, *ends, color=colour, linewidth=4.0)
                axis.plot(x, ends[0], "_", color=colour, markersize=5)
                apart = ~of.connected.astype(bool).to_numpy()
                axis.plot(x[apart], ends[1][apart], "x", color=INK, markersize=3.5)
                goes_on = (of.highest == of.largest).to_numpy()
                axis.plot(x[goes_on], ends[1][goes_on], "^", color=colour, markersize=4)
            column = here[here.mass_ratio == ratios[0]].set_index("level").column.loc[levels]
            words = [f"{level:g}\n({100 * share:.0f} %)" for level, share in column.items()]
            axis.set_xticks(range(len(levels)), words)
            axis.set(xlim=(-0.5, len(levels) - 0.5), ylim=(-0.5, 16.2))
            axis.set_yticks([0, 5, 10, 15])
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
    note(axes[0][0], "measured on concrete", (4.5, 50 * (measured.least + measured.largest)), **how)
    note(axes[0][1], "above a bar: column safer", (2.0, 15.0), **how)
    note(axes[0][1], "below: frame safer", (2.5, 1.2), **how)
    letter(axes.ravel(), titles)
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
