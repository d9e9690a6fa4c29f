"""Coefficient of restitution √r against slenderness: Eq. (25) and its two limits."""

import numpy as np

from figures.drawing import gamma
from replication.drawing import GREY, INK, SINGLE, make_figure, note, shades, sheet

LEADERS = (  # γ and slenderness of a curve, its formula, and where that is written
    (0.0, 30.0, "Housner, solitary column:\n$1-\\frac{3}{2}\\sin^2\\alpha$", (33, 0.82)),
    (np.inf, 33.0, "$\\gamma\\to\\infty$: $\\cos 2\\alpha$", (11, 0.25)),
)
LEADER = {"arrowstyle": "-", "color": INK, "linewidth": 0.6, "shrinkA": 1, "shrinkB": 0}


def draw(restitution_over_slenderness):
    figure, axis = sheet(SINGLE, 66)
    curves = restitution_over_slenderness.groupby("mass_ratio")
    for (mass_ratio, curve), colour in zip(curves, shades(len(curves)), strict=True):
        rocks = curve[curve.restitution >= 0.0]
        axis.plot(curve.slenderness_deg, curve.restitution, ":", color=colour, linewidth=0.9)
        label = gamma(mass_ratio)
        axis.plot(rocks.slenderness_deg, rocks.restitution, color=colour, label=label)
        if mass_ratio in (0.0, np.inf):
            end = np.interp(0.0, -curve.restitution, curve.slenderness_deg)
            axis.plot(end, 0, "o", color=colour, markersize=3.5, zorder=3)
            aside = (2, 8) if mass_ratio == 0.0 else (-18, -8)
            note(axis, f"{end:.1f}°", (end, 0), xytext=aside, textcoords="offset points")
    axis.axhline(0, color=GREY, linewidth=0.6)
    for mass_ratio, slenderness, words, at in LEADERS:
        curve = curves.get_group(mass_ratio)
        tip = (slenderness, np.interp(slenderness, curve.slenderness_deg, curve.restitution))
        axis.annotate(words, tip, at, fontsize=7.5, va="center", arrowprops=LEADER)
    note(axis, "dotted: no rocking\nafter an impact", (60, 0.42), ha="right", color=GREY)
    axis.legend(loc="lower left", ncols=2, labelspacing=0.2)
    axis.set(xlabel=r"Slenderness, $\alpha$ (°)", xlim=(0, 60), ylim=(-0.52, 1.03))
    axis.set_ylabel(r"Coefficient of restitution, $\sqrt{r}$ (–)")
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
