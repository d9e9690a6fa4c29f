"""Where the theorems end: an extreme motion, and falls of the minimum that are only apparent."""

from figures.drawing import gamma
from replication.drawing import DOUBLE, GREY, INK, letter, make_figure, note, shades, sheet

LIGHT, HEAVY = shades(2)
PLACES = {0.0: ((0.45, 0.20), LIGHT), float("inf"): ((0.96, 0.55), HEAVY)}


def draw(certainty_lowest, certainty_lowest_histories):
    figure, axes = sheet(DOUBLE, 58, ncols=2)
    for ratio, course in certainty_lowest_histories.groupby("mass_ratio"):
        place, colour = PLACES[ratio]
        axes[0].plot(course.time, course.rotation_over_alpha, color=colour, linewidth=1.1)
        note(axes[0], gamma(ratio), place, color=colour, ha="right", xycoords="axes fraction")
    ground = axes[0].twinx()
    ground.plot(course.time, course.acceleration, color=GREY, linewidth=0.6)
    ground.set(ylabel="Ground acceleration (g)")
    ground.spines.right.set_visible(True)
    axes[0].axhline(0.0, color=INK, linewidth=0.5, linestyle=":")
    axes[0].set(
        xlabel="Time over duration of the motion (–)", ylabel=r"Rotation, $\theta/\alpha$ (–)"
    )
    axes[0].set(xlim=(0, 2))
    table = certainty_lowest
    axes[1].plot(table.coarse, table["last"], "o", color=INK, markersize=2.6)
    ends = (min(table.coarse.min(), 0.98) - 0.01, 1.0)
    axes[1].plot(ends, ends, color=GREY, linewidth=0.6, linestyle=":")
    axes[1].axhline(1.0, color=INK, linewidth=0.6)
    axes[1].set(xlim=ends, xlabel="Ratio of the minima, coarse grid (–)", ylabel="Finer grids (–)")
    letter(axes, ["Extreme motion, exact equation", "Apparent falls of the minimum"])
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
