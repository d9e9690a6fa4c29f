"""What many tests are about: structures, places, solvers, and which findings break."""

from functools import cache
from io import StringIO
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

import topheavy as th
from documents import check
from replication.config import read_yaml
from replication.step import DIGITS
from steps.shared import plain
from steps.shared.linear import simulate_linear_exact as closed
from topheavy.ground.shapes import ELEMENTARY, FINITE_SHAPES
from topheavy.kernel.forcing import forcing_of, pulse_waveform
from topheavy.kernel.grid import outcomes_of

ROOT = Path(__file__).resolve().parents[1]
RECORDS = ROOT / "data" / "records"
CONFIG = read_yaml(ROOT / "config" / "config.yaml")

COLUMN = th.Column(0.5, 3.0)
FRAME = th.RockingFrame(COLUMN, 1.0)
BLOCK = th.RockingBlock(2.0, 0.25, 0.9)
SIZES = {"half_width": 0.5, "half_height": 3.0}
BOTH = pytest.mark.parametrize("block", [BLOCK, BLOCK.linear()], ids=["exact", "linear"])
SIDES = pytest.mark.parametrize("side", [1.0, -1.0])
TIME = 0.01 * np.arange(400)
MOTION = 0.3 * np.sin(2.5 * np.pi * TIME) * np.exp(-(((TIME - 2.0) / 0.8) ** 2))
"""A motion that rises and dies, in g."""
CLOSED_PULSES = [shape for shape in ELEMENTARY if shape in FINITE_SHAPES]


@cache
def published():
    """Return the findings of the published tables by rule, once for all tests of a process."""
    return check.findings(check.read("rules"))


NAMES = {th.simulate: "Taylor", plain.simulate: "plain", closed: "closed"}
CLOSE = {th.simulate: 1e-8, plain.simulate: 1e-8, closed: 1e-13}
"""How near a solver is to a closed form, of α and of amplitudes."""


def solvers(*blocks):
    """Each solver with each block that it can follow."""
    return [
        pytest.param(solve, block, id=f"{name}-{'linear' if block.linearised else 'exact'}")
        for block in blocks
        for solve, name in NAMES.items()
        if block.linearised or solve is not closed
    ]


EVERY = pytest.mark.parametrize(("solve", "block"), solvers(BLOCK, BLOCK.linear()))
ON_LINEAR = pytest.mark.parametrize("solve", NAMES, ids=NAMES.values())
TWO = [th.simulate, plain.simulate]
BY_TWO = pytest.mark.parametrize("solve", TWO, ids=["Taylor", "plain"])


def fate(end):
    """Whether an outcome or a history overturns, and after how many impacts."""
    return bool(end.overturned), int(end.number_of_impacts)


def as_written(tables):
    """Return tables as they are read from the files of a rule."""
    texts = {n: pd.DataFrame(t).to_csv(index=False, float_format=DIGITS) for n, t in tables.items()}
    return {name: pd.read_csv(StringIO(text)) for name, text in texts.items()}


def broken(findings):
    """Return the names of the findings that do not hold."""
    return {name for name, finding in findings.items() if finding.get("holds") is False}


def grid_of(block, waveform, scales, amplitudes, **named):
    """Return peak, overturned and impacts of all pairs of a scale and an amplitude."""
    cells = np.repeat(scales, len(amplitudes)), np.tile(amplitudes, len(scales))
    which = np.zeros(cells[0].size, np.int64)
    found = outcomes_of([block], waveform, which, *cells, **named)
    return [values.reshape(len(scales), len(amplitudes)) for values in found]


def pulse_forcing(shape, amplitude, ratio, cycles=1):
    """A pulse with ω/p = `ratio`, as the kernel has it."""
    return forcing_of(pulse_waveform(shape, cycles), ratio, amplitude, 0.0)
