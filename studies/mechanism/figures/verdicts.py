"""MuJoCo and theory: outcomes under pulses, friction that prevents sliding, restitution."""

import numpy as np

from figures.drawing import gamma
from figures.palette import OVERTURNS, SURVIVES, greys
from replication.drawing import DOUBLE, GREY, INK, PAPER, letter, make_figure, note, shades, sheet
from studies.mechanism.figures.marks import untested

CONTACTS = {"plastic": "no rebound", "bouncing": "rebound"}
SHAPES = {"one-sine": "sine", "ricker-symmetric": "Ricker"}
DOTS = {
    "survives": {"facecolor": PAPER, "edgecolor": SURVIVES},
    "overturns": {"facecolor": OVERTURNS, "edgecolor": OVERTURNS},
}
LIFTS = (1.3, 2.2, 1.2)  # of the names at the ends of lines
STYLES = ("o-", "s--", "^-.", "D:")
TICKS = (-50, -20, -10, -5, -2, -1, 0, 1, 2, 5)  # %; the axis is linear between −1 and 1


def draw(mechanism_verdicts, mechanism_slides, mechanism_rebounds):
    figure, axes = sheet(DOUBLE, 70, ncols=3, width_ratios=(1.5, 1, 1))
    letter(axes, ["Outcomes near the minimum", "Sliding", "Coefficient of restitution"])
    tables = (mechanism_verdicts, mechanism_slides, mechanism_rebounds)
    if sum(untested(axis, table) for axis, table in zip(axes, tables, strict=True)):
        return figure
    left, right, last = axes
    _pulses(left, mechanism_verdicts)
    models = list(mechanism_slides.groupby(["structure", "mass_ratio"], sort=False))
    colours = shades(len(models))
    for ((structure, mass_ratio), part), colour, up in zip(models, colours, LIFTS, strict=True):
        slip = part[["base_slip", "seat_slip"]].max(axis=1)
        tan = part.tan.iloc[0]
        right.loglog(part.friction / tan, slip, "o-", color=colour, markersize=3)
        end = (1.15 * part.friction.iloc[-1] / tan, up * slip.iloc[-1])
        note(right, f"{structure}\n{gamma(mass_ratio)}", end, color=colour, fontsize=7)
        right.axvline(part.needed.iloc[0] / tan, color=colour, linestyle="--", linewidth=0.9)
    right.axvline(1.0, color=GREY, linestyle=":", linewidth=0.8)
    note(right, r"$\tan\alpha$", (0.93, 0.0045), color=GREY, ha="right")
    right.set(xlabel=r"Friction, $\mu/\tan\alpha$ (–)", ylabel="Longest slide over $b$ (–)")
    right.set_xticks(ticks := (0.5, 1, 2, 4), map(str, ticks))
    right.set_xticks([], minor=True)
    right.set(xlim=(0.16, 20))
    note(right, "dashed:\nrequired\nby the\nforces", (0.21, 4e-4), fontsize=7)
    _rebounds(last, mechanism_rebounds)
    return figure


def _rebounds(axis, table):
    frames = table[table.mass_ratio > 0]
    dampings = sorted(frames.damping_ratio.unique())
    for ratio, colour, style in zip(dampings, greys(len(dampings)), STYLES, strict=True):
        part = frames[frames.damping_ratio == ratio]
        low, high = (
            100 * part.groupby("time_constant").difference.agg(how) for how in ("min", "max")
        )
        restitution = part.point_restitution.iloc[0]
        label = f"{restitution:.2f}"
        axis.fill_between(low.index, low, high, color=colour, alpha=0.2, linewidth=0)
        axis.semilogx(low.index, (low + high) / 2, style, color=colour, markersize=3, label=label)
    axis.axhline(0.0, color=GREY, linewidth=0.5)
    axis.set(xlabel=r"Time constant of the contact, $p\,\tau$ (–)", ylim=(-100, 100))
    axis.set_yscale("symlog", linthresh=1, linscale=0.6)
    axis.set_yticks(TICKS, [f"{tick:g}".replace("-", "−") for tick in TICKS])
    axis.set_yticks([], minor=True)
    axis.set_ylabel(r"Difference from $\sqrt{r}$ of Eq. (25) (%)")
    note(axis, "Eq. (25)", (0.0031, 0.45), color=GREY)
    axis.legend(loc="upper left", ncols=2, title="Rebound of a single point (–)")


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
    axis.set_xlabel("Amplitude over the theory's minimum (–)")
    for x, (words, look) in zip((-0.4, 1.2), DOTS.items(), strict=True):
        axis.scatter([x], [len(rows) + 0.35], s=34, linewidth=0.9, **look)
        note(axis, words, (x + 0.2, len(rows) + 0.35))
    axis.scatter([2.9], [len(rows) + 0.35], s=80, **ring)
    note(axis, "differs from theory", (3.2, len(rows) + 0.35))


if __name__ == "__main__":
    make_figure(snakemake, draw)
