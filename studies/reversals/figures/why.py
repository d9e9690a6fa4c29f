"""Effects of the lower p̂ and of the lower √r in the limit γ → ∞, apart and together."""

import numpy as np

from figures.drawing import PULSES
from figures.palette import CAUSED, OVERTURNED, PREVENTED
from replication.drawing import DOUBLE, make_figure, note, sheet

COLOURS = {"both": OVERTURNED, "helps": PREVENTED, "harms": CAUSED}
HIGHEST = 16.0  # a/(g tan α)
ROWS = {
    "size": r"$\hat{p}$ alone",
    "restitution": r"$\sqrt{r}$ alone",
    "both": "The frame: both",
}


def map_axis(axis, cells):
    """Draw what only the lighter, only the heavier and both overturn, over ω and amplitude.

    One bar for each frequency, because narrow survival regions are too steep to be joined.
    """
    step = np.diff(np.unique(cells.x)).min()
    for mode, colour in COLOURS.items():
        of = cells[cells["mode"] == mode]
        seam = 0.0 if mode == "harms" else 0.25  # a seam would widen slivers
        how = {"color": colour, "edgecolor": colour, "linewidth": seam}
        axis.bar(of.x, of.upper - of.lower, step, bottom=of.lower, **how)
    axis.set(yscale="log", xlim=(0.5, 10), ylim=(0.95, HIGHEST), xticks=(1, 2, 4, 6, 8, 10))
    axis.set_yticks(ticks := (1, 2, 4, 8, 16), map(str, ticks))
    axis.set_yticks([], minor=True)


def draw(reversals_map, reversals_why):
    figure, axes = sheet(DOUBLE, 102, nrows=3, ncols=4, sharex=True, sharey=True)
    slenderness = reversals_map.slenderness_deg.max()
    why = reversals_why[reversals_why.heavier == "infinite"]
    for row, (change, name) in zip(axes, ROWS.items(), strict=True):
        for axis, (shape, words) in zip(row, PULSES.items(), strict=True):
            cells, of = (
                table[
                    (table.change == change)
                    & (table["shape"] == shape)
                    & (table.slenderness_deg == slenderness)
                ]
                for table in (reversals_map, why)
            )
            map_axis(axis, cells)
            how = {"xycoords": "axes fraction", "ha": "right", "fontsize": 7}
            note(axis, f"prevented {100 * of.helps.iloc[0]:.1f} %", (0.99, 0.15), **how)
            note(axis, f"caused {100 * of.harms.iloc[0]:.2f} %", (0.99, 0.05), color=CAUSED, **how)
            if change == "size":
                axis.set_title(words)
            if change == "both":
                axis.set_xlabel(r"Frequency, $\omega/p$ (–)")
        row[0].set_ylabel(f"{name}\nAmplitude, " + r"$a/(g\,\tan\alpha)$ (–)")
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
