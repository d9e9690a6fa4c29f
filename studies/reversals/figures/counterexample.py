"""Histories under a pulse that overturns the frame with γ → ∞ and not its solitary column."""

import numpy as np

from figures.heavier import history
from replication.drawing import DOUBLE, GREY, INK, PAPER, letter, make_figure, note, sheet


def first_impact(axis, run):
    """Mark the first impact: where the rotation first changes its sign."""
    theta = run.rotation_over_alpha.to_numpy()
    at = np.flatnonzero(theta[:-1] * theta[1:] < 0.0)[0]
    place = (run.time.iloc[at], 0.0)
    axis.plot(*place, "o", color=INK, markerfacecolor=PAPER, markersize=3.5, zorder=3)
    note(axis, "first impact", place, xytext=(-5, 7), textcoords="offset points", ha="right")


def draw(reversals_histories):
    figure, axes = sheet(DOUBLE, 54, ncols=2, sharey=True)
    exact = reversals_histories[~reversals_histories.linearised]
    for axis, (_, run) in zip(axes, exact.groupby("mass_ratio"), strict=True):
        history(axis, run, run.iloc[0])
        first_impact(axis, run)
        axis.set_xlabel(r"Time, $t\,\omega/2\pi$ (–)")
    letter(axes, [axis.get_title(loc="left") for axis in axes], first="g")
    axes[0].set(ylim=(-2, 2), yticks=(-2, -1, 0, 1, 2), ylabel=r"Rotation, $\theta/\alpha$ (–)")
    note(axes[0], "pulse", (1.03, -1.72), color=GREY)
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
