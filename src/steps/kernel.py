"""Compile the solver and the motions once: jobs that need them would each compile them."""

import numpy as np

from replication.step import run
from steps.shared import synthetic
from topheavy import Column, Pulse, Record, judge, overturned_by, overturning_map, simulate

COLUMN, PULSE = Column(0.5, 3.0), Pulse("one-sine", 0.3, angular_frequency=6.0)
RECORD = Record(0.01, 0.3 * np.sin(0.06 * np.arange(100)))
QUAKE = synthetic.Scenario(magnitude=6.5, distance=10.0, site_velocity=760.0, directivity=10.0)


def compute():
    """Call what uses each part of the solver: histories, outcomes, maps and scaled records."""
    simulate(COLUMN, PULSE)
    judge(COLUMN, RECORD)
    overturning_map(COLUMN, "one-sine", np.array([6.0]), np.array([0.3]))
    for motion in (PULSE, RECORD):
        overturned_by(COLUMN, motion, np.array([1.0]))
    synthetic.motion(0, 0, QUAKE, pulse=True)


if __name__ == "__main__":
    run(snakemake, compute)
