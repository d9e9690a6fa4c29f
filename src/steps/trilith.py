"""The trilith of Peña et al. (2008): its numbers on p. 4, distance from uplift, outcomes."""

import math
from itertools import product

import numpy as np
import pandas as pd

from replication.digits import print_rounding
from replication.step import check, grid, run, truth, value
from steps.shared import plain
from steps.shared.samples import check_histories
from topheavy import Column, Pulse, RockingFrame, simulate
from topheavy.bodies.structures import STANDARD_GRAVITY

DIGITS = 5e-9  # relative error of a number in a table
ASIDE = 1e-6  # relative distance from a threshold, to either side
AGREE = 1e-8  # difference of rotations between solvers, times α


def table_acceleration(amplitude, frequency):
    """Return the peak acceleration u₀ (2πf)², in g, of u₀ in m and f in Hz (p. 4)."""
    return amplitude * (2.0 * math.pi * frequency) ** 2 / STANDARD_GRAVITY


def table_motion(amplitude, frequency):
    """Return the steady acceleration of the shake table, −u₀ (2πf)² sin 2πft, from t = 0 on."""
    return Pulse(
        "harmonic",
        -table_acceleration(amplitude, frequency),
        angular_frequency=2.0 * math.pi * frequency,
    )


def abrupt_start(frame, amplitude, frequency):
    """Return θ̇ (rad/s) at t = 0⁺ of a frame whose shake table starts at full velocity.

    A displacement u₀ sin 2πft starts with the velocity 2πf u₀. This jump is an infinite
    acceleration, which uplifts the frame for every u₀. Integration of Eq. (23) over the jump at
    θ = 0 gives θ̇ = −p̂² cos α (2πf u₀)/g.
    """
    jump = 2.0 * math.pi * frequency * amplitude
    return -(frame.frequency_parameter**2) * math.cos(frame.slenderness) * jump / STANDARD_GRAVITY


def numbers(frame, settings):
    """Return the numbers of p. 4, each from the ones before it, with their unit."""
    column, (cap, columns) = frame.column, settings["printed"]["masses"]
    acceleration = table_acceleration(settings["table_amplitude"], settings["table_frequency"])
    p, p_hat = column.frequency_parameter, frame.frequency_parameter
    rows = [
        ("tan_slenderness", math.tan(column.slenderness), ""),
        ("slenderness", math.degrees(column.slenderness), "°"),
        ("size", column.size, "m"),
        ("frequency_parameter", p, "rad/s"),
        ("mass_ratio", cap / columns, ""),
        ("frequency_ratio", p_hat / p, ""),
        ("frame_frequency_parameter", p_hat, "rad/s"),
        ("base_acceleration", acceleration * STANDARD_GRAVITY, "m/s²"),
        ("base_acceleration_in_g", acceleration, "g"),
        ("uplift_acceleration", frame.uplift_acceleration, "g"),
        ("acceleration_over_uplift", acceleration / frame.uplift_acceleration, ""),
    ]
    return pd.DataFrame(rows, columns=["quantity", "value", "unit"])


def thresholds(frame, settings):
    """Return the changes that would uplift the trilith, simulated on both sides of each threshold.

    At the amplitude u₀ or frequency f `to_lift`, the peak acceleration is that of uplift.
    """
    u, f = settings["table_amplitude"], settings["table_frequency"]
    amplitude = frame.uplift_acceleration / table_acceleration(1.0, f)
    frequency = math.sqrt(frame.uplift_acceleration / table_acceleration(u, 1.0))
    for motion in (table_motion(amplitude, f), table_motion(u, frequency)):
        outcomes = [  # the first half cycle decides
            simulate(frame, motion.scaled(1.0 + side), duration=4.0 / f, samples=2).outcome
            for side in (-ASIDE, ASIDE)
        ]
        uplifts = [outcome != "no uplift" for outcome in outcomes]
        check(
            uplifts == [False, True],
            f"uplift just below and above {motion} is {uplifts}; expected [False, True]",
        )
    rows = [("amplitude", "mm", 1e3 * u, 1e3 * amplitude), ("frequency", "Hz", f, frequency)]
    return pd.DataFrame(rows, columns=["quantity", "unit", "tested", "to_lift"])


def starts(frame, settings, tightened):
    """Simulate the steady sine of the shake table after starts of increasing abruptness.

    The share is the part of the velocity 2πf u₀ that the shake table reaches at once: 0 is an
    acceleration sine from rest, 1 a displacement sine at full velocity. Two shares bracket the one
    from which the trilith keeps rocking. The histories are those of these two ends.
    """
    u, f, duration = settings["table_amplitude"], settings["table_frequency"], settings["duration"]
    motion, full, alpha = table_motion(u, f), abrupt_start(frame, u, f), frame.slenderness
    times = np.linspace(0.0, duration, 2401)

    def shaken(share, simulate=simulate, **options):
        return simulate(
            frame, motion, velocity=share * full, duration=duration, samples=times, **options
        )

    responses = {share: shaken(share) for share in np.round(np.linspace(0.0, 1.0, 21), 2)}
    rocking = [share for share, response in responses.items() if response.outcome == "rocking"]
    high = min(rocking, default=0.0)
    low = high - 0.05
    while high > 0.0 and high - low > 1e-4:
        middle = (low + high) / 2.0
        responses[middle] = shaken(middle)
        low, high = (middle, high) if responses[middle].outcome == "rests" else (low, middle)
    smooth, abrupt = responses[0.0], responses[1.0]
    repeated = shaken(1.0, tolerance=tightened), shaken(1.0, plain.simulate)
    check_histories(abrupt, repeated, AGREE, "abrupt start")
    late = times > 0.75 * duration
    rows = [
        {
            "share_of_speed": share,
            "outcome": response.outcome,
            "peak_over_alpha": response.peak_rotation / alpha,
            "late_peak_over_alpha": np.abs(response.rotation[late]).max() / alpha,
        }
        for share, response in sorted(responses.items())
    ]
    courses = {"smooth": smooth.rotation / alpha, "abrupt": abrupt.rotation / alpha}
    return rows, {"time": times} | courses


def outcomes(frame, settings):
    """Return the outcome over frequency and displacement amplitude, after a smooth start."""
    rows = []
    for frequency, amplitude in product(
        grid(settings["frequencies"]), grid(settings["amplitudes"])
    ):
        motion, duration = table_motion(amplitude, frequency), settings["cycles"] / frequency
        outcome = simulate(frame, motion, duration=duration, samples=2).outcome
        rows.append(
            {"frequency_hz": frequency, "amplitude_mm": 1e3 * amplitude, "outcome": outcome}
        )
    return rows


def compute(settings, structures, solver):
    frame = RockingFrame(Column(**structures["trilith"]), settings["mass_ratio"])
    rows, histories = starts(frame, settings, solver["tightened"])
    return {
        "trilith_numbers": numbers(frame, settings),
        "trilith_thresholds": thresholds(frame, settings),
        "trilith_starts": rows,
        "trilith_histories": histories,
        "trilith_map": outcomes(frame, settings),
    }


def findings(trilith_numbers, trilith_thresholds, trilith_starts, settings, structures):
    column, printed = structures["trilith"], settings["printed"]
    results = {
        row.quantity: value(row.value, DIGITS * row.value, row.unit)
        for row in trilith_numbers.fillna({"unit": ""}).itertuples()
    }
    acceleration = results["base_acceleration_in_g"]["value"]
    results["stays_below_uplift"] = truth(acceleration < results["uplift_acceleration"]["value"])

    # p. 4 as printed: the halves of width and height, and γ as a quotient of two masses
    halves, measures = printed["half_measures"], [printed["height"], printed["width"]]
    results["half_measures_agree"] = truth(
        np.allclose(2.0 * np.array(halves), measures, rtol=1e-12)
        and np.allclose([column["half_height"], column["half_width"]], halves, rtol=1e-12)
    )
    # γ from the printed p̂, within its rounding, and the computed p: (p̂/p)² = (1 + 2γ)/(1 + 3γ)
    p_hat, p = printed["frame_frequency_parameter"], results["frequency_parameter"]["value"]
    ends = p_hat + print_rounding(p_hat) * np.array([1.0, -1.0])
    least, most = (1.0 - (ends / p) ** 2) / (3.0 * (ends / p) ** 2 - 2.0)
    middle, half = (least + most) / 2.0, (most - least) / 2.0
    results["mass_ratio_by_p_hat"] = value(middle, half, least=least, most=most)

    rest, abrupt = trilith_starts.iloc[0], trilith_starts.iloc[-1]
    low = trilith_starts.share_of_speed[trilith_starts.outcome == "rests"].max()
    high = trilith_starts.share_of_speed[trilith_starts.outcome == "rocking"].min()
    rests = rest.outcome == "no uplift" and rest.peak_over_alpha == 0.0
    amplitude = trilith_thresholds.set_index("quantity").loc["amplitude"]
    overshoot = amplitude.to_lift / amplitude.tested - 1.0
    results["overshoot_to_uplift"] = value(overshoot, ASIDE)
    results["no_pure_rocking"] = truth(rests)
    results["steady_rotation_over_alpha"] = value(abrupt.late_peak_over_alpha, AGREE)
    if low < high:  # slower starts come to rest, and faster ones keep rocking
        middle, error = (low + high) / 2.0, (high - low) / 2.0
        results["least_share_that_keeps_rocking"] = value(middle, error)
    return results


if __name__ == "__main__":
    run(snakemake, compute, findings)
