"""Compare outcomes with heyoka's: python benchmarks/verify_grid.py [cells of a set, or 40000]

Every set of pulses has its own slenderness and mass ratio; a third of its cells lie at A/tan α from
1 to 1.2, the others from 1 to 10, all at ω/p from 0.5 to 10. Records follow, with vertical motion
and without. A case is on a boundary, where the two solvers may differ, if a relative change of
1e-10 in the amplitude changes heyoka's outcome. It needs the dependency group `bench`.
"""

import math
import os
import sys
import warnings
from concurrent.futures import ProcessPoolExecutor
from functools import cache
from itertools import pairwise
from multiprocessing import get_context

import numpy as np
import pandas as pd
from oracle import PulseOracle, RecordOracle

from topheavy import Column, Record, RockingBlock, RockingFrame, overturned_by
from topheavy.kernel.forcing import pulse_waveform
from topheavy.kernel.grid import outcomes_of
from topheavy.kernel.taylor import oscillator

SLIGHT = 1e-10
PIECE = 2000  # cells of a job
MOTIONS = 0.002  # records of a set, each at 25 factors, over the cells of a set

#: Shape, linearised, α in degrees, γ, and the share of the cells that the set gets.
SINE = [(3, 0), (5, 1), (8, 0.5), (8, 4), (11, math.inf), (20, 0), (20, 2), (27, 0.5), (35, 0)]
SINE += [(35, 1)]
OTHERS = [
    ("one-cosine", False),
    ("half-sine", False),
    ("constant", False),
    ("ricker-symmetric", False),
    ("ricker-antisymmetric", False),
    ("one-sine", True),
    ("one-cosine", True),
    ("ricker-symmetric", True),
]
SETS = [("one-sine", False, *pair, 1.0) for pair in SINE]
SETS += [(*kind, *pair, 0.1) for kind in OTHERS for pair in [(5, 1), (20, 0)]]
RECORDS = [(linear, vertical) for linear in (False, True) for vertical in (False, True)]


def block_of(slenderness_deg: float, mass_ratio: float, linearised: bool) -> RockingBlock:
    """Return the block with p = 1; only α and √r matter."""
    alpha = math.radians(slenderness_deg)
    frame = RockingFrame(Column(math.sin(alpha), math.cos(alpha)), mass_ratio)
    return RockingBlock(1.0, alpha, frame.restitution, linearised)


def cells_of(number: int, count: int, level: float) -> tuple[np.ndarray, np.ndarray]:
    """Return amplitudes (g) and frequencies ω/p of a set."""
    chance = np.random.default_rng(100 + number)
    frequencies = chance.uniform(0.5, 10.0, count)
    near, far = chance.uniform(1.0, 1.2, count), chance.uniform(1.0, 10.0, count)
    return np.where(chance.random(count) < 1 / 3, near, far) * level, frequencies


def row(name: str, found, ours, nudged, slenderness: float) -> dict:
    """Return how ours compares with heyoka's outcome, and with those of nudged amplitudes."""
    overturned, peak, impacts = ours
    differs = found.overturned != overturned
    on_boundary = differs and len({one.overturned for one in nudged()} | {found.overturned}) > 1
    return {
        "set": name,
        "overturned": found.overturned,
        "wrong": differs and not on_boundary,
        "on_boundary": on_boundary,
        "other_count": not differs and impacts is not None and found.number_of_impacts != impacts,
        "error": math.nan if differs else abs(found.peak_rotation - peak) / slenderness,
    }


def pulses(job: tuple[int, int, int]) -> list[dict]:
    """Compare the cells of a set from `start` on."""
    number, count, start = job
    shape, linearised, *pair, _ = SETS[number]
    block = block_of(*pair, linearised)
    alpha, restitution = block.slenderness, block.restitution
    amplitudes, frequencies = cells_of(number, count, alpha if linearised else math.tan(alpha))
    cells = np.array([amplitudes, frequencies])[:, start : start + PIECE]
    which = np.zeros(cells.shape[1], np.int64)
    ours = outcomes_of([oscillator(block)], pulse_waveform(shape), which, *cells[1::-1], threads=1)
    peaks, flags, counts = ours
    name = f"{shape}{', linearised' if linearised else ''}, α = {pair[0]}°, γ = {pair[1]:g}"
    oracle = PulseOracle(shape, linearised)

    def truth(amplitude, frequency):
        return oracle(alpha, restitution, amplitude, frequency)

    return [
        row(name, truth(a, w), ours, lambda a=a, w=w: around(truth, a, w), alpha)
        for a, w, ours in zip(*cells, zip(flags, peaks, counts), strict=True)  # noqa: B905
    ]


def around(truth, amplitude, *rest):
    return [truth(amplitude * (1.0 + sign * SLIGHT), *rest) for sign in (-1.0, 1.0)]


def waves(chance: np.random.Generator, samples: int, step: float) -> np.ndarray:
    """Return a motion of a few sines whose largest sample is 1; it ends by a jump."""
    time = step * np.arange(samples)
    each = ((f, chance.normal(), chance.uniform(0, 6)) for f in (2.0, 4.1, 7.3, 13.0))
    found = sum(size * np.sin(f * time + phase) for f, size, phase in each)
    found = found * (0.1 + np.sin(math.pi * time / time[-1]) ** 2)
    return found / np.abs(found).max()


@cache
def record_oracle(linearised: bool, vertical: bool) -> RecordOracle:
    return RecordOracle(linearised, vertical)


def records(job: tuple[int, int]) -> list[dict]:
    """Compare the outcomes of a structure on one record at many factors."""
    number, seed = job
    linearised, has_vertical = RECORDS[number]
    chance, step = np.random.default_rng((500 + number, seed)), 0.02
    column = [Column(0.5, 3.0), Column(0.4, 2.2), Column(0.2, 2.0)][seed % 3]
    structure = [column, RockingFrame(column, 1.0), RockingFrame(column, math.inf)][seed // 3 % 3]
    block = structure.block().linear() if linearised else structure.block()
    samples, up = waves(chance, 400, step), 0.2 * waves(chance, 400, step)
    factors = block.uplift_acceleration * chance.uniform(0.9, 4.0, 25)
    vertical = Record(step, up) if has_vertical else None
    flags = overturned_by(
        block, Record(step, samples), factors, vertical=vertical, scale_vertical=False
    )
    oracle = record_oracle(linearised, has_vertical)
    lengths = [block.frequency_parameter * step] * (samples.size - 1)
    weights = list(pairwise(1.0 + up * has_vertical))

    def truth(factor):
        pieces = zip(lengths, pairwise(factor * samples), weights, strict=True)
        return oracle.follow(block.slenderness, block.restitution, pieces)

    name = f"records{', linearised' * linearised}{', with vertical motion' * has_vertical}"
    return [
        row(name, truth(f), (flag, math.nan, None), lambda f=f: around(truth, f), 1.0)
        for f, flag in zip(factors, flags, strict=True)
    ]


def compared(job: tuple[int, ...]) -> list[dict]:
    warnings.simplefilter("ignore")
    return pulses(job) if len(job) == 3 else records(job)


def main(count: int) -> int:
    jobs = [
        (number, cells, start)
        for number, (*_, share) in enumerate(SETS)
        for cells in [math.ceil(count * share)]
        for start in range(0, cells, PIECE)
    ]
    jobs += [(n, seed) for n in range(len(RECORDS)) for seed in range(math.ceil(count * MOTIONS))]
    with ProcessPoolExecutor(len(os.sched_getaffinity(0)), mp_context=get_context("spawn")) as pool:
        cells = pd.DataFrame([row for rows in pool.map(compared, jobs) for row in rows])
    sets = cells.groupby("set", sort=False)
    table = sets[["overturned", "wrong", "on_boundary", "other_count"]].sum()
    table.insert(0, "cells", sets.size())
    table["error_q99"], table["error_max"] = sets.error.quantile(0.99), sets.error.max()
    print(table.to_string())
    print(f"{table.wrong.sum()} wrong outcomes in {len(cells)} cells")
    return int(table.wrong.any())


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]) if len(sys.argv) > 1 else 40_000))
