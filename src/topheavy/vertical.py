"""A ground motion with a vertical component, for the solvers that integrate it.

Vertical ground acceleration v (g, upward) makes gravity (1 + v) g (proved in
`topheavy.derivation.extension_proofs`). Between impacts

    θ̈ = −p² (1 + v) { sin(α sgn θ − θ) + a/(1 + v) cos(α sgn θ − θ) }

so that the block moves as under a/(1 + v) in gravity (1 + v) g, and uplifts beyond (1 + v) tan α.
Between two samples a/(1 + v) is monotone, as a quotient of two lines.
"""

from dataclasses import dataclass
from functools import partial
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from topheavy.excitation import Excitation, Segment
from topheavy.records import Record


@dataclass(frozen=True, eq=False)
class TwoComponents(Excitation):
    """A horizontal and a vertical record that start together.

    Raises
    ------
    ValueError
        Where the ground falls at 1 g or more, so that nothing presses on it.
    """

    horizontal: Record
    vertical: Record

    def __post_init__(self) -> None:
        lowest = int(self.vertical.acceleration.argmin())
        if self.vertical.acceleration[lowest] <= -1.0:
            raise ValueError(
                f"vertical: sample {lowest} is {self.vertical.acceleration[lowest]:.6g} g; "
                "expected more than −1 g, as the structure loses contact with ground that falls "
                "faster: a smaller factor keeps it in contact"
            )

    @property
    def duration(self) -> float:
        """How long either lasts, s."""
        return max(self.horizontal.duration, self.vertical.duration)

    def accelerations(self, time: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the horizontal acceleration in g at an array of times in s."""
        return self.horizontal.accelerations(time)

    def segments(self, until: float) -> list[Segment]:
        """Return the spans between the samples of either record, up to `until`."""
        end = min(until, self.duration)
        both = (self.horizontal, self.vertical)
        times = np.concatenate([r.time_step * np.arange(r.acceleration.size) for r in both])
        edges = np.append(np.unique(times[times < end]), end)
        # samples that rounding alone keeps apart are one
        edges = edges[np.append(True, np.diff(edges) > 1e-9 * end)]
        lines = [record.accelerations(edges) for record in both]
        spans = zip(pairwise(edges), pairwise(lines[0]), pairwise(lines[1]), strict=True)
        found = []
        for (start, stop), across, up in spans:
            gravity = partial(_line, start, stop, 1.0 + up[0], 1.0 + up[1])
            push = partial(_quotient, partial(_line, start, stop, *across), gravity)
            found.append(Segment(float(start), float(stop), push, gravity))
        return found


def with_vertical(
    excitation: Excitation | None, vertical: Record | None, *, linearised: bool = False
) -> Excitation | None:
    """Return the ground motion of both components, or the horizontal one if there is no other.

    Raises
    ------
    ValueError
        For a vertical component beside anything but a record, or on a linearised block.
    """
    if vertical is None:
        return excitation
    if not isinstance(vertical, Record) or not isinstance(excitation, Record):
        raise ValueError(
            f"excitation is {type(excitation).__name__} and vertical {type(vertical).__name__}; "
            "expected two Records: sample a pulse to combine it with a vertical component"
        )
    if linearised:
        raise ValueError(
            "vertical is given for a linearised block; expected the exact equation of motion"
        )
    return TwoComponents(excitation, vertical)


def refuse_vertical(vertical: object) -> None:
    """Raise ValueError if there is a vertical component, which the Taylor solver does not take."""
    if vertical is not None:
        raise ValueError(
            "vertical is given, and the Taylor solver has no vertical ground acceleration; "
            "expected None, or topheavy.reference.simulate or "
            "topheavy.three_bodies.simulate_three_bodies in place of topheavy.simulate"
        )


def _line(start: float, stop: float, first: float, last: float, time: float) -> float:
    return first + (last - first) * (time - start) / (stop - start)


def _quotient(above: partial[float], below: partial[float], time: float) -> float:
    return above(time) / below(time)
