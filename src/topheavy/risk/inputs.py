"""Checks of the arguments of `fragility`: structures, motions, intensities, levels and groups."""

import math
from collections.abc import Callable, Hashable, Mapping, Sequence
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from topheavy import checks
from topheavy.bodies.structures import RockingBlock, Structure, as_block
from topheavy.checks import short
from topheavy.ground.pulses import Pulse
from topheavy.ground.records import Record

Motion = Pulse | Record
Structures = Mapping[str, Structure] | Sequence[Structure]
Measure = Literal["PGV", "PGA"] | Callable[[Any], float]

UNITS = {"PGV": "m/s", "PGA": "g"}
"""Units of the measures of intensity that have a name."""

MIN_RESAMPLES = 100


def named_blocks(structures: Structures) -> dict[str, RockingBlock]:
    """Return the block of each structure by its name, or raise ValueError.

    In a list the names are "Column 1", "RockingFrame 2" and so on.
    """
    if not isinstance(structures, Mapping | Sequence) or not structures:
        raise ValueError(
            f"structures is {short(structures)}; expected a mapping from names to structures, or a "
            "list of structures"
        )
    named = structures
    if not isinstance(named, Mapping):
        named = {f"{type(each).__name__} {i + 1}": each for i, each in enumerate(named)}
    blocks = {}
    for name, structure in named.items():
        try:
            blocks[name] = as_block(structure)
        except ValueError as error:
            raise ValueError(f"structures, {name}: {error}") from None
    return blocks


def checked_motions(motions: Sequence[Motion]) -> list[Motion]:
    """Return the motions as a list, or raise ValueError unless there are some and all end."""
    if not isinstance(motions, Sequence) or not motions:
        raise ValueError(f"motions is {short(motions)}; expected a list of motions, not empty")
    for place, motion in enumerate(motions):
        if not isinstance(motion, Motion) or not math.isfinite(motion.duration):
            raise ValueError(
                f"motions[{place}] is {short(motion)}; expected a Record or a Pulse that ends"
            )
    return list(motions)


def intensities(motions: Sequence[Motion], measure: Measure) -> NDArray[np.float64]:
    """Return the intensity of each motion: PGV in m/s, PGA in g, or by a function.

    Raises
    ------
    ValueError
        For an unknown measure, a Pulse under one with a name, and an intensity that is not
        positive, since no factor brings such a motion to a level.
    """
    if callable(measure):
        values = [measure(motion) for motion in motions]
    elif measure not in UNITS:
        raise ValueError(
            f"measure is {short(measure)}; expected 'PGV', 'PGA' or a function of a motion"
        )
    else:
        values = []
        for motion in motions:
            if not isinstance(motion, Record):
                raise ValueError(
                    f"a motion is {short(motion)}, which has no {measure}; expected a Record, or a "
                    "function as measure"
                )
            values.append(motion.peak_velocity if measure == "PGV" else motion.peak_acceleration)
    return np.array(
        [checks.positive(f"measure of motions[{i}]", value) for i, value in enumerate(values)]
    )


def checked_levels(levels: ArrayLike) -> NDArray[np.float64]:
    """Return the levels as an array, or raise ValueError unless they are positive and increase."""
    result = checks.axis("levels", levels, zero_allowed=False)
    if (np.diff(result) <= 0.0).any():
        raise ValueError(f"levels is {short(result)}; expected levels that increase")
    return result


def checked_groups(groups: Sequence[Hashable] | None, motions: int) -> list[Hashable] | None:
    """Return the group of each motion, or raise ValueError unless there is one for each.

    Where every motion has a group of its own, nothing can be resampled within groups.
    """
    if groups is None:
        return None
    if len(groups) != motions or len(set(groups)) == motions:
        raise ValueError(
            f"groups is {short(groups)}; expected the group of each of {motions} motions, and two "
            "motions in one group at least, since motions are resampled within their group"
        )
    return list(groups)


def checked_resampling(confidence: float, resamples: int) -> None:
    """Raise ValueError unless intervals can be computed with these numbers."""
    if not 0.0 < checks.fraction("confidence", confidence) < 1.0:
        raise ValueError(f"confidence is {confidence:g}; expected more than 0 and less than 1")
    if not isinstance(resamples, int) or resamples < MIN_RESAMPLES:
        raise ValueError(
            f"resamples is {short(resamples)}; expected a whole number from {MIN_RESAMPLES} on"
        )
