"""Recompute the trilith of Peña et al. (2008): its numbers, and its distance from uplift."""

import math
import re
from dataclasses import replace
from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import Finding, run, truth, value
from topheavy import Column, RockingFrame, simulate
from topheavy.bodies.structures import STANDARD_GRAVITY
from topheavy.derivation.mends import mended_quotient
from topheavy.ground.shaking_table import (
    abrupt_start,
    amplitude_to_uplift,
    frequency_to_uplift,
    table_acceleration,
    table_motion,
)
from topheavy.second import reference

EPS = float(np.finfo(float).eps)
EPS_PRINT = 1e-12  # printed decimals, which are exact but for their doubles
STEP_ASIDE = 1e-6  # of a threshold, to either side


def numbers(frame: RockingFrame, settings: dict) -> pd.DataFrame:
    """Return the numbers of p. 4, each from the ones before it, with their error and unit."""
    column, (cap, columns) = frame.column, settings["printed_masses"]
    p, p_frame = column.frequency_parameter, frame.frequency_parameter
    acceleration = table_acceleration(settings["table_amplitude"], settings["table_frequency"])
    uplift = frame.uplift_acceleration
    rows = [
        ("tan_slenderness", math.tan(column.slenderness), EPS, ""),
        ("slenderness", math.degrees(column.slenderness), 90 * EPS, "°"),
        ("size", column.size, EPS, "m"),
        ("frequency_parameter", p, 8 * EPS, "rad/s"),
        ("mass_ratio", cap / columns, EPS, ""),
        ("frequency_ratio", p_frame / p, EPS, ""),
        ("frame_frequency_parameter", p_frame, 8 * EPS, "rad/s"),
        ("base_acceleration", acceleration * STANDARD_GRAVITY, 8 * EPS, "m/s²"),
        ("base_acceleration_in_g", acceleration, EPS, "g"),
        ("uplift_acceleration", uplift, EPS, "g"),
        ("acceleration_over_uplift", acceleration / uplift, EPS, ""),
    ]
    return pd.DataFrame(rows, columns=["quantity", "value", "error", "unit"])


def of_numbers(table: pd.DataFrame) -> dict[str, Finding]:
    """Return the numbers as findings, and whether the base acceleration is below that of uplift."""
    found: dict[str, Finding] = {}
    for row in table.fillna({"unit": ""}).itertuples():
        found[row.quantity] = value(row.value, row.error, row.unit)
        if row.quantity == "uplift_acceleration":
            acceleration = found["base_acceleration_in_g"].value
            found["stays_below_uplift"] = truth(acceleration < row.value)
    return found


def passage(
    frame: RockingFrame, settings: dict, printed: dict[str, Any], mass_ratio: Finding
) -> dict[str, Finding]:
    """Return what depends on the print of p. 4, by the values of the ledger."""
    column = frame.column
    width, height = printed["trilith_width"], printed["trilith_height"]
    halves = sorted(map(float, re.findall(r"[\d.]+", printed["trilith_half_measures"])))
    ratio = printed["trilith_frame_frequency_parameter"] / printed["trilith_frequency_parameter"]
    implied = (1 - ratio**2) / (3 * ratio**2 - 2)  # (1 + 2γ)/(1 + 3γ) = p̂²/p², solved for γ
    cap, columns = settings["printed_masses"]
    mended = mended_quotient(cap, columns, f"{printed['trilith_mass_ratio']}")
    meant = {}
    if mended:
        meant = {"meant_value": mended[1], "kind": mended[0].kind, "mended": mended[0].text}
    return {
        "half_measures_agree": truth(
            np.allclose(2.0 * np.array(halves), [width, height], rtol=EPS_PRINT)
            and np.allclose([column.half_width, column.half_height], halves, rtol=EPS_PRINT)
        ),
        "mass_ratio": mass_ratio.with_evidence(
            **meant, implied_by_frequencies=implied, cap_mass=frame.mass_ratio * columns
        ),
    }


def lifts(frame: RockingFrame, amplitude: float, frequency: float, duration: float) -> bool:
    motion = table_motion(amplitude, frequency)
    return simulate(frame, motion, duration=duration, samples=2).outcome != "no uplift"


def nearness(frame: RockingFrame, settings: dict) -> list[dict]:
    """Changes that would have uplifted it, with a simulation on each side of the threshold."""
    u, f, column = settings["table_amplitude"], settings["table_frequency"], frame.column
    short = 4.0 / f  # cycles enough: the peak of the first half cycle decides
    amplitude, frequency = amplitude_to_uplift(frame, f), frequency_to_uplift(frame, u)
    half_width = table_acceleration(u, f) * column.half_height

    level = math.atan(table_acceleration(u, f))
    tilt = column.slenderness - level  # gravity, turned by the tilt, leaves this much of α

    def narrowed(to: float) -> RockingFrame:
        return replace(frame, column=Column(to, column.half_height))

    below, above = 1.0 - STEP_ASIDE, 1.0 + STEP_ASIDE
    return [
        {
            "quantity": "amplitude_at_tested_frequency",
            "unit": "mm",
            "tested": 1e3 * u,
            "to_lift": 1e3 * amplitude,
            "safe_side_lifts": lifts(frame, amplitude * below, f, short),
            "other_side_lifts": lifts(frame, amplitude * above, f, short),
        },
        {
            "quantity": "frequency_at_tested_amplitude",
            "unit": "Hz",
            "tested": f,
            "to_lift": frequency,
            "safe_side_lifts": lifts(frame, u, frequency * below, short),
            "other_side_lifts": lifts(frame, u, frequency * above, short),
        },
        {
            "quantity": "effective_width_of_columns",
            "unit": "mm",
            "tested": 2e3 * column.half_width,
            "to_lift": 2e3 * half_width,
            "safe_side_lifts": lifts(narrowed(half_width * above), u, f, short),
            "other_side_lifts": lifts(narrowed(half_width * below), u, f, short),
        },
        {
            "quantity": "tilt_of_the_base",
            "unit": "°",
            "tested": 0.0,
            "to_lift": math.degrees(tilt),
            "safe_side_lifts": lifts(tilted(frame, tilt * below), u, f, short),
            "other_side_lifts": lifts(tilted(frame, tilt * above), u, f, short),
        },
    ]


def tilted(frame: RockingFrame, angle: float) -> RockingFrame:
    """Return the frame whose columns have lost this angle (rad) of their slenderness."""
    column = frame.column
    slenderness = column.slenderness - angle
    return replace(
        frame, column=Column(column.half_height * math.tan(slenderness), column.half_height)
    )


def starts(
    frame: RockingFrame, settings: dict, tightened: float
) -> tuple[list[dict], list[dict], dict[str, float]]:
    """Simulate the shake table's steady sine after starts of increasing abruptness.

    The share is the part of the velocity 2πf u₀ that the shake table reaches at once: 0 is an
    acceleration sine from rest, 1 a displacement sine at full velocity. The histories are those of
    these two ends. The last are the limits: the share from which it keeps rocking, and both routes.
    """
    u, f, duration = settings["table_amplitude"], settings["table_frequency"], settings["duration"]
    motion, full = table_motion(u, f), abrupt_start(frame, u, f)

    def shaken(share: float, simulate=simulate, **options):
        start = {"velocity": share * full, "duration": duration, "samples": 2401}
        return simulate(frame, motion, **start, **options)

    def keeps_rocking(share: float) -> bool:
        return shaken(share).outcome != "rests"

    shares = np.round(np.arange(0.0, 1.0001, 0.05), 2)
    alpha = frame.slenderness
    summary, histories = [], []
    for share in shares:
        response = shaken(share)
        late = np.abs(response.rotation[response.time > duration * 0.75]).max()
        summary.append(
            {
                "share_of_speed": share,
                "outcome": response.outcome,
                "peak_over_alpha": response.peak_rotation / alpha,
                "late_peak_over_alpha": late / alpha,
            }
        )
    for share in (0.0, 0.3, 1.0):
        response = shaken(share)
        histories += [
            {"share_of_speed": share, "time": t, "rotation_over_alpha": theta / alpha}
            for t, theta in zip(response.time, response.rotation, strict=True)
        ]
    rocking = [row["share_of_speed"] for row in summary if row["outcome"] == "rocking"]
    low, high = min(rocking) - 0.05, min(rocking)
    while high - low > 1e-4:
        middle = (low + high) / 2.0
        low, high = (low, middle) if keeps_rocking(middle) else (middle, high)
    usual = shaken(1.0)
    others = (shaken(1.0, tolerance=tightened), shaken(1.0, reference.simulate))
    error = max(np.abs(other.rotation - usual.rotation).max() for other in others) / alpha
    limits = {
        "duration": duration,
        "abrupt_keeps_rocking": all(one.outcome == "rocking" for one in (usual, *others)),
        "peak_deg": math.degrees(usual.peak_rotation),
        "steady_peak_deg": math.degrees(alpha * summary[-1]["late_peak_over_alpha"]),
        "error_over_alpha": error,
        "share_that_rests": low,
        "share_that_rocks": high,
    }
    return summary, histories, limits


def of_starts(starts: pd.DataFrame, limits: pd.Series) -> dict[str, Finding]:
    """Return what the starts come to, from the tables of starts and of limits."""
    rest, abrupt = starts.iloc[0], starts.iloc[-1]
    low, high = limits.share_that_rests, limits.share_that_rocks
    return {
        "rest_from_rest": truth(
            rest.outcome == "no uplift" and rest.peak_over_alpha == 0.0, duration=limits.duration
        ),
        "abrupt_start_keeps_it_rocking": truth(
            limits.abrupt_keeps_rocking,
            peak_deg=limits.peak_deg,
            steady_peak_deg=limits.steady_peak_deg,
            steady_peak_over_alpha=abrupt.late_peak_over_alpha,
            error_over_alpha=limits.error_over_alpha,
        ),
        "least_share_that_keeps_rocking": value((low + high) / 2.0, (high - low) / 2.0),
    }


def no_pure_rocking(started: dict[str, Finding]) -> Finding:
    """Return whether there was no pure rocking below the uplift acceleration, as the paper says."""
    rests = started["rest_from_rest"].holds
    return truth(
        rests and not started["abrupt_start_keeps_it_rocking"].holds,
        holds_when=rests,
        condition="the table takes up its motion without a jump of velocity above the share stated",
        share=started["least_share_that_keeps_rocking"].value,
    )


def findings(
    trilith_numbers: pd.DataFrame,
    trilith_nearness: pd.DataFrame,
    trilith_starts: pd.DataFrame,
    trilith_limits: pd.DataFrame,
) -> dict[str, Finding]:
    """Return the numbers of p. 4, how near the test was to uplift, and what starts it."""
    limits = trilith_limits.set_index("quantity").value
    started, numbers = of_starts(trilith_starts, limits), of_numbers(trilith_numbers)
    over_uplift = numbers.pop("acceleration_over_uplift")
    return {
        **numbers,
        **started,
        **of_nearness(trilith_nearness),
        "acceleration_over_uplift": over_uplift,
        "no_pure_rocking": no_pure_rocking(started),
    }


def of_nearness(near: pd.DataFrame) -> dict[str, Finding]:
    """Return what would have lifted it, from the table of thresholds."""
    to_lift = near.set_index("quantity").to_lift
    amplitude = to_lift["amplitude_at_tested_frequency"]
    frequency = to_lift["frequency_at_tested_amplitude"]
    width, tilt = to_lift["effective_width_of_columns"], to_lift["tilt_of_the_base"]
    tested = near.set_index("quantity").tested["effective_width_of_columns"]
    return {
        "thresholds_bracketed": truth((near.other_side_lifts & ~near.safe_side_lifts).all()),
        "amplitude_to_lift": value(amplitude, amplitude * STEP_ASIDE, "mm"),
        "frequency_to_lift": value(frequency, frequency * STEP_ASIDE, "Hz"),
        "width_to_lift": value(width, width * STEP_ASIDE, "mm"),
        "width_lost_at_each_edge": value((tested - width) / 2.0, width * STEP_ASIDE, "mm"),
        "tilt_to_lift": value(tilt, tilt * STEP_ASIDE, "°"),
    }


def main(settings: dict, printed: dict[str, Any], tightened: float) -> tuple:
    frame = RockingFrame(Column(**settings["column"]), settings["mass_ratio"])
    summary, histories, limits = starts(frame, settings, tightened)
    limits = {name: float(one) for name, one in limits.items()}
    tables = (
        numbers(frame, settings),
        pd.DataFrame(nearness(frame, settings)),
        pd.DataFrame(summary),
        pd.DataFrame(limits.items(), columns=["quantity", "value"]),
    )
    found = findings(*tables)
    read = passage(frame, settings, printed, found["mass_ratio"])
    found["mass_ratio"] = read.pop("mass_ratio")
    return *tables, histories, read | found


def work(job: Any) -> tuple:
    return main(job.params.settings, job.params.printed, job.params.solver["tightened"])


if __name__ == "__main__":
    run(snakemake, work)
