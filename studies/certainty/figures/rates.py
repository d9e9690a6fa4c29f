"""Mean annual rate of overturning over that of the bare column: free cap beam, fixed mass."""

import numpy as np

from figures.drawing import by_size
from figures.palette import FIXED
from replication.drawing import DARKEST, DOUBLE, GREY, INK, PAPER, letter, make_figure, note, sheet

FAMILIES = ("near-fault", "broadband")
MARKS = ("o", "s", "^")  # by exponent, ascending
SUPPORTS = {
    "fixed": (FIXED, FIXED, "same mass fixed"),
    "free": (DARKEST, PAPER, "free cap beam"),
}
MIDDLE = 2.0  # exponent of the lines for columns with a lower √r
SHIFT = 0.012


def draw(certainty_rates, mass_ratio):
    table = certainty_rates[certainty_rates.earthquake == "both"]
    table = table[(table.highest == table.highest.max()) & (table.column == 0)]
    exponents = sorted(table.exponent.unique())
    ratios = sorted(table[table.structure == "free"].mass_ratio.unique())
    figure, axes = sheet(DOUBLE, 70, ncols=2, sharey=True)
    for axis, family in zip(axes, FAMILIES, strict=True):
        here = table[table.family == family]
        for name, (colour, face, _) in SUPPORTS.items():
            for shift, (exponent, mark) in enumerate(zip(exponents, MARKS, strict=True)):
                rows = here[(here.structure == name) & (here.exponent == exponent)]
                axis.errorbar(
                    by_size(mass_ratio, rows.mass_ratio) + (shift - 1) * SHIFT,
                    rows.over,
                    yerr=np.array([rows.over - rows.over_low, rows.over_high - rows.over]),
                    fmt=mark,
                    color=colour,
                    markerfacecolor=face,
                    markersize=3.2,
                    elinewidth=0.7,
                )
        columns = here[(here.structure == "bare") & (here.exponent == MIDDLE)]
        for column in columns[columns.lowered > 0].itertuples():
            axis.axhline(column.over, color=GREY, linewidth=0.8, linestyle="--")
            highest = column.over == columns.over.where(columns.lowered > 0).max()
            beside, side = (1.04, "bottom") if highest else (0.96, "top")
            words = f"column, √r {100 * column.lowered:g} % lower"
            note(axis, words, (0.02, column.over * beside), color=GREY, va=side, fontsize=7)
        axis.axhline(1.0, color=INK, linewidth=0.6)
        names = [r"$\infty$" if np.isinf(g) else f"{g:g}" for g in ratios]
        axis.set_xticks(by_size(mass_ratio, ratios), names)
        axis.set(yscale="log", ylim=(0.3, 10), xlim=(0.0, 1.06))
        axis.set_yticks([0.3, 0.5, 1, 2, 5, 10], ["0.3", "0.5", "1", "2", "5", "10"])
        axis.set_xlabel(r"Mass ratio, $\gamma$ (–), by equal steps of $\hat R$")
        axis.minorticks_off()
    axes[0].set_ylabel("Rate over that of the solitary column (–)")
    for place, (colour, face, words) in enumerate(SUPPORTS.values()):
        at, height = axes[0].transAxes, 0.94 - 0.07 * place
        how = {"color": colour, "markerfacecolor": face, "markersize": 3.2, "transform": at}
        axes[0].plot(0.04, height, MARKS[1], **how)
        note(axes[0], words, (0.07, height), color=colour, xycoords="axes fraction")
    for place, (exponent, mark) in enumerate(zip(exponents, MARKS, strict=True)):
        height = 0.94 - 0.07 * place
        axes[1].plot(0.04, height, mark, color=INK, markersize=3.2, transform=axes[1].transAxes)
        note(axes[1], f"$k$ = {exponent:g}", (0.07, height), xycoords="axes fraction")
    letter(axes, ["Near-fault motions", "Broadband motions"])
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
