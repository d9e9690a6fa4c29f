"""Recorded ground motions: samples in equal steps, joined by straight lines.

Vertical ground acceleration v (g, upward) makes gravity (1 + v) g (proved in
src/derivation/extensions.py of the repository). Between impacts

    θ̈ = −p² (1 + v) { sin(α sgn θ − θ) + a/(1 + v) cos(α sgn θ − θ) }

so that the block moves as under a/(1 + v) in gravity (1 + v) g, and uplifts beyond (1 + v) tan α.
"""

from __future__ import annotations

import re
import unicodedata
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from topheavy import checks
from topheavy.bodies.structures import STANDARD_GRAVITY
from topheavy.ground.excitation import Excitation

_METRES = {"gal": 0.01, "m/s2": 1.0, "cm/s2": 0.01, "mm/s2": 0.001}
UNITS = {"g": 1.0, "%g": 0.01, "mg": 0.001}
UNITS |= {unit: metres / STANDARD_GRAVITY for unit, metres in _METRES.items()}
"""One of each unit of acceleration, in g."""

MAX_RECORDED = 5.0
"""g. No recorded ground acceleration exceeds it."""

MIN_CLIPPED = 4
"""So many equal samples in turn at the peak show that an instrument reached its range."""


def acceleration_in_g(unit: str) -> float | None:
    """Return one unit of acceleration in g, or None for a text that is no such unit."""
    plain = unicodedata.normalize("NFKC", unit).replace("−", "-").lower()
    plain = re.sub(r"[\s()^*]|['’]s", "", plain).replace("sec", "s").replace("/s/s", "/s2")
    return UNITS.get(re.sub(r"(?<=m)[.·⋅]?s-2$", "/s2", plain).replace("gals", "gal"))


@dataclass(frozen=True, eq=False, repr=False)
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
        Of the samples given, such as "m/s2", "gal" or "%g". They are converted to g.
    start : float
        Time of the first sample, s, which two components must share. A history begins with it.

    Warns
    -----
    UserWarning
        If the samples are probably no ground motion, with the number that shows it.

    Raises
    ------
    ValueError
        For a step that is not positive, fewer than two samples, a sample that is not finite or
        beyond 1e6 g, or a unit that is not understood.

    Examples
    --------
    >>> th.Record(0.02, [0.0, 5.0, -5.0, 0.0], unit="m/s2").peak_velocity
    0.05
    """

    time_step: float
    acceleration: NDArray[np.float64]
    name: str = ""
    start: float = 0.0

    def __init__(
        self,
        time_step: float,
        acceleration: ArrayLike,
        name: str = "",
        *,
        unit: str | None = None,
        start: float = 0.0,
    ) -> None:
        time_step = checks.positive("time_step", time_step, "s")
        if not isinstance(name, str) or acceleration_in_g(name) is not None:
            raise ValueError(
                f"name is {checks.short_repr(name)}; expected a text that is no unit, or unit=…"
            )
        label = _label(name)
        samples = checks.numbers(f"{label}: acceleration", acceleration)
        if samples.ndim != 1 or samples.size < 2:
            raise ValueError(f"{label} has shape {samples.shape}; expected at least two samples")
        factor = 1.0 if unit is None else acceleration_in_g(str(unit))
        if factor is None:
            raise ValueError(f"{label}: unit is {unit!r}; expected one of {', '.join(UNITS)}")
        samples *= factor
        self._set(time_step, samples, name, checks.finite("start", start))
        _warn_if_implausible(self, checks.MAX_USUAL_ACCELERATION if unit is None else MAX_RECORDED)

    def _set(self, step: float, samples: NDArray[np.float64], name: str, start: float) -> None:
        k = np.abs(samples).argmax()  # of the largest, or the first NaN
        checks.within_reason(f"{_label(name)}: sample {k} of {samples.size}", samples[k], "g")
        samples.setflags(write=False)
        # Not the __init__ of a dataclass: it would accept arrays only, as the field is one.
        fields = {"time_step": step, "acceleration": samples, "name": name, "start": start}
        for field, value in fields.items():
            object.__setattr__(self, field, value)

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Take the fields of a pickle or copy, in which NumPy makes the samples writable again."""
        self.__dict__.update(state)
        self.acceleration.setflags(write=False)

    def with_samples(self, acceleration: NDArray[np.float64]) -> Record:
        """Return the record with other samples, in g, computed from its own."""
        record = object.__new__(Record)
        record._set(self.time_step, acceleration, self.name, self.start)
        return record

    def __repr__(self) -> str:
        sizes = f"{self.acceleration.size} samples, time step {self.time_step:.6g} s"
        peaks = f"PGA {self.peak_acceleration:.4g} g, PGV {self.peak_velocity:.4g} m/s"
        return f"{self.name or 'record'}: {sizes}, {peaks}"

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
        """PGV, m/s: max |v| at the samples, integrated from rest without baseline correction.

        Samples are joined by straight lines. An agency that integrates in the frequency domain may
        print another value: 1.3 % more for a file of CSMIP with 50 samples a second.
        """
        return float(np.abs(self._velocities()).max()) * STANDARD_GRAVITY

    def _velocities(self) -> NDArray[np.float64]:
        """Return the velocities at the samples after the first, in g s."""
        steps = (self.acceleration[1:] + self.acceleration[:-1]) / 2.0 * self.time_step
        return np.cumsum(steps)

    def detrended(self) -> Record:
        """Return the record without the straight line that fits its accelerations best.

        Offset and drift of an instrument leave with it, and the velocity ends near zero.

        Examples
        --------
        >>> shifted = th.Record(0.01, 5e-4 + np.sin(0.1 * np.pi * np.arange(1001)))
        >>> bool(abs(shifted.detrended().acceleration.mean()) < 1e-12)
        True
        """
        places = np.arange(self.acceleration.size)
        line = np.polynomial.Polynomial.fit(places, self.acceleration, 1)
        return self.with_samples(self.acceleration - line(places))

    def scaled(self, factor: float) -> Record:
        """Return the same record with all accelerations multiplied by `factor`."""
        return self.with_samples(checks.finite("factor", factor) * self.acceleration)

    def scaled_to(self, *, pga: float | None = None, pgv: float | None = None) -> Record:
        """Return the record scaled to a peak ground acceleration (g) or velocity (m/s).

        Raises
        ------
        ValueError
            Unless one of both is given, is positive, and the record has acceleration.

        Warns
        -----
        UserWarning
            For more than 5 g or 5 m/s, and a factor above 1000.
        """
        if (pga is None) == (pgv is None):
            raise ValueError(f"pga is {pga}, pgv is {pgv}; expected one of both")
        if pga is not None:
            wanted, peak = checks.positive("pga", pga, "g"), self.peak_acceleration
            if wanted > MAX_RECORDED:
                checks.warn(f"pga is {wanted:.6g} g, and few exceed 5 g: is it in gal or m/s²?")
        else:
            wanted, peak = checks.positive("pgv", pgv, "m/s"), self.peak_velocity
            if wanted > checks.MAX_USUAL_VELOCITY:
                checks.warn(f"pgv is {wanted:.6g} m/s, and few exceed 5 m/s: is it in cm/s?")
        if peak == 0.0:
            raise ValueError(f"record {self.name!r} has no acceleration; expected one to scale")
        if wanted / peak > checks.MAX_USUAL_FACTOR:
            checks.warn(f"{_label(self.name)} is scaled by {wanted / peak:.3g}: is it noise?")
        return self.scaled(wanted / peak)

    def accelerations(self, time: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the ground acceleration in g at times in s, an array; zero outside the record."""
        samples = np.arange(self.acceleration.size)
        place = np.minimum(time / self.time_step, samples[-1])  # not beyond the end by a rounding
        inside = (time >= 0.0) & (time <= self.duration)
        return np.where(inside, np.interp(place, samples, self.acceleration), 0.0)


def _label(name: str) -> str:
    return f"record {name!r}" if name else "record"


def _warn_if_implausible(record: Record, most: float) -> None:
    """Warn of a record that is probably no ground motion in g, with the number that shows it."""
    samples, velocities = record.acceleration, STANDARD_GRAVITY * record._velocities()
    largest, fastest, last = np.abs(samples).max(), np.abs(velocities).max(), velocities[-1]
    step, one_sign = record.time_step, samples.min() * samples.max() >= 0.0 != largest
    clipped = max(_longest_run(samples == end) for end in (largest, -largest)) if largest else 0
    padded, least = np.pad(samples, 1), checks.MIN_USUAL_ACCELERATION  # zero outside the record
    peak = int(np.abs(padded).argmax())
    behind = peak + int((padded[peak:] != padded[peak]).argmax())
    beside = np.abs(padded[[peak - 1, behind]]).max()
    doubts = {
        f"the velocity at the end is {last:.3g} m/s, with a PGV of {fastest:.3g} m/s: if its "
        "baseline is not corrected, take record.detrended()": abs(last) > 0.3 * fastest,
        f"the PGV is {fastest:.3g} m/s: is a unit wrong?": fastest > checks.MAX_USUAL_VELOCITY,
        "no sample changes sign: is it a ground acceleration?": one_sign,
        f"time_step is {step:.6g} s: is it in ms?": step > checks.MAX_USUAL_STEP,
        f"the largest acceleration is {largest:.3g} g, and few exceed {most:g} g: is it in m/s² "
        "or counts?": largest > most,
        f"the largest acceleration is {largest:.3g} g, and few peaks of interest are below "
        f"{least:g} g: is its unit another?": 0.0 < largest < least,
        f"both neighbours of the peak, sample {peak} of {samples.size}, are below half of it: does "
        "it stand for missing data?": beside < 0.5 * largest and behind - peak < MIN_CLIPPED,
        f"{clipped} samples in turn are equal to the peak: did the instrument reach its range?": (
            clipped >= MIN_CLIPPED
        ),
    }
    if any(doubts.values()):
        text = "; ".join(doubt for doubt, is_so in doubts.items() if is_so)
        checks.warn(f"{_label(record.name)}: {text}")


def _longest_run(flags: NDArray[np.bool_]) -> int:
    """Return the largest number of True in turn."""
    changes = np.flatnonzero(np.diff(np.concatenate([[False], flags, [False]])))
    return int(np.diff(changes)[::2].max(initial=0))


def trim_zeros(record: Record) -> Record:
    """Return a record without the zeros at its end."""
    (moving,) = np.nonzero(record.acceleration)
    size = max(2, int(moving[-1]) + 2) if moving.size else 2
    if size >= record.acceleration.size:
        return record
    return record.with_samples(record.acceleration[:size])


def both_records(excitation: object, vertical: object) -> tuple[Record, Record]:
    """Return two Records that start together, or raise ValueError for other ground motions."""
    if not isinstance(vertical, Record) or not isinstance(excitation, Record):
        raise ValueError(
            f"excitation is {type(excitation).__name__} and vertical {type(vertical).__name__}; "
            "expected two Records: sample a pulse to combine it with a vertical component"
        )
    if abs(excitation.start - vertical.start) > 0.5 * excitation.time_step:
        raise ValueError(
            f"excitation starts at {excitation.start:.6g} s, vertical at {vertical.start:.6g} s; "
            "expected the same: cut both Records to it, and give it as `start`"
        )
    return excitation, vertical


def check_no_free_fall(vertical: Record, factors: ArrayLike = 1.0) -> None:
    """Raise ValueError if the ground falls at 1 g or more: the structure would lose contact."""
    samples, scales = vertical.acceleration, np.ravel(factors)
    for factor in (float(scales.max()), float(scales.min())):
        lowest = int((factor * samples).argmin())
        least = factor * samples[lowest]
        if least <= -1.0:
            side = "less" if factor > 0.0 else "more"
            raise ValueError(
                f"vertical: at {lowest * vertical.time_step:.6g} s its acceleration times "
                f"{factor:.6g} is {least:.6g} g; expected more than −1 g, as the structure loses "
                f"contact with ground that falls faster: factors {side} than "
                f"{-1.0 / samples[lowest]:.6g} are allowed"
            )
