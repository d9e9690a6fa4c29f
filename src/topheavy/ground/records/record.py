"""Recorded ground motions: samples in equal steps, joined by straight lines."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import ArrayLike, NDArray

from topheavy import checks
from topheavy.bodies.structures import STANDARD_GRAVITY
from topheavy.ground.excitation import Excitation, Lines, Segment
from topheavy.ground.records.units import UNDERSTOOD, acceleration_in_g


@dataclass(frozen=True, eq=False)
class Record(Excitation):
    """A recorded ground acceleration: sample k at k·time_step, linear between, zero outside.

    Parameters
    ----------
    time_step : float
        s.
    acceleration : array_like, shape (n,)
        In g, n ≥ 2.
    name : str
        What to call it in figures and messages.
    unit : str, optional
        Of the samples given, as a file may state it: "m/s2", "gal", "%g". They are converted to g.
        Without one they are taken as g, and a warning says if one exceeds
        `checks.LARGEST_RECORDED`; write "g" to say that this is meant.

    Raises
    ------
    ValueError
        For a step that is not positive, fewer than two samples, a sample that is not finite or
        beyond `checks.LARGEST_ACCELERATION`, or a unit that is not understood.

    Examples
    --------
    A record of eqsig (m/s²) and a trace of ObsPy after `remove_response(output="ACC")` (m/s²):

    >>> Record(signal.dt, signal.values, unit="m/s2")  # doctest: +SKIP
    >>> Record(trace.stats.delta, trace.data, unit="m/s2")  # doctest: +SKIP

    Examples
    --------
    >>> th.Record(0.02, [0.0, 2.5, 0.0], unit="m/s2").peak_velocity
    0.05
    """

    time_step: float
    acceleration: NDArray[np.float64]
    name: str = ""

    def __init__(
        self,
        time_step: float,
        acceleration: ArrayLike,
        name: str = "",
        *,
        unit: str | None = None,
    ) -> None:
        checks.positive("time_step", time_step, "s")
        if unit is None and time_step > checks.LONGEST_STEP:
            checks.warn(f"time_step is {time_step:.6g} s, and few are as long: is it in ms?")
        called = f"record {name!r}" if name else "record"
        samples = checks.numbers(f"{called}: acceleration", acceleration)
        if samples.ndim != 1 or samples.size < 2:
            raise ValueError(
                f"{called}: acceleration has shape {samples.shape}; "
                "expected one axis of at least two samples"
            )
        bad = np.flatnonzero(~np.isfinite(samples))
        if bad.size:
            raise ValueError(
                f"{called}: sample {bad[0]} of {samples.size} is {samples[bad[0]]}; "
                "expected finite accelerations in g"
            )
        samples *= _in_g(called, unit)
        largest = np.abs(samples).argmax()
        checks.acceleration(f"{called}: sample {largest} of {samples.size}", samples[largest])
        if unit is None and (peak := abs(samples[largest])) > checks.LARGEST_RECORDED:
            checks.warn(
                f"{called}: the largest acceleration is {peak:.3g} g, and few records exceed "
                f"{checks.LARGEST_RECORDED:g} g: is the unit m/s²? Then give unit='m/s2'; "
                "unit='g' says that g is meant"
            )
        samples.setflags(write=False)
        # A dataclass would take only an array: a field has one type, given and kept.
        for field, value in (("time_step", time_step), ("acceleration", samples), ("name", name)):
            object.__setattr__(self, field, value)

    @property
    def time(self) -> NDArray[np.float64]:
        """Times of the samples, s."""
        return self.time_step * np.arange(self.acceleration.size, dtype=np.float64)

    @property
    def duration(self) -> float:
        """Time of the last sample, s."""
        return (self.acceleration.size - 1) * self.time_step

    @property
    def peak_acceleration(self) -> float:
        """PGA: max |a| of the samples, g."""
        return float(np.abs(self.acceleration).max())

    @property
    def peak_velocity(self) -> float:
        """PGV, m/s: max |v| at the samples, integrated from rest without baseline correction."""
        steps = (self.acceleration[1:] + self.acceleration[:-1]) / 2.0 * self.time_step
        return float(np.abs(np.cumsum(steps)).max()) * STANDARD_GRAVITY

    def scaled(self, factor: float) -> Record:
        """Return the same record with all accelerations multiplied by `factor`."""
        acceleration = checks.finite("factor", factor) * self.acceleration
        return Record(self.time_step, acceleration, self.name, unit="g")

    def scaled_to(self, *, pga: float | None = None, pgv: float | None = None) -> Record:
        """Return the record scaled to a peak ground acceleration (g) or velocity (m/s).

        Raises
        ------
        ValueError
            Unless one of both is given, is positive, and the record has acceleration.
        """
        if (pga is None) == (pgv is None):
            raise ValueError(f"pga is {pga}, pgv is {pgv}; expected one of both")
        if pga is not None:
            wanted, peak = checks.positive("pga", pga, "g"), self.peak_acceleration
        else:
            wanted, peak = checks.positive("pgv", pgv, "m/s"), self.peak_velocity
            if wanted > checks.LARGEST_VELOCITY:
                checks.warn(
                    f"pgv is {wanted:.6g} m/s, and few motions have as much: is it in cm/s?"
                )
        if peak == 0.0:
            raise ValueError(f"record {self.name!r} has no acceleration; expected one to scale")
        return self.scaled(wanted / peak)

    def accelerations(self, time: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the ground acceleration in g at times in s, an array; zero outside the record."""
        samples = np.arange(self.acceleration.size)
        place = np.minimum(time / self.time_step, samples[-1])  # not beyond the end by a rounding
        inside = (time >= 0.0) & (time <= self.duration)
        return np.where(inside, np.interp(place, samples, self.acceleration), 0.0)

    def segments(self, until: float) -> Lines:
        """Return the lines between samples, from 0 to the earlier of `until` and the end."""
        samples, size = self.acceleration.tolist(), np.abs(self.acceleration)
        begun = int(np.count_nonzero(self.time[:-1] < until))

        def line(k: int) -> Segment:
            first, second = samples[k : k + 2]
            start, stop = k * self.time_step, (k + 1) * self.time_step
            slope = (second - first) / self.time_step
            return Segment(start, min(stop, until), partial(_line, start, first, slope))

        return Lines(np.maximum(size[:-1], size[1:])[:begun], line)


def _in_g(called: str, unit: str | None) -> float:
    found = 1.0 if unit is None else acceleration_in_g(str(unit))
    if found is None:
        raise ValueError(f"{called}: unit is {unit!r}; expected {UNDERSTOOD}")
    return found


def _line(start: float, value: float, slope: float, time: float) -> float:
    return value + slope * (time - start)
