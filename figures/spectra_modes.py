"""Both modes of overturning and the survival regions between them: the column and two frames."""

import numpy as np

from figures.drawing import HIGHEST, PULSES, amplitude_axis, gamma
from figures.palette import AT_ONCE, MODEL, OVERTURNED
from replication.drawing import DOUBLE, make_figure, note, sheet

MODES = {"with impact": OVERTURNED, "without impact": AT_ONCE}


def panel(axis, cells):
    """Draw every interval that overturns, and its ends by the linearised equation.

    One bar for each frequency, because narrow survival regions are too steep to be joined.
    """
    step = np.diff(np.unique(cells.x)).min()
    cells = cells.assign(upper=cells.upper.fillna(2.0 * HIGHEST))
    for mode, colour in MODES.items():
        of = cells[(cells["mode"] == mode) & ~cells.linearised]
        how = {"color": colour, "edgecolor": colour, "linewidth": 0.1}
        axis.bar(of.x, of.upper - of.lower, step, bottom=of.lower, **how)
    of = cells[cells.linearised]
    for edge in (of.lower, of.upper):
        axis.hlines(edge, of.x - step / 2, of.x + step / 2, color=MODEL, linewidth=0.7)
    amplitude_axis(axis)


def draw(spectra):
    slenderness = spectra.slenderness_deg.min()
    spectra = spectra.rename(columns={"frequency_ratio": "x"})
    ratios = [0.0, 1.0, np.inf]
    figure, axes = sheet(DOUBLE, 112, nrows=3, ncols=4, sharex=True, sharey=True)
    for row, mass_ratio in zip(axes, ratios, strict=True):
        of = (spectra.mass_ratio == mass_ratio) & (spectra.slenderness_deg == slenderness)
        for axis, (shape, words) in zip(row, PULSES.items(), strict=True):
            panel(axis, spectra[of & (spectra["shape"] == shape)])
            if mass_ratio == ratios[0]:
                axis.set_title(words)
            if mass_ratio == ratios[-1]:
                axis.set_xlabel(r"Frequency, $\omega/p$ (–)")
        row[0].set_ylabel(f"{gamma(mass_ratio)}\nAmplitude, " + r"$a/(g\,\tan\alpha)$ (–)")
    first = axes[0, 0]
    note(first, "after an\nimpact", (3.6, 2.6), ha="center", fontsize=7)
    note(first, "overturns\nwithout\nimpact", (1.7, 7.5), ha="center", fontsize=7)
    note(first, "survives", (6.0, 1.6), ha="center", fontsize=7)
    note(axes[0, 1], "ends when\nlinearised", (5.4, 2.0), ha="center", color=MODEL, fontsize=7)
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
