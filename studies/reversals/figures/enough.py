"""The γ that gives half, nine tenths and 99 % of the gain in the limit γ → ∞."""

import numpy as np

from figures.drawing import PULSES
from replication.drawing import DOUBLE, GREY, INK, PAPER, make_figure, note, sheet

QUANTILES = [0.0, 0.25, 0.5, 0.75, 1.0]


def draw(reversals_enough):
    shares = np.sort(reversals_enough.share.unique())
    places = reversals_enough.sort_values("size_gain")  # γ is linear in 1/(1 − size_gain)
    figure, axes = sheet(DOUBLE, 62, ncols=len(shares), sharey=True)
    for axis, share in zip(axes, shares, strict=True):
        of = reversals_enough[reversals_enough.share == share]
        for place, shape in enumerate(PULSES):
            low, lower, middle, upper, high = of[of["shape"] == shape].mass_ratio.quantile(
                QUANTILES
            )
            axis.plot([low, high], [place] * 2, color=INK, linewidth=0.8)
            axis.plot([lower, upper], [place] * 2, color=INK, linewidth=6, solid_capstyle="butt")
            axis.plot(middle, place, "o", color=PAPER, markeredgecolor=INK, markersize=4)
        size = np.interp(1 / (1 - share), 1 / (1 - places.size_gain), places.mass_ratio)
        middle = of.mass_ratio.median()
        axis.axvline(size, color=INK, linewidth=0.9)
        axis.axvline(middle, color=GREY, linewidth=0.9, linestyle=(0, (3, 2)))
        note(axis, r"$\hat{R}$  ", (size, -0.62), color=INK, ha="right")
        note(axis, "  median", (middle, -0.62), color=GREY, ha="left")
        axis.set(xscale="log", xlabel=r"Mass ratio, $\gamma$ (–)")
        axis.set_title(f"{100 * share:g} % of the gain")
    axes[0].set(yticks=range(len(PULSES)), yticklabels=PULSES.values(), ylim=(3.6, -0.85))
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
