"""What uplift limits: base shear over shaking, ratios to the held frame, and what it costs."""

from figures.drawing import gamma
from replication.drawing import DOUBLE, GREY, INK, PAPER, letter, make_figure, note, shades, sheet

SERIES = {
    ("base_shear", "pinned"): ("base shear", "o", INK, INK),
    ("overturning_moment", "pinned"): ("overturning moment", "s", GREY, GREY),
    ("bending_moment", "pinned"): ("bending moment", "^", INK, INK),
    ("bending_moment", "guided"): ("the same, tops guided", "^", INK, PAPER),
}
MARKS = {"pulse": ".", "record": "+"}
DRAWN = 1.0  # γ of the ratios


def shear(axis, limits):
    """Draw the base shear just after uplift over ü_g, and the largest of every survivor."""
    levels, highest = sorted(limits.mass_ratio.unique()), limits.peak_acceleration.max()
    axis.plot([0.0, highest], [0.0, highest], color=INK, linewidth=0.8, linestyle=(0, (4, 2)))
    note(axis, "rigid, held", (0.55, 0.60), rotation=62, ha="center", fontsize=7)
    for ratio, colour in zip(levels, shades(len(levels)), strict=True):
        of = limits[limits.mass_ratio == ratio].sort_values("peak_acceleration")
        for kind, mark in MARKS.items():
            rows = of[of.kind == kind]
            axis.plot(rows.peak_acceleration, rows.base_shear, mark, color=colour, markersize=3)
        axis.plot(of.peak_acceleration, of.shear_after_uplift, color=colour)
        end = of.shear_after_uplift.iloc[-1]
        note(axis, gamma(ratio), (1.03 * highest, end), color=colour)
    axis.set(xlim=(0, 1.35 * highest), ylim=(0, 0.7), xticks=(0, 0.5, 1.0))
    axis.set(xlabel="Peak ground acceleration (g)", ylabel="Base shear over weight (–)")


def ratios(axis, table):
    """Draw the range and the median of the ratios over the period of the frame that is held."""
    of = table[(table.mass_ratio == DRAWN) & (table.kind == "pulse")]
    held = list(of.held.unique())
    for shift, ((force, top), (label, mark, colour, face)) in enumerate(SERIES.items()):
        rows = of[(of.force == force) & (of.top == top)].set_index("held").loc[held]
        x = [place + 0.19 * (shift - 1.5) for place in range(len(held))]
        axis.vlines(x, rows.least, rows.largest, color=colour, linewidth=1.0)
        how = {"color": colour, "markersize": 3.5, "markerfacecolor": face}
        axis.plot(x, rows["median"], mark, label=label, **how)
    axis.axhline(1.0, color=GREY, linewidth=0.6)
    axis.set(yscale="log", ylim=(0.04, 30))
    axis.set_yticks((0.1, 1, 10), ("0.1", "1", "10"))
    names = [name.removesuffix(" s").replace("rigid", "0\nrigid") for name in held]
    axis.set_xticks(range(len(held)), names)
    axis.set(xlabel="Period of the held frame (s)", ylabel="Rocking over held (–)")
    axis.legend(loc="upper left", fontsize=7)


def cost(axis, limits):
    """Draw the largest rotation of survivors over the ratio of shears, and how many overturned."""
    of = limits[limits.kind == "pulse"]
    levels = sorted(of.mass_ratio.unique())
    for place, (ratio, colour) in enumerate(zip(levels, shades(len(levels)), strict=True)):
        rows = of[of.mass_ratio == ratio]
        axis.plot(rows["base_shear, pinned, rigid"], rows.rotation, ".", color=colour, markersize=3)
        fell = int((rows.outcome == "overturned").sum())
        text = f"{gamma(ratio)}: {fell} of {len(rows)} overturned"
        note(axis, text, (0.98, 2.85 - 0.19 * place), color=colour, ha="right", fontsize=7)
    axis.axhline(1.0, color=GREY, linewidth=0.6, linestyle=":")
    axis.set(xlim=(0, 1), ylim=(0, 3), yticks=(0, 1, 2, 3))
    axis.set(xlabel="Base shear, rocking over rigid held (–)")
    axis.set_ylabel(r"Largest rotation, $|\theta|/\alpha$ (–)")


def draw(uplift_limits, uplift_ratios):
    figure, axes = sheet(DOUBLE, 70, ncols=3)
    shear(axes[0], uplift_limits)
    ratios(axes[1], uplift_ratios)
    cost(axes[2], uplift_limits)
    letter(axes, ["Base shear", f"Peak forces, {gamma(DRAWN)}", "Rotation and overturning"])
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
