"""Rocking histories by the Taylor solver: `simulate`, and `judge` for the outcome only."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from topheavy import checks
from topheavy.bodies.free_rocking import Outcome
from topheavy.bodies.response import EndState, Response, initial_motion, sample_times
from topheavy.bodies.structures import RockingBlock, Structure, as_block
from topheavy.ground.excitation import Excitation, checked_excitation, no_excitation
from topheavy.ground.pulses import Pulse
from topheavy.ground.records import Record, both_records, check_no_free_fall, trim_zeros
from topheavy.kernel.forcing import (
    NO_MOTION,
    RECORD,
    Waveform,
    forcing_of,
    pulse_waveform,
    record_waveform,
)
from topheavy.kernel.grid import outcome_of, sampled
from topheavy.kernel.history import (
    MAX_STEPS_WITH_SAMPLES,
    NO_UPLIFT,
    OVERTURNED,
    RESTS,
    ROCKING,
    UNRESOLVED,
    History,
    Samples,
)
from topheavy.kernel.step import TOLERANCE
from topheavy.kernel.taylor import oscillator

Times = NDArray[np.float64]

MAX_IMPACTS = 100_000
"""The largest number of impacts of one history."""

MIN_TOLERANCE, MAX_TOLERANCE = 1e-16, 1e-2
"""Below the first, rounding dominates the error of a step; above the second, outcomes change."""

_END_STATES: dict[int, EndState] = {
    NO_UPLIFT: "no uplift",
    RESTS: "rests",
    ROCKING: "rocking",
    OVERTURNED: "overturned",
}


def simulate(
    structure: Structure,
    excitation: Pulse | Record | None = None,
    *,
    rotation: float = 0.0,
    velocity: float = 0.0,
    duration: float | None = None,
    samples: int | ArrayLike = 1000,
    tolerance: float = TOLERANCE,
    vertical: Record | None = None,
) -> Response:
    """Return the rocking response to a ground motion, or free rocking without one.

    Parameters
    ----------
    structure : Structure
    excitation : Pulse or Record, optional
    rotation, velocity : float
        θ (rad) and θ̇ (rad/s) at t = 0, signed.
    duration : float, optional
        End of the history and of the forcing, s. Without it the history ends at the first of:
        overturned (at |θ| = π/2), at rest, 1000 impacts after the forcing.
    samples : int or array_like
        Number of uniform times from 0 to the end, or increasing times in s.
    tolerance : float
        Bound on the last two terms of the Taylor series of φ̇/p in a step, relative to α; from
        1e-16 to 1e-2.
    vertical : Record, optional
        Vertical ground acceleration that starts with the record: g, positive upward. The time
        steps of both may differ.

    Returns
    -------
    Response
        Its outcome and peak rotation include the free rocking after the duration.

    Raises
    ------
    ValueError
        For values that are not finite, |θ| ≥ π/2 in the exact equation, a harmonic without a
        duration, a tolerance or a number of samples out of range, a structure whose √r is
        negative, or a vertical acceleration of −1 g or less.
    ArithmeticError
        For a history of more than 100,000 impacts or a million steps.

    Notes
    -----
    Taylor steps whose turning points and impacts are proven by the signs of Bernstein coefficients
    (`topheavy.kernel`). src/audit.py of the repository is an independent, plain solver.

    Examples
    --------
    >>> pulse = th.Pulse("one-sine", 1.0, angular_frequency=2.0)
    >>> th.simulate(th.Column(0.5, 3.0), pulse.scaled(0.2)).outcome
    'overturned'
    """
    block = as_block(structure)
    times = sample_times(samples)
    tolerance = checked_tolerance(tolerance)
    theta, theta_rate = initial_motion(block, rotation, velocity)
    shaking = Shaking.of(excitation, vertical, ends=False)
    p, scale = block.frequency_parameter, shaking.scale(block)
    if duration is not None:
        duration = checks.positive("duration", duration, "s")
    until = math.inf if duration is None else p * duration
    forcing = forcing_of(shaking.waveform, scale, shaking.amplitude, 1.0)
    forcing = forcing._replace(end=min(forcing.end, until))
    if forcing.end == math.inf:
        raise ValueError("duration is None; expected one, as this excitation goes on forever")

    def followed_until(until: float, at: Times) -> tuple[Samples, History]:
        samples = Samples(at, np.full((2, at.size), math.nan), np.empty(MAX_IMPACTS))
        start = theta, theta_rate / p
        history = sampled(oscillator(block), forcing, tolerance, start, until, samples)
        if history.result == UNRESOLVED:
            raise ArithmeticError(
                f"{block} under {_described(excitation)}: more than {MAX_IMPACTS} impacts or "
                f"{MAX_STEPS_WITH_SAMPLES} steps by {history.end / p:.6g} s; a shorter duration or "
                "a smaller restitution has fewer"
            )
        return samples, history

    last, result = math.inf, None
    if isinstance(times, int):
        last = until
        if duration is None:
            result = followed_until(until, np.array([0.0, math.inf]))
            last = result[1].end
        times = np.linspace(0.0, last / p if duration is None else duration, times)
    elif duration is None:
        until = max(p * float(times[-1]), forcing.end)
    if result is None or times.size > 2:
        # The last of uniform times is the end, and no rounding of p (end/p) above it.
        result = followed_until(until, np.minimum(p * times, last))
    (_, motion, impact_times), history = result
    outcome = _END_STATES[history.result]
    if outcome == "rests" and block.restitution == 1.0:
        outcome = "rocking"  # the kernel does not follow bounces that are too low to count
    return Response(
        time=times,
        rotation=motion[0],
        velocity=p * motion[1],
        impact_times=impact_times[: history.all_impacts] / p,
        outcome=outcome,
        number_of_impacts=history.impacts,
        peak_rotation=math.nan if outcome == "overturned" else history.peak,
        slenderness=block.slenderness,
    )


def judge(
    structure: Structure,
    excitation: Pulse | Record,
    *,
    tolerance: float = TOLERANCE,
    vertical: Record | None = None,
) -> Outcome:
    """Return whether a structure overturns, its peak rotation, and the number of impacts.

    The outcome is that of `simulate`, in microseconds: the free rocking is not integrated. The
    peak is max|θ| over the whole motion (NaN if overturned); impacts are counted as in `Response`.

    Parameters
    ----------
    structure, tolerance, vertical
        See `simulate`.
    excitation : Pulse or Record
        One that ends.

    Raises
    ------
    ValueError
        For an excitation that is not a ground motion or goes on forever, a tolerance out of range,
        or a vertical acceleration of −1 g or less.
    ArithmeticError
        For a block that bounces too often to be followed.

    Examples
    --------
    >>> pulse = th.Pulse("one-sine", 1.0, angular_frequency=2.0)
    >>> th.judge(th.Column(0.5, 3.0), pulse.scaled(0.2)).overturned
    True
    """
    shaking, block = Shaking.of(excitation, vertical), as_block(structure)
    return outcome_of(
        oscillator(block),
        shaking.waveform,
        shaking.scale(block),
        shaking.amplitude,
        vertical_factor=1.0,
        tolerance=checked_tolerance(tolerance),
    )


class Shaking(NamedTuple):
    """A ground motion as the kernel reads it: its waveform, ω or Δt, and amplitude."""

    waveform: Waveform
    rate: float
    amplitude: float

    def scale(self, block: RockingBlock) -> float:
        """Return ω/p of a pulse, p Δt of a record."""
        p = block.frequency_parameter
        return p * self.rate if self.waveform.wave == RECORD else self.rate / p

    @classmethod
    def of(
        cls,
        excitation: Excitation | None,
        vertical: Record | None = None,
        *,
        ends: bool = True,
        factors: ArrayLike = 1.0,
    ) -> Shaking:
        """Check a ground motion and return it as the kernel reads it.

        `ends` says that it has to end, and then there has to be one; under the factors on the
        vertical record the structure has to keep contact. Anything else raises ValueError.
        """
        if ends:
            checked_excitation(excitation, ends=True)
        if vertical is not None:
            across, up = both_records(excitation, vertical)
            check_no_free_fall(up, factors)
            across, up = trim_zeros(across), trim_zeros(up)
            ratio = up.time_step / across.time_step
            waveform = record_waveform(across.acceleration, up.acceleration, ratio)
            return cls(waveform, across.time_step, 1.0)
        match excitation:
            case None:
                return cls(NO_MOTION, 1.0, 0.0)
            case Pulse():
                waveform = pulse_waveform(excitation.shape, excitation.cycles)
                return cls(waveform, excitation.angular_frequency, float(excitation.amplitude))
            case Record():
                return cls(_waveform(excitation), excitation.time_step, 1.0)
        raise no_excitation(excitation)


@lru_cache(maxsize=2)
def _waveform(record: Record) -> Waveform:
    """Return a record as the kernel reads it, prepared once for several calls."""
    return record_waveform(trim_zeros(record).acceleration)


def checked_tolerance(value: float) -> float:
    """Return a tolerance of the kernel, or raise ValueError with the accepted range."""
    return checks.within("tolerance", value, MIN_TOLERANCE, MAX_TOLERANCE)


def _described(excitation: Excitation | None) -> str:
    if isinstance(excitation, Record):
        return f"record {excitation.name!r}"
    return "no excitation" if excitation is None else repr(excitation)
