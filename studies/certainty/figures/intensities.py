"""Probability of overturning at stated peak ground velocities: bare, free cap beam, fixed mass."""

from figures.palette import FIXED
from replication.drawing import DOUBLE, make_figure, note, shades, sheet

BARE, FREE = shades(2)
SUPPORTS = {
    "fixed": (FIXED, "s", "same mass fixed"),
    "bare": (BARE, "^", "solitary columns"),
    "free": (FREE, "o", "free cap beam"),
}
FAMILIES = ("near-fault", "broadband")
NAMES = {"temple": "temple columns", "bridge": "piers"}
SHIFT = 0.012


def draw(certainty_intensities):
    table = certainty_intensities[certainty_intensities.measure == "pgv"]
    structures = list(dict.fromkeys(table.structure))
    figure, axes = sheet(
        DOUBLE, 74, nrows=2, ncols=len(structures), sharex=True, sharey=True, squeeze=False
    )
    for row, family in zip(axes, FAMILIES, strict=True):
        for axis, structure in zip(row, structures, strict=True):
            here = table[(table.family == family) & (table.structure == structure)]
            for shift, (support, (colour, mark, _)) in enumerate(SUPPORTS.items()):
                rows = here[here.support == support]
                ends = (
                    rows.probability - rows.probability_low,
                    rows.probability_high - rows.probability,
                )
                axis.errorbar(
                    rows.level + (shift - 1) * SHIFT,
                    rows.probability,
                    yerr=ends,
                    fmt=f"{mark}-",
                    color=colour,
                    markersize=3.2,
                    linewidth=0.9,
                    elinewidth=0.7,
                )
            axis.set(ylim=(-0.02, 1), xlim=(0.1, 1.1), xticks=(0.2, 0.4, 0.6, 1.0))
        row[0].set_ylabel(f"Probability, {family} (–)")
    for axis, structure in zip(axes[0], structures, strict=True):
        size, unit, name = structure.split()
        axis.set_title(f"{float(size):.0f} {unit} {NAMES.get(name, name)}")
    for axis in axes[1]:
        axis.set_xlabel("PGV (m/s)")
    for place, (colour, mark, words) in enumerate(SUPPORTS.values()):
        height = 0.9 - 0.09 * place
        within = {"xycoords": "axes fraction", "color": colour}
        axes[0, 0].plot(
            0.07, height, mark, color=colour, markersize=3.2, transform=axes[0, 0].transAxes
        )
        note(axes[0, 0], words, (0.12, height), **within)
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
