"""Where the theorems end: an extreme motion, and what it overturns."""

from figures.drawing import gamma
from replication.drawing import GREY, INK, SINGLE, make_figure, note, shades, sheet

LIGHT, HEAVY = shades(2)
PLACES = {0.0: ((0.45, 0.20), LIGHT), float("inf"): ((0.96, 0.55), HEAVY)}


def draw(certainty_lowest_histories):
    figure, axis = sheet(SINGLE, 58)
    for ratio, course in certainty_lowest_histories.groupby("mass_ratio"):
        place, colour = PLACES[ratio]
        axis.plot(course.time, course.rotation_over_alpha, color=colour, linewidth=1.1)
        note(axis, gamma(ratio), place, color=colour, ha="right", xycoords="axes fraction")
    ground = axis.twinx()
    ground.plot(course.time, course.acceleration, color=GREY, linewidth=0.6)
    ground.set(ylabel="Ground acceleration (g)")
    ground.spines.right.set_visible(True)
    axis.axhline(0.0, color=INK, linewidth=0.5, linestyle=":")
    axis.set(xlabel="Time over duration of the motion (–)", xlim=(0, 2))
    axis.set_ylabel(r"Rotation, $\theta/\alpha$ (–)")
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
