"""Recompute the trilith of Peña et al. (2008): its numbers, and its distance from uplift."""

import math
import re
from dataclasses import replace
from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import Finding, run, truth, value
from topheavy import Column, RockingFrame, reference, simulate
from topheavy.derivation.mends import mended_quotient
from topheavy.shaking_table import (
    abrupt_start,
    amplitude_to_uplift,
    frequency_to_uplift,
    table_acceleration,
    table_motion,
)
from topheavy.structures import STANDARD_GRAVITY

EPS = float(np.finfo(float).eps)
EPS_PRINT = 1e-12  # printed decimals, which are exact but for their doubles
STEP_ASIDE = 1e-6  # of a threshold, to either side


def passage(frame: RockingFrame, case: dict, printed: dict[str, Any]) -> dict:
    """The numbers of p. 4, each from the ones before it. `printed` has the values of the ledger."""
    column, u, f = frame.column, case["table_amplitude"], case["table_frequency"]
    acceleration = table_acceleration(u, f)
    width, height = printed["trilith_width"], printed["trilith_height"]
    halves = sorted(map(float, re.findall(r"[\d.]+", printed["trilith_half_measures"])))
    ratio = printed["trilith_frame_frequency_parameter"] / printed["trilith_frequency_parameter"]
    implied = (1 - ratio**2) / (3 * ratio**2 - 2)  # (1 + 2γ)/(1 + 3γ) = p̂²/p², solved for γ
    cap, columns = case["printed_masses"]
    mended = mended_quotient(cap, columns, f"{printed['trilith_mass_ratio']}")
    meant = {}
    if mended:
        meant = {"meant_value": mended[1], "kind": mended[0].kind, "mended": mended[0].text}
    return {
        "half_measures_agree": truth(
            np.allclose(2.0 * np.array(halves), [width, height], rtol=EPS_PRINT)
            and np.allclose([column.half_width, column.half_height], halves, rtol=EPS_PRINT)
        ),
        "tan_slenderness": value(math.tan(column.slenderness), EPS),
        "slenderness": value(math.degrees(column.slenderness), 90 * EPS, "°"),
        "size": value(column.size, EPS, "m"),
        "frequency_parameter": value(column.frequency_parameter, 8 * EPS, "rad/s"),
        "mass_ratio": value(
            cap / columns,
            EPS,
            "",
            **meant,
            implied_by_frequencies=implied,
            cap_mass=frame.mass_ratio * columns,
        ),
        "frequency_ratio": value(frame.frequency_parameter / column.frequency_parameter, EPS),
        "frame_frequency_parameter": value(frame.frequency_parameter, 8 * EPS, "rad/s"),
        "base_acceleration": value(acceleration * STANDARD_GRAVITY, 8 * EPS, "m/s²"),
        "base_acceleration_in_g": value(acceleration, EPS, "g"),
        "uplift_acceleration": value(frame.uplift_acceleration, EPS, "g"),
        "stays_below_uplift": truth(acceleration < frame.uplift_acceleration),
        "restitution": value(frame.restitution, EPS),
    }


def lifts(frame: RockingFrame, amplitude: float, frequency: float, duration: float) -> bool:
    motion = table_motion(amplitude, frequency)
    return simulate(frame, motion, duration=duration, samples=2).outcome != "no uplift"


def nearness(frame: RockingFrame, case: dict) -> list[dict]:
    """Changes that would have uplifted it, with a simulation on each side of the threshold."""
    u, f, column = case["table_amplitude"], case["table_frequency"], frame.column
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
    frame: RockingFrame, case: dict, tightened: float
) -> tuple[list[dict], list[dict], dict]:
    """Simulate the shake table's steady sine after starts of increasing abruptness.

    The share is the part of the velocity 2πf u₀ that the shake table reaches at once: 0 is an
    acceleration sine from rest, 1 a displacement sine at full velocity. The histories are those of
    these two ends.
    """
    u, f, duration = case["table_amplitude"], case["table_frequency"], case["duration"]
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
    drawn = of_starts(pd.DataFrame(summary))
    findings = {
        "rest_from_rest": drawn["rest_from_rest"].with_evidence(duration=duration),
        "abrupt_start_keeps_it_rocking": truth(
            all(response.outcome == "rocking" for response in (usual, *others)),
            peak_deg=math.degrees(usual.peak_rotation),
            steady_peak_deg=math.degrees(alpha * summary[-1]["late_peak_over_alpha"]),
            **drawn["abrupt_start_keeps_it_rocking"],
            error_over_alpha=error,
        ),
        "least_share_that_keeps_rocking": value((low + high) / 2.0, (high - low) / 2.0),
    }
    return summary, histories, findings


def of_starts(starts: pd.DataFrame) -> dict[str, Any]:
    """Return what the least and the most abrupt start come to, from the table of starts."""
    rest, abrupt = starts.iloc[0], starts.iloc[-1]
    return {
        "rest_from_rest": truth(rest.outcome == "no uplift" and rest.peak_over_alpha == 0.0),
        "abrupt_start_keeps_it_rocking": {"steady_peak_over_alpha": abrupt.late_peak_over_alpha},
    }


def findings(trilith_nearness: pd.DataFrame, trilith_starts: pd.DataFrame) -> dict[str, Any]:
    """Return how near the test was to uplift; the dimensions and √r are in no table."""
    return of_starts(trilith_starts) | of_nearness(trilith_nearness)


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


def main(
    case: dict, printed: dict[str, Any], tightened: float
) -> tuple[dict, list[dict], list[dict], list[dict]]:
    frame = RockingFrame(Column(**case["column"]), case["mass_ratio"])
    findings = passage(frame, case, printed)
    near = nearness(frame, case)
    summary, histories, started = starts(frame, case, tightened)
    findings |= started | {
        **of_nearness(pd.DataFrame(near)),
        "acceleration_over_uplift": value(
            table_acceleration(case["table_amplitude"], case["table_frequency"])
            / frame.uplift_acceleration,
            EPS,
        ),
    }
    # The paper: below the uplift acceleration there was apparently no pure rocking.
    findings["no_pure_rocking"] = truth(
        findings["rest_from_rest"].holds and not findings["abrupt_start_keeps_it_rocking"].holds,
        holds_when=findings["rest_from_rest"].holds,
        condition="the table takes up its motion without a jump of velocity above the share stated",
        share=findings["least_share_that_keeps_rocking"].value,
    )
    return findings, near, summary, histories


def work(job: Any) -> tuple:
    findings, *tables = main(job.params.case, job.params.printed, job.params.solver["tightened"])
    return *tables, findings


if __name__ == "__main__":
    run(snakemake, work)
