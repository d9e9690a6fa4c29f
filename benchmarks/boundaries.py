"""Check at overturning boundaries that every history ends and that all functions agree.

For each block, equation and pulse, and for each record, a scan finds changes of the outcome.
Bisection with `judge` refines them to two neighbouring floats. At and near these floats we call
`simulate`, `judge` and the map. Each call has to end, and all have to agree on an outcome that is
decided. Under a pulse they also have to agree on the number of impacts. (Under a record there are
rotations near 1e-6 α, the smallest that count; their number changes at other boundaries.)

    python benchmarks/boundaries.py [number of blocks, 100 unless given]
"""

import math
import sys
import time
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from topheavy import (
    Pulse,
    Record,
    Response,
    RockingBlock,
    judge,
    overturned_by,
    overturning_map,
    read_record,
    simulate,
)
from topheavy.ground.shapes import FINITE_SHAPES

RECORDS = Path(__file__).parent.parent / "data" / "records"
SHAPES = sorted(FINITE_SHAPES)
#: Relative distance from a pulse's boundary beyond which all calls have to agree.
PULSE_MARGIN = 1e-12
#: Such calls are made beside a boundary, at these relative distances.
DISTANCES = (1.001 * PULSE_MARGIN, 1e-10, 1e-8, 1e-6)
#: A record's boundary moves when the tolerance becomes this one. The outcome at a factor is decided
#: if this tolerance, a change of the factor by twice that move or by 1e-9, and both leave it.
TIGHT, SLIGHT = 1e-14, 1e-9
#: Points of a scan, in units of the level, and the pulse's boundaries that are taken from it.
SCAN, PULSE_BOUNDARIES = np.geomspace(1.01, 20.0, 60), 2
#: Of the records, so many for each block in turn, with one boundary each.
RECORDS_OF_A_BLOCK = 2


def blocks(number: int) -> list[RockingBlock]:
    """Return blocks from 3° to 40°, of any size and restitution; the same ones each time."""
    random = np.random.default_rng(10)
    slender = np.radians(np.linspace(3.0, 40.0, number))
    return [
        RockingBlock(
            float(random.uniform(1.0, 6.0)), float(alpha), float(random.uniform(0.7, 0.99))
        )
        for alpha in slender
    ]


def boundaries(
    block: RockingBlock, excitation: Pulse | Record
) -> Iterator[tuple[float, float, float]]:
    """Yield neighbouring factors, on an excitation of unit peak, of different outcomes.

    With them comes the relative change of a factor that decided outcomes have to withstand.
    """
    scan = SCAN * block.uplift_acceleration
    outcomes = overturned_by(block, excitation, scan)
    most = PULSE_BOUNDARIES if isinstance(excitation, Pulse) else 1
    for place in np.flatnonzero(outcomes[1:] != outcomes[:-1])[:most]:
        between = float(scan[place]), float(scan[place + 1])
        low, high = _bisect(block, excitation, *between)
        margin = PULSE_MARGIN
        if isinstance(excitation, Record):
            exact, _ = _bisect(block, excitation, *between, tolerance=TIGHT)
            margin = max(SLIGHT, 2.0 * abs(low - exact) / low)
        yield low, high, margin


def _bisect(
    block: RockingBlock, excitation: Pulse | Record, low: float, high: float, **options: float
) -> tuple[float, float]:
    """Return neighbouring factors between two, of different outcomes."""
    outcome = judge(block, excitation.scaled(low), **options).overturned
    while low < (middle := 0.5 * (low + high)) < high:
        if judge(block, excitation.scaled(middle), **options).overturned == outcome:
            low = middle
        else:
            high = middle
    return low, high


def _is_decided(block: RockingBlock, record: Record, margin: float) -> bool:
    """Return whether a tolerance of `TIGHT`, a relative change and both leave the outcome."""
    outcomes = {
        judge(block, record.scaled(1.0 + change), **tolerance).overturned
        for change in (0.0, -margin, margin)
        for tolerance in ({}, {"tolerance": TIGHT})
    }
    return len(outcomes) == 1


def compare(
    block: RockingBlock, excitation: Pulse | Record, low: float, high: float, margin: float
) -> tuple[int, list[str]]:
    """Return how many calls beside a boundary had to agree, and those that do not.

    At the boundary itself, a history has to be of one piece: see `_contradiction`.
    """
    found, compared = [], 0
    factors, off = [low, high], [0.0, 0.0]
    for distance in DISTANCES:
        factors += [low * (1.0 - distance), high * (1.0 + distance)]
        off += [distance, distance]
    if isinstance(excitation, Pulse):
        cells = overturning_map(block, excitation.shape, [excitation.angular_frequency], factors)
    for number, factor in enumerate(factors):
        motion = excitation.scaled(factor)
        end, whole = judge(block, motion), simulate(block, motion, samples=50)
        if isinstance(motion, Pulse):
            has_to_agree = off[number] > margin
            cell = cells.isel(angular_frequency=0, amplitude=number)
            stories = {
                (end.overturned, end.number_of_impacts),
                (whole.overturned, whole.number_of_impacts),
                (bool(cell.overturned), int(cell.number_of_impacts)),
            }
        else:
            has_to_agree = off[number] > margin and _is_decided(block, motion, margin)
            stories = {(end.overturned, 0), (whole.overturned, 0)}
        compared += has_to_agree
        case = f"{block}, {_named(motion)}, factor {factor!r} (no. {number})"
        if has_to_agree and len(stories) > 1:
            found.append(f"{case}: {stories}")
        if (wrong := _contradiction(block, whole)) is not None:
            found.append(f"{case}: {wrong}")
    return compared, found


def _contradiction(block: RockingBlock, whole: Response) -> str | None:
    """Return the place where a history contradicts its outcome, if there is one."""
    last = np.abs(whole.rotation[np.isfinite(whole.rotation)])[-1]
    if whole.overturned != math.isnan(whole.peak_rotation):
        return f"{whole.outcome} with a peak of {whole.peak_rotation}"
    if whole.overturned and last < 0.5 * block.slenderness:
        return f"overturned, and ends at {last / block.slenderness:.3g} α"
    if not whole.overturned and last > 1.01 * max(block.slenderness, whole.peak_rotation):
        return f"{whole.outcome}, and ends at {last / block.slenderness:.3g} α"
    return None


def _named(motion: Pulse | Record) -> str:
    return motion.name if isinstance(motion, Record) else repr(motion)


def excitations(
    block: RockingBlock, turn: int, random: np.random.Generator
) -> Iterator[Pulse | Record]:
    """Yield every pulse, at a frequency of this block's, and the records that it is the turn of."""
    for shape in SHAPES:
        yield Pulse(shape, 1.0, float(block.frequency_parameter * random.uniform(0.8, 8.0)))
    paths = sorted(RECORDS.glob("*.AT2"))
    for number in range(RECORDS_OF_A_BLOCK * turn, RECORDS_OF_A_BLOCK * (turn + 1)):
        record = read_record(paths[number % len(paths)])
        yield record.scaled(1.0 / float(np.abs(record.acceleration).max()))


@dataclass
class Survey:
    """Numbers of boundaries, of calls that had to agree, and what disagrees."""

    pulses: int = 0
    records: int = 0
    decided: int = 0
    wrong: list[str] = field(default_factory=list)


def survey(number: int) -> Survey:
    """Return what a number of blocks give."""
    random, result = np.random.default_rng(11), Survey()
    for turn, exact in enumerate(blocks(number)):
        for excitation in excitations(exact, turn, random):
            for block in (exact, exact.linear()):
                for low, high, margin in boundaries(block, excitation):
                    result.pulses += isinstance(excitation, Pulse)
                    result.records += isinstance(excitation, Record)
                    compared, wrong = compare(block, excitation, low, high, margin)
                    result.decided += compared
                    result.wrong += wrong
    return result


if __name__ == "__main__":
    begin = time.perf_counter()
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 100
    result = survey(count)
    print("".join(f"{line}\n" for line in result.wrong), end="")
    print(
        f"{count} blocks: {result.pulses} boundaries of pulses, {result.records} of records; "
        f"{result.decided} cases had to agree, {len(result.wrong)} do not; "
        f"{time.perf_counter() - begin:.0f} s"
    )
    sys.exit(bool(result.wrong))
