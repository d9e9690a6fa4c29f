"""Which factors on a ground motion overturn a structure: given factors, or intervals of them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from topheavy import checks
from topheavy.bodies.structures import Structure, as_block
from topheavy.ground.excitation import Excitation, no_excitation
from topheavy.ground.pulses import Pulse
from topheavy.ground.records import Record
from topheavy.ground.vertical import both_records, refuse_fall
from topheavy.kernel.grid import outcomes_of
from topheavy.kernel.step import TOLERANCE
from topheavy.kernel.taylor import Oscillator, oscillator
from topheavy.outcomes.simulate import Shaking, as_shaking, checked_tolerance

SURVIVES = -1
"""Label of a factor that is survived; one that overturns is labelled by its impacts."""

MIN_INTERVAL = 1.0 / 1024.0
"""Of the resolution: intervals narrower than this are left inside a bracket."""

BRACKET = 1e-10
"""Width of the brackets, over the larger end of the range."""

Factors = NDArray[np.float64]
Indices = NDArray[np.int64]


class Subject(NamedTuple):
    """A block under a motion, as the kernel takes both."""

    block: Oscillator
    motion: Shaking
    scale: float
    scale_vertical: bool


def overturned_by(
    structure: Structure | Sequence[Structure],
    excitation: Excitation,
    factors: ArrayLike,
    *,
    tolerance: float = TOLERANCE,
    vertical: Record | None = None,
    scale_vertical: bool = True,
) -> NDArray[np.bool_]:
    """Return which factors on an excitation overturn a structure, or each of several.

    The outcomes equal those of `judge` for `excitation.scaled(factor)`.

    Parameters
    ----------
    structure : Structure, or a sequence of m structures
        RockingBlock, Column, RockingFrame, FixedMassColumn or MonolithicPortal.
    excitation : Pulse or Record
        One that ends.
    factors : array_like, shape (n,)
        Not negative.
    tolerance : float
        As of `simulate`.
    vertical : Record, optional
        Vertical ground acceleration that starts with a record: g, positive upward.
    scale_vertical : bool
        Whether the factors multiply the vertical acceleration, too.

    Returns
    -------
    ndarray of bool, shape (n,), or (m, n) of several structures

    Raises
    ------
    ValueError
        For factors that are negative or not finite, for a harmonic, and for a vertical
        acceleration, with its factor, of −1 g or less.

    Examples
    --------
    >>> th.overturned_by(th.Column(0.5, 3.0), th.Pulse("one-sine", 1.0, 2.0), [0.15, 0.4])
    array([False,  True])
    """
    scales = checks.axis("factors", factors, zero_allowed=True)
    bound = checked_tolerance(tolerance)
    several = isinstance(structure, Sequence)
    structures = list(structure) if isinstance(structure, Sequence) else [structure]
    if not structures:
        raise ValueError("structure is an empty list; expected one or more structures")
    ends = (float(scales.min()), float(scales.max()))
    subjects = subjects_of(structures, excitation, ends, vertical, scale_vertical)
    which = np.repeat(np.arange(len(subjects)), scales.size)
    fell, _ = outcomes_by(subjects, which, np.tile(scales, len(subjects)), tolerance=bound)
    return fell.reshape(len(subjects), -1) if several else fell


@dataclass(frozen=True)
class Interval:
    """An interval of factors that overturn, all after one number of impacts.

    Attributes
    ----------
    lower, upper : (float, float)
        Its ends, each as a pair of factors with the boundary between them. Where the range begins
        in the interval, `lower` is the first factor twice; where it ends in it, `upper` is None.
    impacts : int
        Before the fall: 0 is mode 2 of Zhang & Makris (2001).

    Examples
    --------
    >>> column, pulse = th.Column(0.5, 3.0), th.Pulse("one-sine", 1.0, 2.0)
    >>> *_, last = th.overturning_intervals(column, pulse, (0.1, 1.0), resolution=0.01)
    >>> last.upper is None
    True
    """

    lower: tuple[float, float]
    upper: tuple[float, float] | None
    impacts: int


def overturning_intervals(
    structure: Structure,
    excitation: Excitation,
    scale_range: tuple[float, float],
    *,
    resolution: float,
    most_impacts: int | None = None,
    vertical: Record | None = None,
    scale_vertical: bool = True,
) -> list[Interval]:
    """Return the intervals of the factor on an excitation that overturn a block.

    The range is searched on a uniform grid of a step not wider than `resolution`, so that an
    interval that is wider holds a point of the grid and cannot be missed. Each change between
    neighbours is then halved. A third outcome found on the way is an interval narrower than the
    resolution; it is kept, down to a thousandth of the resolution, where a bracket is left as wide
    as it is.

    Parameters
    ----------
    structure, excitation, vertical, scale_vertical
        As of `overturned_by`.
    scale_range : (float, float)
        The first and the last factor.
    resolution : float
        The width of the narrowest interval that must not be missed.
    most_impacts : int, optional
        Count impacts up to this number only: intervals with as many or more become one. The side
        lobes of a Ricker pulse set off long bounces, whose every number is an interval of its own.

    Returns
    -------
    list of Interval
        In ascending order. Neighbours with different numbers of impacts are separate; two with
        the same number that are less than the resolution apart may be returned as one.

    Raises
    ------
    ValueError
        For a range that does not ascend, a resolution that is not positive, a harmonic, or a
        vertical acceleration of −1 g or less at a factor of the range.

    Examples
    --------
    >>> column, pulse = th.Column(0.5, 3.0), th.Pulse("one-sine", 1.0, 2.0)
    >>> found = th.overturning_intervals(column, pulse, (0.1, 1.0), resolution=0.01)
    >>> [interval.impacts for interval in found]
    [1, 0]
    """
    grid = _grid(excitation, scale_range, resolution)
    subjects = subjects_of([structure], excitation, scale_range, vertical, scale_vertical)
    return _intervals(subjects, [grid], resolution, most_impacts)[0]


def intervals_of_many(
    structures: Sequence[Structure],
    excitations: Sequence[Excitation],
    scale_ranges: Sequence[tuple[float, float]],
    *,
    resolution: float,
    most_impacts: int | None = None,
) -> list[list[Interval]]:
    """Return the `overturning_intervals` of several structures, each with its motion and range.

    Their histories run together, which takes a fifth of the time.
    """
    given = list(zip(structures, excitations, scale_ranges, strict=True))
    grids = [_grid(excitation, ends, resolution) for _, excitation, ends in given]
    subjects = [subjects_of([one], excitation, ends)[0] for one, excitation, ends in given]
    return _intervals(subjects, grids, resolution, most_impacts)


def checked_range(excitation: Excitation, scale_range: tuple[float, float]) -> tuple[float, float]:
    """Return the first and the last factor of a range, or raise ValueError for what is none."""
    ends = checks.numbers("scale_range", scale_range)
    if ends.shape != (2,):
        raise ValueError(
            f"scale_range has shape {ends.shape}; expected two factors, the first and the last"
        )
    first, last = (checks.finite("scale_range", value) for value in ends)
    if not first < last:
        raise ValueError(f"scale_range is ({first:.6g}, {last:.6g}); expected it to ascend")
    if isinstance(excitation, (Pulse, Record)):
        for factor in (first, last):
            excitation.scaled(factor)  # refuses what it cannot be
    return first, last


def _grid(excitation: Excitation, scale_range: tuple[float, float], resolution: float) -> Factors:
    """Return the factors that are tried first, of a range and a resolution that are accepted."""
    first, last = checked_range(excitation, scale_range)
    steps = (last - first) / checks.positive("resolution", resolution)
    checks.cells(
        f"resolution is {resolution:g} of {first:g} to {last:g}", math.ceil(min(steps, 1e18))
    )
    return np.linspace(first, last, max(2, math.ceil(steps) + 1))


def _intervals(
    subjects: Sequence[Subject],
    grids: Sequence[Factors],
    resolution: float,
    most_impacts: int | None,
) -> list[list[Interval]]:
    """Return the intervals of each subject from its grid; all halve their brackets at once."""
    most = np.iinfo(np.int64).max
    if most_impacts is not None:
        if not 0.0 <= checks.finite("most_impacts", most_impacts) == int(most_impacts):
            raise ValueError(f"most_impacts is {most_impacts}; expected a whole number from 0 on")
        most = int(most_impacts)

    def label(which: Indices, factors: Factors) -> Indices:
        fell, impacts = outcomes_by(subjects, which, factors)
        return np.where(fell, np.minimum(impacts, most), SURVIVES)

    which = np.repeat(np.arange(len(grids)), [grid.size for grid in grids])
    factors = np.concatenate(grids)
    labels = label(which, factors)
    (at,) = np.nonzero((which[1:] == which[:-1]) & (labels[1:] != labels[:-1]))
    of, low, high, below, above = (
        which[at],
        factors[at],
        factors[at + 1],
        labels[at],
        labels[at + 1],
    )
    firsts = labels[np.searchsorted(which, np.arange(len(grids)))].tolist()
    width = BRACKET * np.array([np.abs(grid[[0, -1]]).max() for grid in grids])
    settled: list[tuple[Any, ...]] = []
    while True:
        middle = 0.5 * (low + high)
        is_open = (high - low > width[of]) & (low < middle) & (middle < high)
        found = np.full(of.size, SURVIVES)
        if is_open.any():
            found[is_open] = label(of[is_open], middle[is_open])
        between = (found != below) & (found != above)
        is_open &= ~between | (high - low > MIN_INTERVAL * resolution)
        settled += zip(*(a[~is_open].tolist() for a in (of, low, high, below, above)), strict=True)
        if not is_open.any():
            break
        left, right = is_open & (found != below), is_open & (found != above)
        of, low, high, below, above = (
            np.concatenate([a[left], b[right]])
            for a, b in ((of, of), (low, middle), (middle, high), (below, found), (found, above))
        )
    boundaries: list[list[Any]] = [[] for _ in grids]
    for number, *boundary in sorted(settled):
        boundaries[number].append(boundary)
    return [
        _between(float(grid[0]), first, found)
        for grid, first, found in zip(grids, firsts, boundaries, strict=True)
    ]


def _between(start: float, label: int, boundaries: Sequence[Sequence[Any]]) -> list[Interval]:
    """Return the intervals between boundaries, in a range whose first factor has a label."""
    intervals, begin = [], (start, start)
    for low, high, _, after in boundaries:
        if label != SURVIVES:
            intervals.append(Interval(begin, (low, high), label))
        begin, label = (low, high), after
    if label != SURVIVES:
        intervals.append(Interval(begin, None, label))
    return intervals


def subjects_of(
    structures: Sequence[Structure],
    excitation: Excitation,
    scale_range: tuple[float, float],
    vertical: Record | None = None,
    scale_vertical: bool = True,
) -> list[Subject]:
    """Return structures under one motion as the kernel takes them; refuse what it cannot take."""
    blocks = [as_block(structure) for structure in structures]
    if excitation is None:
        raise no_excitation(excitation)
    if isinstance(excitation, Pulse) and excitation.duration == math.inf:
        raise ValueError("shape is 'harmonic', which goes on forever; expected a pulse that ends")
    if vertical is not None:
        _, up = both_records(excitation, vertical)
        refuse_fall(up, scale_range if scale_vertical else 1.0)
    motion = as_shaking(excitation, vertical)
    return [Subject(oscillator(b), motion, motion.scale(b), scale_vertical) for b in blocks]


def outcomes_by(
    subjects: Sequence[Subject],
    which: Indices,
    factors: Factors,
    *,
    tolerance: float = TOLERANCE,
    in_full: bool = False,
) -> tuple[NDArray[np.bool_], Indices]:
    """Return whether each factor overturns its subject, by its place in `subjects`, and impacts.

    Unless `in_full`, the impacts of a subject that survives may be those of a part of the record.
    """
    overturned, impacts = np.empty(which.size, bool), np.empty(which.size, np.int64)
    motions: dict[tuple[int, int], list[int]] = {}  # pulses of a shape, or one record
    for number, (_, motion, *_) in enumerate(subjects):
        motions.setdefault((motion.shape, id(motion.record)), []).append(number)
    of_motion = np.empty(len(subjects), np.int64)
    for group, members in enumerate(motions.values()):
        of_motion[members] = group
    scale = np.array([subject.scale for subject in subjects])
    amplitude = np.array([subject.motion.amplitude for subject in subjects])
    scales_vertical = np.array([subject.scale_vertical for subject in subjects])
    blocks = [subject.block for subject in subjects]
    for group, members in enumerate(motions.values()):
        (at,) = np.nonzero(of_motion[which] == group)
        of, motion = which[at], subjects[members[0]].motion
        _, overturned[at], impacts[at] = outcomes_of(
            blocks,
            motion.shape,
            of,
            scale[of],
            amplitude[of] * factors[at],
            motion.record,
            lifts=np.where(scales_vertical[of], factors[at], 1.0),
            tolerance=tolerance,
            in_full=in_full,
        )
    return overturned, impacts
