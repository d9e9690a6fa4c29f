"""Prove the quoted minima and one exception with balls that contain the true numbers."""

import math
from dataclasses import asdict
from typing import Any

import pandas as pd

from replication.step import run, stop, truth
from steps.shared.balls import NotProvenError, block_of, outcome
from steps.shared.cases import column_of

SHAPE = "one-cosine"
QUOTED = [("column", 0.0), ("frame", 1.0), ("frame", math.inf)]
WIDTHS = (1e-8, 1e-7, 1e-6)  # relative distances from a minimum, which has nine digits in its table


def proven(column: dict, gamma: float, amplitude: float, period: float) -> str:
    """Return the outcome that is proven, "survives" or "overturns"."""
    try:
        return outcome(block_of(column, gamma, amplitude, period))
    except NotProvenError as reason:
        stop(
            f"γ = {gamma:g} under {amplitude:.15g} g: no outcome is proven, as {reason}; expected "
            '"survives" or "overturns". Take another period or slenderness, or more BITS and STEPS '
            "in src/steps/shared/balls.py"
        )


def sides(column: dict, gamma: float, minimum: float, period: float) -> list[tuple[float, str]]:
    """Return the closest amplitudes below and above a minimum that differ, with their outcomes."""
    for width in WIDTHS:
        amplitudes = [float(f"{minimum * (1.0 + side * width):.15g}") for side in (-1.0, 1.0)]
        pairs = [(amplitude, proven(column, gamma, amplitude, period)) for amplitude in amplitudes]
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
    for case in spectra_histories.drop_duplicates("mass_ratio").to_dict("records"):
        thin = column_of(case["slenderness_deg"])
        amplitude = float(f"{case['amplitude_over_uplift'] * thin.uplift_acceleration:.15g}")
        length = 2.0 * math.pi / (case["frequency_ratio"] * thin.frequency_parameter)
        end = proven(asdict(thin), case["mass_ratio"], amplitude, length)
        rows.append(
            {"part": "exception", "structure": "frame", "mass_ratio": case["mass_ratio"]}
            | {"amplitude": f"{amplitude:.15g}", "outcome": end}
        )
    return rows


def findings(proven: pd.DataFrame, vase: pd.DataFrame) -> dict[str, Any]:
    """Return whether the outcomes enclose the quoted minima, and whether the exception holds."""
    minima = proven[proven.part == "minimum"].sort_values("amplitude")
    structures = minima.groupby(["structure", "mass_ratio"])
    below, above = structures.amplitude.min(), structures.amplitude.max()
    quoted = vase[vase["shape"] == SHAPE].set_index(["structure", "mass_ratio"])
    minimum = quoted.minimum_overturning[below.index]
    exception = proven[proven.part == "exception"].sort_values("mass_ratio").outcome.tolist()
    return {
        "boundaries": truth(
            all(ends == ["survives", "overturns"] for ends in structures.outcome.agg(list))
            and ((below < minimum) & (minimum < above)).all(),
            minima=len(minimum),
            largest_relative_distance=0.5 * (above / below - 1.0).max(),
        ),
        "exception": truth(exception == ["survives", "overturns"]),
    }


if __name__ == "__main__":
    run(snakemake, compute, findings)
