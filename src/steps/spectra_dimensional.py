"""Overturning spectra of frames of given size: amplitude in g against the pulse's period in s."""

import math
from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import Finding, run, truth
from steps.shared.spectrum import Line, solve
from topheavy import Column, Pulse, RockingFrame, judge
from topheavy.second import reference

ROUNDING = 0.004  # of an amplitude: by so much prints of other studies have been found to differ


def frequency_ratios(spec: dict) -> np.ndarray:
    """Return ω/p in equal ratios, so that the periods lie as densely at either end."""
    return np.geomspace(spec["lowest"], spec["highest"], spec["points"])


def mass_ratio(cap: float | dict) -> float:
    """Return γ of a cap: as it is given, or from the masses of the cap and of one column."""
    if isinstance(cap, dict):
        return cap["cap_mass"] / (2.0 * cap["column_mass"])
    return cap


def lines(settings: dict, structures: dict) -> list[Line]:
    """Return the lines of all spectra; a scale of 1 is an amplitude of 1 g tan α."""
    found = []
    for name, caps in settings["frames"].items():
        column = Column(**structures[name])
        for shape in settings["shapes"]:
            for gamma in map(mass_ratio, caps):
                for ratio in frequency_ratios(settings["frequency_ratios"]):
                    omega = ratio * column.frequency_parameter
                    labels = {
                        "structure": name,
                        "height": 2.0 * column.half_height,
                        "shape": shape,
                        "mass_ratio": gamma,
                        "period": 2.0 * math.pi / omega,
                        "uplift_g": column.uplift_acceleration,
                    }
                    pulse = Pulse(shape, column.uplift_acceleration, omega)
                    found.append(Line(labels, RockingFrame(column, gamma).block(), pulse))
    return found


def published(settings: dict, structures: dict, tightened: float) -> tuple[dict, Finding]:
    """Return the minimum overturning amplitude (g) of a pulse that others have computed.

    As a row for the picture, and as a finding.
    """
    given = settings["published"]
    column = Column(**structures[given["structure"]])
    frame = RockingFrame(column, given["mass_ratio"])
    printed, omega = given["pulse"]["amplitude"], 2.0 * math.pi / given["pulse"]["period"]
    pulse = Pulse(given["pulse"]["shape"], column.uplift_acceleration, omega)
    labels = {"structure": given["structure"]}
    lowest = solve([Line(labels, frame.block(), pulse)], settings).lower.min()
    sides = [pulse.scaled(lowest * (1.0 + away)) for away in (-1e-6, 1e-6)]
    routes = [
        [judge(frame, side, tolerance=tightened).overturned for side in sides],
        [reference.judge(frame, side).overturned for side in sides],
    ]
    amplitude = lowest * column.uplift_acceleration
    row = {
        "structure": given["structure"],
        "shape": pulse.shape,
        "mass_ratio": given["mass_ratio"],
        "period": given["pulse"]["period"],
        "printed_g": printed,
        "lowest_overturning_g": amplitude,
    }
    agrees = abs(amplitude / printed - 1.0) < ROUNDING and routes == [[False, True]] * 2
    drawn = findings(pd.DataFrame([row]))["published_amplitude"]
    return row, truth(agrees, **drawn)


def findings(spectra_published: pd.DataFrame) -> dict[str, Any]:
    """Return the amplitude that others have computed beside ours, from its table."""
    (row,) = spectra_published.itertuples()
    both = {"lowest_overturning_g": row.lowest_overturning_g, "printed_g": row.printed_g}
    return {"published_amplitude": both}


def main(settings: dict, structures: dict, solver: dict) -> tuple[pd.DataFrame, dict, dict]:
    table = solve(lines(settings, structures), settings)
    for end in ("lower", "upper"):
        table[f"{end}_g"] = table[end] * table.uplift_g
    row, finding = published(settings, structures, solver["tightened"])
    return table, row, {"published_amplitude": finding}


def work(job: Any) -> tuple:
    params = job.params
    table, row, findings = main(params.settings, params.structures, params.solver)
    return table, [row], findings


if __name__ == "__main__":
    run(snakemake, work)
