"""Grids of histories, and the bounds on their work."""

import math
import signal
import subprocess
import sys

import numpy as np
import pytest

from tests.cases import grid_of
from topheavy import RockingBlock
from topheavy.kernel.forcing import pulse_waveform, record_waveform
from topheavy.kernel.grid import MIN_PULSES, outcome_of, outcomes_of
from topheavy.kernel.taylor import oscillator

BLOCK = oscillator(RockingBlock(1.0, math.radians(14.0), 0.87))
SCALES, AMPLITUDES = np.linspace(0.5, 10, 61), np.linspace(0.25, 2.5, 31)


def same(first, second) -> None:
    for values, expected in zip(first, second, strict=True):
        np.testing.assert_array_equal(values, expected)


@pytest.mark.parametrize("threads", [2, 3, 7])
@pytest.mark.parametrize("shape", ["one-sine", "ricker-symmetric"])
def test_results_do_not_depend_on_the_number_of_threads(shape, threads):
    assert SCALES.size * AMPLITUDES.size > 3 * MIN_PULSES
    cells = BLOCK, pulse_waveform(shape), SCALES, AMPLITUDES
    serial = grid_of(*cells, threads=1)
    same(grid_of(*cells, threads=threads), serial)
    same(grid_of(*cells), serial)


def mixture(steps, seed):
    """Histories of unlike blocks in an arbitrary order, of both equations."""
    rng = np.random.default_rng(seed)
    blocks = [
        oscillator(RockingBlock(1.0, math.radians(alpha), restitution, linearised))
        for alpha, restitution in ((5.0, 0.95), (14.0, 0.9), (31.0, 0.3))
        for linearised in (False, True)
    ]
    block_index = rng.permutation(np.repeat(np.arange(len(blocks)), 23))
    scales = rng.choice(steps, 138)
    levels = np.array([block.uplift_level for block in blocks])[block_index]
    return blocks, block_index, scales, levels * rng.uniform(0.9, 6.0, block_index.size)


@pytest.mark.parametrize("threads", [1, 2])
@pytest.mark.parametrize("shape", ["one-sine", "ricker-antisymmetric", "record", "two records"])
def test_histories_of_mixed_blocks_have_the_bits_of_each_alone(shape, threads):
    vertical_factors = np.zeros(138)
    if "record" in shape:
        time = np.linspace(0, 20, 500)
        up = 0.4 * np.sin(5 * time[:400]) if shape == "two records" else None
        waveform = record_waveform(np.sin(3 * time) + 0.7 * np.sin(1 + 7.7 * time), up, 0.731)
        vertical_factors = np.random.default_rng(8).uniform(-1.8, 1.8, 138)
        blocks, block_index, scales, amplitudes = mixture([0.011, 0.02, 0.043], 3)
    else:
        waveform = pulse_waveform(shape)
        blocks, block_index, scales, amplitudes = mixture([0.7, 3.0, 6.1], 3)
    cells = blocks, waveform, block_index, scales, amplitudes
    results = outcomes_of(*cells, vertical_factors=vertical_factors, threads=threads)
    assert 0.1 < results.overturned.mean() < 0.9
    for k in range(block_index.size):
        cell = blocks[block_index[k]], waveform, scales[k], amplitudes[k]
        end = outcome_of(*cell, vertical_factor=vertical_factors[k])
        expected = end.peak_rotation, end.overturned, end.number_of_impacts
        np.testing.assert_array_equal([part[k] for part in results], expected)


CHILD = """
import os, signal, sys, threading, time
import numpy as np
from topheavy import Record, RockingBlock, overturning_map, simulate
signal.signal(signal.SIGINT, signal.default_int_handler)  # that a shell's background job ignores
block = RockingBlock(2.0, 0.25, 0.95)
record = Record(0.01, np.tile(0.27 * np.sin(np.arange(1_000_000) * 0.06), 3))
calls = {
    "simulate": lambda: simulate(block, record, samples=2),
    "overturning_map": lambda: overturning_map(
        block, "one-sine", np.linspace(1, 20, 4000), np.linspace(0.26, 1, 4000)
    ),
}
overturning_map(block, "one-sine", [3.0], [0.3])
def interrupt():
    sent.append(time.process_time())
    os.kill(os.getpid(), signal.SIGINT)
for name, call in calls.items():
    sent = []
    threading.Timer(0.3, interrupt).start()
    try:
        call()
        sys.exit(f"{name} finished")
    except KeyboardInterrupt:
        print(name, time.process_time() - sent[0], flush=True)
raise KeyboardInterrupt
"""


def test_ctrl_c_ends_a_long_call():
    child = subprocess.run(
        [sys.executable, "-c", CHILD], capture_output=True, text=True, timeout=240
    )
    assert child.stderr.rstrip().endswith("KeyboardInterrupt"), child.stderr
    assert child.returncode == -signal.SIGINT
    ended = dict(line.split() for line in child.stdout.splitlines())
    assert set(ended) == {"simulate", "overturning_map"}
    # of the processor: a busy machine takes longer, but does no more
    assert max(map(float, ended.values())) < 2.0
