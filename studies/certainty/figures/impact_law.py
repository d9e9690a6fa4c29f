"""What hangs on the impact law: maps under pulses, and probabilities under synthetic motions."""

from replication.drawing import ACCENT, DARK, DOUBLE, GREY, INK, LIGHT, letter, note, publish, sheet

WAYS = {
    "both": (DARK, "both √r"),
    "frame alone": (LIGHT, "frame alone"),
    "column alone": (ACCENT, "column alone"),
    "scatter": (GREY, "random, from this factor"),
}
FAMILIES = ("near-fault", "broadband")
SHIFT = 0.002


def draw(certainty_restitution):
    table = certainty_restitution
    figure, axes = sheet(DOUBLE, 58, ncols=3)
    pulses = table[table.under == "pulses"]
    for way, (colour, _) in list(WAYS.items())[:3]:
        rows = pulses[pulses.way == way].sort_values("factor")
        axes[0].plot(rows.factor, 100 * rows.helps, "o-", color=colour, markersize=2.6)
        axes[0].plot(rows.factor, 100 * rows.harms, "o--", color=colour, markersize=2.6)
    axes[0].set(ylabel="Share of the plane (%)", ylim=(0, None))
    less = table[table.under == "difference"]
    for axis, family in zip(axes[1:], FAMILIES, strict=True):
        for shift, (way, (colour, _)) in enumerate(WAYS.items()):
            rows = less[(less.way == way) & (less.family == family)].sort_values("factor")
            ends = (rows.less - rows.less_low, rows.less_high - rows.less)
            axis.errorbar(
                rows.factor + (shift - 1.5) * SHIFT,
                rows.less,
                yerr=ends,
                fmt="o" if way == "scatter" else "o-",
                color=colour,
                markersize=2.6,
                linewidth=0.9,
                elinewidth=0.7,
            )
        axis.axhline(0.0, color=INK, linewidth=0.6)
        axis.set(ylabel="Probability, column less frame (–)")
    for place, (colour, words) in enumerate(WAYS.values()):
        at = (0.04, 0.26 - 0.07 * place)
        note(axes[1], words, at, color=colour, xycoords="axes fraction")
    low = min(axis.get_ylim()[0] for axis in axes[1:])
    high = max(axis.get_ylim()[1] for axis in axes[1:])
    for axis in axes[1:]:
        axis.set_ylim(low - 0.3 * (high - low), high)
    for axis in axes:
        axis.set(xlabel="Factor on √r (–)")
    letter(axes, ["Pulses: prevented, caused (dashed)", "Near-fault motions", "Broadband motions"])
    return figure


if __name__ == "__main__":
    publish(snakemake, draw)
