"""Minimum overturning amplitude for increasing γ."""

from figures.drawing import gamma
from replication.drawing import INK, SINGLE, make_figure, shades, sheet


def draw(skeleton_gain):
    table = skeleton_gain[skeleton_gain.lowered == 0.0]
    figure, axis = sheet(SINGLE, 55)
    places = range(len(table))
    axis.bar(places, table.lowest_low, color=shades(len(places)), width=0.62)
    for place, low in zip(places, table.lowest_low, strict=True):
        axis.annotate(f"{low:.3f}", (place, low), ha="center", va="bottom", color=INK, fontsize=7.5)
    axis.set(xticks=places, xticklabels=map(gamma, table.mass_ratio))
    axis.set(ylabel=r"Minimum overturning amplitude ($g\,\tan\alpha$)", ylim=(0, None))
    axis.margins(y=0.12)
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
