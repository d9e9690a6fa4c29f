"""Boxes of amplitudes that survive, from zero to the proven boundary of each structure."""

import math

from figures.drawing import gamma
from figures.palette import greys
from replication.drawing import DOUBLE, GREY, PAPER, make_figure, note, sheet

KINDS = {"no uplift": "no uplift", "bounded": "bounded by the lemma", "followed": "followed"}
WIDE = 0.003  # over the boundary: the edges of narrower boxes would hide them
NAMES = {"bare": "Column", "fixed": "Fixed mass", "free": "Frame"}
GAMMAS = (0.0, 1.0, math.inf)


def draw(proven_below):
    colours = dict(zip(KINDS, greys(len(KINDS)), strict=True))
    figure, axis = sheet(DOUBLE, 70)
    names = []
    shown = proven_below[proven_below.structure.isin(NAMES) & proven_below.mass_ratio.isin(GAMMAS)]
    for row, ((name, ratio), part) in enumerate(shown.groupby(["structure", "mass_ratio"])):
        label = NAMES[name] if name == "bare" else f"{NAMES[name]}, {gamma(ratio)}"
        names.append(label)
        for kind, boxes in part[part.kind.isin(KINDS)].groupby("kind"):
            for low, width in zip(boxes.low, boxes.high - boxes.low, strict=True):
                span = low / boxes.minimum.iloc[0], width / boxes.minimum.iloc[0]
                edge = 0.3 if span[1] > WIDE else 0.0
                look = {"facecolor": colours[kind], "edgecolor": PAPER, "linewidth": edge}
                axis.broken_barh([span], (row - 0.32, 0.64), **look)
        uplift = part.uplift.iloc[0] / part.minimum.iloc[0]
        axis.plot([uplift] * 2, [row - 0.42, row + 0.42], color=GREY, linewidth=1.0)
    note(axis, "uplift", (uplift, row + 0.46), ha="center", va="bottom", color=GREY)
    for kind, text in KINDS.items():
        axis.plot([], [], color=colours[kind], linewidth=5, label=text)
    axis.legend(loc="upper center", bbox_to_anchor=(0.5, -0.2), ncols=3, frameon=False)
    axis.set(
        xlim=(0.4, 1.0),
        ylim=(-0.6, len(names) - 0.1),
        yticks=range(len(names)),
        yticklabels=names,
        xlabel="Acceleration amplitude over the minimum overturning amplitude (–)",
    )
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
