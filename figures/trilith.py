"""Outcome of the trilith on a shake table, its test, and two starts of the table."""

import numpy as np
from matplotlib.colors import ListedColormap
from palette import AT_ONCE, GREY, INK, ROCKS, SURVIVES

from replication.drawing import DASHED, DOUBLE, letter, note, sheet

LEADER = {"arrowstyle": "-", "color": INK, "linewidth": 0.6, "shrinkA": 1, "shrinkB": 2}


def plane(axis, cells, thresholds):
    """Draw the outcomes over frequency and amplitude of the table, and the published test."""
    tested, to_lift = thresholds.tested, thresholds.to_lift
    along = np.linspace(cells.frequency_hz.min(), cells.frequency_hz.max(), 361)

    def uplift(frequency):  # the peak acceleration is u₀ (2πf)²
        return to_lift["amplitude"] * (tested["frequency"] / frequency) ** 2

    uplifts = cells.outcome != "no uplift"
    if (astray := cells[uplifts != (cells.amplitude_mm > uplift(cells.frequency_hz))]).size:
        raise ValueError(f"cells on the wrong side of the line of uplift:\n{astray}")
    fell = cells.assign(fell=np.where(cells.outcome == "overturned", 1.0, np.nan))
    grid = fell.pivot_table(
        index="amplitude_mm", columns="frequency_hz", values="fell", dropna=False
    )
    look = {"cmap": ListedColormap([AT_ONCE]), "rasterized": True, "zorder": 1.5}
    axis.pcolormesh(grid.columns, grid.index, grid, **look)
    highest = cells.amplitude_mm.max()
    axis.fill_between(along, uplift(along), 1.05 * highest, color=ROCKS, linewidth=0)
    axis.plot(along, uplift(along), color=INK)
    test = (tested["frequency"], tested["amplitude"])
    axis.plot(*test, "o", color=INK, markersize=4, zorder=4)
    words = f"test: {test[0]:g} Hz, {test[1]:g} mm"
    axis.annotate(words, test, (1.15, 1.9), fontsize=7.5, va="center", arrowprops=LEADER)
    note(axis, "stays\nat rest", (1.2, 8.5))
    note(axis, "rocks", (5.0, 9.0), color=SURVIVES)
    note(axis, "overturns", (8.2, 17))
    note(axis, "uplift", (2.2, 16.0), (3, 0))
    axis.set(xlim=along[[0, -1]], ylim=(grid.index[0] - 0.25, highest + 0.25))
    axis.set(xticks=range(1, int(along[-1]) + 1), yticks=range(5, int(highest) + 1, 5))
    axis.set(xlabel="Frequency of the shake table (Hz)", ylabel="Amplitude of the shake table (mm)")


def histories(axis, runs, steady):
    """Draw the rotations after a smooth and after an abrupt start, and the steady amplitude."""
    axis.plot(runs.time, runs.abrupt, color=SURVIVES, linewidth=0.8)
    axis.plot(runs.time, runs.smooth, color=INK, linewidth=1.6)
    for level in (-steady, steady):
        axis.axhline(level, color=GREY, linewidth=0.7, linestyle=DASHED)
    note(axis, "table at full speed at once: keeps rocking", (1.6, 0.108), color=SURVIVES)
    words = f"steady amplitude {steady:.3f}$\\,\\alpha$"
    note(axis, words, (runs.time.max() - 0.1, 0.08), ha="right", color=GREY)
    note(axis, "table from rest: stays at rest (black)", (1.6, -0.108))
    axis.set(xlim=(0, runs.time.max()), ylim=(-0.125, 0.125))
    axis.set(xlabel="Time, $t$ (s)", ylabel=r"Rotation, $\theta/\alpha$ (–)")


def draw(trilith_map, trilith_thresholds, trilith_starts, trilith_histories):
    figure, (left, right) = sheet(DOUBLE, 54, ncols=2, width_ratios=(1, 1.15))
    plane(left, trilith_map, trilith_thresholds.set_index("quantity"))
    histories(right, trilith_histories, trilith_starts.late_peak_over_alpha.iloc[-1])
    titles = ["Outcome after a smooth start", "The test, after two starts of the table"]
    letter([left, right], titles)
    return figure
