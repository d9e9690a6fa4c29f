"""Minimum overturning acceleration of the trilith and a bridge, and its gain by a cap beam."""

from matplotlib.ticker import NullLocator

from figures.drawing import PULSES, gamma
from replication.drawing import DOUBLE, GREY, INK, make_figure, note, shades, sheet

PERIODS = (0.3, 0.5, 1, 2, 3, 5, 8)  # s, marked on an axis that reaches them
LEVELS = (0.2, 0.3, 0.5, 1, 2)  # g
GAINS = (1, 1.2, 1.5, 2, 2.5)


def lowest(cells):
    """Return the minimum overturning acceleration, g, by period and γ; no column if none does."""
    return cells.groupby(["period", "mass_ratio"]).lower_g.min().unstack()


def minimum(axis, lines, uplift):
    for (_, line), colour in zip(lines.items(), shades(lines.shape[1]), strict=True):
        axis.plot(line.index, line, color=colour)
    axis.axhline(uplift, color=GREY, linewidth=0.7)
    ticks(axis.yaxis, LEVELS)
    axis.set(ylim=(0.8 * uplift, 1.05 * lines.max().max()))
    at = {"xytext": (-2, -5), "textcoords": "offset points", "ha": "right"}
    note(axis, "uplift", (lines.index.max(), uplift), color=GREY, **at)


def gain(axis, lines):
    """Draw the minimum of every frame over that of the lightest structure."""
    colours = shades(lines.shape[1])
    for (mass_ratio, line), colour in list(zip(lines.items(), colours, strict=True))[1:]:
        axis.plot(line.index, line / lines.iloc[:, 0], color=colour, label=gamma(mass_ratio))
    axis.axhline(1.0, color=colours[0], label=gamma(lines.columns[0]))
    ticks(axis.yaxis, GAINS)
    axis.set(ylim=(0.95, 2.6))


def ticks(axis, places):
    """Mark an axis in equal ratios at round numbers."""
    axis.axes.set(**{f"{axis.axis_name}scale": "log"})
    axis.set_ticks(places, [f"{place:g}" for place in places])
    axis.set_minor_locator(NullLocator())


def draw(spectra_dimensional, spectra_published):
    heights = spectra_dimensional.groupby("structure", sort=False).height.first()
    names, shapes = list(heights.index), list(dict.fromkeys(spectra_dimensional["shape"]))
    grid = {"nrows": len(names), "ncols": 2 * len(shapes), "squeeze": False}
    figure, axes = sheet(DOUBLE, 4 + 42 * len(names), **grid)
    for row, name in zip(axes, names, strict=True):
        for place, shape in enumerate(shapes):
            table = spectra_dimensional
            cells = table[(table.structure == name) & (table["shape"] == shape)]
            lines, pair = lowest(cells), row[2 * place : 2 * place + 2]
            minimum(pair[0], lines, cells.uplift_g.iloc[0])
            gain(pair[1], lines)
            for axis, what in zip(pair, ("minimum", "gain"), strict=True):
                first, last = cells.period.min(), cells.period.max()
                ticks(axis.xaxis, [each for each in PERIODS if first <= each <= last])
                axis.set(xlim=(first, last), xlabel="Period of the pulse (s)")
                axis.set_title(f"{PULSES[shape]}: {what}")
            pair[1].set_ylabel(f"Ratio to {gamma(lines.columns[0])} (–)")
            pair[0].set_ylabel("Minimum amplitude (g)")
        title = f"{name.replace('_', ' ')}, {heights[name]:.1f} m"
        row[1].legend(loc="upper right", handlelength=1.4, labelspacing=0.2)
        row[0].set_ylabel(f"{title[0].upper()}{title[1:]}\nMinimum amplitude (g)")
    for point in spectra_published.itertuples():
        axis = axes[names.index(point.structure), 2 * shapes.index(point.shape)]
        axis.plot(point.period, point.printed_g, "D", color=INK, markersize=3.5, zorder=4)
        words = f"Zhou et al. (2019):\n{point.printed_g:g} g"
        at = {"xytext": (4, 12), "textcoords": "offset points"}
        note(axis, words, (point.period, point.printed_g), **at)
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
