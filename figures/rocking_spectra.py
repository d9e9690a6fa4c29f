"""Peak rotation against size under real records, and the sizes that overturn: column and frames."""

from figures.drawing import RECORDS, gamma
from replication.drawing import ACCENT, DOUBLE, GREY, note, publish, shades, sheet

COLUMNS = 3
TICKS = (0.5, 1, 2, 5, 10, 20)
ABOVE, APART = 1.12, 0.1  # of θ/α: where the strips of overturned sizes begin, and their distance


def panel(axis, cells, ratios):
    for place, (mass_ratio, colour) in enumerate(zip(ratios, shades(len(ratios)), strict=True)):
        run = cells[cells.mass_ratio == mass_ratio].sort_values("size")
        axis.plot(run["size"], run.peak_over_alpha, color=colour, linewidth=0.9)
        fallen, open_ones = run[run.overturned & run.told], run[~run.told]
        height = ABOVE + APART * place
        strip = {"linestyle": "none", "markersize": 4.2, "markeredgewidth": 1.1}
        axis.plot(fallen["size"], [height] * len(fallen), "|", color=colour, **strip)
        strip = {"linestyle": "none", "markersize": 1.6, "markeredgewidth": 0}
        axis.plot(open_ones["size"], [height] * len(open_ones), "o", color=ACCENT, **strip)
    axis.axhline(1.0, color=GREY, linewidth=0.5)
    axis.set(xscale="log", xlim=(0.48, 21), ylim=(0, ABOVE + APART * len(ratios)))
    axis.set_xticks(TICKS, [f"{tick:g}" for tick in TICKS])
    axis.set_xticks([], minor=True)
    axis.set_yticks((0, 0.5, 1.0))


def draw(rocking_spectra):
    ratios = sorted(rocking_spectra.mass_ratio.unique())
    records = rocking_spectra.groupby("record", sort=False)
    rows = 1 + len(records) // COLUMNS  # the last place is for the key
    figure, axes = sheet(DOUBLE, 50 * rows, nrows=rows, ncols=COLUMNS, sharey=True, squeeze=False)
    for axis in axes.flat[len(records) :]:
        axis.axis("off")
    for axis, (record, cells) in zip(axes.flat, records, strict=False):
        panel(axis, cells, ratios)
        axis.set_title(RECORDS.get(record, record.replace("_", " ")))
        axis.set_xlabel("Size of a column, $R$ (m)")
    for row in axes:
        row[0].set_ylabel(r"Peak rotation, $\theta_\mathrm{max}/\alpha$ (–)")
    key = axes[-1, -1]
    for place, (mass_ratio, colour) in enumerate(zip(ratios, shades(len(ratios)), strict=True)):
        height = 1.3 - 0.2 * place
        key.plot([0.55, 1.1], [height] * 2, color=colour)
        key.plot([1.3, 1.45, 1.6], [height] * 3, "|", color=colour, markeredgewidth=1.1)
        note(key, f"{gamma(mass_ratio)}: peak; overturned", (1.9, height))
    height = 1.22 - 0.2 * len(ratios)
    key.plot([1.45], [height], "o", color=ACCENT, markersize=2, markeredgewidth=0)
    note(
        key,
        "undecided: the outcome changes if the\nrecord is rescaled by $10^{-9}$",
        (1.9, height),
    )
    key.set(xscale="log", xlim=(0.48, 21), ylim=axes[0, 0].get_ylim())
    return figure


if __name__ == "__main__":
    publish(snakemake, draw)
