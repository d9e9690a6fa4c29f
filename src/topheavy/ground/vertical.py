"""A horizontal and a vertical ground motion together: checks, and both in common segments.

Vertical ground acceleration v (g, upward) makes gravity (1 + v) g (proved in
src/derivation/extensions.py of the repository). Between impacts

    θ̈ = −p² (1 + v) { sin(α sgn θ − θ) + a/(1 + v) cos(α sgn θ − θ) }

so that the block moves as under a/(1 + v) in gravity (1 + v) g, and uplifts beyond (1 + v) tan α.
Between two samples a/(1 + v) is monotone, as a quotient of two lines.
"""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray

from topheavy.ground.excitation import Excitation, Lines, Segment
from topheavy.ground.records import Record


@dataclass(frozen=True, eq=False)
class TwoComponents(Excitation):
    """A horizontal and a vertical record that start together; see `check_no_free_fall`."""

    horizontal: Record
    vertical: Record

    def __post_init__(self) -> None:
        check_no_free_fall(self.vertical)

    @property
    def duration(self) -> float:
        """How long either lasts, s."""
        return max(self.horizontal.duration, self.vertical.duration)

    def accelerations(self, time: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the horizontal acceleration in g at an array of times in s."""
        return self.horizontal.accelerations(time)

    def segments(self, until: float) -> Lines:
        """Return the spans between the samples of either record, up to `until`."""
        end = min(until, self.duration)
        both = (self.horizontal, self.vertical)
        times = np.concatenate([r.time_step * np.arange(r.acceleration.size) for r in both])
        edges = np.append(np.unique(times[times < end]), end)
        # samples that rounding alone keeps apart are one
        edges = edges[np.append(True, np.diff(edges) > 1e-9 * end)]
        lines = []
        for record in both:
            line = np.stack([*pairwise(record.accelerations(edges))])
            line[edges[1:] + edges[:-1] > 2.0 * record.duration] = 0.0  # it ends by a jump
            lines.append(line)
        across, gravity = lines[0], 1.0 + lines[1]

        def span(k: int) -> Segment:
            start, stop = float(edges[k]), float(edges[k + 1])

            def weight(time: float) -> float:
                return _line(start, stop, gravity[k], time)

            def push(time: float) -> float:
                return _line(start, stop, across[k], time) / weight(time)

            return Segment(start, stop, push, weight)

        return Lines(np.abs(across / gravity).max(axis=1), span)


def with_vertical(excitation: Excitation | None, vertical: Record | None) -> Excitation | None:
    """Return the ground motion of both components, or the horizontal one if it is the only one."""
    if vertical is None:
        return trim_zeros(excitation) if isinstance(excitation, Record) else excitation
    return TwoComponents(*map(trim_zeros, both_records(excitation, vertical)))


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


def _line(start: float, stop: float, ends: NDArray[np.float64], time: float) -> float:
    return float(ends[0] + (ends[1] - ends[0]) * (time - start) / (stop - start))
