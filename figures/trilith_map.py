"""Outcome of the trilith on a shake table in steady harmonic motion, and its published test."""

import numpy as np
from matplotlib.colors import ListedColormap

from figures.palette import AT_ONCE, ROCKS
from replication.drawing import DOUBLE, INK, letter, make_figure, note, sheet

ARROW = {"arrowstyle": "-|>", "color": INK, "shrinkA": 0, "shrinkB": 0, "mutation_scale": 7}


def outcomes(axis, cells, uplift):
    """Draw the cells that overturn; others rock above the curve of uplift, and rest below it."""
    threshold = np.interp(cells.frequency_hz, *uplift)
    lifts = cells.outcome != "no uplift"
    if (astray := cells[lifts != (cells.amplitude_mm > threshold)]).size:
        raise ValueError(f"cells on the wrong side of the line of uplift:\n{astray}")
    fell = cells.assign(fell=np.where(cells.outcome == "overturned", 1.0, np.nan))
    of = {"index": "amplitude_mm", "columns": "frequency_hz", "dropna": False}
    grid = fell.pivot_table(values="fell", **of)
    how = {"cmap": ListedColormap([AT_ONCE]), "rasterized": True, "zorder": 1.5}
    axis.pcolormesh(grid.columns, grid.index, grid, **how)


def draw(trilith_map, trilith_uplift, trilith_nearness):
    figure, (left, right) = sheet(DOUBLE, 74, ncols=2, width_ratios=(1.25, 1))
    near = trilith_nearness.set_index("quantity")
    amplitude = near.loc["amplitude_at_tested_frequency"]
    frequency = near.loc["frequency_at_tested_amplitude"]
    width = near.loc["effective_width_of_columns"]
    test = (frequency.tested, amplitude.tested)
    along, threshold = trilith_uplift.frequency_hz, trilith_uplift.amplitude_to_uplift_mm
    outcomes(left, trilith_map, (along, threshold))
    left.fill_between(along, threshold, 21, color=ROCKS, linewidth=0)
    for axis in (left, right):
        axis.plot(along, threshold, color=INK)
        axis.plot(*test, "o", color=INK, markersize=4, zorder=4)
        axis.set(
            xlabel="Frequency of the shake table, $f$ (Hz)",
            ylabel="Amplitude of the shake table, $u_0$ (mm)",
        )
    note(left, "stays at rest", (1.2, 6.8))
    note(left, "rocks", (5.0, 9.0))
    note(left, "overturns", (8.2, 17))
    note(
        left,
        r"$u_0=g\,\tan\alpha/(2\pi f)^2$",
        (2.3, 14.8),
        xytext=(3, 0),
        textcoords="offset points",
    )
    note(left, "test", test, xytext=(-5, -5), textcoords="offset points", ha="right")
    left.set(xlim=(1, 10), ylim=(0.75, 20.25), xticks=range(1, 11), yticks=range(5, 21, 5))

    right.fill_between(along, threshold, 20, color=ROCKS, linewidth=0)
    right.plot(along, threshold * width.to_lift / width.tested, "--", color=INK, linewidth=0.9)
    right.annotate("", (test[0], amplitude.to_lift), test, arrowprops=ARROW)
    right.annotate("", (frequency.to_lift, test[1]), test, arrowprops=ARROW)
    more = {"textcoords": "offset points"}
    note(
        right,
        f"uplifts at {amplitude.to_lift:.2f} mm",
        (test[0], amplitude.to_lift),
        xytext=(4, 7),
        **more,
    )
    note(
        right,
        f"uplifts at {frequency.to_lift:.2f} Hz",
        (frequency.to_lift, test[1]),
        xytext=(4, 4),
        **more,
    )
    words = f"test of Peña et al.:\n{test[1]:g} mm, {test[0]:g} Hz"
    note(right, words, test, xytext=(-6, -11), ha="right", **more)
    at = (2.9, np.interp(2.9, along, threshold))
    note(
        right,
        f"columns as built,\n{width.tested:g} mm wide",
        at,
        xytext=(6, 8),
        textcoords="offset points",
    )
    words = f"base contact on\n{width.to_lift:.0f} mm only"
    note(right, words, (2.55, 3.6))
    right.set(xlim=(2.5, 4.3), ylim=(3, 9))
    letter(
        [left, right], ["Outcome after ten cycles from rest", "Distance of the test from uplift"]
    )
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
