"""Overturning maps, and the intervals of acceleration amplitude that overturn."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from topheavy import checks
from topheavy.excitation import Excitation
from topheavy.kernel.forcing import SHAPES
from topheavy.kernel.grid import LANES, outcomes_of
from topheavy.kernel.outcome import TOLERANCE
from topheavy.kernel.taylor import oscillator
from topheavy.pulses import Pulse, checked_shape
from topheavy.records import Record
from topheavy.simulate import as_forcing, checked_tolerance, no_excitation
from topheavy.structures import RockingBlock, Structure

if TYPE_CHECKING:
    import xarray

SAFE = -1
"""Label of a factor that is survived; one that overturns is labelled by its impacts."""

NARROWEST = 1.0 / 1024.0
"""Of the resolution: intervals narrower than this are left inside a bracket."""

BRACKET = 1e-10
"""Width of the brackets, over the larger end of the range."""

TOGETHER = 2 * LANES
"""Factors that are labelled at a time where boundaries are halved."""

AT_A_TIME = 16 * LANES
"""Factors that are labelled at a time where only the first that overturns is sought."""

MOST_HALVINGS = 64
"""The range is at most twice its larger end wide, and 2/`BRACKET` < 2³⁵: 35 rounds are enough."""


def overturning_map(
    structure: Structure, shape: str, angular_frequencies: ArrayLike, amplitudes: ArrayLike
) -> "xarray.Dataset":
    """Return which pulses overturn a block, and how far it rocks under the others.

    Parameters
    ----------
    structure : RockingBlock, Column or RockingFrame
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
    """
    import xarray  # here: with pandas it takes a second that only maps need

    block = structure.block()
    if checked_shape(shape) == "harmonic":
        raise ValueError("shape is 'harmonic', which goes on forever; expected a pulse that ends")
    frequencies = _axis("angular_frequencies", angular_frequencies, zero_allowed=False)
    amplitudes = _axis("amplitudes", amplitudes, zero_allowed=True)
    checks.acceleration("the largest of amplitudes", amplitudes.max())
    scales = frequencies / block.frequency_parameter
    peak, overturned, impacts = outcomes_of(oscillator(block), SHAPES[shape], scales, amplitudes)
    dims = ("angular_frequency", "amplitude")
    return xarray.Dataset(
        {
            "peak_rotation": (dims, peak, {"units": "rad", "long_name": "largest |θ|"}),
            "overturned": (dims, overturned, {"units": "1"}),
            "impacts": (dims, impacts, {"units": "1", "long_name": "number of impacts"}),
        },
        coords={
            "angular_frequency": ("angular_frequency", frequencies, {"units": "rad/s"}),
            "amplitude": ("amplitude", amplitudes, {"units": "g"}),
        },
        attrs={
            "shape": shape,
            "frequency_parameter": block.frequency_parameter,
            "slenderness": block.slenderness,
            "restitution": block.restitution,
            "linearised": int(block.linearised),
        },
    )


def _axis(name: str, values: ArrayLike, *, zero_allowed: bool) -> NDArray[np.float64]:
    axis = np.atleast_1d(checks.numbers(name, values))
    if axis.ndim != 1 or axis.size == 0:
        raise ValueError(f"{name} has shape {axis.shape}; expected a list of numbers, not empty")
    if not np.isfinite(axis).all():
        raise ValueError(f"{name} holds {axis[~np.isfinite(axis)][0]}; expected finite numbers")
    if (axis < 0.0).any() or not (zero_allowed or axis.all()):
        sign = "negative" if zero_allowed else "zero or negative"
        raise ValueError(f"{name} goes down to {axis.min():.6g}; it cannot be {sign}")
    return axis


def overturned_by(
    structure: Structure,
    excitation: Excitation,
    factors: ArrayLike,
    *,
    tolerance: float = TOLERANCE,
) -> NDArray[np.bool_]:
    """Return which factors on an excitation overturn a block: those of a fragility curve.

    The outcomes equal those of `judge` for `excitation.scaled(factor)`; common parts are prepared
    only once.

    Parameters
    ----------
    structure : RockingBlock, Column or RockingFrame
    excitation : Pulse or Record
        One that ends.
    factors : array_like, shape (n,)
        Not negative.
    tolerance : float
        As of `simulate`.

    Returns
    -------
    ndarray of bool, shape (n,)

    Raises
    ------
    ValueError
        For factors that are negative or not finite, and for a harmonic.
    """
    return outcomes_by(structure, excitation, factors, tolerance=tolerance)[0]


def outcomes_by(
    structure: Structure,
    excitation: Excitation,
    factors: ArrayLike,
    *,
    tolerance: float = TOLERANCE,
) -> tuple[NDArray[np.bool_], NDArray[np.int64]]:
    """Return which factors on an excitation overturn a block, and its impacts under each.

    Parameters and errors are those of `overturned_by`.

    Returns
    -------
    overturned, impacts : ndarray, shape (n,)
        The impacts before it overturns or the forcing ends and it rests.
    """
    scales = _axis("factors", factors, zero_allowed=True)
    block = structure.block()
    shape, scale, amplitude, record = _ending_forcing(block, excitation)
    _, overturned, impacts = outcomes_of(
        oscillator(block),
        shape,
        np.array([scale]),
        amplitude * scales,
        record,
        tolerance=checked_tolerance(tolerance),
    )
    return overturned[0], impacts[0]


@dataclass(frozen=True)
class Interval:
    """Scales that overturn, with one number of impacts before.

    `lower` and `upper` are pairs (low, high) with the boundary between them. Where the range
    begins in an interval, `lower` is its first scale twice; where it ends in one, `upper` is None.
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
) -> list[Interval]:
    """Return the intervals of the factor on an excitation that overturn a block.

    The range is searched on a uniform grid of a step not wider than `resolution`, so that an
    interval that is wider holds a point of the grid and cannot be missed. Each change between
    neighbours is then halved, all at once. A third outcome found on the way is an interval
    narrower than the resolution; it is kept, down to a thousandth of the resolution, where a
    bracket is left as wide as it is.

    Parameters
    ----------
    structure : RockingBlock, Column or RockingFrame
    excitation : Pulse or Record
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
        For a range that does not ascend, a resolution that is not positive, or a harmonic.
    """
    grid = _grid(excitation, scale_range, resolution)
    first = float(grid[0])
    if most_impacts is not None and most_impacts < 0:
        raise ValueError(f"most_impacts is {most_impacts}; expected a number from 0 on")
    label = _labeller(structure, excitation, most_impacts)
    labels = label(grid)
    changes = np.flatnonzero(labels[1:] != labels[:-1])
    boundaries = _bisect(
        label,
        [(grid[i], grid[i + 1], labels[i], labels[i + 1]) for i in changes],
        _width(grid),
        NARROWEST * resolution,
    )
    intervals, begin, current = [], (first, first), labels[0]
    for low, high, _, after in boundaries:
        if current != SAFE:
            intervals.append(Interval(begin, (low, high), int(current)))
        begin, current = (low, high), after
    if current != SAFE:
        intervals.append(Interval(begin, None, int(current)))
    return intervals


def minimum_overturning(
    structure: Structure,
    excitation: Excitation,
    scale_range: tuple[float, float],
    *,
    resolution: float,
) -> tuple[float, float] | None:
    """Return a bracket of the lowest factor on an excitation that overturns a block.

    It is the lower end of the first of `overturning_intervals`, of which the others are not sought;
    parameters and errors are those.

    Returns
    -------
    (float, float), or None
        The first factor twice where that overturns; None where no factor does.
    """
    grid = _grid(excitation, scale_range, resolution)
    label = _labeller(structure, excitation, 0)
    for begin in range(0, grid.size, AT_A_TIME):
        overturns = label(grid[begin : begin + AT_A_TIME]) != SAFE
        if overturns.any():
            at = begin + int(np.argmax(overturns))
            break
    else:
        return None
    if at == 0:
        return float(grid[0]), float(grid[0])
    bracket = [(grid[at - 1], grid[at], SAFE, 0)]
    ((low, high, *_),) = _bisect(label, bracket, _width(grid), NARROWEST * resolution)
    return low, high


def _grid(
    excitation: Excitation, scale_range: tuple[float, float], resolution: float
) -> NDArray[np.float64]:
    """Return the factors that are tried first, of a range and a resolution that are accepted."""
    first, last = (checks.finite("scale_range", value) for value in scale_range)
    if not first < last:
        raise ValueError(f"scale_range is ({first:.6g}, {last:.6g}); expected it to ascend")
    checks.positive("resolution", resolution)
    if isinstance(excitation, (Pulse, Record)):
        for factor in (first, last):
            excitation.scaled(factor)  # refuses what it cannot be
    return np.linspace(first, last, max(2, math.ceil((last - first) / resolution) + 1))


def _width(grid: NDArray[np.float64]) -> float:
    """Return the width of the brackets of boundaries on a grid."""
    return BRACKET * float(np.abs(grid[[0, -1]]).max())


Labels = NDArray[np.int64]
Boundary = tuple[float, float, int, int]  # low, high, label below, label above


def _labeller(
    structure: Structure, excitation: Excitation, most_impacts: int | None
) -> Callable[[NDArray[np.float64]], Labels]:
    """Return the function that labels an array of factors."""
    block = structure.block()
    shape, scale, amplitude, record = _ending_forcing(block, excitation)
    most = np.iinfo(np.int64).max if most_impacts is None else most_impacts

    def label(factors: NDArray[np.float64]) -> Labels:
        _, overturned, impacts = outcomes_of(
            oscillator(block), shape, np.array([scale]), amplitude * factors, record
        )
        return np.where(overturned[0], np.minimum(impacts[0], most), SAFE)

    return label


def _ending_forcing(
    block: RockingBlock, excitation: Excitation
) -> tuple[int, float, float, NDArray[np.float64]]:
    """Return an excitation as the kernel takes it, if it is one and ends."""
    if excitation is None:
        raise no_excitation(excitation)
    if isinstance(excitation, Pulse) and excitation.duration == math.inf:
        raise ValueError("shape is 'harmonic', which goes on forever; expected a pulse that ends")
    return as_forcing(block, excitation)


def _bisect(
    label: Callable[[NDArray[np.float64]], Labels],
    boundaries: list[Boundary],
    width: float,
    narrowest: float,
) -> list[Boundary]:
    """Return the boundaries (low, high, label below, label above), halved down to `width`.

    Several halvings ahead are labelled at a time, whichever halves they will turn out to take.
    """
    done: list[Boundary] = []
    known: dict[float, int] = {}
    for _ in range(MOST_HALVINGS):
        open_ones: list[Boundary] = []
        for boundary in boundaries:
            low, high = boundary[:2]
            settled = high - low <= width or not low < 0.5 * (low + high) < high
            (done if settled else open_ones).append(boundary)
        if not open_ones:
            return sorted((float(a), float(b), int(c), int(d)) for a, b, c, d in done)
        middles = [0.5 * (low + high) for low, high, _, _ in open_ones]
        if not known.keys() >= set(middles):
            depth = max(1, int(math.log2(TOGETHER / len(open_ones) + 1)))
            ahead = [point for one in open_ones for point in halvings(*one[:2], depth)]
            known = dict(zip(ahead, label(np.array(ahead)), strict=True))
        boundaries = []
        for (low, high, below, above), middle in zip(open_ones, middles, strict=True):
            found = known[middle]
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


def halvings(low: float, high: float, depth: int) -> list[float]:
    """Return the middle of a bracket, and those of its halves, down to `depth`.

    The kernel judges many factors in little more time than one: let it judge them together.
    """
    middle = 0.5 * (low + high)
    if depth == 1:
        return [middle]
    below, above = halvings(low, middle, depth - 1), halvings(middle, high, depth - 1)
    return [middle, *below, *above]
