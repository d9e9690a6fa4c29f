"""Frame and equivalent column with Housner's √r: where their outcomes differ."""

from matplotlib.colors import ListedColormap

from figures.drawing import PULSES
from figures.palette import CAUSED, OVERTURNED, PREVENTED, greys
from replication.drawing import DOUBLE, GREY, PAPER, letter, make_figure, note, sheet

STYLES = ("o-", "s--", "^-.", "D:")


def draw(mechanism_equivalence, mechanism_equivalence_map):
    figure, (left, middle, right) = sheet(DOUBLE, 58, ncols=3, width_ratios=(1.2, 1, 1))
    cells = mechanism_equivalence_map.set_index("frequency_ratio").T
    colours = ListedColormap([PAPER, PREVENTED, CAUSED, OVERTURNED])
    left.pcolormesh(
        cells.columns,
        cells.index.astype(float),
        cells,
        cmap=colours,
        vmin=0,
        vmax=3,
        shading="nearest",
        rasterized=True,
    )
    left.set(xlabel=r"Frequency, $\omega/p$ (–)", ylabel=r"Amplitude, $a/(g\,\tan\alpha)$ (–)")
    left.set(xticks=(1, 2, 4, 6, 8), yticks=(1, 3, 6, 9, 12))
    note(left, "both overturn", (1.0, 9.5))
    note(left, "both survive", (5.2, 2.2))
    note(left, "only the\ncolumn\noverturns", (7.9, 6.0), ha="right")

    for shape, colour, style in zip(PULSES, greys(len(PULSES)), STYLES, strict=True):
        part = mechanism_equivalence[mechanism_equivalence["shape"] == shape]
        heaviest = part[part.mass_ratio == part.mass_ratio.max()]
        how = {"color": colour, "markersize": 3, "label": PULSES[shape]}
        middle.plot(heaviest.slenderness, 100 * heaviest.share_apart, style, **how)
        right.plot(heaviest.slenderness, 100 * heaviest.lowest_change_mean, style, **how)
    ticks = sorted(mechanism_equivalence.slenderness.unique())
    for axis in (middle, right):
        axis.set_xticks(ticks, [f"{tick:.3g}" for tick in ticks])
        axis.set_xlabel(r"Slenderness, $\alpha$ (°)")
    middle.set(ylabel="Pulses with different outcomes (%)", ylim=(0, 10))
    right.set(ylabel="Column against frame (%)")
    right.axhline(0.0, color=GREY, linewidth=0.5)
    middle.legend(loc="upper left", ncols=2, fontsize=6.5, columnspacing=0.8)
    letter(
        (left, middle, right), ["Outcomes", "Share of different outcomes", "Mean minimum amplitude"]
    )
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
