"""A horizontal and a vertical ground motion together: what is refused of them.

Vertical ground acceleration v (g, upward) makes gravity (1 + v) g (proved in
src/derivation/extensions.py of the repository). Between impacts

    θ̈ = −p² (1 + v) { sin(α sgn θ − θ) + a/(1 + v) cos(α sgn θ − θ) }

so that the block moves as under a/(1 + v) in gravity (1 + v) g, and uplifts beyond (1 + v) tan α.
"""

import numpy as np
from numpy.typing import ArrayLike

from topheavy.ground.records import Record


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
