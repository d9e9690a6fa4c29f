"""Probability of overturning and the coefficient of restitution that ends the benefit"""

from palette import ALONE, EQUAL, GREY, INK, PAPER, tint

from replication.drawing import DOUBLE, letter, note, sheet
from topheavy import Column

SETS = {"near-fault": ("o", 0.14), "broadband": ("s", -0.14)}  # marker, and place in a row


def words(lowered, reduction):
    """Return the label of a row of the table."""
    if reduction:
        return f"{lowered} {100 * reduction:g} % lower"
    return "both of Eq. (25)" if lowered == "both" else lowered


def draw(break_even, break_even_benefit, config):
    figure, axes = sheet(DOUBLE, 56, ncols=2)
    rows = break_even_benefit.set_index(["set", "lowered", "reduction"])
    keys = [*dict.fromkeys(key[1:] for key in rows.index)]  # from the lowest row upwards
    keys.sort(key=lambda key: (key[0] != "column alone", key[0] != "both", -key[1]))
    for name, (marker, off) in SETS.items():
        look = {"color": INK, "markerfacecolor": INK if marker == "o" else PAPER, "markersize": 4}
        for place, key in enumerate(keys):
            row = 100 * rows.loc[(name, *key), ["benefit", "benefit_low", "benefit_high"]]
            axes[0].hlines(place + off, row.benefit_low, row.benefit_high, color=INK, linewidth=1.1)
            label = None if place else name
            axes[0].plot(row.benefit, place + off, marker, **look, label=label)
        ends = 100 * break_even.loc[break_even.set == name, ["end", "end_low", "end_high"]]
        places = [place - off for place in range(len(ends))]
        errors = ends.end - ends.end_low, ends.end_high - ends.end
        axes[1].errorbar(places, ends.end, yerr=errors, fmt=marker, **look, elinewidth=1.1)
    low, high = (100 * share for share in config["break_even"]["measured"])
    column = Column(**config["structures"][config["motions"]["structure"]])
    lossless = 100 * (1 - 1 / column.restitution)
    axes[1].axhspan(low, high, color=tint(GREY, 0.25), lw=0)
    note(axes[1], "measured: lower", (1.5, (low + high) / 2), ha="center", fontsize=7)
    axes[1].axhline(0.0, color=GREY, linewidth=0.7)
    note(axes[1], "measured: higher", (1.5, lossless / 2), ha="center", fontsize=7)
    arrow = {"arrowstyle": "->", "color": GREY, "linewidth": 0.8, "shrinkA": 0, "shrinkB": 0}
    axes[1].annotate("", (2.3, lossless), (2.3, 0.0), arrowprops=arrow)
    note(axes[1], "above a point: column safer", (1.5, 13.5), color=ALONE, ha="center")
    note(axes[1], "below a point: frame safer", (1.5, 1.2), color=EQUAL, ha="center")
    axes[0].axvline(0.0, color=GREY, linewidth=0.7)
    note(axes[0], "frame safer", (0.5, len(keys) - 0.3), color=EQUAL)
    note(axes[0], "column safer", (-0.5, len(keys) - 0.3), color=ALONE, ha="right")
    axes[0].set(xlim=(-11, 24), ylim=(-0.5, len(keys)))
    axes[0].set_xlabel("Probability, column minus frame (percentage points)")
    axes[0].set_yticks(range(len(keys)), [words(*key) for key in keys])
    axes[0].tick_params(axis="y", length=0)
    velocities = sorted(break_even.velocity.unique())
    axes[1].set_xticks(range(len(velocities)), [f"{velocity:g}" for velocity in velocities])
    axes[1].set(xlim=(-0.5, len(velocities) - 0.5), ylim=(lossless - 0.5, 14.5))
    axes[1].set_xlabel("Peak ground velocity (m/s)")
    axes[1].set_ylabel(r"Reduction of the column's $\sqrt{r}$ (%)")
    axes[0].legend(loc="lower right", handletextpad=0.2)
    benefit = f"Benefit at {config['motions']['velocity']:g} m/s, by $\\sqrt{{r}}$"
    letter(axes, [benefit, "Reduction that ends the benefit"])
    return figure
