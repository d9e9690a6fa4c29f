"""Where only the frame or only its solitary column overturns, one example, and how often."""

import math

import numpy as np
from matplotlib.patches import PathPatch
from matplotlib.path import Path
from palette import CAUSED, GREY, OVERTURNED, OVERTURNS, PALE, PREVENTED, PREVENTS, SURVIVES

from replication.drawing import DASHED, DOUBLE, PULSES, letter, note, ring, shaded, sheet

WINDOW = (0.5, 6.0, 1.0, 16.0)  # ω/p and a/(g tan α) of the picture
STRUCTURES = dict(shaded((0.0, math.inf)))  # colours, by γ
LEADER = {"arrowstyle": "-", "linewidth": 0.7, "shrinkA": 1, "shrinkB": 0}


def outlines(cells):
    """Return the outlines of the regions that overturn a structure: vertices, shape (n, 2).

    The first two are the regions without an impact and, of those after one, the widest interval at
    each frequency. They join the computed frequencies. The others are narrower intervals.
    """
    step = np.diff(np.unique(cells.frequency_ratio)).min()
    at_once = cells[cells["mode"] == "without impact"]
    after = cells[cells["mode"] == "with impact"]
    after = after.assign(width=after.upper - after.lower).sort_values(["frequency_ratio", "width"])
    widest = after.groupby("frequency_ratio").tail(1)
    regions = []
    for region in (at_once, widest):
        edges = region.lower, region.upper.fillna(WINDOW[3]).clip(upper=WINDOW[3])
        lower, upper = (np.column_stack([region.frequency_ratio, edge]) for edge in edges)
        regions.append(np.vstack([lower, upper[::-1], lower[:1]]))
    for x, low, high in after.drop(widest.index)[["frequency_ratio", "lower", "upper"]].to_numpy():
        left, right = x - step / 2, x + step / 2
        corners = [[left, low], [right, low], [right, high], [left, high], [left, low]]
        regions.append(np.array(corners))
    return regions


def alike(table, example):
    """Return the rows of the shape and the slenderness of an example."""
    pulses, degrees = table["shape"] == example["shape"], table.slenderness_deg
    return table[pulses & (degrees == example.slenderness_deg)]


def plane(axis, spectra, areas, example):
    """Draw what only the column, only the frame and both overturn, and the boundaries of each."""
    cells = alike(spectra, example)
    cells = cells[cells.mass_ratio.isin(STRUCTURES)]
    regions = {ratio: outlines(part) for ratio, part in cells.groupby("mass_ratio")}
    paths = {
        ratio: Path.make_compound_path(*[Path(region, closed=True) for region in parts])
        for ratio, parts in regions.items()
    }
    column, frame = (paths[ratio] for ratio in STRUCTURES)
    for path, colour in ((frame, CAUSED), (column, PREVENTED), (column, OVERTURNED)):
        patch = axis.add_patch(PathPatch(path, facecolor=colour, linewidth=0))
    patch.set_clip_path(frame, axis.transData)
    for ratio, colour in STRUCTURES.items():
        for region in regions[ratio][:2]:
            axis.plot(*region.T, color=colour, linewidth=1.1)
    axis.set(xlim=WINDOW[:2], ylim=WINDOW[2:], xticks=(1, 2, 3, 4, 5, 6), yticks=(1, 4, 8, 12, 16))
    axis.set(xlabel=r"Frequency, $\omega/p$ (–)", ylabel=r"Amplitude, $a/(g\,\tan\alpha)$ (–)")
    place = (example.frequency_ratio, example.amplitude_over_uplift)
    ring(axis, *place, size=7.5, zorder=4)
    note(axis, "1", place, ha="center", va="center_baseline", fontsize=7, zorder=5)
    (share,) = alike(areas, example).itertuples()
    note(axis, "both overturn", (0.7, 13.0), color=OVERTURNS)
    note(axis, "both survive", (4.6, 14.0), color=SURVIVES)
    words = f"overturning caused\non {100 * share.caused:.1f} % of the map"
    leader = LEADER | {"color": CAUSED}
    note(axis, words, (3.2, 8.1), xytext=(3.6, 12.5), color=CAUSED, arrowprops=leader)
    words = f"overturning prevented\non {100 * share.prevented:.1f} % of the map"
    leader = LEADER | {"color": PREVENTS}
    note(axis, words, (4.5, 7.4), xytext=(4.3, 10.0), color=PREVENTS, arrowprops=leader)
    note(axis, "column", (4.7, 3.4), color=STRUCTURES[0.0])
    words = "frame,\n$\\gamma\\to\\infty$"
    note(axis, words, (3.75, 4.9), ha="right", color=STRUCTURES[math.inf])


def histories(axis, example):
    """Draw the rotations of both structures under the pulse that is marked on the map."""
    axis.axhspan(-1, 1, color=PALE, linewidth=0)
    axis.axvspan(0, 1, ymax=0.03, color=GREY, linewidth=0)
    note(axis, "pulse", (1.05, -1.75), color=GREY)
    for ratio, words, colour, place in (
        (0.0, "column survives", SURVIVES, (1.75, -0.75)),
        (math.inf, "frame overturns", OVERTURNS, (1.6, 1.4)),
    ):
        run = example[example.mass_ratio == ratio]
        axis.plot(run.time_over_period, run.rotation_over_alpha, color=colour)
        theta = run.rotation_over_alpha.to_numpy()
        first = np.flatnonzero(theta[:-1] * theta[1:] < 0.0)[0]
        ring(axis, run.time_over_period.iloc[first], 0.0, colour, zorder=3)
        note(axis, words, place, color=colour)
    axis.set(xlim=(0, 3), ylim=(-2, 2), yticks=(-2, -1, 0, 1, 2))
    axis.set(xlabel=r"Time, $t\,\omega/2\pi$ (–)", ylabel=r"Rotation, $\theta/\alpha$ (–)")


def shares(axis, areas):
    """Draw the shares of overturning prevented and caused, by shape and slenderness."""
    slendernesses = np.sort(areas.slenderness_deg.unique())
    places = 0.17 * (np.arange(len(slendernesses)) - (len(slendernesses) - 1) / 2)
    for group, shape in enumerate(PULSES):
        rows = areas[areas["shape"] == shape].set_index("slenderness_deg").loc[slendernesses]
        for name, colour, mark in (("prevented", PREVENTED, "o"), ("caused", CAUSED, "v")):
            axis.plot(group + places, 100 * rows[name], mark, color=colour, markersize=4)
    for name, colour in (("prevented", PREVENTS), ("caused", CAUSED)):
        mean = 100 * areas[name].mean()
        axis.axhline(mean, color=colour, linewidth=0.7, linestyle=DASHED)
        note(axis, f"mean {mean:.1f}", (3.48, mean + 1.8), ha="right", color=colour)
    note(axis, "prevented", (0.42, 17.5), color=PREVENTS)
    note(axis, "caused", (1.34, 3.0), color=CAUSED)
    axis.set_xticks(range(len(PULSES)), [words.replace(" ", "\n") for words in PULSES.values()])
    axis.tick_params(axis="x", length=0)
    axis.set(xlim=(-0.5, len(PULSES) - 0.5), ylim=(-0.6, 20), ylabel="Share of the map (%)")


def draw(spectra, spectra_areas, spectra_histories):
    areas = spectra_areas.query("change == 'frame' and beside == 'column' and mass_ratio == inf")
    example = spectra_histories.iloc[0]
    figure, axes = sheet(DOUBLE, 72, "AB;AC", width_ratios=(1.2, 1))
    plane(axes["A"], spectra, areas, example)
    histories(axes["B"], spectra_histories)
    shares(axes["C"], areas)
    slendernesses = ", ".join(f"{angle:.2g}" for angle in np.sort(areas.slenderness_deg.unique()))
    titles = [
        f"{PULSES[example['shape']]}, $\\alpha$ = {example.slenderness_deg:g}°",
        "Rotation under pulse 1",
        f"Four pulses, each with $\\alpha$ = {slendernesses}°",
    ]
    letter([axes[key] for key in "ABC"], titles)
    return figure
