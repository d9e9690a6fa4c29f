"""What overturns the trilith and a bridge: amplitude in g over the period of the pulse in s."""

from drawing import (
    ACCENT,
    DOUBLE,
    PULSES,
    bands,
    gamma,
    letter,
    note,
    publish,
    shades,
    sheet,
)

FRAMES = {"trilith": "Trilith, columns of 0.8 m", "bridge": "Bridge, piers of 7.0 m"}
HIGHEST = {"trilith": 2.0, "bridge": 1.5}  # g
NAMES = {"period": "x", "lower_g": "lower", "upper_g": "upper"}
FILLS = {"with impact": "#e8eff5", "without impact": "#c0ccd7"}
SHOWN = 0.01  # g: what is narrower, tongue or bay, is not drawn


def draw(spectra_dimensional, spectra_published):
    table = spectra_dimensional.drop(columns=["lower", "upper"]).rename(columns=NAMES)
    shapes = list(dict.fromkeys(table["shape"]))
    figure, axes = sheet(DOUBLE, 112, nrows=len(shapes), ncols=len(FRAMES), sharex="col")
    for row, shape in zip(axes, shapes, strict=True):
        for axis, name in zip(row, FRAMES, strict=True):
            cells = table[(table.structure == name) & (table["shape"] == shape)]
            panel(axis, cells, HIGHEST[name])
            axis.set_ylabel("Amplitude (g)")
            note(axis, PULSES[shape], (0.98, 0.94), xycoords="axes fraction", ha="right")
    for point in spectra_published.itertuples():
        axis = axes[shapes.index(point.shape), list(FRAMES).index(point.structure)]
        axis.plot(point.period, point.printed_g, "o", color=ACCENT, markersize=4, zorder=4)
        words = f"Zhou et al. (2019): {point.printed_g:g} g"
        note(axis, words, (point.period, 0.1), ha="center", color=ACCENT)
    for axis in axes[-1]:
        axis.set_xlabel("Period of the pulse (s)")
    first = axes[0, 0]
    note(first, "overturns without impact", (1.3, 1.1), ha="center")
    note(first, "after an impact", (0.95, 0.45), ha="center")
    letter(axes[0], FRAMES.values())
    return figure


def panel(axis, cells, highest):
    """Fill what overturns the heaviest, by its mode; draw the lowest amplitude of every γ."""
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
