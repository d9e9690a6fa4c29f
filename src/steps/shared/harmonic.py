"""Harmonic motions of random phase and length: the narrowest band that a set of motions can have.

Between frames the order of the probabilities can turn there, at some levels; rule motions compares
broad-band sets.
"""

import math
import warnings
from collections.abc import Iterator, Mapping
from itertools import combinations
from typing import Any

import numpy as np
from numpy.typing import NDArray

from steps.shared.samples import Cell
from topheavy import Column, Record, RockingFrame, overturned_by
from topheavy.risk.resampling import Ensemble

Settings = Mapping[str, Any]


def motion(settings: Settings, number: int, column: Column) -> Record:
    """Return motion `number`: a sine of amplitude g tan α that starts at a random phase.

    It lasts a random number of cycles, which need not be whole, so that it jumps at both ends.
    """
    random = np.random.default_rng((settings["seed"], number))
    phase, cycles = random.uniform(0.0, 2.0 * math.pi), random.uniform(*settings["cycles"])
    omega = settings["frequency_ratio"] * column.frequency_parameter
    step = 2.0 * math.pi / (omega * settings["points"])
    times = step * np.arange(round(cycles * settings["points"]) + 1)
    with warnings.catch_warnings(action="ignore"):  # the ground still moves at the end
        return Record(step, column.uplift_acceleration * np.sin(omega * times + phase))


def outcomes(settings: Settings, gammas: list[float], column: Column) -> NDArray[np.bool_]:
    """Return whether motions overturn frames, shape (motions, γ, levels); γ = 0 is the column."""
    levels = np.array(settings["amplitudes"])
    frames = [RockingFrame(column, gamma) for gamma in gammas]
    motions = (motion(settings, number, column) for number in range(settings["motions"]))
    return np.array([overturned_by(frames, record, levels) for record in motions])


def pairs(
    settings: Settings, gammas: list[float], overturned: NDArray[np.bool_], bootstrap: Settings
) -> list[dict[str, Any]]:
    """Return the probabilities of each pair of structures at each level, and their difference.

    A difference above 0 means that the heavier structure overturns more often.
    """
    ensemble = Ensemble(overturned, None, **bootstrap)
    shares = ensemble.means()
    return [
        {"amplitude": level, "lighter": gammas[light], "heavier": gammas[heavy]}
        | {"motions": len(overturned)}
        | {"probability_lighter": shares[0, light, place]}
        | {"probability_heavier": shares[0, heavy, place]}
        | ensemble.bounds("difference", shares[:, heavy, place] - shares[:, light, place])
        for place, level in enumerate(settings["amplitudes"])
        for light, heavy in combinations(range(len(gammas)), 2)
    ]


def sampled(
    settings: Settings, gammas: list[float], overturned: NDArray[np.bool_], column: Column
) -> Iterator[Cell]:
    """Yield outcomes at the middle level of the shortest motion, which the plain solver repeats."""
    records = [motion(settings, number, column) for number in range(settings["motions"])]
    shortest = min(range(len(records)), key=lambda number: records[number].acceleration.size)
    level = len(settings["amplitudes"]) // 2
    for place, gamma in enumerate(gammas):
        block, fell = RockingFrame(column, gamma).block(), overturned[shortest, place, level]
        yield block, records[shortest], None, settings["amplitudes"][level], bool(fell)
