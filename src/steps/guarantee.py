"""Ground velocities below which nothing overturns, however the ground moves, and attacks on them.

Half the range of the horizontal ground velocity below V_n excludes overturning before the n-th
impact since rest, below V* at all times, if b/h ≤ 3/4 (Theorem 4 of the supplement):

    V_n = (g/p̂) sin(α/2)/cos α/(1 + √r + … + √r^(n−1)),    V* = (g/p̂) (1 − √r) sin(α/2)/cos α.

The worst motion jumps between its limits just after each impact. It is followed visit by visit, a
visit being the motion between two impacts, and for some structures as an acceleration with ramps.
"""

import math
import warnings
from collections.abc import Iterator
from functools import partial
from itertools import product
from typing import Any

import numpy as np
import pandas as pd
from scipy.optimize import brentq

from replication.step import check, run, truth, value
from steps.shared.cases import bisected, column_of, lowered
from steps.shared.lobes import half_range
from topheavy import (
    STANDARD_GRAVITY,
    Column,
    FixedMassColumn,
    Pulse,
    Record,
    Response,
    RockingBlock,
    RockingFrame,
    simulate,
)

SUPPORTS = {"frame": RockingFrame, "fixed mass": FixedMassColumn}
FIRST = range(1, 6)  # numbers of visits n of V_n
LIMIT = math.inf  # number of visits of V*
BEGIN = (0.97, 1.04)  # ends of a bisection, times the stated velocity, which is not their middle
FLIGHTS = (8.0, 100.0)  # longest visits that are tried, times 1/p
BEFORE = 1.0 - 1e-9  # share of the time of an impact, at which the block has not lost speed yet
FORGOTTEN = 1e-7  # share of a first rate: impacts that leave less of it stand for infinitely many
SETTLED = 1e-3  # likewise under a motion with ramps
CREEP = 0.5  # acceleration with which a motion with ramps begins, times the uplift acceleration


def velocity(block: RockingBlock, visits: float) -> float:
    """Return V_n, or V* for infinitely many visits, m/s."""
    root, alpha = block.restitution, block.slenderness
    total = 1.0 / (1.0 - root) if visits == LIMIT else sum(root**k for k in range(int(visits)))
    scale = STANDARD_GRAVITY / block.frequency_parameter
    return scale * math.sin(alpha / 2.0) / math.cos(alpha) / total


def break_even(column: RockingBlock, block: RockingBlock, visits: float) -> float:
    """Return the reduction of √r of the column alone that makes both V_n equal; NaN if none."""

    def excess(reduction: float) -> float:
        return velocity(lowered(column, reduction), visits) - velocity(block, visits)

    return brentq(excess, 0.0, 1.0) if excess(0.0) * excess(1.0) < 0.0 else math.nan


def stated(structures: dict, settings: dict) -> Iterator[dict]:
    """Yield V_1 to V_5 and V* of columns, frames and columns with a fixed mass."""
    cases = product(settings["structures"], SUPPORTS, settings["mass_ratios"])
    for name, support, gamma in cases:
        if gamma == 0.0 and support != "frame":
            continue
        column = Column(**structures[name])
        block = SUPPORTS[support](column, gamma).block()
        root = block.restitution
        yield {
            "structure": name,
            "support": support,
            "mass_ratio": gamma,
            "slenderness_deg": math.degrees(block.slenderness),
            "restitution": root,
            **{f"velocity_{n}": velocity(block, n) for n in FIRST},
            "velocity": velocity(block, LIMIT),
            "gain": velocity(block, LIMIT) / velocity(column.block(), LIMIT) - 1.0,
            # vertical acceleration, g, from which no velocity is guaranteed
            "vertical": (1.0 - root**2) / (1.0 + root**2),
        }


def over_visits(column: Column, settings: dict) -> Iterator[dict]:
    """Yield the gain of frames in V_n, and how much it depends on the √r of the column alone."""
    solitary = column.block()
    lower = lowered(solitary, settings["reduction"])
    for gamma, visits in product(settings["mass_ratios"][1:], (*settings["visits"], LIMIT)):
        block = RockingFrame(column, gamma).block()
        yield {
            "mass_ratio": gamma,
            "visits": visits,
            "gain": velocity(block, visits) / velocity(solitary, visits) - 1.0,
            "gain_if_lower": velocity(block, visits) / velocity(lower, visits) - 1.0,
            "break_even": break_even(solitary, block, visits),
        }


# The worst motion ---------------------------------------------------------------------------------


def landing(block: RockingBlock, start: float) -> float:
    """Return the rate (rad/s) at the next impact of a block that starts with a rate at θ = 0.

    The rate is NaN if the block overturns.
    """
    for flight in FLIGHTS:
        duration = flight / block.frequency_parameter
        response = simulate(block, velocity=start, duration=duration, samples=2)
        if response.overturned:
            return math.nan
        if response.impact_times.size:
            break
    before = BEFORE * response.impact_times[:1]
    return abs(float(simulate(block, velocity=start, samples=before).velocity[0]))


def survives(block: RockingBlock, limit: float, visits: float) -> bool:
    """Return whether a block survives the visits under the worst motion within ±`limit`, m/s.

    A jump D of the ground velocity changes φ̇ by (p²/g) D cos(α − φ), here at φ = 0.
    """
    factor = block.frequency_parameter**2 / STANDARD_GRAVITY * math.cos(block.slenderness)
    jump, rate = 2.0 * limit * factor, 0.0
    for _ in range(impacts_until(block, FORGOTTEN) if visits == LIMIT else int(visits)):
        rate = landing(block, block.restitution * rate + jump)
        if math.isnan(rate):
            return False
    return True


def impacts_until(block: RockingBlock, share: float) -> int:
    """Return the number of impacts after which less than a share of the first rate is left."""
    return math.ceil(math.log(share) / math.log(block.restitution))


def attacked(settings: dict) -> Iterator[dict]:
    """Yield V_n and V* by bisection, beside the stated ones, for columns and frames of 1 m size."""
    spec = settings["attack"]
    cases = [*product(spec["slendernesses"], settings["mass_ratios"], FIRST)]
    cases += product(spec["limits"], spec["mass_ratios"], [LIMIT])
    for angle, gamma, visits in cases:
        block = RockingFrame(column_of(angle), gamma).block()
        expected = velocity(block, visits)
        limit = bisected(
            partial(survives, block, visits=visits),
            [end * expected for end in BEGIN],
            spec["tolerance"] * expected,
            f"α = {angle:g}°, γ = {gamma:g}, n = {visits}",
        )
        row = {"slenderness_deg": angle, "mass_ratio": gamma, "visits": visits}
        yield row | {"stated": expected, "found": limit}


def worst_motion(block: RockingBlock, limit: float, step: float) -> tuple[Record, Response]:
    """Return the worst motion with ramps, and the response to it.

    The ground creeps to −`limit` (m/s) without uplift. Then its velocity changes to the other
    limit within two time steps, and again after each impact of the response so far.
    """
    uplift = block.uplift_acceleration
    steps = math.ceil(limit / (CREEP * uplift * STANDARD_GRAVITY * step))
    creep = np.full(steps, -limit / (steps * STANDARD_GRAVITY * step))
    samples, side = [0.0, *creep, 0.0], 1.0
    ramp = 2.0 * limit / (STANDARD_GRAVITY * step)
    for _ in range(impacts_until(block, SETTLED)):
        samples += [side * ramp, 0.0]
        side = -side
        with warnings.catch_warnings(action="ignore"):  # it is no record of an earthquake
            motion = Record(step, samples)
        response = simulate(block, motion, samples=2)
        if response.overturned:
            break
        impact = response.impact_times[response.impact_times > (len(samples) - 2) * step][0]
        samples += [0.0] * (math.ceil(impact / step) + 1 - len(samples))
    return motion, response


def ramped(settings: dict) -> Iterator[dict]:
    """Yield outcomes of worst motions with ramps, a little below and above V*."""
    spec = settings["ramps"]
    for angle, gamma, share in product(
        *(spec[n] for n in ("slendernesses", "mass_ratios", "shares"))
    ):
        block = RockingFrame(column_of(angle), gamma).block()
        step, alpha = spec["time_step"] / block.frequency_parameter, block.slenderness
        limit = share * velocity(block, LIMIT)
        motion, response = worst_motion(block, limit, step)
        reached = half_range(motion)
        check(
            abs(reached / limit - 1.0) < 1e-9, f"half the range is {reached:g} m/s, not {limit:g}"
        )
        sine = math.sin(alpha / 2.0) * math.sqrt(max(1.0 - share**2, 0.0))
        yield {
            "slenderness_deg": angle,
            "mass_ratio": gamma,
            "share": share,
            "overturned": response.overturned,
            "peak": response.peak_rotation / alpha,
            "largest_peak": 1.0 - 2.0 * math.asin(sine) / alpha,
        }


# Until the first impact ---------------------------------------------------------------------------


def until_first_impacts(column: Column, settings: dict) -> Iterator[dict]:
    """Yield rotations under one pulse, from uplift to the first impact of each structure."""
    spec = settings["order"]
    pulse = Pulse(spec["shape"], spec["amplitude"], period=spec["period"])
    times = np.linspace(0.0, spec["duration"], spec["samples"])
    for gamma in spec["mass_ratios"]:
        response = simulate(RockingFrame(column, gamma), pulse, samples=times)
        end = response.impact_times[0] if response.impact_times.size else math.inf
        shares = np.abs(response.rotation) / column.slenderness
        for time, share, push in zip(times, shares, pulse.excitation(times), strict=True):
            if time < end and share <= spec["highest"]:
                row = {"mass_ratio": gamma, "time": time, "acceleration": push}
                yield row | {"rotation_over_alpha": share}


def compute(settings: dict, structures: dict) -> dict[str, Any]:
    """Return stated velocities, their gains over visits, attacks on them, and a first visit."""
    column = Column(**structures[settings["structure"]])
    return {
        "guarantee": [*stated(structures, settings)],
        "visits": [*over_visits(column, settings)],
        "attack": [*attacked(settings)],
        "motions": [*ramped(settings)],
        "order": [*until_first_impacts(column, settings)],
    }


def findings(
    guarantee: pd.DataFrame,
    guarantee_attack: pd.DataFrame,
    guarantee_motions: pd.DataFrame,
    settings: dict,
) -> dict[str, Any]:
    """Return whether the stated velocities are sharp, and the first ones of two structures."""
    attack, motions = guarantee_attack, guarantee_motions
    tolerance = settings["attack"]["tolerance"]
    apart = (attack.found / attack.stated - 1.0).abs()
    below = motions.share < 1.0
    fell = motions.overturned.astype(bool)
    peaks = motions[below].peak <= motions[below].largest_peak + 1e-9
    frames = guarantee[guarantee.support == "frame"].groupby("structure")
    structure = frames.get_group(settings["structure"]).sort_values("mass_ratio")
    return {
        "velocity_is_sharp": truth(
            (apart < tolerance).all() and (fell == ~below).all() and peaks.all(),
            cases=len(attack),
            apart=tolerance,
            motions=len(motions),
        ),
        "first_velocity_of_the_column": value(structure.velocity_1.iloc[0], 0.0, "m/s"),
        "first_velocity_of_the_heaviest": value(structure.velocity_1.iloc[-1], 0.0, "m/s"),
    }


if __name__ == "__main__":
    run(snakemake, compute, findings)
