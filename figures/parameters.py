"""Size, frequency parameter and coefficient of restitution of the frame."""

import numpy as np
from palette import GREY, INK

from replication.drawing import DOUBLE, gamma, letter, note, ring, shaded, sheet

LEADER = {"arrowstyle": "-", "color": INK, "linewidth": 0.6, "shrinkA": 1, "shrinkB": 0}
FORMULAS = (  # γ and slenderness of a curve, its formula, and where that is written
    (0.0, 30.0, "Housner, solitary column:\n$1-\\frac{3}{2}\\sin^2\\alpha$", (30, 0.86)),
    (np.inf, 33.0, "$\\gamma\\to\\infty$: $\\cos 2\\alpha$", (13, 0.4)),
)
RATIOS = {  # column; name, limit, and where both are written
    "size_ratio": (r"size $\hat{R}/R$", r"$\hat{R}/R\to 3/2$", 7),
    "frequency_ratio": (r"frequency parameter $\hat{p}/p$", r"$\hat{p}/p\to\sqrt{2/3}$", 12),
}


def over_mass_ratio(axis, table):
    finite, last = table[np.isfinite(table.mass_ratio)], table.iloc[-1]
    end = finite.mass_ratio.max()
    for column, (name, limit, above) in RATIOS.items():
        axis.axhline(last[column], color=GREY, linestyle=":", linewidth=0.9)
        note(axis, limit, (end, last[column]), (0, above), ha="right", color=GREY)
        axis.plot(finite.mass_ratio, finite[column], color=INK)
        reached = np.interp(1.0, finite.mass_ratio, finite[column])
        ring(axis, 1.0, reached, size=4, zorder=3)
        aside = (6, -8 if column == "size_ratio" else 8)
        note(axis, f"{name} = {reached:.2f} at $\\gamma$ = 1", (1.0, reached), aside)
    axis.plot(0, 1, "o", color=INK, markersize=3.5, clip_on=False, zorder=3)
    note(axis, "solitary column", (0, 1), (9, 0))
    axis.set(xlim=(0, end), ylim=(0.75, 1.58), xlabel=r"Mass ratio, $\gamma$ (–)")
    axis.set_ylabel("Frame over column (–)")


def over_slenderness(axis, table):
    curves = table.groupby("mass_ratio")
    for (mass_ratio, curve), colour in shaded(curves):
        rocks = curve[curve.restitution >= 0.0]
        axis.plot(curve.slenderness_deg, curve.restitution, ":", color=colour, linewidth=0.9)
        axis.plot(rocks.slenderness_deg, rocks.restitution, color=colour, label=gamma(mass_ratio))
        if mass_ratio in (0.0, np.inf):
            end = np.interp(0.0, -curve.restitution, curve.slenderness_deg)
            axis.plot(end, 0, "o", color=colour, markersize=3.5, zorder=3)
            aside = (2, 8) if mass_ratio == 0.0 else (-18, -8)
            note(axis, f"{end:.1f}°", (end, 0), aside)
    axis.axhline(0, color=GREY, linewidth=0.6)
    for mass_ratio, slenderness, words, place in FORMULAS:
        curve = curves.get_group(mass_ratio)
        tip = (slenderness, np.interp(slenderness, curve.slenderness_deg, curve.restitution))
        axis.annotate(words, tip, place, fontsize=7.5, va="center", arrowprops=LEADER)
    axis.legend(loc="lower left", ncols=2, labelspacing=0.2)
    axis.set(xlabel=r"Slenderness, $\alpha$ (°)", xlim=(0, 60), ylim=(-0.52, 1.03))
    axis.set_ylabel(r"Coefficient of restitution, $\sqrt{r}$ (–)")


def draw(mass_ratio, restitution):
    figure, (left, right) = sheet(DOUBLE, 58, ncols=2)
    over_mass_ratio(left, mass_ratio)
    over_slenderness(right, restitution)
    letter([left, right], ["Size and frequency parameter", "Coefficient of restitution"])
    return figure
