"""Rocking histories by the compiled kernel: `simulate`, and `judge` for the verdict alone."""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from topheavy import checks
from topheavy.excitation import Excitation
from topheavy.free_rocking import Ending
from topheavy.kernel.forcing import (
    NO_RECORD,
    NONE,
    RECORD,
    SHAPES,
    Forcing,
    prepare_record,
    pulse_forcing,
    record_forcing,
)
from topheavy.kernel.grid import record_order
from topheavy.kernel.outcome import MAX_STEPS, PULSE_ORDER, TOLERANCE, outcome, working_array
from topheavy.kernel.taylor import oscillator
from topheavy.kernel.trace import NO_UPLIFT, OVERTURNED, RESTS, ROCKING, trace
from topheavy.pulses import Pulse
from topheavy.records import Record
from topheavy.response import Outcome, Response, initial_motion, sample_times
from topheavy.structures import RockingBlock, Structure

Times = NDArray[np.float64]

MOST_IMPACTS = 100_000
"""Room for the times of impacts of one history."""

_OUTCOMES: dict[int, Outcome] = {
    NO_UPLIFT: "no uplift",
    RESTS: "rests",
    ROCKING: "rocking",
    OVERTURNED: "overturned",
}


def simulate(
    structure: Structure,
    excitation: Excitation | None = None,
    *,
    rotation: float = 0.0,
    velocity: float = 0.0,
    duration: float | None = None,
    samples: int | ArrayLike = 1000,
    tolerance: float = TOLERANCE,
) -> Response:
    """Return the rocking response to a ground motion, or free rocking without one.

    Parameters
    ----------
    structure : RockingBlock, Column or RockingFrame
    excitation : Pulse or Record, optional
    rotation, velocity : float
        θ (rad) and θ̇ (rad/s) at t = 0, signed.
    duration : float, optional
        Where the history ends, s, and with it the forcing. Without it the history ends at the
        first of: overturned (at |θ| = π/2), at rest, 1000 impacts after the forcing.
    samples : int or array_like
        A number of uniform times from 0 to the end, or increasing times in s, which may reach
        beyond the end.
    tolerance : float
        Bound on the last two terms of the Taylor series of φ̇/p in a step, relative to α.

    Returns
    -------
    Response
        Its outcome and peak rotation are those of the forcing, up to the duration, and of all the
        free rocking after it, even of what lies beyond the duration.

    Raises
    ------
    ValueError
        For values that are not finite, |θ| ≥ π/2 in the exact equation, a harmonic without a
        duration, or a structure whose √r is negative.

    Notes
    -----
    Taylor steps whose turning points and impacts are proven by the signs of Bernstein coefficients
    (`topheavy.kernel`). `topheavy.reference.simulate` is the second, independent route.
    """
    block = structure.block()
    times = sample_times(samples)
    theta, theta_rate = initial_motion(block, rotation, velocity)
    shape, scale, amplitude, record = as_forcing(block, excitation)
    p = block.frequency_parameter
    until = math.inf if duration is None else p * checks.positive("duration", duration, "s")
    forcing, order = _forcing(shape, scale, amplitude, record, tolerance)
    forcing = forcing._replace(end=min(forcing.end, until))
    if forcing.end == math.inf:
        raise ValueError("duration is not given; expected one, as this excitation goes on forever")

    def follow(until: float, at: Times) -> tuple[NDArray[np.float64], Times, tuple[float, ...]]:
        motion, impacts = np.full((2, at.size), math.nan), np.empty(MOST_IMPACTS)
        found = trace(
            working_array(),
            order,
            tolerance,
            oscillator(block),
            forcing,
            record,
            theta,
            theta_rate / p,
            until,
            p * at,
            motion,
            impacts,
        )
        return motion, impacts, found

    if isinstance(times, int):
        end = duration if duration is not None else follow(until, np.empty(0))[2][0] / p
        times = np.linspace(0.0, end, times)
    elif duration is None:
        until = max(p * float(times[-1]), forcing.end)
    motion, impacts, (_, result, peak, counted, landed) = follow(until, times)
    if landed > MOST_IMPACTS:
        raise ArithmeticError(f"{block}: {landed} impacts; room is for {MOST_IMPACTS}")
    outcome = _OUTCOMES[int(result)]
    return Response(
        time=times,
        rotation=motion[0],
        velocity=p * motion[1],
        impacts=impacts[: int(landed)] / p,
        outcome=outcome,
        number_of_impacts=int(counted),
        peak_rotation=math.nan if outcome == "overturned" else peak,
    )


def judge(structure: Structure, excitation: Excitation, *, tolerance: float = TOLERANCE) -> Ending:
    """Return only how the response to a ground motion of finite duration ends.

    The same as `simulate`, in microseconds: the free rocking is not integrated. The peak is max|θ|
    over the whole motion (NaN if overturned), the impacts are counted as in `Response`.
    """
    if not isinstance(excitation, (Pulse, Record)):
        raise ValueError(f"excitation is {excitation!r}; expected a Pulse or a Record")
    if excitation.duration == math.inf:
        raise ValueError("the excitation goes on forever; expected one that ends")
    block = structure.block()
    shape, scale, amplitude, record = as_forcing(block, excitation)
    forcing, order = _forcing(shape, scale, amplitude, record, tolerance)
    found = outcome(working_array(), order, tolerance, oscillator(block), forcing, record)
    if not found.resolved:
        raise ArithmeticError(
            f"{block} bounces too often to be followed to the end of the forcing "
            f"({excitation if isinstance(excitation, Pulse) else excitation.name!r}), in more than "
            f"{MAX_STEPS} steps; a smaller restitution lets it come to rest"
        )
    return Ending(bool(found.overturned), float(found.peak), int(found.impacts))


def _forcing(
    shape: int, scale: float, amplitude: float, record: NDArray[np.float64], tolerance: float
) -> tuple[Forcing, int]:
    """Return the forcing of the kernel, and the order of the series that follow it."""
    if shape == RECORD:
        return record_forcing(record, scale, amplitude), record_order(scale, tolerance)
    return pulse_forcing(shape, amplitude, scale), PULSE_ORDER


def as_forcing(
    block: RockingBlock, excitation: Excitation | None
) -> tuple[int, float, float, NDArray[np.float64]]:
    """Return a ground motion as the kernel takes it: shape, ω/p or p Δt, amplitude, record."""
    p = block.frequency_parameter
    match excitation:
        case None:
            return NONE, 1.0, 0.0, NO_RECORD
        case Pulse():
            scale = excitation.angular_frequency / p
            return SHAPES[excitation.shape], scale, float(excitation.amplitude), NO_RECORD
        case Record():
            return RECORD, p * excitation.time_step, 1.0, prepare_record(excitation.acceleration)
    raise ValueError(f"excitation is {excitation!r}; expected a Pulse or a Record")
