"""Both modes of overturning and the survival regions between them: the column and two frames."""

import numpy as np

from figures.drawing import HIGHEST, PULSES, amplitude_axis, bands, gamma
from replication.drawing import ACCENT, DARK, DOUBLE, LIGHT, note, publish, sheet

MODES = {"with impact": LIGHT, "without impact": DARK}
SHOWN = 0.05  # g tan α: narrower bands and survival regions are not drawn
SHORT = 8  # frequencies: shorter edges would only be dots


def panel(axis, cells):
    for mode, colour in MODES.items():
        for band in bands(cells[~cells.linearised], mode, HIGHEST, SHOWN):
            axis.fill_between(*zip(*band, strict=True), color=colour, linewidth=0.3)
        for band in bands(cells[cells.linearised], mode, HIGHEST, SHOWN):
            x, lower, upper = zip(*band, strict=True)
            if len(band) < SHORT:
                continue
            for edge in (lower, upper):
                drawn = [value if value < HIGHEST else None for value in edge]
                axis.plot(x, drawn, color=ACCENT, linewidth=0.7)
    amplitude_axis(axis)


def draw(spectra):
    slenderness = spectra.slenderness_deg.min()
    spectra = spectra.rename(columns={"frequency_ratio": "x"})
    ratios = [0.0, 1.0, np.inf]
    figure, axes = sheet(DOUBLE, 140, nrows=3, ncols=4, sharex=True, sharey=True)
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
    note(first, "overturns\nwithout\nimpact", (1.7, 7.5), ha="center", color="white", fontsize=7)
    note(first, "survives", (6.0, 1.6), ha="center", fontsize=7)
    note(axes[0, 1], "edges when\nlinearised", (5.2, 2.0), ha="center", color=ACCENT, fontsize=7)
    return figure


if __name__ == "__main__":
    publish(snakemake, draw)
