"""Histories by the model of Allen et al., by each simplification, and of the exact frame."""

from figures.drawing import MODELS
from figures.palette import MODEL
from replication.drawing import DOUBLE, GREY, INK, letter, make_figure, note, sheet

MOTIONS = {"pulse": "One-sine pulse", "record": "El Centro 1940, scaled"}


def draw(allen_histories):
    figure, axes = sheet(
        DOUBLE, 84, nrows=5, ncols=2, sharex="col", height_ratios=(0.7, 1, 1, 1, 1)
    )
    for column, motion in zip(axes.T, MOTIONS, strict=True):
        runs = allen_histories[allen_histories.motion == motion].groupby("model")
        exact = runs.get_group("exact")
        column[0].plot(exact.time, exact.acceleration, color=GREY, linewidth=0.7)
        column[0].set_ylabel(r"$\ddot{u}_g$ (g)")
        for axis, (model, words) in zip(column[1:], MODELS.items(), strict=True):
            run = runs.get_group(model)
            axis.plot(exact.time, exact.rotation_over_alpha, color=INK, linewidth=0.8)
            axis.plot(run.time, run.rotation_over_alpha, color=MODEL, linewidth=0.8)
            change = run.rotation_over_alpha.abs().max() / exact.rotation_over_alpha.abs().max() - 1
            words += f": peak {100 * change:+.1f} %".replace("-", "−")
            axis.text(
                0.995, 0.93, words, transform=axis.transAxes, ha="right", color=MODEL, fontsize=7.5
            )
            axis.set(ylim=(-1, 1.25), ylabel=r"$\theta/\alpha$ (–)")
        column[-1].set(xlabel="Time, $t$ (s)", xlim=(0, exact.time.max()))
    note(axes[1, 0], "exact", (0.03, 0.2), xycoords="axes fraction")
    letter(axes[0], MOTIONS.values())
    figure.align_ylabels()
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
