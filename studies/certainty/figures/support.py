"""What the support of a mass does to the probability of overturning, and how √r decides it."""

from figures.palette import ALONE, EQUAL, FIXED
from replication.drawing import GREY, INK, PAPER, SINGLE, letter, make_figure, note, sheet

STRUCTURE, PGV = "6 m temple", 0.6  # m/s
SUPPORTS = {  # from the lowest row upwards
    "free": ("frame, $\\gamma$ = 1:\nmass carried freely", EQUAL),
    "bare": ("solitary column", ALONE),
    "fixed": ("vase, $\\gamma$ = 1:\nmass fixed to it", FIXED),
}
FAMILIES = {"near-fault": ("o", 0.14), "broadband": ("s", -0.14)}  # marker and place in a row
WAYS = {  # from the lowest row upwards
    ("column alone", 0.9): "column, 10 % lower",
    ("column alone", 0.95): "column, 5 % lower",
    ("both", 1.0): "both by Eq. (25)",
    ("frame alone", 0.95): "frame, 5 % lower",
}


def dots(axis, rows, value, at, colour, family):
    """Draw values in per cent with their intervals, in a row."""
    mark, off = FAMILIES[family]
    (one,) = (100 * rows[[value, f"{value}_low", f"{value}_high"]]).to_numpy()
    axis.hlines(at + off, one[1], one[2], color=colour, linewidth=1.1)
    face = colour if mark == "o" else PAPER
    axis.plot(one[0], at + off, mark, color=colour, markerfacecolor=face, markersize=4)
    return one[2], at + off


def draw(certainty_intensities, certainty_benefit):
    table = certainty_intensities
    table = table[(table.structure == STRUCTURE) & (table.measure == "pgv") & (table.level == PGV)]
    figure, axes = sheet(SINGLE, 90, nrows=2, height_ratios=(1.15, 1.15))
    for at, (support, (_, colour)) in enumerate(SUPPORTS.items()):
        for family in FAMILIES:
            rows = table[(table.support == support) & (table.family == family)]
            end = dots(axes[0], rows, "probability", at, colour, family)
            if support == "bare":
                note(axes[0], family, (end[0] + 1.5, end[1]), color=colour)
    for at, (way, factor) in enumerate(WAYS):
        for family in FAMILIES:
            rows = certainty_benefit[
                (certainty_benefit.way == way)
                & (certainty_benefit.factor == factor)
                & (certainty_benefit.family == family)
            ]
            dots(axes[1], rows, "less", at, INK, family)
    axes[1].axvline(0.0, color=GREY, linewidth=0.7)
    note(axes[1], "frame is safer", (0.5, 3.62), color=GREY)
    note(axes[1], "column is safer", (-0.5, 3.62), color=GREY, ha="right")
    axes[0].set(xlim=(0, 65), ylim=(-0.5, 2.5), xlabel="Probability of overturning (%)")
    axes[0].set_yticks(range(3), [words for words, _ in SUPPORTS.values()])
    axes[1].set(xlim=(-13, 24), ylim=(-0.5, 3.95))
    axes[1].set_xlabel("Probability of column less that of frame (points)")
    axes[1].set_yticks(range(4), WAYS.values())
    axes[1].set_ylabel(r"$\sqrt{r}$")
    for axis in axes:
        axis.tick_params(axis="y", length=0)
    letter(axes, [f"Overturning at a PGV of {PGV:g} m/s", "Benefit, if one of the two loses more"])
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
