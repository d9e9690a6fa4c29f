"""Housner's two scale effects: the larger of two similar columns, the longer of two pulses."""

from figures.palette import OVERTURNS, SURVIVES
from replication.drawing import DOUBLE, GREY, PALE, letter, make_figure, note, sheet

DASHES = {"smaller": (0, (4, 1.5)), "larger": "-"}


def draw(scale_effects):
    figure, axes = sheet(
        DOUBLE, 58, nrows=2, ncols=2, sharex=True, sharey="row", height_ratios=(0.45, 1)
    )
    for (top, bottom), pulse in zip(axes.T, ("shorter", "longer"), strict=True):
        runs = scale_effects[scale_effects.pulse == pulse].groupby("column")
        bottom.axhspan(-1, 1, color=PALE, linewidth=0)
        for column, dashes in DASHES.items():
            run = runs.get_group(column)
            fell = run.rotation_over_alpha.abs().max() > 1.2
            colour = OVERTURNS if fell else SURVIVES
            bottom.plot(run.time, run.rotation_over_alpha, color=colour, linestyle=dashes)
            peak = run.rotation_over_alpha.abs().max()
            words = f"{column} column ({'solid' if dashes == '-' else 'dashed'}) " + (
                "overturns" if fell else f"survives, peak {peak:.2f}$\\,\\alpha$"
            )
            at = (0.98, 0.14 if column == "larger" else 0.05)
            note(bottom, words, at, xycoords="axes fraction", ha="right", color=colour)
        top.plot(run.time, run.acceleration, color=GREY)
        bottom.set(xlabel="Time, $t$ (s)", ylim=(-1.4, 1.4), xlim=(0, run.time.max()))
    axes[0, 0].set_ylabel(r"$\ddot{u}_g$ (g)")
    axes[1, 0].set_ylabel(r"Rotation, $\theta/\alpha$ (–)")
    letter(axes[0], ["Shorter pulse", "Longer pulse, same amplitude"])
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
