"""The largest amplitude for which the period is that of small swings, within a given share."""

from replication.drawing import INK, SINGLE, make_figure, shades, sheet


def draw(skeleton_limit):
    table = skeleton_limit
    figure, axis = sheet(SINGLE, 50)
    places = range(len(table))
    axis.bar(places, table.amplitude_deg, color=shades(len(places)), width=0.62)
    for place, degrees in zip(places, table.amplitude_deg, strict=True):
        axis.annotate(f"{degrees:.1f}", (place, degrees), ha="center", va="bottom", color=INK)
    axis.set(xticks=places, xticklabels=[f"{share:.1%}" for share in table.share])
    axis.set(xlabel="Error of the period (%)", ylabel="Largest amplitude (°)", ylim=(0, None))
    axis.margins(y=0.12)
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
