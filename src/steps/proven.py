"""Prove the quoted minima and one exception with balls that contain the true numbers."""

import math
from typing import Any

import pandas as pd

from replication.step import run, truth
from steps.shared.balls import NotProvenError, block_of, outcome
from steps.shared.cases import column_of
from topheavy import Column

SHAPE = "one-cosine"
QUOTED = [("column", 0.0), ("frame", 1.0), ("frame", math.inf)]
WIDTHS = (1e-8, 1e-7, 1e-6)  # relative distances from a minimum to try: tables have nine digits


def proven(column: dict, gamma: float, amplitude: float, period: float) -> str:
    """Return the outcome that is proven, or "undecided"."""
    try:
        return outcome(block_of(column, gamma, amplitude, period))
    except NotProvenError as reason:
        print(f"γ = {gamma:g} under {amplitude:.15g} g: {reason}")
        return "undecided"


def sides(column: dict, gamma: float, minimum: float, period: float) -> list[tuple[float, str]]:
    """Return the closest amplitudes below and above a minimum that differ, with their outcomes."""
    for width in WIDTHS:
        amplitudes = [float(f"{minimum * (1.0 + side * width):.15g}") for side in (-1.0, 1.0)]
        pairs = [(one, proven(column, gamma, one, period)) for one in amplitudes]
        if [end for _, end in pairs] == ["survives", "overturns"]:
            break
    return pairs


def compute(
    vase: pd.DataFrame, spectra_histories: pd.DataFrame, column: dict, period: float
) -> list[dict[str, Any]]:
    """Return a row for each outcome, with its amplitude in g."""
    quoted = vase[vase["shape"] == SHAPE].set_index(["structure", "mass_ratio"])
    rows = [
        {"part": "minimum", "structure": name, "mass_ratio": gamma}
        | {"amplitude": f"{amplitude:.15g}", "outcome": end}
        for name, gamma in QUOTED
        for amplitude, end in sides(
            column, gamma, float(quoted.minimum_overturning[name, gamma]), period
        )
    ]
    for at in spectra_histories.drop_duplicates("mass_ratio").to_dict("records"):
        own: Column = column_of(at["slenderness_deg"])
        amplitude = float(f"{at['amplitude_over_uplift'] * own.uplift_acceleration:.15g}")
        length = 2.0 * math.pi / (at["frequency_ratio"] * own.frequency_parameter)
        both = {"half_width": own.half_width, "half_height": own.half_height}
        end = proven(both, at["mass_ratio"], amplitude, length)
        rows.append(
            {"part": "exception", "structure": "frame", "mass_ratio": at["mass_ratio"]}
            | {"amplitude": f"{amplitude:.15g}", "outcome": end}
        )
    return rows


def findings(proven: pd.DataFrame, vase: pd.DataFrame) -> dict[str, Any]:
    """Return whether the outcomes enclose the quoted minima, and what the exception is."""
    minimum = proven[proven.part == "minimum"]
    quoted = vase[vase["shape"] == SHAPE].set_index(["structure", "mass_ratio"])
    first, last, tables = [], [], []
    for one, rows in minimum.groupby(["structure", "mass_ratio"]):
        first.append(rows.amplitude.min())
        last.append(rows.amplitude.max())
        tables.append(quoted.minimum_overturning[one])
    outcomes = minimum.sort_values("amplitude").groupby(["structure", "mass_ratio"]).outcome
    exception = proven[proven.part == "exception"].sort_values("mass_ratio").outcome.tolist()
    return {
        "boundaries": truth(
            all(each == ["survives", "overturns"] for each in outcomes.agg(list))
            and all(a < b < c for a, b, c in zip(first, tables, last, strict=True)),
            minima=len(first),
            largest_relative_distance=max(
                0.5 * (c / a - 1.0) for a, c in zip(first, last, strict=True)
            ),
        ),
        "exception": truth(exception == ["survives", "overturns"]),
    }


if __name__ == "__main__":
    run(snakemake, compute, findings)
