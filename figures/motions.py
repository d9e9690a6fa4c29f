"""Probability of overturning and gain under models of ground motion"""

import math

from drawing import gamma
from palette import ALONE, EQUAL, FIXED

from replication.drawing import DARKEST, DOUBLE, GREY, INK, letter, note, sheet

SETS = ("near-fault", "broadband")
STRUCTURES = {  # name and γ, as in the table: words, colour, place of the words
    ("fixed mass", 1.0): ("column, mass\nfixed on top", FIXED, (0.49, 0.86)),
    ("column", 0.0): ("column", ALONE, (0.64, 0.56)),
    ("frame", 1.0): ("frame, " + gamma(1.0), EQUAL, (1.1, 0.44)),
    ("frame", math.inf): ("frame, " + gamma(math.inf), DARKEST, (1.22, 0.29)),
}
COLOURS = {"fixed": FIXED, "column": ALONE, "frame": EQUAL}
VELOCITIES = (0.5, 0.75, 1.0, 1.5, 2.0)


def fragility(axis, curves):
    for (structure, ratio), (_, colour, _) in STRUCTURES.items():
        curve = curves[(curves.structure == structure) & (curves.mass_ratio == ratio)]
        axis.plot(curve.velocity, curve.probability, color=colour, linewidth=1.0)
        band = (curve.velocity, curve.probability_low, curve.probability_high)
        axis.fill_between(*band, color=colour, alpha=0.25, linewidth=0)
    axis.axhline(0.5, color=GREY, linewidth=0.5)
    axis.set(xscale="log", xlim=(curves.velocity.min(), curves.velocity.max()), ylim=(0, 1))
    axis.set_xticks(VELOCITIES, [f"{tick:g}" for tick in VELOCITIES])
    axis.set_xticks([], minor=True)
    axis.set(yticks=(0, 0.5, 1), xlabel="Peak ground velocity (m/s)")


def draw(motions, motions_fragility, config):
    figure, axes = sheet(DOUBLE, 112, "ab;cd", height_ratios=(1, 1.15))
    for axis, name in zip((axes["a"], axes["b"]), SETS, strict=True):
        fragility(axis, motions_fragility[motions_fragility.model == name])
    axes["a"].set_ylabel("Probability of overturning (–)")
    for words, colour, at in STRUCTURES.values():
        note(axes["b"], words, at, color=colour)
    table = motions.iloc[::-1].reset_index(drop=True)
    for place, row in table.iterrows():
        shares = [(axes["c"], name, colour) for name, colour in COLOURS.items()]
        for axis, name, colour in [*shares, (axes["d"], "gain", INK)]:
            axis.hlines(place, 100 * row[f"{name}_low"], 100 * row[f"{name}_high"], color=colour)
            axis.plot(100 * row[name], place, "o", color=colour, markersize=3.5)
    axes["c"].set(xlim=(0, 100), xlabel="Probability of overturning (%)")
    axes["d"].set(xlim=(0, 50), xlabel="Gain in the median overturning velocity (%)")
    axes["c"].set_yticks(range(len(table)), table.model)
    axes["d"].set_yticks(range(len(table)), [""] * len(table))
    for axis in (axes["c"], axes["d"]):
        axis.set_ylim(-0.6, len(table) - 0.4)
        axis.tick_params(axis="y", length=0)
    titles = [f"{name.capitalize()} motions" for name in SETS]
    titles += [f"Models, at {config['motions']['velocity']:g} m/s", "Frame over column"]
    letter(list(axes.values()), titles)
    return figure
