"""Minimum overturning amplitude of frames with increasing γ, over that of the solitary column."""

import numpy as np

from figures.drawing import PULSES, gamma
from replication.drawing import DOUBLE, GREY, make_figure, note, shades, sheet


def draw(reversals_spectra):
    slendernesses = np.sort(reversals_spectra.slenderness_deg.unique())[[0, -1]]
    keys = ["slenderness_deg", "shape", "mass_ratio", "frequency_ratio"]
    lowest = reversals_spectra.groupby(keys).lower.min()
    ratios = np.sort(reversals_spectra.mass_ratio.unique())
    figure, axes = sheet(DOUBLE, 78, nrows=2, ncols=4, sharex=True, sharey=True)
    for row, slenderness in zip(axes, slendernesses, strict=True):
        for axis, (shape, words) in zip(row, PULSES.items(), strict=True):
            column = lowest.loc[slenderness, shape, 0.0]
            for mass_ratio, colour in zip(ratios[1:], shades(len(ratios) - 1), strict=True):
                gain = (lowest.loc[slenderness, shape, mass_ratio] / column).dropna()
                axis.plot(gain.index, gain, color=colour, linewidth=1.0, label=gamma(mass_ratio))
            axis.axhline(1.0, color=GREY, linewidth=0.6)
            if slenderness == slendernesses[0]:
                axis.set_title(words)
            else:
                axis.set_xlabel(r"Frequency, $\omega/p$ (–)")
        row[0].set_ylabel(f"$\\alpha$ = {slenderness:.3g}°\nRatio of minima (–)")
        row[0].set(yscale="log", xlim=(0.5, 10), xticks=(1, 2, 4, 6, 8, 10))
        row[0].set_yticks(ticks := (1, 1.5, 2, 3, 4, 6), [f"{tick:g}" for tick in ticks])
        row[0].set_yticks([], minor=True)
    axes[0, 3].legend(loc="upper right", handlelength=1.4, labelspacing=0.2, borderaxespad=0.1)
    note(axes[0, 2], "solitary column", (9.9, 1.02), color=GREY, ha="right", va="bottom")
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
