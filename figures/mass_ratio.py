"""Size and coefficient of restitution of the frame against its mass ratio: Eqs. (24), (25)."""

import numpy as np

from replication.drawing import GREY, INK, PAPER, SINGLE, letter, make_figure, note, sheet

AS_HEAVY = 1.0  # γ of a cap beam as heavy as both columns
ASIDE = {"textcoords": "offset points"}


def size(axis, mass_ratio):
    """Draw R̂/R, its limit, and what γ = 1 gives of the increase."""
    finite, last = mass_ratio[np.isfinite(mass_ratio.mass_ratio)], mass_ratio.iloc[-1]
    axis.axhline(last.size_ratio, color=GREY, linestyle=(0, (4, 2)), linewidth=0.8)
    limit = r"limit 3/2 for $\gamma\to\infty$"
    note(axis, limit, (10, last.size_ratio), xytext=(0, 7), ha="right", color=GREY, **ASIDE)
    axis.plot(finite.mass_ratio, finite.size_ratio, color=INK)
    axis.plot(0, 1, "o", color=INK, markersize=3.5, clip_on=False, zorder=3)
    note(axis, "solitary column", (0, 1), xytext=(9, 0), **ASIDE)
    reached, share = (
        float(np.interp(AS_HEAVY, finite.mass_ratio, finite[name]))
        for name in ("size_ratio", "share_of_size_gain")
    )
    axis.plot(AS_HEAVY, reached, "o", color=INK, markerfacecolor=PAPER, markersize=4, zorder=3)
    words = (
        f"$\\gamma$ = {AS_HEAVY:g}: {reached:.2f}, or {100 * share:.0f} %\nof the possible increase"
    )
    note(axis, words, (AS_HEAVY, reached), xytext=(8, -9), **ASIDE)
    axis.set(xlim=(0, 10), ylim=(0.97, 1.56), ylabel=r"Size, $\hat{R}/R$ (–)")


def restitution(axis, table):
    """Draw √r for several slendernesses, from the solitary column to its limit (dashed)."""
    for place, (slenderness, line) in enumerate(table.groupby("slenderness_deg")):
        finite, limit = line[np.isfinite(line.mass_ratio)], line.restitution.iloc[-1]
        axis.axhline(limit, color=GREY, linewidth=0.8, linestyle=(0, (4, 2)))
        axis.plot(finite.mass_ratio, finite.restitution, color=INK)
        axis.plot(0, finite.restitution.iloc[0], "o", color=INK, markersize=3, clip_on=False)
        name = r"$\alpha$ = " if place == 0 else ""
        at = {"xytext": (0, 2 - 2 * place), "textcoords": "offset points"} if place < 2 else {}
        note(axis, f"{name}{slenderness:g}°", (10.15, limit), annotation_clip=False, **at)
    axis.set(xlim=(0, 10), ylim=(0.46, 1.02), xlabel=r"Mass ratio, $\gamma$ (–)")
    axis.set_ylabel(r"Restitution, $\sqrt{r}$ (–)")


def draw(mass_ratio, restitution_over_mass_ratio):
    figure, axes = sheet(SINGLE, 84, nrows=2, sharex=True, height_ratios=(1.35, 1))
    size(axes[0], mass_ratio)
    restitution(axes[1], restitution_over_mass_ratio)
    letter(axes, ["Size of the equivalent column", "Coefficient of restitution of the frame"])
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
