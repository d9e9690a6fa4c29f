"""Probability of overturning, peak rotation and gain under models of ground motion"""

import math

from drawing import gamma
from palette import ALONE, EQUAL, FIXED

from replication.drawing import DARKEST, DOUBLE, GREY, INK, PAPER, letter, note, sheet

FAMILIES = ("near-fault", "broadband")
DASHES = ("-", "--")  # of the sets of a family, by earthquake
STRUCTURES = {  # of the first two graphs: colour, place of the words
    "fixed mass": (FIXED, (1.15, 0.28)),
    "column": (ALONE, (1.15, 0.17)),
    "frame": (EQUAL, (1.15, 0.06)),
}
SHADES = {0.0: ALONE, 1.0: EQUAL, math.inf: DARKEST}  # a beam as heavy as both columns, and heavier
COLOURS = {"fixed": FIXED, "column": ALONE, "frame": EQUAL}
MARKERS = "^osDv"  # of columns of different size
VELOCITIES = (0.5, 1.0, 2.0)


def fragility(axis, curves, mass_ratio):
    for dash, (_, quake) in zip(DASHES, curves.groupby("model"), strict=True):
        for structure, (colour, _) in STRUCTURES.items():
            ratio = 0.0 if structure == "column" else mass_ratio
            curve = quake[(quake.structure == structure) & (quake.mass_ratio == ratio)]
            axis.plot(curve.velocity, curve.probability, dash, color=colour, linewidth=1.0)
    axis.axhline(0.5, color=GREY, linewidth=0.5)
    axis.set(xscale="log", xlim=(0.37, 2.6), ylim=(0, 1))
    axis.set_xticks(VELOCITIES, [f"{tick:g}" for tick in VELOCITIES])
    axis.set_xticks([], minor=True)
    axis.set(yticks=(0, 0.5, 1), xlabel="Peak ground velocity (m/s)")


def rotation(axis, rows):
    for place, (ratio, colour) in enumerate(SHADES.items()):
        peaks = rows[rows.mass_ratio == ratio].groupby("velocity").median_peak
        low, high = peaks.min().clip(upper=2.0), peaks.max().clip(upper=2.0)
        axis.fill_between(low.index, low, high, color=colour, alpha=0.35, linewidth=0)
        for end in (low, high):
            axis.plot(end.index, end, color=colour, linewidth=0.8)
        note(axis, gamma(ratio), (0.22, 0.93 - 0.1 * place), color=colour)
    axis.set(xlim=(0.2, 1.0), ylim=(0, 1), yticks=(0, 0.5, 1), xlabel="Peak ground velocity (m/s)")
    axis.set_ylabel(r"Median peak $|\theta|/\alpha$ (–)")


def draw(motions, motions_fragility, motions_rotations, motions_gains, config):
    inputs, sizes = config["motions"], config["structures"]
    mass_ratio, markers = (
        inputs["mass_ratio"],
        dict(zip(inputs["structures"], MARKERS, strict=False)),
    )
    heavier = motions_gains.mass_ratio[motions_gains.mass_ratio < math.inf].max()
    figure, axes = sheet(DOUBLE, 103, "aabbcc;dddeee", height_ratios=(1, 1.4))
    curves = motions_fragility[motions_fragility.column == inputs["structure"]]
    for axis, name in zip((axes["a"], axes["b"]), FAMILIES, strict=True):
        of = curves[curves.model.str.startswith(name)]
        fragility(axis, of, mass_ratio)
    axes["a"].set_ylabel("Probability of overturning (–)")
    for name, (colour, at) in STRUCTURES.items():
        words = f"{name}, {gamma(mass_ratio)}" if name == "frame" else name
        note(axes["a"], words, at, color=colour)
    for dash, model in zip(DASHES, sorted(of.model.unique()), strict=True):
        axes["b"].plot([], [], dash, color=INK, linewidth=1.0, label=model.split(", ")[1])
    axes["b"].legend(loc="lower right", handlelength=1.8, borderaxespad=0.1)
    rotation(axes["c"], motions_rotations)
    table = motions.iloc[::-1].reset_index(drop=True)
    for place, row in table.iterrows():
        for name, colour in COLOURS.items():
            ends = 100 * row[f"{name}_low"], 100 * row[f"{name}_high"]
            axes["d"].hlines(place, *ends, color=colour)
            axes["d"].plot(100 * row[name], place, "o", color=colour, markersize=3.5)
        for gain in motions_gains[motions_gains.model == row.model].itertuples():
            if gain.mass_ratio in (mass_ratio, heavier):
                face = INK if gain.mass_ratio == mass_ratio else PAPER
                mark = {"marker": markers[gain.structure], "color": INK, "markerfacecolor": face}
                axes["e"].plot(100 * gain.gain, place, markersize=4, linestyle="", **mark)
    for name, marker in markers.items():
        words = f"{2 * sizes[name]['half_height']:g} m"
        axes["e"].plot([], [], marker, color=INK, markersize=4, label=words)
    hollow = {"markerfacecolor": PAPER, "markersize": 4, "label": gamma(heavier)}
    axes["e"].plot([], [], "o", color=INK, **hollow)
    axes["e"].legend(loc="lower right")
    axes["d"].set(xlim=(0, 100), xlabel="Probability of overturning (%)")
    axes["e"].set(xlim=(0, 85), xlabel="Gain in the median overturning velocity (%)")
    axes["d"].set_yticks(range(len(table)), table.model)
    axes["e"].set_yticks(range(len(table)), [""] * len(table))
    for axis in (axes["d"], axes["e"]):
        axis.set_ylim(-0.6, len(table) - 0.4)
        axis.tick_params(axis="y", length=0)
    titles = [f"{name.capitalize()} motions" for name in FAMILIES]
    titles += ["Peak rotation", f"Models, at {inputs['velocity']:g} m/s"]
    letter(list(axes.values()), [*titles, "Frame over column"])
    return figure
