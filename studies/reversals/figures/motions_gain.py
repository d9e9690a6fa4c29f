"""Gain of the median overturning PGV by a cap beam; cells in which only one structure overturns."""

import math

import numpy as np

from figures.drawing import by_size, gamma
from figures.palette import CAUSED, PREVENTED
from replication.drawing import DOUBLE, GREY, INK, PAPER, letter, make_figure, note, sheet

STRUCTURE = "temple"
FAMILIES = {"near-fault": ("o", -1), "broadband": ("s", 1)}  # marker, side
HATCHES = {"near-fault": None, "broadband": "//////"}
SHIFT = 0.007  # so that the two families stand beside each other
LEFT = 0.72  # of the axis for reversals, over that for the other cells


def gains(axis, medians, mass_ratio):
    frames = medians[(medians.as_large_as == 0) & (medians.family == "near-fault")]
    x = by_size(mass_ratio, frames.mass_ratio)
    axis.plot(x, 100 * frames.expected_gain, color=GREY, linewidth=0.9)
    note(axis, r"if only $\hat p\,\mathrm{PGV}$ mattered", (0.45, 5.4), color=GREY)
    for family, (marker, side) in FAMILIES.items():
        run = medians[(medians.family == family) & (medians.gain != 0)]
        for solitary, face in ((False, INK), (True, PAPER)):
            points = run[(run.as_large_as > 0) == solitary]
            ratios = points.as_large_as if solitary else points.mass_ratio
            errors = 100 * np.array([points.gain - points.gain_low, points.gain_high - points.gain])
            how = {"fmt": marker, "markersize": 3.5, "linewidth": 0.9, "markerfacecolor": face}
            x = by_size(mass_ratio, ratios) + SHIFT * (side - 4 * solitary)
            axis.errorbar(x, 100 * points.gain, errors, color=INK, **how)
    ratios = sorted(medians.mass_ratio.unique())
    names = [r"$\infty$" if math.isinf(ratio) else f"{ratio:g}" for ratio in ratios]
    axis.set_xticks(by_size(mass_ratio, ratios), names)
    axis.set(xlabel=r"Mass ratio, $\gamma$ (–), by equal steps of $\hat R$", ylim=(0, 40))
    axis.set_ylabel("Gain of the median overturning PGV (%)")
    for place, (family, (marker, _)) in enumerate(FAMILIES.items()):
        height = 37 - 3.2 * place
        axis.plot(0.035, height, marker, color=INK, markersize=3.5)
        note(axis, f"{family} motions", (0.06, height))
    note(axis, r"hollow: solitary column of size $\hat R$", (0.02, 30.6))


def falls(axis, pairs):
    """Draw the share of cells in which only one of frame and solitary column overturns."""
    run = pairs[pairs.lighter == 0]
    ratios = sorted(run.heavier.unique())
    for family, (_, side) in FAMILIES.items():
        cells = run[run.family == family].sort_values("heavier")
        places = np.arange(len(ratios)) - 0.18 * side
        for key, sign, colour in (("only_lighter", 1, PREVENTED), ("only_heavier", -1, CAUSED)):
            share, low, high = (100 * cells[key + end] for end in ("", "_low", "_high"))
            errors = np.array([share - low, high - share])[::sign]
            how = {"color": colour, "hatch": HATCHES[family], "edgecolor": PAPER, "linewidth": 0}
            axis.barh(places, sign * share, height=0.32, **how)
            axis.errorbar(sign * share, places, xerr=errors, fmt="none", color=INK, linewidth=0.7)
    axis.axvline(0.0, color=INK, linewidth=0.6)
    axis.set(yticks=range(len(ratios)), yticklabels=map(gamma, ratios))
    reach, top = 110 * run.only_lighter_high.max(), len(ratios) - 0.3
    axis.set(xlim=(-LEFT * reach, reach), ylim=(-0.6, top + 0.4))
    ticks = np.arange(-10, reach, 5)
    axis.set_xticks(ticks, [f"{abs(tick):g}" for tick in ticks])
    axis.set_xlabel("Share of all motions at all intensities (%)")
    note(axis, "only the frame overturns", (-0.03 * reach, top), ha="right", color=CAUSED)
    note(axis, "only the column overturns", (0.03 * reach, top))


def draw(reversals_pairs, reversals_medians, mass_ratio):
    figure, axes = sheet(DOUBLE, 66, ncols=2)
    gains(axes[0], reversals_medians[reversals_medians.structure == STRUCTURE], mass_ratio)
    falls(axes[1], reversals_pairs[reversals_pairs.structure == STRUCTURE])
    letter(axes, ["Gain of the median capacity", "Outcomes that differ"])
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
