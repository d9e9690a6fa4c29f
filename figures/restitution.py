"""Coefficient of restitution √r against slenderness and mass ratio: Eq. (25) and its two limits."""

import numpy as np

from figures.drawing import gamma
from replication.drawing import DOUBLE, GREY, INK, letter, make_figure, note, shades, sheet

LEADERS = (  # γ and slenderness of a curve, its formula, and where that is written
    (0.0, 30.0, "Housner, solitary column:\n$1-\\frac{3}{2}\\sin^2\\alpha$", (35, 0.8)),
    (np.inf, 33.0, "$\\gamma\\to\\infty$: $\\cos 2\\alpha$", (14, 0.25)),
)
LEADER = {"arrowstyle": "-", "color": INK, "linewidth": 0.6, "shrinkA": 1, "shrinkB": 0}


def draw(restitution_over_slenderness, restitution_over_mass_ratio):
    figure, (left, right) = sheet(DOUBLE, 66, ncols=2)
    curves = restitution_over_slenderness.groupby("mass_ratio")
    for (mass_ratio, curve), colour in zip(curves, shades(len(curves)), strict=True):
        rocks = curve[curve.restitution >= 0.0]
        left.plot(curve.slenderness_deg, curve.restitution, ":", color=colour, linewidth=0.9)
        label = gamma(mass_ratio)
        left.plot(rocks.slenderness_deg, rocks.restitution, color=colour, label=label)
        if mass_ratio in (0.0, np.inf):
            end = np.interp(0.0, -curve.restitution, curve.slenderness_deg)
            left.plot(end, 0, "o", color=colour, markersize=3.5, zorder=3)
            aside = (2, 8) if mass_ratio == 0.0 else (-18, -8)
            note(left, f"{end:.1f}°", (end, 0), xytext=aside, textcoords="offset points")
    left.axhline(0, color=GREY, linewidth=0.6)
    for mass_ratio, slenderness, words, at in LEADERS:
        curve = curves.get_group(mass_ratio)
        tip = (slenderness, np.interp(slenderness, curve.slenderness_deg, curve.restitution))
        left.annotate(words, tip, at, fontsize=7.5, va="center", arrowprops=LEADER)
    note(left, "dotted: no rocking\nafter an impact", (60, 0.42), ha="right", color=GREY)
    left.legend(loc="lower left", ncols=2, labelspacing=0.2)
    left.set(xlabel=r"Slenderness, $\alpha$ (°)", xlim=(0, 60), ylim=(-0.52, 1.03))

    for slenderness, line in restitution_over_mass_ratio.groupby("slenderness_deg"):
        finite, limit = line[np.isfinite(line.mass_ratio)], line.restitution.iloc[-1]
        right.axhline(finite.restitution.iloc[0], color=GREY, linewidth=0.6, linestyle=(0, (1, 2)))
        right.axhline(limit, color=GREY, linewidth=0.8, linestyle=(0, (4, 2)))
        right.plot(finite.mass_ratio, finite.restitution, color=INK)
        right.plot(0, finite.restitution.iloc[0], "o", color=INK, markersize=3, clip_on=False)
        name = (
            r"$\alpha$ = " if slenderness == restitution_over_mass_ratio.slenderness_deg[0] else ""
        )
        note(right, f"{name}{slenderness:g}°", (10.15, limit), annotation_clip=False)
    top, limit = finite.restitution.iloc[0], line.restitution.iloc[-1]
    note(right, "Housner", (9.9, top - 0.018), ha="right", color=GREY)
    note(right, r"$\cos 2\alpha$", (9.9, limit - 0.018), ha="right", color=GREY)
    right.set(xlabel=r"Mass ratio, $\gamma$ (–)", xlim=(0, 10), ylim=(0.46, 1.01))
    for axis in (left, right):
        axis.set_ylabel(r"Coefficient of restitution, $\sqrt{r}$ (–)")
    titles = ["Restitution over the slenderness", "Restitution over the mass ratio"]
    letter([left, right], titles, first="c")
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
