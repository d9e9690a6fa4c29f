"""Simulate every candidate block, and linear oscillators, under every measured motion."""

import sys
from itertools import product
from pathlib import Path

import numpy as np
import pandas as pd
import yaml
from scipy.signal import cont2discrete, detrend, lfilter

from topheavy import Record, RockingBlock, overturned_by

TIME_STEP, UNIT = 0.01, 2e-4  # s, g
FACTORS = np.exp(np.linspace(-0.5, 0.5, 11))  # on a motion
CONFIG = yaml.safe_load(Path("config.yaml").read_text())


def read(folder, share, noise):
    """Return tests, their motions, and the tests left out, whose peak is off its nominal value."""
    tests, arrays = pd.read_csv(f"{folder}/tests.csv"), np.load(f"{folder}/accelerations.npz")
    series = [detrend(arrays[f"test_{number:03d}"] * UNIT) for number in tests.test]
    tests["peak"] = [np.abs(each).max() for each in series]
    tests["record"] = tests.motion.str.extract(r"(RSN\d+)")[0].fillna(tests.motion)
    limit = np.maximum(share * tests.nominal_pga_g, noise)
    kept = (tests.peak - tests.nominal_pga_g).abs() <= limit
    motions = [Record(TIME_STEP, series[k], unit="g") for k in np.flatnonzero(kept)]
    remaining = tests[kept].assign(velocity=[motion.peak_velocity for motion in motions])
    return remaining.reset_index(drop=True), motions, tests[~kept]


def candidates(slendernesses, frequency_parameters, restitutions, scan, **_):
    """Return (slenderness, p, coefficient of restitution): three free, one free, and none free."""
    p, free = scan["frequency_parameter"], (slendernesses, frequency_parameters, restitutions)
    one, of_scan = (
        [(angle, p, 1 - 1.5 * np.sin(angle) ** 2) for angle in angles]  # Eq. (25) without a beam
        for angles in (slendernesses, scan["slendernesses"])
    )
    return {"free": [*product(*free)], "one": one, "scan": of_scan}


def displacements(motions, periods, dampings):
    """Return log peak displacements of linear oscillators, shape (oscillators, tests)."""
    rows, padded = [], [np.append(motion.acceleration, np.zeros(300)) for motion in motions]
    for period, damping in product(np.geomspace(**periods), dampings):
        w = 2 * np.pi / period
        above, below, _ = cont2discrete(([1.0], [1.0, 2 * damping * w, w * w]), TIME_STEP, "foh")
        rows.append([np.abs(lfilter(above.ravel(), below, each)).max() for each in padded])
    return np.log(rows)


if __name__ == "__main__":
    _, motions, _ = read(sys.argv[1], **CONFIG["left_out"])
    simulated = {"oscillators": displacements(motions, **CONFIG["oscillators"])}
    for name, numbers in candidates(**CONFIG).items():
        blocks = [RockingBlock(p, angle, restitution) for angle, p, restitution in numbers]
        simulated[name] = [overturned_by(blocks, motion, FACTORS) for motion in motions]
    np.savez_compressed("results/simulated.npz", **simulated)
