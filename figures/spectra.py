"""Minimum overturning acceleration against frequency, over p of the column and over p̂ of each."""

import numpy as np

from replication.drawing import (
    DOUBLE,
    GREY,
    PAPER,
    PULSES,
    gamma,
    letter,
    note,
    shades,
    sheet,
)

HIGHEST = 12.0  # a/(g tan α) of the axes
MASS_RATIOS = [0.0, 1.0, np.inf]  # 1: as heavy as both columns
SHORT = {"one-sine": 2, "one-cosine": 3}  # order n: minima without an impact tend to (ω/p̂)ⁿ/2π


def slower(mass_ratio):
    """Return p/p̂ of a frame, Eq. (23)."""
    share = 0.5 if np.isinf(mass_ratio) else mass_ratio / (1.0 + 2.0 * mass_ratio)
    return np.sqrt(1.0 + share)


def panel(axis, cells, scaled):
    """Draw a line for each γ, with an open circle where it ends within the axes."""
    axis.set(yscale="log", xlim=(0.5, 8), ylim=(0.93, HIGHEST), xticks=(1, 2, 4, 6, 8))
    axis.set_yticks(ticks := (1, 2, 3, 5, 10), map(str, ticks))
    axis.set_yticks([], minor=True)
    for mass_ratio, colour in zip(MASS_RATIOS, shades(len(MASS_RATIOS)), strict=True):
        found = cells[cells.mass_ratio == mass_ratio].groupby("frequency_ratio").lower.min()
        frequencies = found.index.to_numpy() * (slower(mass_ratio) if scaled else 1.0)
        axis.plot(frequencies, found, color=colour, label=gamma(mass_ratio))
        if found.iloc[-1] < 0.9 * HIGHEST and frequencies[-1] < axis.get_xlim()[1]:
            how = {"color": colour, "markerfacecolor": PAPER, "markersize": 3.5}
            axis.plot(frequencies[-1], found.iloc[-1], "o", **how)
    axis.axhline(1.0, color=GREY, linewidth=0.6)


def without_impact(axis, cells, shape):
    """Draw the minima without an impact over ω/p̂, which coincide, and what they tend to."""
    at_once = cells[(cells["mode"] == "without impact") & (cells["shape"] == shape)]
    for mass_ratio in MASS_RATIOS:
        found = at_once[at_once.mass_ratio == mass_ratio].groupby("frequency_ratio").lower.min()
        axis.plot(found.index * slower(mass_ratio), found, color=GREY, linewidth=0.7)
    if shape in SHORT:
        frequencies = np.linspace(0.5, 8.0, 61)
        axis.plot(frequencies, frequencies ** SHORT[shape] / (2 * np.pi), ":", color=GREY)


def draw(spectra, config):
    slenderness = config["spectra"]["slendernesses"][1]
    cells = spectra[np.isclose(spectra.slenderness_deg, slenderness)]
    figure, axes = sheet(DOUBLE, 84, nrows=2, ncols=4, sharey=True)
    for row, parameter in zip(axes, ("p", r"\hat{p}"), strict=True):
        for axis, shape in zip(row, PULSES, strict=True):
            panel(axis, cells[cells["shape"] == shape], parameter != "p")
            if parameter != "p":
                without_impact(axis, cells, shape)
            axis.set_xlabel(f"Frequency, $\\omega/{parameter}$ (–)")
        row[0].set_ylabel("Minimum overturning\n" + r"acceleration, $a/(g\,\tan\alpha)$ (–)")
    letter(axes.flat, [*PULSES.values()] * 2)
    above = {"loc": "lower right", "bbox_to_anchor": (1.0, 0.06)}  # the line of uplift
    axes[0, 3].legend(handlelength=1.4, labelspacing=0.2, borderaxespad=0.1, **above)
    note(axes[0, 0], "uplift", (7.9, 1.13), color=GREY, ha="right")
    note(axes[1, 0], "without\nimpact", (0.8, 5.6), color=GREY)
    note(axes[1, 0], r"$(\omega/\hat{p})^2/2\pi$", (4.6, 1.35), color=GREY)
    return figure
