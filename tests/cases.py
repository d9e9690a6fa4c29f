"""What many tests are about: structures, places, tables, and which findings break.

Each function imports what it needs: a test of one module loads no other.
"""

from functools import cache
from io import StringIO
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import yaml

import topheavy as th

ROOT = Path(__file__).resolve().parents[1]
RECORDS = ROOT / "data" / "records"
CONFIG = yaml.load((ROOT / "config" / "config.yaml").read_bytes(), yaml.CSafeLoader)

COLUMN = th.Column(0.5, 3.0)
FRAME = th.RockingFrame(COLUMN, 1.0)
BLOCK = th.RockingBlock(2.0, 0.25, 0.9)
SIZES = {"half_width": 0.5, "half_height": 3.0}
BOTH = pytest.mark.parametrize("block", [BLOCK, BLOCK.linear()], ids=["exact", "linear"])
SIDES = pytest.mark.parametrize("side", [1.0, -1.0])
TIME = 0.01 * np.arange(400)
MOTION = 0.3 * np.sin(2.5 * np.pi * TIME) * np.exp(-(((TIME - 2.0) / 0.8) ** 2))
"""A motion that rises and dies, in g."""


@cache
def published():
    """Return the findings of the published tables by rule, once for all tests of a process."""
    from documents import check

    return check.findings(check.read("rules"))


def fate(end):
    """Whether an outcome or a history overturns, and after how many impacts."""
    return bool(end.overturned), int(end.number_of_impacts)


def as_written(tables):
    """Return tables as they are read from the files of a rule."""
    from replication.step import DIGITS

    texts = {n: pd.DataFrame(t).to_csv(index=False, float_format=DIGITS) for n, t in tables.items()}
    return {name: pd.read_csv(StringIO(text)) for name, text in texts.items()}


def broken(findings):
    """Return the names of the findings that do not hold."""
    return {name for name, finding in findings.items() if finding.get("holds") is False}


def grid_of(block, waveform, scales, amplitudes, **named):
    """Return peak, overturned and impacts of all pairs of a scale and an amplitude."""
    cells = np.repeat(scales, len(amplitudes)), np.tile(amplitudes, len(scales))
    which = np.zeros(cells[0].size, np.int64)
    from topheavy.kernel.grid import outcomes_of

    results = outcomes_of([block], waveform, which, *cells, **named)
    return [values.reshape(len(scales), len(amplitudes)) for values in results]


def pulse_forcing(shape, amplitude, ratio, cycles=1):
    """A pulse with ω/p = `ratio`, as the kernel has it."""
    from topheavy.kernel.forcing import forcing_of, pulse_waveform

    return forcing_of(pulse_waveform(shape, cycles), ratio, amplitude, 0.0)
