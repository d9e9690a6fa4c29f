"""Probability of overturning of a temple's columns for increasing γ, and its reduction."""

import math

from figures.drawing import gamma
from replication.drawing import DOUBLE, GREY, INK, letter, make_figure, note, shades, sheet

STRUCTURE = "temple"
FAMILIES = ("near-fault", "broadband")
INTENSITIES, VELOCITIES = (0.5, 0.8, 1, 1.5, 2), (0.5, 0.75, 1, 1.5, 2)
BAND = {"alpha": 0.25, "linewidth": 0}


def fragility(axis, curves, colours):
    """Draw all curves, with bands for the lightest and the heaviest."""
    for ratio, colour in colours.items():
        curve = curves[curves.mass_ratio == ratio]
        axis.plot(curve.intensity, curve.probability, color=colour, linewidth=1.0)
        if ratio in (0.0, math.inf):
            band = (curve.intensity, curve.probability_low, curve.probability_high)
            axis.fill_between(*band, color=colour, **BAND)
    axis.axhline(0.5, color=GREY, linewidth=0.5)
    axis.set(ylim=(0, 1), yticks=(0, 0.5, 1))


def less(axis, curves, colours):
    """Draw by how much two of the curves are below that without a cap."""
    for ratio, place in ((1.0, 6), (math.inf, 34)):
        curve, colour = curves[curves.mass_ratio == ratio], colours[ratio]
        points, low, high = (100 * curve[name] for name in ("less", "less_low", "less_high"))
        axis.plot(curve.intensity, points, color=colour, linewidth=1.0)
        axis.fill_between(curve.intensity, low, high, color=colour, **BAND)
        note(axis, gamma(ratio), (1.05, place), color=colour)
    axis.axhline(0.0, color=INK, linewidth=0.6)
    axis.set(ylim=(-4, 40))


def logarithmic(axis, ends, ticks):
    axis.set(xscale="log", xlim=ends)
    axis.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    axis.set_xticks([], minor=True)


def draw(reversals_fragility):
    table = reversals_fragility
    table = table[(table.structure == STRUCTURE) & (table.as_large_as == 0)]
    ratios = sorted(table.mass_ratio.unique())
    colours = dict(zip(ratios, shades(len(ratios)), strict=True))
    figure, axes = sheet(DOUBLE, 98, nrows=2, ncols=2, sharey="row")
    for column, family in zip(axes.T, FAMILIES, strict=True):
        curves = table[table.family == family]
        fragility(column[0], curves, colours)
        less(column[1], curves, colours)
        for axis in column:
            axis.set_xlabel(r"Intensity, $p\,\mathrm{PGV}/(g\,\tan\alpha)$ (–)")
            logarithmic(axis, (curves.intensity.min(), curves.intensity.max()), INTENSITIES)
        top = column[0].twiny()
        logarithmic(top, (curves.pgv.min(), curves.pgv.max()), VELOCITIES)
        top.set_xlabel("PGV (m/s)")
        top.spines.top.set_visible(True)
    letter(axes[0], [f"{family.capitalize()} motions" for family in FAMILIES])
    for axis, mark, family in zip(axes[1], "cd", FAMILIES, strict=True):
        axis.set_title(f"({mark}) Reduction by the cap beam: {family}")
    axes[0, 0].set_ylabel("Probability of overturning (–)")
    axes[1, 0].set_ylabel("Reduction (percentage points)")
    for place, (ratio, colour) in enumerate(colours.items()):
        words = gamma(ratio) + (", column" if ratio == 0 else "")
        column, row = divmod(place, -(-len(ratios) // 2))
        at = (0.58 + 0.25 * column, 0.41 - 0.105 * row)
        note(axes[0, 1], words, at, color=colour, xycoords="axes fraction")
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
