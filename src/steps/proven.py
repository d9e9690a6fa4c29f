"""Verify with interval arithmetic the quoted minima, all amplitudes below two, one exception."""

import json
import math
from typing import Any

import pandas as pd

from replication.step import run, truth
from steps.shared.cases import column_of
from steps.shared.spectrum import FRAME, line
from topheavy import Column, Pulse, RockingFrame
from topheavy.bodies.structures import Structure
from topheavy.proven import certified, checking, survives_below

SHAPE = "one-cosine"
QUOTED = {("column", 0.0): True, ("frame", 1.0): False, ("frame", math.inf): True}
"""The quoted minima, and whether all amplitudes below them are verified, too."""
READ_AGAIN = 10  # each tenth box: the search takes only steps that the checker accepts
WIDTHS = (1e-8, 1e-7, 1e-6)  # from a minimum, over it: the tables have nine digits


def outcome(certificate: dict | None) -> str:
    """Return the outcome that a certificate proves, read as a stranger reads it."""
    if certificate is None:
        return "undecided"
    return checking.check(json.loads(json.dumps(certificate)))


def sides(structure: Structure, pulse: Pulse, minimum: float) -> list[tuple[float, dict | None]]:
    """Return the closest amplitudes below and above a minimum that differ, with certificates."""
    for width in WIDTHS:
        amplitudes = [float(f"{minimum * (1.0 + side * width):.15g}") for side in (-1.0, 1.0)]
        pairs = [(amplitude, certified(structure, pulse, amplitude)) for amplitude in amplitudes]
        if [outcome(certificate) for _, certificate in pairs] == ["survives", "overturns"]:
            break
    return pairs


def compute(
    vase: pd.DataFrame, spectra_histories: pd.DataFrame, column: dict, period: float
) -> dict[str, Any]:
    """Return a row for each outcome, with its amplitudes in g, and the certificates as JSON."""
    rows, lines = [], []

    def keep(
        part: str, name: str, gamma: float, span: tuple[float, float], certificate: dict | None
    ) -> None:
        row = {"part": part, "structure": name, "mass_ratio": gamma}
        row |= {end: f"{x:.15g}" for end, x in zip(("low", "high"), span, strict=True)}  # exact
        again = part != "below" or len(rows) % READ_AGAIN == 0 or certificate is None
        rows.append(row | {"outcome": outcome(certificate) if again else certificate["outcome"]})
        if certificate:
            lines.append(json.dumps(certificate) + "\n")

    quoted = vase[vase["shape"] == SHAPE].set_index(["structure", "mass_ratio"])
    pulse = Pulse(SHAPE, 1.0, 2.0 * math.pi / period)
    for (name, gamma), has_boxes in QUOTED.items():
        structure: Structure = Column(**column)
        if name == "frame":
            structure = RockingFrame(structure, gamma)
        both = sides(structure, pulse, float(quoted.minimum_overturning[name, gamma]))
        for amplitude, certificate in both:
            keep("minimum", name, gamma, (amplitude, amplitude), certificate)
        if has_boxes:
            certificates, left = survives_below(structure, pulse, both[0][0])
            for one in certificates:
                low, high = map(float, one["factor"])
                keep("below", name, gamma, (low, high), one)
            for span in left:
                keep("below", name, gamma, span, None)
    for at in spectra_histories.drop_duplicates("mass_ratio").to_dict("records"):
        slenderness, ratio = at["slenderness_deg"], at["frequency_ratio"]
        *_, pulse = line(FRAME, 0.0, slenderness, at["shape"], ratio)
        pulse = pulse.scaled(at["amplitude_over_uplift"])
        frame = RockingFrame(column_of(slenderness), at["mass_ratio"])
        span = (pulse.amplitude, pulse.amplitude)
        keep("exception", "frame", at["mass_ratio"], span, certified(frame, pulse))
    return {"table": rows, "certificates": "".join(lines)}


def findings(proven: pd.DataFrame, vase: pd.DataFrame) -> dict[str, Any]:
    """Return whether the outcomes enclose the quoted minima, and what else they say together."""
    of_each = ["structure", "mass_ratio"]
    parts = {part: rows.groupby(of_each) for part, rows in proven.groupby("part")}
    minimum, boxes = parts["minimum"], parts["below"]
    first, last = minimum.low.min(), minimum.low.max()
    tables = vase[vase["shape"] == SHAPE].set_index(of_each).minimum_overturning[first.index]
    exception = parts["exception"].outcome.first().tolist()  # in the order of γ
    gapless = [
        [0.0, *rows.high] == [*rows.low, first[structure]]
        for structure, rows in ((name, each.sort_values("low")) for name, each in boxes)
    ]
    return {
        "boundaries": truth(
            all(outcomes == ["survives", "overturns"] for outcomes in minimum.outcome.agg(list))
            and bool(((first < tables) & (tables < last)).all()),
            minima=len(first),
            largest_relative_distance=0.5 * (last / first - 1.0).max(),
        ),
        "nothing_below": truth(
            all(gapless) and set(proven.outcome[proven.part == "below"]) == {"survives"},
            structures=len(boxes),
            boxes=int(boxes.size().sum()),
        ),
        "exception": truth(exception == ["survives", "overturns"]),
    }


if __name__ == "__main__":
    run(snakemake, compute, findings)
