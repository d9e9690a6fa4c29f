"""The fewest intervals with which the trapezoidal rule integrates within a given error."""

from replication.drawing import INK, SINGLE, make_figure, shades, sheet


def draw(skeleton_limit):
    table = skeleton_limit
    figure, axis = sheet(SINGLE, 50)
    places = range(len(table))
    axis.bar(places, table.intervals, color=shades(len(places)), width=0.62)
    for place, intervals in zip(places, table.intervals, strict=True):
        axis.annotate(f"{intervals}", (place, intervals), ha="center", va="bottom", color=INK)
    axis.set(xticks=places, xticklabels=[f"{error:.1%}" for error in table.error])
    axis.set(xlabel="Error of the integral (%)", ylabel="Fewest intervals (–)", ylim=(0, None))
    axis.margins(y=0.12)
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
