"""Find the pulses for which the model of Allen et al. (1986) gives the wrong outcome."""

import math
from collections.abc import Iterator
from itertools import groupby
from operator import itemgetter
from typing import Any

import pandas as pd

from replication.workbench import Finding, grid, run, truth
from topheavy import Column, Pulse, RockingFrame, judge
from topheavy.bodies.massless_columns import simplified

OUTCOMES = {
    (False, False): "both survive",
    (True, True): "both overturn",
    (False, True): "falsely overturned",
    (True, False): "falsely safe",
}


def main(settings: dict) -> tuple[pd.DataFrame, dict]:
    alpha = math.radians(settings["slenderness"])
    frame = RockingFrame(Column(math.sin(alpha), math.cos(alpha)), settings["mass_ratio"])
    p = frame.column.frequency_parameter
    models = {name: simplified(frame, name) for name in ("linearised", "all")}
    rows = []
    for omega in grid(settings["frequency_ratios"]):
        found: dict[str, list[tuple[float, str]]] = {name: [] for name in models}
        for amplitude in grid(settings["amplitudes"]):
            pulse = Pulse(settings["shape"], amplitude * frame.uplift_acceleration, omega * p)
            exact = judge(frame, pulse).overturned
            for name, block in models.items():
                verdict = OUTCOMES[exact, judge(block, pulse).overturned]
                found[name].append((float(amplitude), verdict))
        rows += [
            {"model": name, "frequency_ratio": omega, **run}
            for name, cells in found.items()
            for run in runs(cells)
        ]
    table = pd.DataFrame(rows)
    return table, findings(table)


def runs(cells: list[tuple[float, str]]) -> Iterator[dict[str, Any]]:
    """Yield the neighbouring amplitudes, over that of uplift, that have the same verdict."""
    for verdict, some in groupby(cells, itemgetter(1)):
        amplitudes = [amplitude for amplitude, _ in some]
        ends = {"lowest": amplitudes[0], "highest": amplitudes[-1]}
        yield ends | {"cells": len(amplitudes), "verdict": verdict}


def findings(allen_overturning: pd.DataFrame) -> dict[str, Finding]:
    """Return the share of the pulses with each outcome, from the table of outcomes."""
    counts = allen_overturning.groupby(["model", "verdict"]).cells.sum()
    shares = counts / counts.groupby("model").sum()
    return {
        name: truth(True, **{word.replace(" ", "_"): share for word, share in shares[name].items()})
        for name in allen_overturning.model.unique()
    }


if __name__ == "__main__":
    run(snakemake, lambda job: main(job.params.settings))
