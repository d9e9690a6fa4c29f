"""Outcome of the trilith on a shake table in steady harmonic motion, and its published test."""

import numpy as np
from matplotlib.colors import ListedColormap

from replication.drawing import ACCENT, DARK, DOUBLE, INK, LIGHT, letter, note, publish, sheet

OUTCOMES = {"no uplift": 0, "rests": 1, "rocking": 1, "overturned": 2}
ARROW = {"arrowstyle": "-|>", "color": ACCENT, "shrinkA": 0, "shrinkB": 0, "mutation_scale": 7}


def draw(trilith_map, trilith_nearness):
    figure, (left, right) = sheet(DOUBLE, 74, ncols=2, width_ratios=(1.25, 1))
    cells = trilith_map.assign(kind=trilith_map.outcome.map(OUTCOMES))
    grid = cells.pivot_table(index="amplitude_mm", columns="frequency_hz", values="kind")
    colours = ListedColormap(["white", LIGHT, DARK])
    left.pcolormesh(grid.columns, grid.index, grid, cmap=colours, vmin=0, vmax=2, rasterized=True)

    near = trilith_nearness.set_index("quantity")
    amplitude = near.loc["amplitude_at_tested_frequency"]
    frequency = near.loc["frequency_at_tested_amplitude"]
    width = near.loc["effective_width_of_columns"]
    test = (frequency.tested, amplitude.tested)
    along = np.linspace(1.0, 10.0, 400)
    threshold = (
        amplitude.to_lift * (frequency.tested / along) ** 2
    )  # u₀ ∝ f⁻², through the simulated one
    for axis in (left, right):
        axis.plot(along, threshold, color=INK)
        axis.plot(*test, "o", color=ACCENT, markersize=4, zorder=4)
        axis.set(
            xlabel="Frequency of the table, $f$ (Hz)", ylabel="Amplitude of the table, $u_0$ (mm)"
        )
    note(left, "stays at rest", (1.2, 6.8))
    note(left, "rocks", (5.0, 9.0))
    note(left, "overturns", (8.2, 17), color="white")
    note(
        left,
        r"$u_0=g\,\tan\alpha/(2\pi f)^2$",
        (2.3, 14.8),
        xytext=(3, 0),
        textcoords="offset points",
    )
    note(left, "test", test, xytext=(-5, -5), textcoords="offset points", ha="right", color=ACCENT)
    left.set(xlim=(1, 10), ylim=(0.75, 20.25), xticks=range(1, 11), yticks=range(5, 21, 5))

    right.fill_between(along, threshold, 20, color=LIGHT, linewidth=0)
    right.plot(along, threshold * width.to_lift / width.tested, "--", color=ACCENT, linewidth=0.9)
    right.annotate("", (test[0], amplitude.to_lift), test, arrowprops=ARROW)
    right.annotate("", (frequency.to_lift, test[1]), test, arrowprops=ARROW)
    more = {"textcoords": "offset points", "color": ACCENT}
    note(
        right,
        f"lifts at {amplitude.to_lift:.2f} mm",
        (test[0], amplitude.to_lift),
        xytext=(4, 7),
        **more,
    )
    note(
        right,
        f"lifts at {frequency.to_lift:.2f} Hz",
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
    note(right, words, (2.55, 3.6), color=ACCENT)
    right.set(xlim=(2.5, 4.3), ylim=(3, 9))
    letter(
        [left, right], ["Outcome after ten cycles from rest", "Distance of the test from uplift"]
    )
    return figure


if __name__ == "__main__":
    publish(snakemake, draw)
