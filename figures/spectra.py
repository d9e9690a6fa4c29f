"""Minimum overturning acceleration against frequency: the column and two of its frames."""

import numpy as np

from figures.drawing import HIGHEST, PULSES, amplitude_axis, gamma
from replication.drawing import DOUBLE, GREY, PAPER, letter, make_figure, note, shades, sheet

MASS_RATIOS = [0.0, 1.0, np.inf]  # γ


def lowest(lines):
    """Return the frequencies of a spectrum that overturn at all, and the lowest amplitudes."""
    found = lines.groupby("frequency_ratio").lower.min()
    return found.index, found.to_numpy()


def panel(axis, cells):
    """Draw a line for each γ, with an open circle where it ends within the axes."""
    amplitude_axis(axis)
    for mass_ratio, colour in zip(MASS_RATIOS, shades(len(MASS_RATIOS)), strict=True):
        frequencies, amplitudes = lowest(cells[cells.mass_ratio == mass_ratio])
        axis.plot(frequencies, amplitudes, color=colour, label=gamma(mass_ratio))
        if amplitudes[-1] < 0.9 * HIGHEST and frequencies[-1] < axis.get_xlim()[1]:
            how = {"color": colour, "markerfacecolor": PAPER, "markersize": 3.5}
            axis.plot(frequencies[-1], amplitudes[-1], "o", **how)
    axis.axhline(1.0, color=GREY, linewidth=0.6)


def draw(spectra):
    spectra = spectra[~spectra.linearised]
    slendernesses = np.sort(spectra.slenderness_deg.unique())
    rows = len(slendernesses)
    figure, axes = sheet(DOUBLE, 54 * rows, nrows=rows, ncols=4, sharex=True, sharey=True)
    for row, slenderness in zip(axes, slendernesses, strict=True):
        for axis, shape in zip(row, PULSES, strict=True):
            of = (spectra["shape"] == shape) & (spectra.slenderness_deg == slenderness)
            panel(axis, spectra[of])
            if slenderness == slendernesses[-1]:
                axis.set_xlabel(r"Frequency, $\omega/p$ (–)")
        words = f"$\\alpha$ = {slenderness:.3g}°\nMinimum amplitude, " + r"$a/(g\,\tan\alpha)$ (–)"
        row[0].set_ylabel(words)
    letter(axes.flat, [*PULSES.values()] * rows)
    above = {"loc": "lower right", "bbox_to_anchor": (1.0, 0.06)}  # the line of uplift
    axes[0, 3].legend(handlelength=1.4, labelspacing=0.2, borderaxespad=0.1, **above)
    note(axes[0, 0], "uplift", (7.9, 1.1), color=GREY, ha="right")
    words = "circle: at higher\nfrequencies no\namplitude up to\n12 overturns"
    note(axes[0, 1], words, (0.99, 0.22), xycoords="axes fraction", ha="right", color=GREY)
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
