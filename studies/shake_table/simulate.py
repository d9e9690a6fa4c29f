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
    """Return tests with their motions, and those left out, whose peak is off its nominal value."""
    tests, arrays = pd.read_csv(f"{folder}/tests.csv"), np.load(f"{folder}/accelerations.npz")
    series = [detrend(arrays[f"test_{number:03d}"] * UNIT) for number in tests.test]
    tests["shaking"] = [Record(TIME_STEP, each, unit="g") for each in series]
    tests[["peak", "velocity"]] = [(m.peak_acceleration, m.peak_velocity) for m in tests.shaking]
    tests["record"] = tests.motion.str.extract(r"(RSN\d+)")[0].fillna(tests.motion)
    limit = np.maximum(share * tests.nominal_pga_g, noise)
    kept = (tests.peak - tests.nominal_pga_g).abs() <= limit
    return tests[kept].reset_index(drop=True), tests[~kept]


def displacements(motions, periods, dampings):
    """Return log peak displacements of linear oscillators, shape (tests, oscillators)."""
    columns, padded = [], [np.append(motion.acceleration, np.zeros(300)) for motion in motions]
    for period, damping in product(np.geomspace(**periods), dampings):
        w = 2 * np.pi / period
        above, below, _ = cont2discrete(([1.0], [1.0, 2 * damping * w, w * w]), TIME_STEP, "foh")
        columns.append([np.abs(lfilter(above.ravel(), below, each)).max() for each in padded])
    return np.log(np.transpose(columns))


if __name__ == "__main__":
    tests, _ = read(sys.argv[1], **CONFIG["left_out"])
    simulated = {"oscillators": displacements(tests.shaking, **CONFIG["oscillators"])}
    ps, angles, restitutions, _ = CONFIG["candidates"].values()
    free = [RockingBlock(*each) for each in product(ps, angles, restitutions)]
    p, angles = CONFIG["scan"]["frequency_parameter"], angles + CONFIG["scan"]["slenderness"]
    one = [RockingBlock(p, angle, 1 - 1.5 * np.sin(angle) ** 2) for angle in angles]  # Eq. (25)
    for name, blocks in (("free", free), ("one", one)):
        simulated[name] = [overturned_by(blocks, motion, FACTORS) for motion in tests.shaking]
    np.savez_compressed("results/simulated.npz", **simulated)
