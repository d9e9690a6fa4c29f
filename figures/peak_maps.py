"""Peak rotation of column and frames under pulses, and the pulses that overturn them."""

from matplotlib.colors import BoundaryNorm

from figures.drawing import gamma
from figures.palette import HATCHED, OVERTURNED, PEAKS
from replication.drawing import DOUBLE, INK, letter, make_figure, note, sheet

LEVELS = [0, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.1]  # of α


def draw(peak_maps):
    ratios = sorted(peak_maps.mass_ratio.unique())
    figure, axes = sheet(DOUBLE, 58, ncols=len(ratios), sharey=True)
    norm = BoundaryNorm(LEVELS, PEAKS.N, extend="max")
    for axis, mass_ratio in zip(axes, ratios, strict=True):
        cells = peak_maps[peak_maps.mass_ratio == mass_ratio].drop(columns="mass_ratio")
        cells = cells.set_index("amplitude_over_uplift")
        axis.axhspan(1.0, 12.0, linewidth=0.0, **HATCHED)
        image = axis.pcolormesh(
            cells.columns.astype(float),
            cells.index,
            cells,
            cmap=PEAKS,
            norm=norm,
            shading="nearest",
            rasterized=True,
        )
        axis.set(xlim=(0.5, 8), ylim=(0, 12), xlabel=r"Frequency, $\omega/p$ (–)")
        axis.set(xticks=(1, 2, 4, 6, 8), yticks=(0, 1, 3, 6, 9, 12))
    axes[0].set_ylabel(r"Amplitude, $a/(g\,\tan\alpha)$ (–)")
    bare = {"facecolor": OVERTURNED, "edgecolor": "none", "pad": 2}
    note(axes[0], "overturns", (2.1, 9.0), ha="center", bbox=bare)
    note(axes[0], "no uplift", (5.0, 0.5), ha="center", color=INK, fontsize=7)
    bar = figure.colorbar(image, ax=axes, ticks=[0, 0.2, 0.4, 0.6, 0.8, 1.0], pad=0.01)
    bar.set_label(r"Peak rotation, $\theta_\mathrm{max}/\alpha$ (–)")
    bar.ax.set_yticks([], minor=True)
    names = [", solitary column", "", ""]
    letter(axes, [gamma(g) + name for g, name in zip(ratios, names, strict=True)])
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
