"""Verify with interval arithmetic the quoted minima, all amplitudes below two, and one exception.

Each outcome is verified by two programs: a search, and a checker that shares no code with it.
"""

import json
import math
from typing import Any

import pandas as pd

from replication.step import run, truth
from steps.shared.spectrum import FRAME, column_of, line
from topheavy import Column, Pulse, RockingFrame
from topheavy.bodies.structures import Structure
from topheavy.proven import certified, checking, survives_below
from topheavy.proven.certificate import BITS

SHAPE = "one-cosine"
QUOTED = {("bare", 0.0): True, ("free", 1.0): False, ("free", math.inf): True}
"""The quoted minima, and whether all amplitudes below them are verified, too."""
WIDTHS = (1e-8, 1e-7, 1e-6)  # from a minimum, over it: the tables have nine digits
DIGITS = (72, BITS)  # bits: the checker takes a quarter of the time where the first suffice


def accepts(certificate: dict | None, structure: Structure, pulse: Pulse) -> bool:
    """Return whether there is a certificate of this problem, and the checker proves the same."""
    if certificate is None:
        return False
    try:
        checking.concerns(certificate, structure, pulse, factors(certificate))
        return checking.check(certificate) == certificate["outcome"]
    except checking.Refused:
        return False


def factors(certificate: dict) -> tuple[float, float]:
    """Return the lowest and the highest factor on the pulse."""
    ends = (text.partition("/") for text in certificate["factor"])
    low, high = (int(top) / int(below or 1) for top, _, below in ends)
    return low, high


def undecided(low: float = 1.0, high: float = 1.0) -> dict:
    return {"outcome": "undecided", "factor": [str(low), str(high)], "impacts": -1}


def proof(structure: Structure, pulse: Pulse) -> dict:
    """Return the certificate of the outcome under a pulse."""
    for bits in DIGITS:
        _, certificate = certified(structure, pulse, bits=bits)
        if accepts(certificate, structure, pulse):
            return certificate
    return undecided()


def sides(structure: Structure, pulse: Pulse) -> tuple[float, list[dict]]:
    """Return w and the certificates of 1 − w and 1 + w times the pulse, the closest that differ."""
    for width in WIDTHS:
        found = [proof(structure, pulse.scaled(1.0 + side * width)) for side in (-1.0, 1.0)]
        if [one["outcome"] for one in found] == ["survives", "overturns"]:
            break
    return width, found


def below(structure: Structure, period: float, high: float) -> list[dict]:
    """Return the certificates of boxes of amplitudes from 0 to `high`, g."""
    pulse = Pulse(SHAPE, 1.0, 2.0 * math.pi / period)
    boxes = survives_below(structure, pulse, high, accepts=lambda c: accepts(c, structure, pulse))
    return [*boxes.certificates, *(undecided(*ends) for ends in boxes.open)]


def compute(
    vase: pd.DataFrame, spectra_histories: pd.DataFrame, column: dict, period: float
) -> dict[str, Any]:
    """Return a row for each outcome, with its amplitudes in g, and the certificates as JSON."""
    rows, lines = [], []

    def keep(part: str, structure: str, gamma: float, amplitude: float, one: dict) -> None:
        low, high = (f"{amplitude * end:.15g}" for end in factors(one))
        row = {"part": part, "structure": structure, "mass_ratio": gamma, "low": low, "high": high}
        rows.append(row | {"outcome": one["outcome"], "impacts": one["impacts"]})
        if one["outcome"] != "undecided":
            line_of = {"claim": f"{part}: {structure}, γ = {gamma:g}"} | one
            lines.append(json.dumps(line_of, ensure_ascii=False, allow_nan=False) + "\n")

    quoted = vase[vase["shape"] == SHAPE].set_index(["structure", "mass_ratio"])
    for (name, gamma), has_boxes in QUOTED.items():
        structure: Structure = Column(**column)
        if name == "free":
            structure = RockingFrame(structure, gamma)
        minimum = float(quoted.minimum_overturning[name, gamma])
        width, both = sides(structure, Pulse(SHAPE, minimum, 2.0 * math.pi / period))
        for one, side in zip(both, (-1.0, 1.0), strict=True):
            keep("minimum", name, gamma, minimum * (1.0 + side * width), one)
        if has_boxes:
            for one in below(structure, period, float(f"{minimum * (1.0 - width):.15g}")):
                keep("below", name, gamma, 1.0, one)
    for at in spectra_histories.drop_duplicates("mass_ratio").to_dict("records"):
        slenderness, ratio = at["slenderness_deg"], at["frequency_ratio"]
        *_, pulse = line(FRAME, 0.0, slenderness, at["shape"], ratio)
        pulse = pulse.scaled(at["amplitude_over_uplift"])
        frame = RockingFrame(column_of(slenderness), at["mass_ratio"])
        keep("exception", "free", at["mass_ratio"], pulse.amplitude, proof(frame, pulse))
    return {"table": rows, "certificates": "".join(lines)}


def findings(proven: pd.DataFrame) -> dict[str, Any]:
    """Return what the verified outcomes say together."""
    of_each = ["structure", "mass_ratio"]
    parts = {part: rows.groupby(of_each) for part, rows in proven.groupby("part")}
    minimum, boxes = parts["minimum"], parts["below"]
    first, last = minimum.low.min(), minimum.low.max()
    exception = parts["exception"].outcome.first().tolist()  # in the order of γ
    gapless = [
        [0.0, *rows.high] == [*rows.low, first[structure]]
        for structure, rows in ((name, each.sort_values("low")) for name, each in boxes)
    ]
    return {
        "boundaries": truth(
            all(outcomes == ["survives", "overturns"] for outcomes in minimum.outcome.agg(list)),
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
