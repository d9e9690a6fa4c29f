"""Overturning spectra of the trilith and a bridge: amplitude in g against pulse period in s."""

from figures.drawing import PULSES, bands, gamma
from replication.drawing import ACCENT, DOUBLE, letter, note, publish, shades, sheet

HIGHEST = 7.0  # over the amplitude of uplift
NAMES = {"period": "x", "lower_g": "lower", "upper_g": "upper"}
FILLS = {"with impact": "#e8eff5", "without impact": "#c0ccd7"}
SHOWN = 0.01  # g: narrower bands and survival regions are not drawn


def draw(spectra_dimensional, spectra_published):
    table = spectra_dimensional.drop(columns=["lower", "upper"]).rename(columns=NAMES)
    heights = table.groupby("structure", sort=False).height.first()
    names, shapes = list(heights.index), list(dict.fromkeys(table["shape"]))
    grid = {"nrows": len(shapes), "ncols": len(names), "sharex": "col", "squeeze": False}
    figure, axes = sheet(DOUBLE, 4 + 54 * len(shapes), **grid)
    for row, shape in zip(axes, shapes, strict=True):
        for axis, name in zip(row, names, strict=True):
            cells = table[(table.structure == name) & (table["shape"] == shape)]
            panel(axis, cells)
            axis.set_ylabel("Amplitude (g)")
            note(axis, PULSES[shape], (0.98, 0.94), xycoords="axes fraction", ha="right")
    for point in spectra_published.itertuples():
        axis = axes[shapes.index(point.shape), names.index(point.structure)]
        axis.plot(point.period, point.printed_g, "o", color=ACCENT, markersize=4, zorder=4)
        words = f"Zhou et al. (2019): {point.printed_g:g} g"
        note(axis, words, (point.period, 0.1), ha="center", color=ACCENT)
    for axis in axes[-1]:
        axis.set_xlabel("Period of the pulse (s)")
    inside = {"xycoords": "axes fraction", "ha": "center"}
    note(axes[0, 0], "overturns without impact", (0.5, 0.6), **inside)
    note(axes[-1, 0], "after an impact", (0.22, 0.62), **inside)
    titles = (f"{name.replace('_', ' ')}, columns of {heights[name]:.1f} m" for name in names)
    letter(axes[0], [title[0].upper() + title[1:] for title in titles])
    return figure


def panel(axis, cells):
    """Fill the overturning regions of the heaviest frame by mode; draw the minimum of every γ."""
    highest = HIGHEST * cells.uplift_g.iloc[0]
    ratios = sorted(cells.mass_ratio.unique())
    heaviest = cells[cells.mass_ratio == ratios[-1]]
    for mode, colour in FILLS.items():
        for band in bands(heaviest, mode, 2.0 * highest, SHOWN):
            axis.fill_between(*zip(*band, strict=True), color=colour, linewidth=0.3)
    for mass_ratio, colour in zip(ratios, shades(len(ratios)), strict=True):
        lowest = cells[cells.mass_ratio == mass_ratio].groupby("x").lower.min()
        axis.plot(lowest.index, lowest, color=colour, label=gamma(mass_ratio))
    axis.axhline(cells.uplift_g.iloc[0], color=ACCENT, linewidth=0.7)
    axis.set(ylim=(0, highest), xlim=(cells.x.min(), cells.x.max()))
    note(
        axis,
        "uplift",
        (cells.x.max(), cells.uplift_g.iloc[0]),
        xytext=(-2, -5),
        textcoords="offset points",
        ha="right",
        color=ACCENT,
    )
    axis.legend(loc="upper right", bbox_to_anchor=(1, 0.9), handlelength=1.4)


if __name__ == "__main__":
    publish(snakemake, draw)
