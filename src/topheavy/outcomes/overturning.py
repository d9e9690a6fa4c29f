"""Overturning maps, and the intervals of acceleration amplitude that overturn.

Histories run in the lanes of the CPU, whatever their structure: what is asked of several structures
or motions at once costs less than one after the other, and gives the same to the last bit.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Generator, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from topheavy import checks
from topheavy.bodies.structures import RockingBlock, Structure, as_block
from topheavy.checks import short
from topheavy.ground.excitation import Excitation, no_excitation
from topheavy.ground.pulses import Pulse, checked_shape
from topheavy.ground.records import Record
from topheavy.ground.vertical import both_records, refuse_fall
from topheavy.kernel.forcing import RECORD, SHAPES
from topheavy.kernel.grid import FEW_AT_ONCE, MANY_AT_ONCE, Outcomes, mixed_outcomes_of, outcomes_of
from topheavy.kernel.outcome import TOLERANCE
from topheavy.kernel.taylor import Oscillator, oscillator
from topheavy.outcomes.simulate import Shaking, as_shaking, checked_tolerance

if TYPE_CHECKING:
    import xarray

SAFE = -1
"""Label of a factor that is survived; one that overturns is labelled by its impacts."""

NARROWEST = 1.0 / 1024.0
"""Of the resolution: intervals narrower than this are left inside a bracket."""

BRACKET = 1e-10
"""Width of the brackets, over the larger end of the range."""

MOST_HALVINGS = 64
"""The range is at most twice its larger end wide, and 2/`BRACKET` < 2³⁵: 35 rounds are enough."""


Factors = NDArray[np.float64]
Boundary = tuple[float, float, int, int]  # low, high, label below, label above
Answer = TypeVar("Answer")


def overturning_map(
    structure: Structure, shape: str, angular_frequencies: ArrayLike, amplitudes: ArrayLike
) -> xarray.Dataset:
    """Return which pulses overturn a block, and how far it rocks under the others.

    Parameters
    ----------
    structure : Structure
        RockingBlock, Column, RockingFrame, FixedMassColumn or MonolithicPortal.
    shape : str
        A shape of `Pulse` that ends ("harmonic" does not).
    angular_frequencies : array_like
        ω in rad/s, positive.
    amplitudes : array_like
        In g, not negative.

    Returns
    -------
    xarray.Dataset
        peak_rotation (rad, NaN where overturned), overturned and impacts, over
        (angular_frequency, amplitude). As of `judge`, but for what both leave out of the peak: it
        differs by 1e-10 α or so.

    Examples
    --------
    >>> found = th.overturning_map(th.Column(0.5, 3.0), "one-sine", [2.0, 4.0], [0.2, 0.4, 0.8])
    >>> found.overturned.values
    array([[ True,  True,  True],
           [False,  True,  True]])
    """
    block = as_block(structure)
    if checked_shape(shape) == "harmonic":
        raise ValueError("shape is 'harmonic', which goes on forever; expected a pulse that ends")
    frequencies = checks.axis("angular_frequencies", angular_frequencies, zero_allowed=False)
    amplitudes = checks.axis("amplitudes", amplitudes, zero_allowed=True)
    checks.acceleration("the largest of amplitudes", amplitudes.max())
    checks.cells("angular_frequencies by amplitudes", frequencies.size, amplitudes.size)
    scales = frequencies / block.frequency_parameter
    return outcomes_dataset(
        block,
        outcomes_of(oscillator(block), SHAPES[shape], scales, amplitudes),
        {
            "angular_frequency": ("angular_frequency", frequencies, {"units": "rad/s"}),
            "amplitude": ("amplitude", amplitudes, {"units": "g"}),
        },
        shape=shape,
        frequency_parameter=block.frequency_parameter,
    )


def outcomes_dataset(
    block: RockingBlock,
    outcomes: Outcomes,
    coordinates: dict[str, tuple[str, NDArray[np.float64], dict[str, str]]],
    **attributes: str | float,
) -> xarray.Dataset:
    """Return the outcomes of `outcomes_of` over its first two coordinates, with their units."""
    import xarray  # here: with pandas it takes a second that only maps need

    dims = tuple(coordinates)[:2]
    peak, overturned, impacts = outcomes
    return xarray.Dataset(
        {
            "peak_rotation": (dims, peak, {"units": "rad", "long_name": "largest |θ|"}),
            "overturned": (dims, overturned, {"units": "1"}),
            "impacts": (dims, impacts, {"units": "1", "long_name": "number of impacts"}),
        },
        coords=coordinates,
        attrs=attributes
        | {
            "slenderness": block.slenderness,
            "restitution": block.restitution,
            "linearised": int(block.linearised),
        },
    )


class Search(NamedTuple):
    """A search of factors: `overturning_intervals` and `minimum_overturning` have one each.

    >>> th.Search(th.Column(0.5, 3.0), th.Pulse("one-sine", 1.0, 2.0), (0.1, 1.0)).scale_range
    (0.1, 1.0)
    """

    structure: Structure
    excitation: Excitation
    scale_range: tuple[float, float]
    vertical: Record | None = None
    scale_vertical: bool = True


def overturned_by(
    structure: Structure,
    excitation: Excitation,
    factors: ArrayLike,
    *,
    tolerance: float = TOLERANCE,
    vertical: Record | None = None,
    scale_vertical: bool = True,
) -> NDArray[np.bool_]:
    """Return which factors on an excitation overturn a block: those of a fragility curve.

    The outcomes equal those of `judge` for `excitation.scaled(factor)`; common parts are prepared
    only once.

    Parameters
    ----------
    structure : Structure
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
    ndarray of bool, shape (n,)

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
    return outcomes_by(
        structure,
        excitation,
        factors,
        tolerance=tolerance,
        vertical=vertical,
        scale_vertical=scale_vertical,
        in_full=False,
    )[0]


def outcomes_by(
    structure: Structure,
    excitation: Excitation,
    factors: ArrayLike,
    *,
    tolerance: float = TOLERANCE,
    vertical: Record | None = None,
    scale_vertical: bool = True,
    in_full: bool = True,
) -> tuple[NDArray[np.bool_], NDArray[np.int64]]:
    """Return which factors on an excitation overturn a block, and its impacts under each.

    Parameters and errors are those of `overturned_by`; `in_full` is as of `mixed_outcomes_of`.

    Returns
    -------
    overturned, impacts : ndarray, shape (n,)
        The impacts before it overturns or the forcing ends and it rests.
    """
    scales = checks.axis("factors", factors, zero_allowed=True)
    ends = (float(scales.min()), float(scales.max()))
    subjects = subjects_of([Search(structure, excitation, ends, vertical, scale_vertical)])
    bound = checked_tolerance(tolerance)
    return outcomes_of_subjects(subjects, [scales], bound, in_full=in_full)[0]


def overturned_together(
    structures: Sequence[Structure],
    excitation: Excitation,
    factors: ArrayLike,
    *,
    tolerance: float = TOLERANCE,
    vertical: Record | None = None,
    scale_vertical: bool = True,
) -> NDArray[np.bool_]:
    """Return which factors on one excitation overturn each of several structures.

    Parameters
    ----------
    structures : sequence of Structure
        Of any kinds, m of them.
    factors : array_like, shape (n,) or (m, n)
        The same for all, or a row for each; the rest is as of `overturned_by`.

    Returns
    -------
    ndarray of bool, shape (m, n)

    Raises
    ------
    ValueError
        For no structures, as many rows of factors as there are not structures, and as
        `overturned_by`.

    Examples
    --------
    >>> structures = [th.Column(0.5, 3.0), th.Column(1.0, 6.0)]
    >>> th.overturned_together(structures, th.Pulse("one-sine", 1.0, 2.0), [0.2, 0.4])
    array([[ True,  True],
           [ True,  True]])
    """
    structures = _several("structures", structures)
    given = np.atleast_1d(checks.numbers("factors", factors))
    if given.ndim > 2 or (given.ndim == 2 and len(given) != len(structures)):
        raise ValueError(
            f"factors has shape {given.shape}; expected a list of them, or a row for each of the "
            f"{len(structures)} structures"
        )
    rows = [
        checks.axis("factors", row, zero_allowed=True)
        for row in np.broadcast_to(given, (len(structures), given.shape[-1]))
    ]
    subjects = subjects_of(
        [
            Search(one, excitation, (float(row.min()), float(row.max())), vertical, scale_vertical)
            for one, row in zip(structures, rows, strict=True)
        ]
    )
    found = outcomes_of_subjects(subjects, rows, checked_tolerance(tolerance))
    return np.array([overturned for overturned, _ in found])


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
    neighbours is then halved, all at once. A third outcome found on the way is an interval
    narrower than the resolution; it is kept, down to a thousandth of the resolution, where a
    bracket is left as wide as it is.

    Parameters
    ----------
    structure : Structure
        RockingBlock, Column, RockingFrame, FixedMassColumn or MonolithicPortal.
    excitation : Pulse or Record
    scale_range : (float, float)
        The first and the last factor.
    resolution : float
        The width of the narrowest interval that must not be missed.
    most_impacts : int, optional
        Count impacts up to this number only: intervals with as many or more become one. The side
        lobes of a Ricker pulse set off long bounces, whose every number is an interval of its own.
    vertical : Record, optional
        Vertical ground acceleration that starts with a record: g, positive upward.
    scale_vertical : bool
        Whether the factors multiply the vertical acceleration, too.

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
    search = Search(structure, excitation, scale_range, vertical, scale_vertical)
    most = _most(most_impacts)
    (found,) = _answered([search], lambda grid: _intervals(grid, resolution), resolution, most)
    return found


def intervals_together(
    searches: Sequence[Search], *, resolution: float, most_impacts: int | None = None
) -> list[list[Interval]]:
    """Return the `overturning_intervals` of several searches, in their order.

    >>> search = th.Search(th.Column(0.5, 3.0), th.Pulse("one-sine", 1.0, 2.0), (0.1, 1.0))
    >>> [len(found) for found in th.intervals_together([search], resolution=0.01)]
    [2]
    """
    return _answered(
        _several("searches", searches),
        lambda grid: _intervals(grid, resolution),
        resolution,
        _most(most_impacts),
    )


def minimum_overturning(
    structure: Structure,
    excitation: Excitation,
    scale_range: tuple[float, float],
    *,
    resolution: float,
    vertical: Record | None = None,
    scale_vertical: bool = True,
) -> tuple[float, float] | None:
    """Return a bracket of the lowest factor on an excitation that overturns a block.

    It is the lower end of the first of `overturning_intervals`, of which the others are not sought;
    parameters and errors are those. The bracket is narrow, but it belongs to the resolution: a
    narrower interval may overturn below it, above all under a record. State the resolution with
    the minimum; `topheavy.lowest_overturning` halves it down to a floor and reports each step.

    Returns
    -------
    (float, float), or None
        The first factor twice where that overturns; None where no factor does.

    Examples
    --------
    >>> column, pulse = th.Column(0.5, 3.0), th.Pulse("one-sine", 1.0, 2.0)
    >>> low, high = th.minimum_overturning(column, pulse, (0.1, 1.0), resolution=0.01)
    >>> round(low, 6)
    0.191798
    """
    search = Search(structure, excitation, scale_range, vertical, scale_vertical)
    (found,) = _answered([search], lambda grid: _minimum(grid, resolution), resolution, 0)
    return found


def minima_together(
    searches: Sequence[Search], *, resolution: float
) -> list[tuple[float, float] | None]:
    """Return the `minimum_overturning` of several searches, in their order.

    >>> search = th.Search(th.Column(0.5, 3.0), th.Pulse("one-sine", 1.0, 2.0), (0.1, 1.0))
    >>> [round(low, 6) for low, high in th.minima_together([search], resolution=0.01)]
    [0.191798]
    """
    given = _several("searches", searches)
    return _answered(given, lambda grid: _minimum(grid, resolution), resolution, 0)


def _several(name: str, values: Sequence[Any]) -> list[Any]:
    if not isinstance(values, Iterable):
        raise ValueError(f"{name} is {short(values)}; expected a list of one or more")
    if not (found := list(values)):
        raise ValueError(f"{name} is empty; expected one or more")
    return found


def _most(most_impacts: int | None) -> int:
    if most_impacts is None:
        return int(np.iinfo(np.int64).max)
    if not 0.0 <= checks.finite("most_impacts", most_impacts) == int(most_impacts):
        raise ValueError(f"most_impacts is {most_impacts}; expected a whole number from 0 on")
    return int(most_impacts)


def _grid(search: Search, resolution: float) -> Factors:
    """Return the factors that are tried first, of a range and a resolution that are accepted."""
    first, last = checked_range(search.excitation, search.scale_range)
    steps = (last - first) / checks.positive("resolution", resolution)
    checks.cells(
        f"resolution is {resolution:g} of {first:g} to {last:g}", math.ceil(min(steps, 1e18))
    )
    return np.linspace(first, last, max(2, math.ceil(steps) + 1))


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


def _width(grid: Factors) -> float:
    """Return the width of the brackets of boundaries on a grid."""
    return BRACKET * float(np.abs(grid[[0, -1]]).max())


# What a search asks, and in which order -----------------------------------------------------------


class Asked(NamedTuple):
    """The factors whose labels a search waits for; they are the middles of brackets, or none."""

    factors: Factors
    brackets: list[tuple[float, float]]


def _intervals(grid: Factors, resolution: float) -> Generator[Asked, Any, list[Interval]]:
    """Yield the factors that `overturning_intervals` needs; return its intervals."""
    first = float(grid[0])
    labels = yield Asked(grid, [])
    changes = np.flatnonzero(labels[1:] != labels[:-1])
    given = [(grid[i], grid[i + 1], labels[i], labels[i + 1]) for i in changes]
    boundaries = yield from _halved(given, _width(grid), NARROWEST * resolution)
    intervals, begin, current = [], (first, first), labels[0]
    for low, high, _, after in boundaries:
        if current != SAFE:
            intervals.append(Interval(begin, (low, high), int(current)))
        begin, current = (low, high), after
    if current != SAFE:
        intervals.append(Interval(begin, None, int(current)))
    return intervals


def _minimum(grid: Factors, resolution: float) -> Generator[Asked, Any, tuple[float, float] | None]:
    """Yield the factors that `minimum_overturning` needs; return its bracket."""
    for begin in range(0, grid.size, MANY_AT_ONCE):
        overturns = (yield Asked(grid[begin : begin + MANY_AT_ONCE], [])) != SAFE
        if overturns.any():
            at = begin + int(np.argmax(overturns))
            break
    else:
        return None
    if at == 0:
        return float(grid[0]), float(grid[0])
    bracket = [(grid[at - 1], grid[at], SAFE, 0)]
    ((low, high, *_),) = yield from _halved(bracket, _width(grid), NARROWEST * resolution)
    return low, high


def _halved(
    boundaries: list[Boundary], width: float, narrowest: float
) -> Generator[Asked, Any, list[Boundary]]:
    """Return the boundaries (low, high, label below, label above), halved down to `width`."""
    done: list[Boundary] = []
    for _ in range(MOST_HALVINGS):
        open_ones: list[Boundary] = []
        for boundary in boundaries:
            low, high = boundary[:2]
            settled = high - low <= width or not low < 0.5 * (low + high) < high
            (done if settled else open_ones).append(boundary)
        if not open_ones:
            return sorted((float(a), float(b), int(c), int(d)) for a, b, c, d in done)
        middles = [0.5 * (low + high) for low, high, _, _ in open_ones]
        labels = yield Asked(np.array(middles), [(low, high) for low, high, _, _ in open_ones])
        boundaries = []
        for (low, high, below, above), middle, found in zip(
            open_ones, middles, labels, strict=True
        ):
            if found == below:
                boundaries.append((middle, high, below, above))
            elif found == above:
                boundaries.append((low, middle, below, above))
            elif high - low > narrowest:
                boundaries += [(low, middle, below, found), (middle, high, found, above)]
            else:
                done.append((low, high, below, above))
    raise ArithmeticError(
        f"{len(boundaries)} boundaries are not settled after {MOST_HALVINGS} halvings, among them "
        f"that from {boundaries[0][0]!r} to {boundaries[0][1]!r}; expected brackets of {width:g}"
    )


# What answers all searches together ---------------------------------------------------------------


class _Subject(NamedTuple):
    """A block under a motion, as the kernel takes both."""

    block: Oscillator
    shaking: Shaking
    scale: float
    scale_vertical: bool


def _answered(
    searches: Sequence[Search],
    begin: Callable[[Factors], Generator[Asked, Any, Answer]],
    resolution: float,
    most_impacts: int,
) -> list[Answer]:
    """Return what each search returns; `begin` makes it from its first factors."""
    asking = [begin(_grid(search, resolution)) for search in searches]
    subjects = subjects_of(searches)

    def label(asked: Mapping[int, Factors]) -> list[NDArray[np.int64]]:
        found = outcomes_of_subjects(
            [subjects[number] for number in asked], [*asked.values()], TOLERANCE
        )
        return [np.where(fell, np.minimum(count, most_impacts), SAFE) for fell, count in found]

    return steered(asking, label)


def steered(
    asking: Sequence[Generator[Asked, Any, Answer]],
    label: Callable[[Mapping[int, Factors]], Sequence[NDArray[Any]]],
) -> list[Answer]:
    """Return what each search returns; `label` labels factors of several, by their numbers.

    The factors that all searches wait for are labelled together. Where they are few, several
    halvings ahead are labelled with them, whichever halves they will turn out to take.
    """
    answers: dict[int, Answer] = {}
    known: dict[int, Mapping[float, int]] = {}  # halvings ahead, by the number of the search
    waiting = {number: next(search) for number, search in enumerate(asking)}
    while waiting:
        missing = {
            number: asked
            for number, asked in waiting.items()
            if number not in known or not known[number].keys() >= set(asked.factors.tolist())
        }
        count = sum(len(asked.brackets) for asked in missing.values())
        depth = max(1, int(math.log2(FEW_AT_ONCE / max(count, 1) + 1)))
        ahead = {
            number: np.array([factor for one in asked.brackets for factor in halvings(*one, depth)])
            if asked.brackets and depth > 1
            else asked.factors
            for number, asked in missing.items()
        }
        found = dict(zip(ahead, label(ahead), strict=True))
        for number, asked in list(waiting.items()):
            labels = found.get(number)
            if labels is None or ahead[number] is not asked.factors:
                if labels is not None:
                    pairs = zip(ahead[number].tolist(), labels.tolist(), strict=True)
                    known[number] = dict(pairs)
                labels = np.array([known[number][factor] for factor in asked.factors.tolist()])
            try:
                waiting[number] = asking[number].send(labels)
            except StopIteration as end:
                answers[number] = end.value
                del waiting[number]
    return [answers[number] for number in range(len(asking))]


def subjects_of(searches: Sequence[Search]) -> list[_Subject]:
    """Return blocks and motions as the kernel takes them; each motion is prepared but once."""
    prepared: dict[tuple[int, int], Shaking] = {}
    subjects = []
    for search in searches:
        block, excitation, vertical = as_block(search.structure), search.excitation, search.vertical
        if vertical is not None:
            _, up = both_records(excitation, vertical)
            refuse_fall(up, search.scale_range if search.scale_vertical else 1.0)
        key = (id(excitation), id(vertical))
        if key not in prepared:
            prepared[key] = _ending(excitation, vertical)
        shaking = prepared[key]
        scale = shaking.scale(block)
        subjects.append(_Subject(oscillator(block), shaking, scale, search.scale_vertical))
    return subjects


def outcomes_of_subjects(
    subjects: Sequence[_Subject],
    factors: Sequence[Factors],
    tolerance: float,
    *,
    in_full: bool = False,
) -> list[tuple[NDArray[np.bool_], NDArray[np.int64]]]:
    """Return which factors overturn each subject, and its impacts; each has factors of its own.

    Unless `in_full`, the impacts of a subject that survives may be those of a part of the record.
    Histories under one record, or under pulses of one shape, run together.
    """
    groups: dict[tuple[int, int], list[int]] = {}
    for number, (_, shaking, *_) in enumerate(subjects):
        record = id(shaking.record) if shaking.shape == RECORD else 0
        groups.setdefault((shaking.shape, record), []).append(number)
    found: dict[int, tuple[NDArray[np.bool_], NDArray[np.int64]]] = {}
    for (shape, _), members in groups.items():
        alike = [subjects[number] for number in members]
        given = [factors[number] for number in members]
        sizes = [each.size for each in given]
        pairs = list(zip(alike, given, strict=True))
        _, overturned, impacts = mixed_outcomes_of(
            [subject.block for subject in alike],
            shape,
            np.repeat(np.arange(len(alike)), sizes),
            np.repeat([subject.scale for subject in alike], sizes),
            np.concatenate([subject.shaking.amplitude * each for subject, each in pairs]),
            alike[0].shaking.record,
            lifts=np.concatenate(
                [each if subject.scale_vertical else np.ones_like(each) for subject, each in pairs]
            ),
            tolerance=tolerance,
            in_full=in_full,
        )
        cuts = np.cumsum(sizes)[:-1]
        found_here = zip(np.split(overturned, cuts), np.split(impacts, cuts), strict=True)
        found |= dict(zip(members, found_here, strict=True))
    return [found[number] for number in range(len(subjects))]


def _ending(excitation: Excitation, vertical: Record | None) -> Shaking:
    """Return an excitation as the kernel takes it, if it is one and ends."""
    if excitation is None:
        raise no_excitation(excitation)
    if isinstance(excitation, Pulse) and excitation.duration == math.inf:
        raise ValueError("shape is 'harmonic', which goes on forever; expected a pulse that ends")
    return as_shaking(excitation, vertical)


def halvings(low: float, high: float, depth: int) -> list[float]:
    """Return the middle of a bracket, and those of its halves, down to `depth`.

    The kernel judges many factors in little more time than one: let it judge them together.
    """
    middle = 0.5 * (low + high)
    if depth == 1:
        return [middle]
    below, above = halvings(low, middle, depth - 1), halvings(middle, high, depth - 1)
    return [middle, *below, *above]
