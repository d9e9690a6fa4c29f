"""Difference between three bodies by Newton and Euler and one degree of freedom."""

from figures.drawing import PULSES
from figures.palette import RECORD, greys
from replication.drawing import DOUBLE, INK, letter, make_figure, sheet

PANELS = {
    "rotation_apart": r"Rotation, over $\alpha$",
    "force_apart": "Forces, over the weight",
    "ratio_apart": r"Coefficient of restitution, from $\sqrt{r}$",
}
LABELS = PULSES | {"el_centro_1940_NS": "El Centro"}
MARKERS = "os^D"


def draw(mechanism_three_bodies):
    figure, axes = sheet(DOUBLE, 58, ncols=len(PANELS), sharex=True)
    groups = list(mechanism_three_bodies.groupby("excitation", sort=False))
    colours = [*greys(len(groups) - 1), RECORD]
    for axis, name in zip(axes, PANELS, strict=True):
        for (excitation, part), marker, colour in zip(groups, MARKERS, colours, strict=True):
            label = LABELS[excitation]
            axis.loglog(
                part.mass_ratio, part[name], marker + "-", color=colour, markersize=4, label=label
            )
        axis.set(xlabel=r"Mass ratio, $\gamma$ (–)", xticks=(0.01, 0.1, 1, 10, 100))
        axis.set_xticks([], minor=True)
    axes[0].set_ylabel("Largest difference (–)", color=INK)
    figure.legend(*axes[0].get_legend_handles_labels(), loc="outside upper right", ncols=4)
    letter(axes, PANELS.values())
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
