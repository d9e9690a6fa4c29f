"""Peak rotation and outcome against size under measured records: column and frames."""

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.patches import Patch, Rectangle

from figures.drawing import RECORDS, gamma
from figures.palette import HATCHED, PEAKS, UNDECIDED
from replication.drawing import DOUBLE, GREY, make_figure, note, sheet

COLUMNS = 4
TICKS = (0.5, 1, 2, 5, 10, 20)
HIGH = 0.8  # of a strip, over the distance of two


def panel(axis, cells, ratios):
    """Draw one strip for each γ: peak rotation by shade, what overturns, what cannot be decided."""
    for place, ratio in enumerate(ratios):
        run = cells[cells.mass_ratio == ratio].sort_values("size")
        size, edge = run["size"].to_numpy(), place - HIGH / 2
        ends = np.sqrt(size[1:] * size[:-1])  # half-way on the axis in equal ratios
        ends = [size[0] ** 2 / ends[0], *ends, size[-1] ** 2 / ends[-1]]
        axis.add_patch(Rectangle((ends[0], edge), ends[-1] - ends[0], HIGH, linewidth=0, **HATCHED))
        peaks = run.peak_over_alpha.where(~run.overturned & run.decided).to_numpy()[None]
        how = {"cmap": PEAKS, "vmin": 0, "vmax": 1, "rasterized": True}
        axis.pcolormesh(ends, [edge, edge + HIGH], peaks, **how)
        for left, right, told in zip(ends[:-1], ends[1:], run.decided, strict=True):
            if not told:
                axis.add_patch(Rectangle((left, edge), right - left, HIGH, color=UNDECIDED, lw=0))
        around = {"facecolor": "none", "edgecolor": GREY, "linewidth": 0.5}
        axis.add_patch(Rectangle((ends[0], edge), ends[-1] - ends[0], HIGH, **around))
    axis.set(xscale="log", xlim=(0.47, 21.5), ylim=(-0.55, len(ratios) - 0.45))
    axis.set_xticks(TICKS, [f"{tick:g}" for tick in TICKS])
    axis.set_xticks([], minor=True)
    axis.set_yticks(range(len(ratios)), map(gamma, ratios))
    axis.tick_params(axis="y", length=0)


def draw(rocking_spectra):
    ratios = sorted(rocking_spectra.mass_ratio.unique())
    records = rocking_spectra.groupby("record", sort=False)
    rows = 1 + len(records) // COLUMNS  # the last place is for the key
    figure, axes = sheet(DOUBLE, 37 * rows, nrows=rows, ncols=COLUMNS, sharey=True, squeeze=False)
    for axis in axes.flat[len(records) :]:
        axis.axis("off")
    for axis, (record, cells) in zip(axes.flat, records, strict=False):
        panel(axis, cells, ratios)
        axis.set_title(RECORDS.get(record, record.replace("_", " ")))
        axis.set_xlabel("Size of a column, $R$ (m)")
    key = axes[-1, -1]
    patches = [Patch(linewidth=0, label="overturns", **HATCHED)]
    patches += [Patch(color=UNDECIDED, linewidth=0, label="cannot be decided")]
    key.legend(handles=patches, loc="upper left", handlelength=1.4, borderaxespad=0)
    words = "(the outcome changes if the record\nis rescaled by $10^{-9}$)"
    note(key, words, (0.0, 0.42), xycoords="axes fraction", fontsize=7)
    bar = key.inset_axes((0.02, 0.14, 0.9, 0.1))
    figure.colorbar(ScalarMappable(cmap=PEAKS), cax=bar, orientation="horizontal")
    bar.set_xlabel(r"survives; peak rotation, $\theta_\mathrm{max}/\alpha$ (–)")
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
