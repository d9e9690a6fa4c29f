"""The plain solver, `src/audit.py`, on the library's structures and ground motions; and samples.

A sample of the outcomes of a rule is computed again: beside a change of outcome, and where the
Taylor solver is sure.
"""

import math
from collections import defaultdict
from collections.abc import Callable, Iterable, Sequence
from functools import partial
from itertools import groupby

import numpy as np
from numpy.typing import ArrayLike

import audit
from replication.step import check
from topheavy import Pulse, Record, Response, RockingBlock
from topheavy import judge as judge_by_taylor
from topheavy.bodies.free_rocking import Outcome
from topheavy.bodies.response import initial_motion, sample_times
from topheavy.bodies.structures import Structure, as_block
from topheavy.ground.excitation import Excitation, checked_excitation
from topheavy.ground.records import both_records, check_no_free_fall, trim_zeros

NEAR = 1e-3  # of a factor on a motion: how far a change of outcome is at most
FREE = 60.0  # over p: in which what loses a tenth of its speed at impacts comes to rest
NUDGE = 1e-9  # of a motion: no measurement resolves it

Cell = tuple[RockingBlock, Record, Record | None, float, bool]
"""A structure, a motion and its vertical component, the factor on both, whether it overturns."""


def ground_of(
    excitation: Excitation | None, vertical: Record | None = None, duration: float | None = None
) -> tuple[audit.Ground, float, float]:
    """Return a ground motion of the audit, up to a duration, with its amplitude (g) and ω."""
    if vertical is not None:
        both_records(excitation, vertical)
        check_no_free_fall(vertical)
    if excitation is None:
        return audit.QUIET, 0.0, 1.0
    checked_excitation(excitation, ends=duration is None)
    amplitude, omega = 1.0, 1.0
    if isinstance(excitation, Pulse):
        amplitude, omega = excitation.amplitude, excitation.angular_frequency
        if excitation.shape == "harmonic":
            cycles = math.ceil(omega * duration / (2.0 * math.pi))
            ground = audit.pulse("one-sine", cycles)
        else:
            ground = audit.pulse(excitation.shape, excitation.cycles)
    else:
        ground = _lines(excitation, vertical)
    if duration is not None and omega * duration < ground.corners[-1]:
        corners = ground.corners[ground.corners < omega * duration]
        ground = ground._replace(corners=np.append(corners, omega * duration))
    return ground, amplitude, omega


def _lines(record: Record, vertical: Record | None) -> audit.Ground:
    """Return records by straight lines, without the zeros at their end and zero right behind it."""
    if vertical is None:
        moving = trim_zeros(record)
        return audit.record(moving.acceleration, moving.time_step)
    times, lines = [], []
    for part in map(trim_zeros, (record, vertical)):
        time = part.time_step * np.arange(part.acceleration.size)
        times.append(np.append(time, np.nextafter(time[-1], math.inf)))
        lines.append(partial(np.interp, xp=times[-1], fp=np.append(part.acceleration, 0.0)))
    last = max(time[-2] for time in times)
    corners = np.union1d(*times)
    at, up = lines
    return audit.Ground(at, corners[corners <= last], weight=lambda x: 1.0 + up(x), straight=True)


def _body(block: RockingBlock) -> audit.Body:
    return audit.Body(block.frequency_parameter, block.slenderness, block.restitution)


def judge(
    structure: Structure, excitation: Excitation, *, vertical: Record | None = None
) -> Outcome:
    """Return how the response to a ground motion ends, as `topheavy.judge`."""
    block = as_block(structure)
    ground, amplitude, omega = ground_of(excitation, vertical)
    return _ends([block], [amplitude], ground, [omega])[0]


def judge_pulses(cells: Sequence[tuple[Structure, Pulse]]) -> list[Outcome]:
    """Return how responses to pulses end; those of one shape and equation are followed together.

    Together they take a fraction of the time that one takes after another.
    """
    ends, alike = {}, defaultdict(list)
    for at, (structure, pulse) in enumerate(cells):
        block = as_block(structure)
        alike[pulse.shape, pulse.cycles, block.linearised].append((at, block, pulse))
    for some in alike.values():
        at, blocks, pulses = zip(*some, strict=True)
        grounds, amplitudes, omegas = zip(*map(ground_of, pulses), strict=True)
        ends |= zip(at, _ends(blocks, amplitudes, grounds[0], omegas), strict=True)
    return [ends[at] for at in range(len(cells))]


def _ends(
    blocks: Sequence[RockingBlock], amplitudes: ArrayLike, ground: audit.Ground, omegas: ArrayLike
) -> list[Outcome]:
    """Return how responses of one equation end; there is one frequency, or one for each."""
    bodies, linear = [*map(_body, blocks)], blocks[0].linearised
    end = audit.follow(bodies, np.array(amplitudes), ground, np.array(omegas), linear)
    columns = end.overturned.tolist(), end.peak.tolist(), end.hits.tolist()
    return [Outcome(*one) for one in zip(*columns, strict=True)]


def simulate(
    structure: Structure,
    excitation: Excitation | None = None,
    *,
    rotation: float = 0.0,
    velocity: float = 0.0,
    duration: float | None = None,
    samples: int | ArrayLike = 1000,
    vertical: Record | None = None,
    leap: Callable | None = None,
) -> Response:
    """Return the response, as `topheavy.simulate`; `leap` integrates a step in another way.

    A number of samples lies between 0 and the duration, or `FREE` of free rocking after the ground
    motion. The impacts are those until the last sample, or until the outcome is known.
    """
    block, times = as_block(structure), sample_times(samples)
    theta, rate = initial_motion(block, rotation, velocity)
    ground, amplitude, omega = ground_of(excitation, vertical, duration)
    if isinstance(times, int):
        free = FREE / block.frequency_parameter
        times = np.linspace(0.0, duration or ground.corners[-1] / omega + free, times)
    motion = audit.follow(
        [_body(block)],
        amplitude,
        ground,
        omega,
        block.linearised,
        (theta, rate / block.frequency_parameter),
        omega * times,
        leap,
    )
    outcome = "rocking" if motion.velocity[0, -1] or motion.rotation[0, -1] else "rests"
    if not motion.peak[0]:
        outcome = "no uplift"
    return Response(
        time=times,
        rotation=motion.rotation[0],
        velocity=motion.velocity[0] * block.frequency_parameter,
        impact_times=np.array(motion.impacts[0]) / omega,
        outcome="overturned" if motion.overturned[0] else outcome,
        number_of_impacts=int(motion.hits[0]),
        peak_rotation=float(motion.peak[0]),
        slenderness=block.slenderness,
    )


def overturns(block: RockingBlock, record: Record, up: Record | None, factor: float) -> bool:
    """Return whether a motion times a factor overturns a structure, by the Taylor solver."""
    return judge_by_taylor(
        block, record.scaled(factor), vertical=up and up.scaled(factor)
    ).overturned


def beside_a_boundary(overturns: Callable[[float], bool], factor: float) -> float:
    """Return a factor with the outcome of this one, within NEAR of one with the other outcome."""
    outcome, other = overturns(factor), factor
    while overturns(other) == outcome:
        factor, other = other, other * (0.9 if outcome else 1.1)
    while abs(other / factor - 1.0) > NEAR:
        middle = math.sqrt(factor * other)
        if overturns(middle) == outcome:
            factor = middle
        else:
            other = middle
    return factor


def is_known(block: RockingBlock, record: Record, up: Record | None, factor: float) -> bool:
    """Return whether the Taylor solver has the same outcome under a motion nudged up and down."""
    near = [overturns(block, record, up, factor * (1.0 + by)) for by in (-NUDGE, 0.0, NUDGE)]
    return all(near) or not any(near)


def motion_of(cell: Cell) -> tuple[Record, Record | None, float]:
    """Return the motion of a cell, by which structures may be followed together.

    Factors on a vertical motion differ from those on amplitudes: there the factor is of the motion.
    """
    _, record, up, factor, _ = cell
    return record, up, factor if up else 1.0


def check_sample(cells: Iterable[Cell]) -> None:
    """Stop the step unless the plain solver has the same outcomes.

    Those that a nudge of the motion changes are not compared. The plain solver follows successive
    cells together that share a motion.
    """
    compared = differ = 0
    known = (cell for cell in cells if is_known(*cell[:4]))
    for (record, up, scale), some in groupby(known, motion_of):
        blocks, *_, factors, fell = zip(*some, strict=True)
        ground, *_ = ground_of(record.scaled(scale), up and up.scaled(scale))
        ends = _ends(blocks, np.array(factors) / scale, ground, 1.0)
        compared += len(fell)
        differ += sum(one.overturned != other for one, other in zip(ends, fell, strict=True))
    text = f"the plain solver has {differ} of {compared} outcomes otherwise"
    print(text, flush=True)
    check(compared > 0 and differ == 0, text)
