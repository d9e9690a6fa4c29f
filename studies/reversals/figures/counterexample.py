"""Histories under a pulse that overturns the frame with γ → ∞ and not its solitary column."""

from figures.heavier import history
from replication.drawing import DOUBLE, GREY, INK, note, publish, sheet


def draw(reversals_histories):
    figure, axes = sheet(DOUBLE, 84, nrows=2, ncols=2, sharex=True, sharey=True)
    models = reversals_histories.groupby("linearised")
    for row, (linearised, both) in zip(axes, models, strict=True):
        for axis, (_, run) in zip(row, both.groupby("mass_ratio"), strict=True):
            history(axis, run, run.iloc[0], INK)
            if linearised:
                axis.set_title(f"{axis.get_title('left')}, linearised")
                axis.set_xlabel(r"Time, $t\,\omega/2\pi$ (–)")
        row[0].set_ylabel(r"Rotation, $\theta/\alpha$ (–)")
    axes[0, 0].set(ylim=(-2, 2), yticks=(-2, -1, 0, 1, 2))
    note(axes[0, 0], "pulse", (1.03, -1.72), color=GREY)
    return figure


if __name__ == "__main__":
    publish(snakemake, draw)
