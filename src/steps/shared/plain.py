"""The plain solver, `src/audit.py`, on the library's structures and ground motions."""

import math
from collections import defaultdict
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

import audit
from topheavy import Pulse, Record, Response, RockingBlock
from topheavy.bodies.free_rocking import Outcome
from topheavy.bodies.response import initial_motion, sample_times
from topheavy.bodies.structures import Structure, as_block
from topheavy.ground.excitation import Excitation, checked_excitation
from topheavy.ground.records import both_records, check_no_free_fall, trim_zeros

FREE = 60.0  # duration of free rocking in which a block with √r = 0.9 comes to rest, times 1/p


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
    push, lift = lines
    return audit.Ground(
        push, corners[corners <= last], weight=lambda x: 1.0 + lift(x), straight=True
    )


def judge(
    structure: Structure, excitation: Excitation, *, vertical: Record | None = None
) -> Outcome:
    """Return how the response to a ground motion ends, as `topheavy.judge`."""
    ground, amplitude, omega = ground_of(excitation, vertical)
    return judge_together([as_block(structure)], amplitude, ground, omega)[0]


def judge_pulses(cells: Sequence[tuple[Structure, Pulse]]) -> list[Outcome]:
    """Return how responses to pulses end.

    Responses to pulses of one shape by one equation are followed together, which is faster.
    """
    ends, groups = {}, defaultdict(list)
    for number, (structure, pulse) in enumerate(cells):
        block = as_block(structure)
        groups[pulse.shape, pulse.cycles, block.linearised].append((number, block, pulse))
    for group in groups.values():
        numbers, blocks, pulses = zip(*group, strict=True)
        grounds, amplitudes, omegas = zip(*map(ground_of, pulses), strict=True)
        ends |= zip(numbers, judge_together(blocks, amplitudes, grounds[0], omegas), strict=True)
    return [ends[number] for number in range(len(cells))]


def judge_together(
    blocks: Sequence[RockingBlock], amplitudes: ArrayLike, ground: audit.Ground, omegas: ArrayLike
) -> list[Outcome]:
    """Return how responses of one equation end; there is one frequency, or one for each."""
    motion = _followed(blocks, amplitudes, ground, omegas)
    columns = motion.overturned.tolist(), motion.peak.tolist(), motion.hits.tolist()
    return [Outcome(*row) for row in zip(*columns, strict=True)]


def _followed(
    blocks: Sequence[RockingBlock],
    amplitudes: ArrayLike,
    ground: audit.Ground,
    omegas: ArrayLike,
    *options: Any,
) -> audit.Motion:
    """Return the motion of blocks of one equation by the audit, with its other options."""
    bodies = [audit.Body(b.frequency_parameter, b.slenderness, b.restitution) for b in blocks]
    equation = blocks[0].linearised
    return audit.follow(bodies, np.array(amplitudes), ground, np.array(omegas), equation, *options)


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
    p = block.frequency_parameter
    theta, rate = initial_motion(block, rotation, velocity)
    ground, amplitude, omega = ground_of(excitation, vertical, duration)
    if isinstance(times, int):
        times = np.linspace(0.0, duration or ground.corners[-1] / omega + FREE / p, times)
    motion = _followed([block], amplitude, ground, omega, (theta, rate / p), omega * times, leap)
    outcome = "rocking" if motion.velocity[0, -1] or motion.rotation[0, -1] else "rests"
    if not motion.peak[0]:
        outcome = "no uplift"
    return Response(
        time=times,
        rotation=motion.rotation[0],
        velocity=motion.velocity[0] * p,
        impact_times=np.array(motion.impacts[0]) / omega,
        outcome="overturned" if motion.overturned[0] else outcome,
        number_of_impacts=int(motion.hits[0]),
        peak_rotation=float(motion.peak[0]),
        slenderness=block.slenderness,
    )
