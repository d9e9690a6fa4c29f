"""Ten samples of motions: how often they overturn vase, column and frame, and the gain."""

import pandas as pd

from figures.palette import ALONE, EQUAL, FIXED
from replication.drawing import DOUBLE, INK, letter, make_figure, note, sheet

STRUCTURES = {"vase": FIXED, "column": ALONE, "frame": EQUAL}


def named(row):
    """Return the words of a row."""
    if not pd.isna(row.soil):
        return f"noise, soil {row.soil:g} Hz, filter {row.corner:g} Hz"
    return row.model + (f", factor ≤ {row.most:g}" if row.most < float("inf") else "")


def draw(robustness_models):
    table = robustness_models.iloc[::-1].reset_index(drop=True)
    figure, axes = sheet(DOUBLE, 62, ncols=2, sharey=True)
    for place, row in table.iterrows():
        of = [(axes[0], name, colour) for name, colour in STRUCTURES.items()]
        for axis, name, colour in [*of, (axes[1], "gain", INK)]:
            ends = 100 * row[f"{name}_low"], 100 * row[f"{name}_high"]
            axis.hlines(place, *ends, color=colour, linewidth=1.1)
            axis.plot(100 * row[name], place, "o", color=colour, markersize=3.5)
    top = len(table) - 0.45
    for name, colour in STRUCTURES.items():
        note(axes[0], name, (100 * table[name].iloc[-1], top), color=colour, ha="center")
    axes[0].set(xlim=(0, 100), xlabel="Probability of overturning (%)")
    axes[1].set(xlim=(0, 50), xlabel="Gain in the median velocity (%)")
    axes[0].set_yticks(range(len(table)), [named(row) for row in table.itertuples()])
    for axis in axes:
        axis.set_ylim(-0.6, len(table) + 0.1)
        axis.tick_params(axis="y", length=0)
    letter(axes, ["Overturning at 0.6 m/s", "Frame over column"])
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
