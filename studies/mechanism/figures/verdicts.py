"""Outcomes under pulses in MuJoCo and in theory, and the friction that prevents sliding."""

import numpy as np

from figures.drawing import gamma
from figures.palette import OVERTURNS, SURVIVES
from replication.drawing import DOUBLE, GREY, INK, PAPER, letter, make_figure, note, shades, sheet
from studies.mechanism.figures.marks import untested

CONTACTS = {"plastic": "no rebound", "bouncing": "rebound"}
SHAPES = {"one-sine": "sine", "ricker-symmetric": "Ricker"}
DOTS = {
    "survives": {"facecolor": PAPER, "edgecolor": SURVIVES},
    "overturns": {"facecolor": OVERTURNS, "edgecolor": OVERTURNS},
}


def draw(mechanism_verdicts, mechanism_slides):
    figure, (left, right) = sheet(DOUBLE, 78, ncols=2, width_ratios=(1.25, 1))
    letter((left, right), ["Outcomes near the minimum overturning amplitude", "Sliding"])
    if untested(left, mechanism_verdicts) or untested(right, mechanism_slides):
        return figure
    _pulses(left, mechanism_verdicts)
    models = list(mechanism_slides.groupby(["structure", "mass_ratio"], sort=False))
    for ((structure, mass_ratio), part), colour in zip(models, shades(len(models)), strict=True):
        slip = part[["base_slip", "seat_slip"]].max(axis=1)
        tan = part.tan.iloc[0]
        label = f"{structure}, {gamma(mass_ratio)}"
        right.loglog(part.friction / tan, slip, "o-", color=colour, markersize=3, label=label)
        right.axvline(part.needed.iloc[0] / tan, color=colour, linestyle="--", linewidth=0.9)
    right.axvline(1.0, color=GREY, linestyle=":", linewidth=0.8)
    note(right, r"$\tan\alpha$", (0.96, 1.4), color=GREY, ha="right")
    right.set(xlabel=r"Friction, $\mu/\tan\alpha$ (–)", ylabel="Longest slide over $b$ (–)")
    right.set_xticks(ticks := (0.5, 1, 2, 4), map(str, ticks))
    right.set_xticks([], minor=True)
    right.set(xlim=(0.16, 5))
    right.legend(loc="lower left", title="dashed: required\nby the forces", fontsize=7)
    return figure


def _pulses(axis, table):
    rows = list(table.groupby(["contact", "structure", "shape", "frequency_ratio"], sort=False))
    factors = sorted(table.factor.unique())
    places = {factor: place for place, factor in enumerate(factors)}
    for height, (_, part) in enumerate(reversed(rows)):
        x = part.factor.map(places)
        for word, look in DOTS.items():
            chosen = part.engine == (word == "overturns")
            heights = np.full(int(chosen.sum()), height)
            axis.scatter(x[chosen], heights, s=34, linewidth=0.9, **look)
        apart = part.engine != part.theory
        ring = {"facecolor": "none", "edgecolor": INK, "linewidth": 1.3}
        axis.scatter(x[apart], np.full(int(apart.sum()), height), s=80, **ring)
    names = [
        f"{CONTACTS[contact]}, {structure}, {SHAPES[shape]} {ratio:g}"
        for (contact, structure, shape, ratio), _ in reversed(rows)
    ]
    axis.set_yticks(range(len(rows)), names, fontsize=6.5)
    axis.set_xticks(range(len(factors)), [f"{factor:g}" for factor in factors])
    predicted = sum(factor < 1 for factor in factors) - 0.5
    axis.plot([predicted] * 2, [-0.7, len(rows) - 0.4], color=GREY, linewidth=0.8)
    axis.set(xlim=(-0.5, len(factors) - 0.3), ylim=(-0.7, len(rows) + 1.1))
    axis.set_xlabel("Amplitude over the theory's minimum overturning one (–)")
    for x, (words, look) in zip((-0.3, 0.95), DOTS.items(), strict=True):
        axis.scatter([x], [len(rows) + 0.35], s=34, linewidth=0.9, **look)
        note(axis, words, (x + 0.17, len(rows) + 0.35))
    axis.scatter([2.75], [len(rows) + 0.35], s=80, **ring)
    note(axis, "differs from theory", (2.97, len(rows) + 0.35))


if __name__ == "__main__":
    make_figure(snakemake, draw)
