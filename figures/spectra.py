"""Minimum overturning acceleration against frequency: every γ, exact and linearised."""

import numpy as np

from figures.drawing import PULSES, amplitude_axis, gamma
from figures.palette import MODEL
from replication.drawing import DOUBLE, GREY, note, publish, shades, sheet


def lowest(lines):
    """Return the frequencies of a spectrum that overturn at all, and the lowest amplitudes."""
    found = lines.groupby("frequency_ratio").lower.min()
    return found.index, found.to_numpy()


def panel(axis, cells, ratios):
    for mass_ratio, colour in zip(ratios, shades(len(ratios)), strict=True):
        of = cells[cells.mass_ratio == mass_ratio].groupby("linearised")
        axis.plot(
            *lowest(of.get_group(False)), color=colour, linewidth=1.0, label=gamma(mass_ratio)
        )
        if mass_ratio in (ratios[0], ratios[-1]):
            how = {"color": MODEL, "linewidth": 0.8, "linestyle": (0, (3, 2))}
            axis.plot(*lowest(of.get_group(True)), **how)
    axis.axhline(1.0, color=GREY, linewidth=0.6)
    amplitude_axis(axis)


def draw(spectra):
    ratios = np.sort(spectra.mass_ratio.unique())
    slendernesses = np.sort(spectra.slenderness_deg.unique())
    rows = len(slendernesses)
    figure, axes = sheet(DOUBLE, 54 * rows, nrows=rows, ncols=4, sharex=True, sharey=True)
    for row, slenderness in zip(axes, slendernesses, strict=True):
        for axis, (shape, words) in zip(row, PULSES.items(), strict=True):
            of = (spectra["shape"] == shape) & (spectra.slenderness_deg == slenderness)
            panel(axis, spectra[of], ratios)
            if slenderness == slendernesses[0]:
                axis.set_title(words)
            if slenderness == slendernesses[-1]:
                axis.set_xlabel(r"Frequency, $\omega/p$ (–)")
        words = f"$\\alpha$ = {slenderness:.3g}°\nMinimum amplitude, " + r"$a/(g\,\tan\alpha)$ (–)"
        row[0].set_ylabel(words)
    axes[0, 3].legend(loc="lower right", handlelength=1.4, labelspacing=0.2, borderaxespad=0.1)
    note(axes[0, 0], "uplift", (7.9, 1.05), color=GREY, ha="right")
    words = "dashed: linearised,\n" + r"$\gamma=0$ and $\gamma=\infty$"
    note(axes[0, 1], words, (0.97, 0.12), xycoords="axes fraction", ha="right", color=MODEL)
    return figure


if __name__ == "__main__":
    publish(snakemake, draw)
