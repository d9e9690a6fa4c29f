"""Required coefficient of friction against γ, slenderness, bay and cap depth; and under records."""

import numpy as np

from figures.drawing import gamma
from figures.palette import OVERTURNS
from replication.drawing import DOUBLE, GREY, INK, letter, make_figure, note, shades, sheet

LABELS = {
    "mass_ratio": r"Mass ratio, $\gamma$ (–)",
    "slenderness": r"Slenderness, $\alpha$ (°)",
    "span": "Span over column width (–)",
    "depth": "Depth over column width (–)",
}
CROWDED = (0.05, 1.2, 1.35)  # ticks without a label
HIGHEST = 7.2  # of tan α, drawn


def draw(mechanism_dependence, mechanism_records):
    figure, axes = sheet(DOUBLE, 88, "ABCD;EEEE")
    for axis, (name, label) in zip(list(axes.values())[:4], LABELS.items(), strict=True):
        table = mechanism_dependence[mechanism_dependence.varied == name]
        rocking = table.rocking.replace(np.inf, np.nan)
        axis.plot(table.value, rocking, "o-", color=INK, markersize=3)
        axis.plot(table.value, table.impact, "s--", color=GREY, markersize=2.5)
        axis.axhline(1.0, color=GREY, linewidth=0.5, linestyle=":")
        axis.set(xlabel=label, ylim=(0, HIGHEST))
        if name != "slenderness":
            axis.set_xscale("log")
            ticks = [tick for tick in table.value if tick not in CROWDED]
            axis.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
            axis.set_xticks([], minor=True)
    axes["A"].set_ylabel(r"Friction, $\mu/\tan\alpha$ (–)")
    note(axes["A"], "rocking", (0.3, 3.0))
    note(axes["A"], "impacts", (0.06, 0.34), color=GREY)
    note(axes["C"], "below: a column\ntop opens", (1.62, 6.5), color=INK)
    records = axes["E"]
    _records(records, mechanism_records)
    titles = ["Mass ratio", "Slenderness", "Bay", "Depth of the cap beam", "Measured records"]
    letter(list(axes.values()), titles)
    return figure


def _records(axis, table):
    groups = list(table.groupby(["structure", "mass_ratio"], sort=False))
    for place, ((_, mass_ratio), part) in enumerate(groups):
        at = place + np.linspace(-0.2, 0.2, len(part))
        fell = (part.outcome == "overturned").to_numpy()
        face = shades(2)[int(mass_ratio > 0)]
        how = {"s": 16, "edgecolor": shades(2)[1], "linewidth": 0.6}
        axis.scatter(at[~fell], part.demand[~fell], facecolor=face, **how)
        axis.scatter(at[fell], part.demand[fell], marker="x", color=OVERTURNS, s=16)
        axis.plot((place - 0.3, place + 0.3), [part.tan.iloc[0]] * 2, color=GREY, linewidth=0.8)
    names = [f"{structure}, {gamma(g)}" for (structure, g), _ in groups]
    axis.set_xticks(range(len(groups)), names)
    axis.set(ylabel=r"Friction, $\mu$ (–)", ylim=(0, 0.78), xlim=(-0.6, len(groups) - 0.4))
    note(axis, r"$\tan\alpha$", (0.34, groups[0][1].tan.iloc[0]), color=GREY)
    note(axis, "crosses: overturned", (len(groups) - 0.5, 0.72), ha="right", color=OVERTURNS)


if __name__ == "__main__":
    make_figure(snakemake, draw)
