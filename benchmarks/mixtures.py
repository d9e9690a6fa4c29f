"""Mixed histories for `verify_grid`: unlike structures at once, under records and vertical motion.

Every mixture has columns, frames, columns with a fixed mass and portals, each with its own factors
on one motion. Its bits must not depend on the number of threads, on the width of the registers, or
on which histories run beside which.
"""

import json
import math
import os
import subprocess
import sys
from typing import NamedTuple

import numpy as np
from kernel import Found
from oracle import RecordOracle

from topheavy import Column, FixedMassColumn, MonolithicPortal, RockingFrame
from topheavy.kernel.forcing import (
    AT,
    NO_RECORD,
    RECORD,
    SHAPES,
    START,
    STOP,
    UP,
    UP_STOP,
    prepare_record,
    prepare_two_records,
)
from topheavy.kernel.grid import mixed_outcomes_of
from topheavy.kernel.taylor import oscillator

COLUMNS = [Column(0.5, 3.0), Column(0.4, 2.2), Column(0.2, 2.0)]
STRUCTURES = [
    make(column)
    for column in COLUMNS
    for make in (
        lambda column: column,
        lambda column: RockingFrame(column, 1.0),
        lambda column: RockingFrame(column, math.inf),
        lambda column: FixedMassColumn(column, 0.5, 1.0, 0.3),
        lambda column: MonolithicPortal(column, 0.5, 1.5),
    )
]
#: Motion, linearised, and the time step of the vertical record over that of the horizontal one.
SETS = [("record", linearised, None) for linearised in (False, True)]
SETS += [
    ("record", linearised, ratio) for linearised in (False, True) for ratio in (1.0, 0.5, 0.731)
]
SAMPLES, STEP = 400, 0.02  # s
WIDTHS = [
    {},
    {"NUMBA_CPU_NAME": "generic", "NUMBA_CPU_FEATURES": "+avx,+fma"},
]


class Mixture(NamedTuple):
    """Histories as `mixed_outcomes_of` takes them."""

    blocks: list
    shape: int
    which: np.ndarray
    scales: np.ndarray
    amplitudes: np.ndarray
    record: np.ndarray
    lifts: np.ndarray


def waves(chance: np.random.Generator, samples: int, step: float) -> np.ndarray:
    """Return a motion of a few sines whose largest sample is 1; it ends by a jump."""
    time = step * np.arange(samples)
    each = ((f, *chance.normal(size=1), chance.uniform(0, 6)) for f in (2.0, 4.1, 7.3, 13.0))
    found = sum(size * np.sin(f * time + phase) for f, size, phase in each)
    found = found * (0.1 + np.sin(math.pi * time / time[-1]) ** 2)
    return found / np.abs(found).max()


def blocks_of(linearised: bool) -> list:
    blocks = [structure.block() for structure in STRUCTURES]
    return [oscillator(block.linear() if linearised else block) for block in blocks]


def mixture(number: int, count: int) -> Mixture:
    """Return the histories of a set; those of pulses come after `SETS`."""
    chance = np.random.default_rng(500 + number)
    which = chance.integers(0, len(STRUCTURES), count)
    p = np.array([structure.block().frequency_parameter for structure in STRUCTURES])[which]
    if number < len(SETS):
        _, linearised, ratio = SETS[number]
        samples = waves(chance, SAMPLES, STEP)
        if ratio is None:
            record = prepare_record(samples)
        else:
            up = 0.5 * waves(chance, round(1.1 * SAMPLES / ratio), ratio * STEP)
            record = prepare_two_records(samples, up, ratio)
        shape, scales = RECORD, p * STEP
    else:
        name = sorted(set(SHAPES) - {"harmonic"})[number - len(SETS)]
        linearised, shape, record = bool(number % 2), SHAPES[name], NO_RECORD
        scales = chance.uniform(0.5, 10.0, count)
    blocks = blocks_of(linearised)
    level = np.array([block.level for block in blocks])[which]
    amplitudes = level * chance.uniform(0.9, 4.0, count)
    return Mixture(
        blocks, shape, which, scales, amplitudes, record, chance.uniform(-1.8, 1.8, count)
    )


def outcomes(given: Mixture, nudge: float = 0.0, threads: int = 1) -> tuple:
    factors = given.amplitudes * (1.0 + nudge)
    return mixed_outcomes_of(
        *given[:4], factors, given.record, lifts=given.lifts * (1.0 + nudge), threads=threads
    )


def truth(given: Mixture, k: int, oracle: RecordOracle, nudge: float = 0.0) -> Found:
    """Return what heyoka finds for a history under records."""
    block, record = given.blocks[given.which[k]], given.record
    factor, step = given.amplitudes[k] * (1.0 + nudge), given.scales[k]
    if record.shape[0] <= UP:
        return oracle(block.slenderness, block.restitution, factor * record[START], step)
    lift, last = given.lifts[k] * (1.0 + nudge), record.shape[1] - 1
    pieces = [
        (
            step * (record[AT, j + 1] - record[AT, j]),
            (factor * record[START, j], factor * record[STOP, j]),
            (1.0 + lift * record[UP, j], 1.0 + lift * record[UP_STOP, j]),
        )
        for j in range(last)
    ]
    return oracle.follow(block.slenderness, block.restitution, pieces)


def bits(count: int) -> list[str]:
    """Return the results of every mixture, by one thread, by two, and in another order, as text."""
    found = []
    for number in range(len(SETS) + len(SHAPES) - 1):
        given = mixture(number, count)
        order = np.random.default_rng(number).permutation(count)
        other = given._replace(
            which=given.which[order],
            scales=given.scales[order],
            amplitudes=given.amplitudes[order],
            lifts=given.lifts[order],
        )
        back = np.argsort(order)
        ways = [outcomes(given), outcomes(given, threads=2)]
        ways.append(tuple(values[back] for values in outcomes(other, threads=2)))
        texts = [[values.tobytes().hex() for values in way] for way in ways]
        if any(text != texts[0] for text in texts):
            raise ValueError(f"mixture {number} depends on threads or on the order of histories")
        found.append("".join(texts[0]))
    return found


def same_bits(count: int) -> int:
    """Return in how many mixtures the results differ between widths of the registers."""
    found = []
    for cpu in WIDTHS:
        code = f"import json, mixtures; print(json.dumps(mixtures.bits({count})))"
        environment = {k: v for k, v in os.environ.items() if "NUMBA_CPU" not in k} | cpu
        folder = os.path.dirname(os.path.abspath(__file__))
        done = subprocess.run(
            [sys.executable, "-c", code],
            env=environment | {"PYTHONPATH": folder},
            capture_output=True,
            text=True,
            check=True,
        )
        found.append(json.loads(done.stdout))
    return sum(one != other for one, other in zip(*found, strict=True))
