"""Does negative stiffness make a frame stable? The frame, and the same with tendons."""

import math
from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import Finding, grid, run, truth
from topheavy import Column, Pulse, RockingFrame
from topheavy.restrained import (
    least_stiffness,
    restoring_moment,
    restrained_peak_by_scipy,
    restrained_peaks,
)

AFTER = 10.0  # over p̂: how long a frame is followed after the pulse
CLOSE = 1e-2  # of the peak: what the two routes may differ by
SURE = 2e-3  # of the peak: own error of what SciPy computes, too
SEED = 2014


def histories(frame: RockingFrame, settings: dict) -> pd.DataFrame:
    """Return the peaks over α without and with tendons, and their change at twice the time step."""
    block, rows = frame.block(), []
    p, alpha, tan = frame.frequency_parameter, frame.slenderness, frame.uplift_acceleration
    spec = settings["amplitudes"]
    amplitudes = np.geomspace(spec["lowest"], spec["highest"], spec["points"])
    kappa = least_stiffness(block) * np.array([0.0, *settings["stiffnesses"]])
    for shape in settings["shapes"]:
        for ratio in grid(settings["frequency_ratios"]):
            pulse = Pulse(shape, tan, ratio * frame.column.frequency_parameter)
            steps = math.ceil(pulse.duration * p / settings["time_step"])
            fine, coarse = (
                restrained_peaks(
                    block,
                    kappa[:, None],
                    pulse,
                    amplitudes,
                    duration=pulse.duration + AFTER / p,
                    time_step=factor * pulse.duration / steps,
                )
                / alpha
                for factor in (1.0, 2.0)
            )
            errors = np.abs(fine - coarse)
            rows += [
                {
                    "shape": shape,
                    "frequency_ratio": ratio,
                    "amplitude": amplitude,
                    "stiffness": stiffness,
                    "free": fine[0, place],
                    "restrained": fine[row, place],
                    "error": max(errors[0, place], errors[row, place]),
                }
                for place, amplitude in enumerate(amplitudes)
                for row, stiffness in enumerate(settings["stiffnesses"], 1)
            ]
    return pd.DataFrame(rows)


def second_route(table: pd.DataFrame, frame: RockingFrame, settings: dict) -> pd.Series:
    """Return the peak over α by SciPy of a sample of frames with tendons that stay within α."""
    within = table[(table.restrained < 1.0) & (table.error < SURE * table.restrained)]
    chosen = within.sample(settings["sample"], random_state=SEED)
    block, p = frame.block(), frame.frequency_parameter
    found = {}
    for place, row in chosen.iterrows():
        omega = row.frequency_ratio * frame.column.frequency_parameter
        pulse = Pulse(row["shape"], row.amplitude * frame.uplift_acceleration, omega)
        peak = restrained_peak_by_scipy(
            block,
            row.stiffness * least_stiffness(block),
            pulse,
            duration=pulse.duration + AFTER / p,
            longest_step=0.005 / p,
        )
        found[place] = peak / frame.slenderness
    return pd.Series(found, dtype=float).reindex(table.index)


def main(settings: dict) -> tuple[pd.DataFrame, dict[str, Finding]]:
    frame = RockingFrame(Column(**settings["column"]), settings["mass_ratio"])
    table = histories(frame, settings)
    table["by_scipy"] = second_route(table, frame, settings)
    phi = np.linspace(0.0, frame.slenderness, 101)
    block = frame.block()
    rises = [
        bool((np.diff(restoring_moment(block, factor * least_stiffness(block), phi)) > 0.0).all())
        for factor in settings["stiffnesses"]
    ]
    found = findings(table)
    return table, found | {"stiffness_is_positive": truth(all(rises), tendons=len(rises))}


def findings(negative_stiffness: pd.DataFrame) -> dict[str, Finding]:
    """Return which frame rotates less, and which stays within α, from the table of histories."""
    table = negative_stiffness
    told = (table.free - table.restrained).abs() > table.error
    both = told & (table.free < 1.0) & (table.restrained < 1.0)
    free_less = both & (table.free < table.restrained)
    stays = pd.DataFrame({"free": table.free < 1.0, "restrained": table.restrained < 1.0})
    asked = table[table.by_scipy.notna()]
    apart = (asked.by_scipy / asked.restrained - 1.0).abs()
    return {
        "negative_stiffness_and_gravity": truth(
            bool(both.any()) and not (both & ~free_less).any() and bool(stays.free.all()),
            holds_when=bool(free_less.any()) and bool(stays.free.any()),
            condition="it means that gravity returns the frame, and that some pulses turn it less "
            "than with a stiffness that stays positive",
            histories=len(table),
            both_within=int(both.sum()),
            free_rotates_less=int(free_less.sum()),
            only_free_within=int((stays.free & ~stays.restrained).sum()),
            only_restrained_within=int((stays.restrained & ~stays.free).sum()),
        ),
        "positive_stiffness_stays_within_more": truth(
            (stays.restrained & ~stays.free).sum() > (stays.free & ~stays.restrained).sum()
        ),
        "second_route": truth(
            len(asked) > 0 and bool((apart < CLOSE).all()),
            histories=len(asked),
            largest_relative=float(apart.max()),
        ),
    }


def work(job: Any) -> tuple:
    return main(job.params.settings)


if __name__ == "__main__":
    run(snakemake, work)
