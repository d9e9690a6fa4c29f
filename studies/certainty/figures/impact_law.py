"""What hangs on the impact law: maps under pulses, and probabilities under synthetic motions."""

from figures.palette import CAUSED, PREVENTED
from replication.drawing import DOUBLE, GREY, INK, PAPER, letter, make_figure, note, sheet

WAYS = {  # of scaling √r: marker, colour and face, words
    "both": ("o", INK, INK, "both √r"),
    "frame alone": ("s", INK, PAPER, "frame alone"),
    "column alone": ("^", GREY, GREY, "column alone"),
    "scatter": ("D", GREY, PAPER, "random, from this factor"),
}
FAMILIES = ("near-fault", "broadband")
SHIFT = 0.002


def draw(certainty_restitution):
    table = certainty_restitution
    figure, axes = sheet(DOUBLE, 58, ncols=3)
    pulses = table[table.under == "pulses"]
    for way, (marker, _, face, _) in list(WAYS.items())[:3]:
        rows = pulses[pulses.way == way].sort_values("factor")
        for share, colour, line in ((rows.helps, PREVENTED, "-"), (rows.harms, CAUSED, "--")):
            how = {"color": colour, "markersize": 3}
            how["markerfacecolor"] = PAPER if face == PAPER else colour
            axes[0].plot(rows.factor, 100 * share, marker + line, **how)
    axes[0].set(ylabel="Share of the map (%)", ylim=(0, None))
    less = table[table.under == "difference"]
    for axis, family in zip(axes[1:], FAMILIES, strict=True):
        for shift, (way, (marker, colour, face, _)) in enumerate(WAYS.items()):
            rows = less[(less.way == way) & (less.family == family)].sort_values("factor")
            ends = (rows.less - rows.less_low, rows.less_high - rows.less)
            axis.errorbar(
                rows.factor + (shift - 1.5) * SHIFT,
                rows.less,
                yerr=ends,
                fmt=marker if way == "scatter" else marker + "-",
                color=colour,
                markersize=3,
                markerfacecolor=face,
                linewidth=0.9,
                elinewidth=0.7,
            )
        axis.axhline(0.0, color=INK, linewidth=0.6)
        axis.set(ylabel="Probability, column less frame (–)")
    for place, (marker, colour, face, words) in enumerate(WAYS.values()):
        x, y = 0.04, 0.26 - 0.07 * place
        how = {"color": colour, "markerfacecolor": face, "markersize": 3}
        axes[1].plot(x, y, marker, transform=axes[1].transAxes, **how)
        note(axes[1], words, (x + 0.04, y), color=colour, xycoords="axes fraction")
    low = min(axis.get_ylim()[0] for axis in axes[1:])
    high = max(axis.get_ylim()[1] for axis in axes[1:])
    for axis in axes[1:]:
        axis.set_ylim(low - 0.3 * (high - low), high)
    for axis in axes:
        axis.set(xlabel="Factor on √r (–)")
    letter(axes, ["Pulses: prevented, caused (dashed)", "Near-fault motions", "Broadband motions"])
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
