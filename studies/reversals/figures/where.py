"""Where only the frame or only its solitary column overturns, and how often, for pairs of γ."""

import numpy as np
from matplotlib.patches import Patch

from figures.drawing import PULSES
from figures.palette import CAUSED, OVERTURNED, PREVENTED, tint
from replication.drawing import DOUBLE, GREY, PAPER, letter, make_figure, note, sheet

COLOURS = {"both": OVERTURNED, "helps": PREVENTED, "harms": CAUSED}
NAMES = {"both": "both overturn", "helps": "prevented by cap beam", "harms": "caused by cap beam"}
HIGHEST = 16.0  # a/(g tan α)


def map_axis(axis, cells):
    """Draw what only the lighter, only the heavier and both overturn, over ω and amplitude.

    One bar for each frequency, because narrow survival regions are too steep to be joined.
    """
    step = np.diff(np.unique(cells.x)).min()
    for mode, colour in COLOURS.items():
        of = cells[cells["mode"] == mode]
        seam = 0.0 if mode == "harms" else 0.25  # a seam would widen slivers
        how = {"color": colour, "edgecolor": colour, "linewidth": seam, "label": NAMES[mode]}
        axis.bar(of.x, of.upper - of.lower, step, bottom=of.lower, **how)
    axis.set(yscale="log", xlim=(0.5, 10), ylim=(0.95, HIGHEST), xticks=(1, 2, 4, 6, 8, 10))
    axis.set_yticks(ticks := (1, 2, 4, 8, 16), map(str, ticks))
    axis.set_yticks([], minor=True)


def shares(axis, areas):
    """Draw the shares of overturning prevented (up) and caused (down), by shape and slenderness."""
    slendernesses = np.sort(areas.slenderness_deg.unique())
    colours = [tint(PREVENTED, share) for share in np.linspace(0.35, 1.0, len(slendernesses))]
    for group, shape in enumerate(PULSES):
        for place, (slenderness, colour) in enumerate(zip(slendernesses, colours, strict=True)):
            of = areas[(areas["shape"] == shape) & (areas.slenderness_deg == slenderness)]
            at = group + 0.2 * (place - 1.5)
            label = f"{slenderness:.3g}°" if group == 0 else None
            axis.bar(at, 100 * of.helps, 0.18, color=colour, label=label)
            harms = 100 * of.harms.iloc[0]
            axis.bar(at, -harms, 0.18, color=CAUSED)
            how = {"color": CAUSED, "ha": "center", "va": "top", "fontsize": 6}
            note(axis, f"{harms:.1f}", (at, -harms - 0.3), **how)
    axis.axhline(0.0, color=GREY, linewidth=0.6)
    axis.set(xticks=range(len(PULSES)), ylim=(-4.2, 25), ylabel="Share of the map (%)")
    axis.set_xticklabels([words.replace(" ", "\n") for words in PULSES.values()])
    axis.tick_params(axis="x", length=0)
    axis.legend(title=r"Prevented, $\alpha$ =", title_fontsize=7.5, loc="upper right", ncols=4)
    note(axis, "Caused", (3.45, -3.2), color=CAUSED, ha="right")


def pairs(axis, areas):
    """Write the shares of overturning prevented and caused for each pair, means over all maps."""
    names = {value: "∞" if value == "infinite" else f"{float(value):g}" for value in areas.heavier}
    means = areas.groupby(["lighter", "heavier"])[["helps", "harms"]].mean() * 100
    lighter = sorted(areas.lighter.unique())
    heavier = sorted(names, key=lambda value: np.inf if value == "infinite" else float(value))
    top = means.harms.max()
    for row, light in enumerate(lighter):
        for column, heavy in enumerate(heavier):
            if (light, heavy) not in means.index:
                continue
            helps, harms = means.loc[(light, heavy)]
            axis.fill_between(
                [column, column + 1], row, row + 1, color=CAUSED, alpha=0.4 * harms / top, lw=0
            )
            at = (column + 0.5, row + 0.5)
            note(axis, f"+{helps:.1f}\n−{harms:.2f}", at, ha="center", fontsize=6.8)
    count = len(lighter)
    axis.set(
        xlim=(0, count), ylim=(count, 0), xlabel=r"Heavier, $\gamma$", ylabel=r"Lighter, $\gamma$"
    )
    axis.set_xticks(np.arange(count) + 0.5, [names[heavy] for heavy in heavier])
    axis.set_yticks(np.arange(count) + 0.5, [f"{light:g}" for light in lighter])
    axis.tick_params(length=0)
    axis.spines[["left", "bottom"]].set_visible(False)


def draw(reversals_map, reversals_areas):
    figure, axes = sheet(DOUBLE, 125, "ABCD;EEFF", height_ratios=(1, 1.15))
    slenderness = reversals_map.slenderness_deg.min()
    cells = reversals_map[
        (reversals_map.change == "both") & (reversals_map.slenderness_deg == slenderness)
    ]
    for key, shape in zip("ABCD", PULSES, strict=True):
        map_axis(axes[key], cells[cells["shape"] == shape])
        axes[key].set_xlabel(r"Frequency, $\omega/p$ (–)")
        axes[key].tick_params(labelleft=key == "A")
    axes["A"].set_ylabel(r"Amplitude, $a/(g\,\tan\alpha)$ (–)")
    ends = reversals_areas[
        (reversals_areas.lighter == 0.0) & (reversals_areas.heavier == "infinite")
    ]
    shares(axes["E"], ends)
    pairs(axes["F"], reversals_areas)
    titles = [
        *PULSES.values(),
        "$\\gamma\\to\\infty$ against the solitary column",
        "All pairs: mean share (%)",
    ]
    letter([axes[key] for key in "ABCDEF"], titles)
    neither = Patch(facecolor=PAPER, edgecolor=GREY, linewidth=0.5, label="both survive")
    handles = [*axes["D"].get_legend_handles_labels()[0], neither]
    figure.legend(handles=handles, loc="outside upper right", ncols=4, handlelength=1.0)
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
