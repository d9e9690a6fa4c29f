"""Proven outcomes of random cells against the Taylor solver, and a sample against SciPy.

    uv run python benchmarks/proven_cells.py 20000

Structures, pulses and equations are drawn at random, with amplitudes uniform from 1 to 16 times
uplift. Printed: contradictions, undecided cells by cause, how many of these are far from any
boundary (the solver gives one outcome at 1 ± 1e-6 times the amplitude), refusals and times.
"""

import json
import math
import random
import statistics
import sys
import time
from collections import Counter

from topheavy import Column, FixedMassColumn, MonolithicPortal, Pulse, RockingFrame, judge
from topheavy.ground.shapes import ENDING
from topheavy.proven import certified
from topheavy.proven.checking import Refused, check
from topheavy.second import reference

SEED = 28
BY_SCIPY = 40  # one cell of so many
CHECKED = 10


def drawn():
    """Return a structure, whether it is linearised, and a pulse."""
    alpha, size = random.uniform(3.0, 40.0), random.choice((0.5, 3.0, 10.0))
    b, h = (round(size * f(math.radians(alpha)), 4) for f in (math.sin, math.cos))
    column, gamma = Column(b, h), random.choice((0.0, 0.25, 1.0, 4.0, math.inf))
    structure = random.choice(
        (
            RockingFrame(column, gamma),
            RockingFrame(column, gamma).block,
            FixedMassColumn(column, gamma, b, b),
            MonolithicPortal(column, gamma, 4.0 * b, b, b / 2.0),
        )
    )
    structure = structure() if callable(structure) else structure
    block = structure.block()
    linearised = random.random() < 0.3
    block = block.linear() if linearised else block
    amplitude = random.uniform(1.0, 16.0) * block.uplift_acceleration * random.choice((-1, 1))
    omega = random.uniform(0.5, 10.0) * column.frequency_parameter
    return structure, block, Pulse(random.choice(ENDING), amplitude, omega)


def main(cells):
    random.seed(SEED)
    counts, causes, times, at = Counter(), Counter(), [], 0
    while at < cells:
        try:
            structure, block, pulse = drawn()
        except ValueError:  # √r is negative
            continue
        at += 1
        begin = time.process_time()
        found, certificate = certified(structure, pulse, linearised=block.linearised)
        times.append(time.process_time() - begin)
        falls = judge(block, pulse).overturned
        if found.outcome == "undecided":
            causes[found.cause] += 1
            near = {judge(block, pulse.scaled(1.0 + side * 1e-6)).overturned for side in (-1, 1)}
            counts["undecided far from boundaries"] += near == {falls}
            continue
        counts[found.outcome] += 1
        counts["contradict the Taylor solver"] += (found.outcome == "overturns") != falls
        if at % BY_SCIPY == 0:
            counts["by SciPy"] += 1
            other = reference.judge(block, pulse).overturned
            counts["contradict SciPy"] += (found.outcome == "overturns") != other
        if at % CHECKED == 0:
            counts["checked"] += 1
            try:
                check(certificate)
            except Refused as reason:
                counts[f"refused: {reason}"] += 1
    print(
        json.dumps(
            counts
            | {"undecided": causes, "median ms": 1e3 * statistics.median(times)}
            | {"slowest ms": 1e3 * max(times)},
            indent=1,
        )
    )


if __name__ == "__main__":
    main(int(sys.argv[1]))
