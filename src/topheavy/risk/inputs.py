"""What `fragility` accepts: structures with names, motions with intensities, levels, groups."""

import math
from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from topheavy import checks
from topheavy.bodies.structures import Column, RockingBlock, Structure
from topheavy.checks import short
from topheavy.ground.pulses import Pulse
from topheavy.ground.records import Record
from topheavy.ground.vertical import both_records, refuse_fall

Motion = Pulse | Record
Structures = Mapping[str, Structure] | Sequence[Structure]
Measure = Literal["PGV", "PGA"] | Callable[[Any], float]

Array = NDArray[np.float64]

UNITS = {"PGV": "m/s", "PGA": "g"}
"""The measures of intensity that have a name, and their units."""

FEWEST_RESAMPLES = 100
MOST_RESAMPLES = 100_000


@dataclass(frozen=True)
class Variant:
    """A structure that is judged: one that was given, or a column with a lowered √r.

    `lowered` is the share by which √r is lowered: 0 for a structure as it was given.
    """

    name: str
    block: RockingBlock
    column: bool
    lowered: float = 0.0


def variants(structures: Structures, lowered: Iterable[float]) -> list[Variant]:
    """Return all structures by name, then each `Column` with √r lowered by each share.

    Raises
    ------
    ValueError
        For what is no structure or has no √r, no structures at all, a share that is not between 0
        and 1, and shares without a `Column`.
    """
    given = [
        Variant(name, _block(f"structures[{key!r}]", structure), isinstance(structure, Column))
        for name, key, structure in _named(structures)
    ]
    if not isinstance(lowered, Iterable):
        raise ValueError(
            f"lowered is {short(lowered)}; expected a list of shares, for example (0.05,)"
        )
    shares = [checks.fraction(f"lowered[{i}]", share) for i, share in enumerate(lowered)]
    for place, share in enumerate(shares):
        if not 0.0 < share < 1.0 or share in shares[:place]:
            raise ValueError(
                f"lowered[{place}] is {share:g}; expected different shares of √r, each more than 0 "
                "and less than 1, for example (0.05, 0.10)"
            )
    columns = [one for one in given if one.column]
    if shares and not columns:
        raise ValueError(
            f"lowered is {short(shares)}, and structures has no Column; expected one at least, as "
            "the √r of columns alone is lowered"
        )
    return given + [
        Variant(
            f"{one.name}, √r {100.0 * share:g} % lower",
            one.block.with_restitution((1.0 - share) * one.block.restitution),
            True,
            share,
        )
        for share in shares
        for one in columns
    ]


def pairs(under: Sequence[Variant]) -> list[tuple[int, int]]:
    """Return the places of the variants that are compared.

    All structures as they were given, in their order; and each column with a lowered √r with each
    structure that is no column.
    """
    given = [place for place, one in enumerate(under) if not one.lowered]
    rivals = [place for place in given if not under[place].column]
    return [(i, j) for i in given for j in given if i < j] + [
        (i, j) for i, one in enumerate(under) if one.lowered for j in rivals
    ]


def checked_motions(motions: Sequence[Motion]) -> list[Motion]:
    """Return the motions as a list; raise ValueError unless all are of finite duration."""
    if not isinstance(motions, Iterable):
        raise ValueError(f"motions is {short(motions)}; expected a list of motions")
    found = list(motions)
    if not found:
        raise ValueError("motions is empty; expected at least one motion")
    for place, motion in enumerate(found):
        if not isinstance(motion, Motion):
            raise ValueError(f"motions[{place}] is {short(motion)}; expected a Record or a Pulse")
        if not math.isfinite(motion.duration):
            raise ValueError(f"motions[{place}] goes on forever; expected a motion that ends")
    return found


def factors(motions: Sequence[Motion], measure: Measure, levels: Array) -> Array:
    """Return the factors that bring motions to levels of intensity, shape (motions, levels).

    Raises
    ------
    ValueError
        For an unknown measure, a motion that is no `Record` under one with a name, an intensity
        that is not positive, since no factor brings such a motion to a level, and a motion that
        the highest level scales beyond `checks.LARGEST_ACCELERATION`.
    """
    found = levels / intensities(motions, measure)[:, None]
    for place, (motion, largest) in enumerate(zip(motions, found[:, -1], strict=True)):
        try:
            motion.scaled(largest)
        except ValueError as error:
            raise ValueError(f"motions[{place}] scaled to {levels[-1]:g}: {error}") from None
    return found


def intensities(motions: Sequence[Motion], measure: Measure) -> Array:
    """Return the intensity of each motion: PGV in m/s, PGA in g, or by a function."""
    if not callable(measure) and measure not in UNITS:
        raise ValueError(
            f"measure is {short(measure)}; expected 'PGV', 'PGA' or a function of a motion"
        )
    found = []
    for place, motion in enumerate(motions):
        called = f"motions[{place}]"
        if callable(measure):
            found.append(checks.positive(f"measure of {called}", measure(motion)))
            continue
        if not isinstance(motion, Record):
            raise ValueError(
                f"{called} is {short(motion)}, which has no {measure}; expected a Record, or a "
                "function as measure"
            )
        value = motion.peak_velocity if measure == "PGV" else motion.peak_acceleration
        name = f" of record {motion.name!r}" if motion.name else ""
        found.append(checks.positive(f"{called}: {measure}{name}", value, UNITS[measure]))
    return np.array(found)


def checked_vertical(
    vertical: Sequence[Record] | None, motions: Sequence[Motion], factors: Array
) -> list[Record | None]:
    """Return the vertical component of each motion, or None for each.

    Raises
    ------
    ValueError
        Unless there is a `Record` for each motion, itself one, that the `factors` on it, a row for
        each motion or one for all, leave above −1 g.
    """
    if vertical is None:
        return [None] * len(motions)
    if not isinstance(vertical, Sequence) or len(vertical) != len(motions):
        raise ValueError(
            f"vertical is {short(vertical)}; expected a list of {len(motions)} Records, the "
            "vertical component of each motion"
        )
    rows = np.broadcast_to(factors, (len(motions), factors.shape[-1]))
    for place, (motion, up, scales) in enumerate(zip(motions, vertical, rows, strict=True)):
        try:
            refuse_fall(both_records(motion, up)[1], scales)
        except ValueError as error:
            told = str(error).removeprefix("vertical: ")
            raise ValueError(f"vertical[{place}]: {told}") from None
    return list(vertical)


def checked_levels(levels: ArrayLike) -> Array:
    """Return the levels as an array, or raise ValueError unless they are positive and increase."""
    found = checks.numbers("levels", levels)
    if found.ndim != 1 or not found.size:
        raise ValueError(f"levels has shape {found.shape}; expected a list of numbers, not empty")
    bad = np.flatnonzero(~(np.isfinite(found) & (found > 0.0)))
    if bad.size:
        raise ValueError(f"levels[{bad[0]}] is {found[bad[0]]:g}; expected a positive number")
    falls = np.flatnonzero(np.diff(found) <= 0.0)
    if falls.size:
        low, high = found[falls[0] : falls[0] + 2]
        raise ValueError(
            f"levels[{falls[0] + 1}] is {high:g} after {low:g}; expected levels that increase"
        )
    return found


def checked_groups(groups: Sequence[Hashable] | None, motions: int) -> list[Hashable] | None:
    """Return the group of each motion, or raise ValueError unless there is one for each.

    Where every motion has a group of its own, nothing can be resampled within groups.
    """
    if groups is None:
        return None
    if isinstance(groups, str) or not isinstance(groups, Iterable):
        raise ValueError(f"groups is {short(groups)}; expected a list, the group of each motion")
    found = list(groups)
    if len(found) != motions:
        raise ValueError(f"groups has {len(found)} elements; expected {motions}, one for a motion")
    if len(set(found)) == motions:
        raise ValueError(
            f"groups is {short(found)}, a group for each motion; expected one at least with two "
            "motions, as motions are resampled within their group"
        )
    return found


def sampling(groups: Sequence[Hashable] | None, motions: int) -> str:
    """Return in words which sources of scatter the intervals include."""
    if groups is None:
        return f"sampling of {motions} motions, each drawn independently of the others"
    sizes = [groups.count(group) for group in dict.fromkeys(groups)]
    alone = sizes.count(1)
    single = f"; {alone} of the groups have one motion, and no scatter" if alone else ""
    return (
        f"sampling of {motions} motions only within {len(sizes)} groups, without the scatter "
        f"between groups{single}"
    )


def checked_resampling(confidence: float, resamples: int, seed: int) -> None:
    """Raise ValueError unless intervals can be computed with these numbers."""
    if not 0.0 < checks.fraction("confidence", confidence) < 1.0:
        raise ValueError(f"confidence is {confidence:g}; expected more than 0 and less than 1")
    for name, value, least in (("resamples", resamples, FEWEST_RESAMPLES), ("seed", seed, 0)):
        whole = isinstance(value, (int, np.integer)) and not isinstance(value, bool)
        if not whole or value < least:
            raise ValueError(f"{name} is {short(value)}; expected a whole number from {least} on")
    if resamples > MOST_RESAMPLES:
        raise ValueError(f"resamples is {resamples}; expected at most {MOST_RESAMPLES}")


def _named(structures: object) -> list[tuple[str, str | int, Any]]:
    """Return the name, the key or place, and the structure of each."""
    found: list[tuple[str, str | int, Any]]
    if isinstance(structures, Mapping):
        found = [(name, name, structure) for name, structure in structures.items()]
    elif isinstance(structures, Sequence) and not isinstance(structures, str):
        found = [
            (f"{type(structure).__name__} {place + 1}", place, structure)
            for place, structure in enumerate(structures)
        ]
    else:
        raise ValueError(
            f"structures is {short(structures)}; expected a mapping from names to structures, or a "
            "list of structures"
        )
    if not found:
        raise ValueError("structures is empty; expected at least one structure")
    for name, _, _ in found:
        if not isinstance(name, str):
            raise ValueError(f"structures has the name {name!r}; expected a text")
    return found


def _block(called: str, structure: Any) -> RockingBlock:
    if isinstance(structure, type) or not callable(getattr(structure, "block", None)):
        raise ValueError(
            f"{called} is {short(structure)}; expected a structure, for example "
            "Column.of_dimensions(width=1.6, height=9.6)"
        )
    try:
        found = structure.block()
    except ValueError as error:
        raise ValueError(f"{called}: {error}") from None
    if not isinstance(found, RockingBlock):
        raise ValueError(f"{called}: block() gives {short(found)}; expected a RockingBlock")
    return found
