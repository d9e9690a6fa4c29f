"""Required coefficient of friction over frequency and amplitude of a pulse."""

from matplotlib.colors import BoundaryNorm

from figures.drawing import amplitude_axis, gamma
from figures.palette import DEMAND, HATCHED, OPENS, OVERTURNED
from replication.drawing import DOUBLE, INK, letter, make_figure, note, sheet

LEVELS = [1.0, 1.2, 1.5, 2.0, 3.0, 4.0, 6.0]  # of tan α
HIGHEST = 24.0
BARE = {"facecolor": OVERTURNED, "edgecolor": "none"}


def draw(mechanism_admissible):
    ratios = sorted(mechanism_admissible.mass_ratio.unique())
    figure, axes = sheet(DOUBLE, 66, ncols=len(ratios), sharey=True)
    norm = BoundaryNorm(LEVELS, DEMAND.N, extend="max")
    for axis, mass_ratio in zip(axes, ratios, strict=True):
        table = mechanism_admissible[mechanism_admissible.mass_ratio == mass_ratio]
        axis.patch.set(**HATCHED)
        stands = table.demand.where(~table.overturned)
        cells = table.assign(stands=stands).pivot_table(
            index="amplitude", columns="frequency_ratio", values="stands", dropna=False
        )
        image = axis.pcolormesh(
            cells.columns,
            cells.index,
            cells,
            cmap=DEMAND,
            norm=norm,
            shading="nearest",
            rasterized=True,
        )
        pulls = table.pivot_table(index="amplitude", columns="frequency_ratio", values="pulls")
        if pulls.to_numpy().any():
            axis.contour(
                pulls.columns, pulls.index, pulls.astype(float), [0.5], colors=OPENS, linewidths=1
            )
            if mass_ratio == min(ratio for ratio in ratios if ratio > 0.0):
                at = (3.2, 0.72 * table[table.pulls].amplitude.min())
                words, bare = "tension at a\ncolumn top", BARE | {"pad": 1}
                note(axis, words, at, color=OPENS, ha="center", fontsize=7, bbox=bare)
        amplitude_axis(axis)
        axis.set(ylim=(1, HIGHEST), xlabel=r"Frequency, $\omega/p$ (–)")
        axis.set_yticks(ticks := (1, 2, 3, 5, 10, 20), map(str, ticks))
    axes[0].set_ylabel(r"Amplitude, $a/(g\,\tan\alpha)$ (–)")
    note(axes[0], "overturns", (2.6, 12.0), ha="center", color=INK, bbox=BARE | {"pad": 2})
    bar = figure.colorbar(image, ax=axes, ticks=LEVELS, pad=0.01)
    bar.set_label(r"Required coefficient of friction, $\mu/\tan\alpha$ (–)")
    bar.ax.set_yticks([], minor=True)
    bar.ax.set_yticklabels([f"{level:g}" for level in LEVELS])
    letter(axes, [gamma(g) + (", solitary column" if g == 0 else "") for g in ratios])
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
