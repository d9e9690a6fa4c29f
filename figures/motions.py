"""Probability of overturning against the peak ground velocity, and gain of the frame by model"""

import numpy as np
from palette import ALONE, EQUAL, FIXED, GREY, INK

from replication.drawing import DOUBLE, gamma, letter, logarithmic, note, sheet

FAMILIES = ("near-fault", "broadband")
DASHES = ("-", "--")  # lines of the two earthquakes of a family
STRUCTURES = {  # colour, place of the words
    "fixed mass": (FIXED, (1.0, 0.28)),
    "column": (ALONE, (1.0, 0.17)),
    "frame": (EQUAL, (1.0, 0.06)),
}
MARKERS = "^osDv"  # markers of the sizes of columns
APART = 0.25  # rows of a model, between columns of different size


def fragility(axis, curves, mass_ratio):
    for dash, (_, quake) in zip(DASHES, curves.groupby("model"), strict=True):
        for structure, (colour, _) in STRUCTURES.items():
            ratio = 0.0 if structure == "column" else mass_ratio
            curve = quake[(quake.structure == structure) & (quake.mass_ratio == ratio)]
            axis.plot(curve.velocity, curve.probability, dash, color=colour, linewidth=1.0)
    axis.axhline(0.5, color=GREY, linewidth=0.5)
    logarithmic(axis, (0.5, 1.0, 2.0))
    axis.set(xlim=(0.37, 2.6), ylim=(0, 1), yticks=(0, 0.5, 1))
    axis.set_xlabel("Peak ground velocity (m/s)")


def gain(axis, rows, markers, sizes):
    """Draw the gain by model, with its interval, one marker for each size of the columns."""
    models = list(dict.fromkeys(rows.model))[::-1]
    axis.hlines(np.arange(len(models) - 1) + 0.5, 0, 75, color=GREY, linewidth=0.25)
    for number, (structure, marker) in enumerate(markers.items()):
        part = rows[rows.structure == structure]
        places = [models.index(model) + APART * (1 - number) for model in part.model]
        axis.hlines(places, 100 * part.gain_low, 100 * part.gain_high, color=GREY, linewidth=0.8)
        label = f"{2 * sizes[structure]['half_height']:g} m"
        look = {"color": INK, "markersize": 3.5, "linestyle": "", "label": label}
        axis.plot(100 * part.gain, places, marker, **look)
    axis.legend(
        loc="center right",
        title="Columns of",
        title_fontsize=7.5,
        frameon=True,
        edgecolor="none",
        framealpha=1,
    )
    axis.set_yticks(range(len(models)), models)
    axis.tick_params(axis="y", length=0)
    axis.set(xlim=(0, 75), ylim=(-0.6, len(models) - 0.4))
    axis.set_xlabel("Gain in the median overturning PGV (%)")


def draw(motions_fragility, motions_gains, config):
    inputs = config["motions"]
    mass_ratio = inputs["mass_ratio"]
    figure, axes = sheet(DOUBLE, 66, "abc", width_ratios=(1, 1, 1.35))
    curves = motions_fragility[motions_fragility.column == inputs["structure"]]
    for axis, name in zip((axes["a"], axes["b"]), FAMILIES, strict=True):
        family = curves[curves.model.str.startswith(name)]
        fragility(axis, family, mass_ratio)
    axes["a"].set_ylabel("Probability of overturning (–)")
    for name, (colour, place) in STRUCTURES.items():
        words = f"{name}, {gamma(mass_ratio)}" if name == "frame" else name
        note(axes["a"], words, place, color=colour)
    for dash, model in zip(DASHES, sorted(family.model.unique()), strict=True):
        axes["b"].plot([], [], dash, color=INK, linewidth=1.0, label=model.split(", ")[1])
    axes["b"].legend(loc="lower right", handlelength=1.8, borderaxespad=0.1)
    markers = dict(zip(inputs["structures"], MARKERS, strict=False))
    rows = motions_gains[motions_gains.mass_ratio == mass_ratio]
    gain(axes["c"], rows, markers, config["structures"])
    titles = [f"{name.capitalize()} motions" for name in FAMILIES]
    letter(list(axes.values()), [*titles, f"Frame over column, {gamma(mass_ratio)}"])
    return figure
