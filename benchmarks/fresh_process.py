"""Measure time and peak memory of a fresh process that imports, or computes a map, warm and cold.

Python may write its byte code, as by default. "Cold" means without compiled code of this package;
the libraries keep theirs. The process itself reads its memory (VmHWM of Linux), since the value
that the parent receives includes the parent's own memory before it started the child.
"""

import os
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

import topheavy

MAP = """
import sys
import numpy as np
from topheavy import Column, RockingFrame, overturning_map
column = Column(0.5, 2.0)
frequencies = column.frequency_parameter * np.linspace(0.5, 10.0, 300)
amplitudes = column.uplift_acceleration * np.linspace(1.0, 10.0, int(sys.argv[1]) // 300)
overturning_map(RockingFrame(column, 1.0), "one-sine", frequencies, amplitudes)
print(next(line.split()[1] for line in open("/proc/self/status") if line.startswith("VmHWM")))
"""
CELLS = 120_000
MANY = 26 * CELLS
BYTES_A_CELL = 8 + 1 + 8  # peak, overturned, impacts


class Run(NamedTuple):
    """Wall and processor time in s, peak memory in MB."""

    wall: float
    processor: float
    memory: float


def imported(times: int = 15) -> float:
    """Return the processor time (s) of importing the package beyond that of importing NumPy."""
    codes = ("import numpy", "import numpy, topheavy")
    pairs = [[child(code)[1] for code in codes] for _ in range(times)]
    numpy, both = (min(column) for column in zip(*pairs, strict=True))
    return both - numpy


def run(cells: int, path: Path | None = None) -> Run:
    """Compute a map in a process of its own, with the package found under `path` if given."""
    own = {"PYTHONPATH": str(path), "NUMBA_CACHE_DIR": str(path)} if path else {}
    begin = time.perf_counter()
    memory, processor = child(MAP, str(cells), environment=os.environ | own)
    return Run(time.perf_counter() - begin, processor, int(memory) / 1024.0)


def child(
    code: str, *arguments: str, environment: Mapping[str, str] = os.environ
) -> tuple[str, float]:
    """Run code in a Python of its own; return what it prints and its processor time in s."""
    environment = {k: v for k, v in environment.items() if k != "PYTHONDONTWRITEBYTECODE"}
    command = [sys.executable, "-c", code, *arguments]
    process = subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, text=True)
    printed = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    if status:
        raise RuntimeError(f"{command[2:]} ended with status {status}")
    return printed, usage.ru_utime + usage.ru_stime


def least(runs: list[Run]) -> Run:
    """Return the least of each, the measure that other work on the machine disturbs least."""
    return Run(*(min(column) for column in zip(*runs, strict=True)))


def warm(times: int = 7) -> Run:
    run(CELLS)
    return least([run(CELLS) for _ in range(times)])


def cold(times: int = 3) -> Run:
    """Return the least of runs from copies of the package without any cache."""
    runs = []
    for _ in range(times):
        with tempfile.TemporaryDirectory() as folder:
            source = Path(topheavy.__file__).parent
            shutil.copytree(
                source, Path(folder, "topheavy"), ignore=shutil.ignore_patterns("__pycache__")
            )
            runs.append(run(CELLS, Path(folder)))
    return least(runs)


def growth(times: int = 3) -> float:
    """Return how much more memory twice the cells take, over the size of their results.

    Both maps are so large that the peak is theirs, and not that of the imports.
    """
    few, many = (least([run(cells) for _ in range(times)]) for cells in (MANY // 2, MANY))
    return (many.memory - few.memory) * 1024.0**2 / (BYTES_A_CELL * (MANY - MANY // 2))
