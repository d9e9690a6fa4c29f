"""Compute p̂ and R̂ against γ (Eqs. (23), (24)), their limits, and the γ of given shares."""

import math
from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import run, truth, value
from topheavy import Column, RockingFrame

ROUNDING = 4.0 * np.finfo(float).eps


def main(settings: dict) -> tuple[pd.DataFrame, dict]:
    column = Column(0.5, 3.0)  # any: the ratios do not depend on it
    gammas = [*np.linspace(0.0, settings["largest"], settings["points"]), math.inf]
    frames = [RockingFrame(column, gamma) for gamma in gammas]
    p_ratio = np.array([frame.frequency_parameter for frame in frames]) / column.frequency_parameter
    r_ratio = np.array([frame.equivalent_size for frame in frames]) / column.size
    share = (r_ratio - 1.0) / (r_ratio[-1] - 1.0)
    columns = {
        "mass_ratio": gammas,
        "frequency_ratio": p_ratio,
        "size_ratio": r_ratio,
        "share_of_size_gain": share,
        "share_of_frequency_gain": (1.0 - p_ratio) / (1.0 - p_ratio[-1]),
    }
    shares, table = np.array(settings["shares_of_gain"]), pd.DataFrame(columns)
    drawn = findings(table)
    gain = drawn.pop("gain_at_mass_ratio_one")
    # differences that are smaller than the digits of the table
    return table, drawn | {
        "limit_of_frequency_ratio": value(p_ratio[-1], abs(p_ratio[-1] - math.sqrt(2 / 3))),
        "limit_of_size_ratio": value(r_ratio[-1], abs(r_ratio[-1] - 1.5)),
        # share of the gain in R̂: 2γ/(1 + 2γ) = s
        "mass_ratio_for_gain_in_size": truth(
            True, shares=shares, mass_ratios=shares / (2.0 * (1.0 - shares))
        ),
        "gain_at_mass_ratio_one": gain,
    }


def findings(mass_ratio: pd.DataFrame) -> dict[str, Any]:
    """Return the limits and the growth of R̂, from the table of both ratios."""
    last = mass_ratio.iloc[-1]
    gain = mass_ratio.share_of_size_gain[np.searchsorted(mass_ratio.mass_ratio, 1.0)]
    return {
        "limit_of_frequency_ratio": {"value": last.frequency_ratio, "unit": ""},
        "limit_of_size_ratio": {"value": last.size_ratio, "unit": ""},
        "heavier_is_larger": truth(
            np.all(np.diff(mass_ratio.frequency_ratio) < 0.0)
            and np.all(np.diff(mass_ratio.size_ratio) > 0.0),
            mass_ratios=len(mass_ratio),
        ),
        "gain_at_mass_ratio_one": value(gain, ROUNDING),
    }


if __name__ == "__main__":
    run(snakemake, lambda job: main(job.params.settings))
