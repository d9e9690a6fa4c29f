"""Histories under a pulse that overturns the frame with γ → ∞ and not its solitary column."""

from figures.heavier import history
from replication.drawing import DOUBLE, GREY, letter, note, publish, sheet


def draw(reversals_histories):
    figure, axes = sheet(DOUBLE, 54, ncols=2, sharey=True)
    exact = reversals_histories[~reversals_histories.linearised]
    for axis, (_, run) in zip(axes, exact.groupby("mass_ratio"), strict=True):
        history(axis, run, run.iloc[0])
        axis.set_xlabel(r"Time, $t\,\omega/2\pi$ (–)")
    letter(axes, [axis.get_title(loc="left") for axis in axes], first="g")
    axes[0].set(ylim=(-2, 2), yticks=(-2, -1, 0, 1, 2), ylabel=r"Rotation, $\theta/\alpha$ (–)")
    note(axes[0], "pulse", (1.03, -1.72), color=GREY)
    return figure


if __name__ == "__main__":
    publish(snakemake, draw)
