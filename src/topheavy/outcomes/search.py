"""Which factors on a ground motion overturn a structure, and how far it rocks under the others."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from topheavy import checks
from topheavy.bodies.structures import (
    RockingBlock,
    Structure,
    Structures,
    are_several,
    as_block,
    named_blocks,
)
from topheavy.ground.excitation import Excitation
from topheavy.ground.pulses import Pulse
from topheavy.ground.records import Record
from topheavy.kernel.grid import outcomes_of
from topheavy.kernel.step import TOLERANCE
from topheavy.kernel.taylor import IMPACTS, OUTCOME, PEAK, Oscillator, oscillator
from topheavy.outcomes.simulate import Shaking, checked_tolerance

if TYPE_CHECKING:
    import xarray

SURVIVES = -1
"""Label of a factor that the structure survives; the label of another is its number of impacts."""

MIN_INTERVAL = 1.0 / 1024.0
"""Normalised by the resolution: narrower intervals remain inside a bracket."""

BRACKET = 1e-10
"""Width of the brackets, normalised by their larger end."""

Factors = NDArray[np.float64]
Indices = NDArray[np.int64]
Outcomes = tuple[Factors, NDArray[np.bool_], Indices]


class Case(NamedTuple):
    """A block under a motion, as arguments of the kernel."""

    block: Oscillator
    motion: Shaking
    scale: float
    scale_vertical: bool


def overturned_by(
    structure: Structures,
    excitation: Pulse | Record,
    factors: ArrayLike,
    *,
    tolerance: float = TOLERANCE,
    vertical: Record | None = None,
    scale_vertical: bool = True,
) -> NDArray[np.bool_]:
    """Return which factors on a ground motion overturn a structure, or each of several structures.

    Parameters
    ----------
    structure : Structure, or m structures in a list or a mapping from names
    excitation : Pulse or Record
        One that ends.
    factors : array_like, shape (n,)
        Not negative.
    tolerance : float
        See `simulate`.
    vertical : Record, optional
        Vertical ground acceleration that starts with the record: g, positive upward.
    scale_vertical : bool
        Whether the factors also multiply the vertical acceleration.

    Returns
    -------
    ndarray of bool, shape (n,), or (m, n) for several structures

    Raises
    ------
    ValueError
        For factors that are negative or not finite, for a harmonic, and for a vertical
        acceleration, with its factor, of −1 g or less.

    Examples
    --------
    >>> pulse = th.Pulse("one-sine", 1.0, angular_frequency=2.0)
    >>> th.overturned_by(th.Column(0.5, 3.0), pulse, [0.15, 0.4])
    array([False,  True])
    """
    blocks = named_blocks(structure).values()
    _, overturned = peaks_and_outcomes(
        [*blocks], excitation, factors, tolerance, vertical, scale_vertical, OUTCOME
    )
    return overturned if are_several(structure) else overturned[0]


def peak_rotations(
    structure: Structures,
    excitation: Pulse | Record,
    factors: ArrayLike,
    *,
    tolerance: float = TOLERANCE,
    vertical: Record | None = None,
    scale_vertical: bool = True,
) -> xarray.DataArray:
    """Return max|θ| in rad under each factor on a ground motion; NaN where it overturns.

    Over the factors this is the curve of an incremental dynamic analysis (Vamvatsikos & Cornell
    2002). Parameters and errors are those of `overturned_by`.

    Returns
    -------
    xarray.DataArray
        Over the factor, or (structure, factor) for several structures, with the peak ground
        acceleration (g) of each factor and the slenderness (rad) of each structure.

    Examples
    --------
    >>> pier = th.Column.of_dimensions(width=1.6, height=9.6)  # m
    >>> structures = {"pier": pier, "bent": th.RockingFrame(pier, mass_ratio=2.0)}
    >>> record = th.read_record("data/records/el_centro_1940_NS.AT2")
    >>> peaks = th.peak_rotations(structures, record, np.linspace(0.5, 4.0, 71))
    >>> peaks.sel(factor=2.0).to_series().round(4).to_dict()
    {'pier': 0.0813, 'bent': 0.0305}
    >>> axes = th.plot.rotations(peaks)
    """
    import xarray

    blocks, scales = named_blocks(structure), checks.numbers("factors", factors).ravel()
    peaks, _ = peaks_and_outcomes(
        [*blocks.values()], excitation, factors, tolerance, vertical, scale_vertical
    )
    accelerations = excitation.peak_acceleration * scales
    name = "peak ground acceleration"
    result = xarray.DataArray(
        peaks,
        {
            "factor": scales,
            "peak_acceleration": ("factor", accelerations, {"units": "g", "long_name": name}),
        }
        | structure_coordinates(blocks),
        ("structure", "factor"),
        "peak_rotation",
        {"units": "rad", "long_name": "largest |θ|"},
    )
    return result if are_several(structure) else result.isel(structure=0)


def structure_coordinates(blocks: Mapping[str, RockingBlock]) -> dict[str, Any]:
    """Return names, slenderness and √r of structures as coordinates of a result."""
    slenderness = [block.slenderness for block in blocks.values()]
    return {
        "structure": [*blocks],
        "slenderness": ("structure", slenderness, {"units": "rad"}),
        "restitution": ("structure", [block.restitution for block in blocks.values()]),
    }


def peaks_and_outcomes(
    structures: Sequence[Structure],
    excitation: Excitation,
    factors: ArrayLike,
    tolerance: float = TOLERANCE,
    vertical: Record | None = None,
    scale_vertical: bool = True,
    detail: int = PEAK,
) -> tuple[Factors, NDArray[np.bool_]]:
    """Return peak rotation (rad) and overturning under each factor, shape (structures, factors)."""
    scales = checks.axis_values("factors", factors, zero_allowed=True)
    ends = (float(scales.min()), float(scales.max()))
    cases = cases_of(structures, excitation, ends, vertical, scale_vertical)
    peak, overturned, _ = outcomes_of_factors(
        cases,
        np.repeat(np.arange(len(cases)), scales.size),
        np.tile(scales, len(cases)),
        tolerance=checked_tolerance(tolerance),
        detail=detail,
    )
    shape = (len(cases), scales.size)
    return peak.reshape(shape), overturned.reshape(shape)


@dataclass(frozen=True)
class FactorInterval:
    """An interval of factors that overturn, all after the same number of impacts.

    Attributes
    ----------
    lower, upper : (float, float)
        Its ends, each as a pair of factors with the boundary between them. If the range begins in
        the interval, `lower` is the first factor twice; if it ends in it, `upper` is None.
    number_of_impacts : int
        Before overturning. 0 is mode 2 of Zhang & Makris (2001), 1 is their mode 1.

    Notes
    -----
    `overturned_by` does not count impacts and takes other steps, so that its boundaries may lie
    apart from these by the solver's error, which grows with the number of impacts.

    Examples
    --------
    >>> column, pulse = th.Column(0.5, 3.0), th.Pulse("one-sine", 1.0, angular_frequency=2.0)
    >>> *_, last = th.overturning_intervals(column, pulse, (0.1, 1.0), resolution=0.01)
    >>> last.upper is None
    True
    """

    lower: tuple[float, float]
    upper: tuple[float, float] | None
    number_of_impacts: int


def overturning_intervals(
    structure: Structure,
    excitation: Pulse | Record,
    scale_range: tuple[float, float],
    *,
    resolution: float,
    most_impacts: int | None = None,
    vertical: Record | None = None,
    scale_vertical: bool = True,
) -> list[FactorInterval]:
    """Return the intervals of the factor on a ground motion that overturn a structure.

    The search begins with a uniform grid. Each change of the outcome between neighbours is then
    halved. A third outcome in between is an interval narrower than the resolution. It is kept if
    it is wider than a thousandth of the resolution.

    Parameters
    ----------
    structure, excitation, vertical, scale_vertical
        See `overturned_by`.
    scale_range : (float, float)
        The first and the last factor; negative factors mirror the motion.
    resolution : float
        Largest step of the grid: no wider interval is missed.
    most_impacts : int, optional
        Count impacts only up to this number, so that intervals with as many or more become one.
        The side lobes of a Ricker pulse cause long bouncing, with an interval for every number.

    Returns
    -------
    list of FactorInterval
        In ascending order. Neighbours with different numbers of impacts are separate; two with
        the same number that are less than the resolution apart may be returned as one.

    Examples
    --------
    >>> column, pulse = th.Column(0.5, 3.0), th.Pulse("one-sine", 1.0, angular_frequency=2.0)
    >>> intervals = th.overturning_intervals(column, pulse, (0.1, 1.0), resolution=0.01)
    >>> [interval.number_of_impacts for interval in intervals]
    [1, 0]
    """
    grid = _grid(scale_range, resolution := checks.positive("resolution", resolution))
    cases = cases_of([structure], excitation, scale_range, vertical, scale_vertical)
    return intervals_on(cases, [grid], resolution, most_impacts)[0]


def intervals_of_many(
    structures: Sequence[Structure],
    excitations: Sequence[Excitation],
    scale_range: tuple[float, float],
    *,
    resolution: float,
    most_impacts: int | None = None,
    finer: tuple[float, float] | None = None,
) -> list[list[FactorInterval]]:
    """Return the `overturning_intervals` of several structures, each with its motion.

    `finer` is a factor and a resolution. Where the first interval begins below the factor, the
    range below this interval is searched again at the resolution: close to uplift, under long
    pulses, the lowest intervals are narrow.
    """
    pairs = list(zip(structures, excitations, strict=True))
    cases = [cases_of([structure], motion, scale_range)[0] for structure, motion in pairs]
    grids = [_grid(scale_range, resolution)] * len(cases)
    intervals = intervals_on(cases, grids, resolution, most_impacts)
    if finer:
        (below, resolution), first = finer, scale_range[0]
        ends = [some[0].lower[0] if some else math.inf for some in intervals]
        places = [place for place, end in enumerate(ends) if first < end < below]
        cases = [cases[place] for place in places]
        grids = [_grid((first, ends[place]), resolution) for place in places]
        lower = intervals_on(cases, grids, resolution, most_impacts)
        for place, some in zip(places, lower, strict=True):
            intervals[place] = some + intervals[place]
    return intervals


def checked_range(scale_range: tuple[float, float]) -> tuple[float, float]:
    """Return the first and the last factor of a range, or raise ValueError for any other value."""
    ends = checks.numbers("scale_range", scale_range)
    if ends.shape != (2,):
        raise ValueError(
            f"scale_range has shape {ends.shape}; expected two factors, the first and the last"
        )
    first, last = (checks.finite("scale_range", value) for value in ends)
    if not first < last:
        raise ValueError(f"scale_range is ({first:.6g}, {last:.6g}); expected it to ascend")
    return first, last


def steps_across(
    scale_range: tuple[float, float], name: str, width: float
) -> tuple[float, float, float]:
    """Return the first and the last factor of a range, and how many steps of a width it has."""
    first, last = checked_range(scale_range)
    steps = (last - first) / width
    checks.number_of_cells(
        f"{name} is {width:.6g} of {first:g} to {last:g}", math.ceil(min(steps, 1e18))
    )
    return first, last, steps


def _grid(scale_range: tuple[float, float], resolution: float) -> Factors:
    """Return the first factors of a search, in equal steps not wider than the resolution."""
    first, last, steps = steps_across(scale_range, "resolution", resolution)
    return np.linspace(first, last, max(2, math.ceil(steps) + 1))


def intervals_on(
    cases: Sequence[Case],
    grids: Sequence[Factors],
    resolution: float,
    most_impacts: int | None,
) -> list[list[FactorInterval]]:
    """Return the intervals of each case from its grid. All brackets are halved together."""
    if not grids:
        return []
    most = np.iinfo(np.int64).max
    if most_impacts is not None:
        most = min(most, checks.whole("most_impacts", most_impacts, 0))
    detail = OUTCOME if most <= 1 else IMPACTS

    def label(case_index: Indices, factors: Factors) -> Indices:
        _, overturned, impacts = outcomes_of_factors(cases, case_index, factors, detail=detail)
        return np.where(overturned, np.minimum(impacts, most), SURVIVES)

    case_index = np.repeat(np.arange(len(grids)), [grid.size for grid in grids])
    factors = np.concatenate(grids)
    labels = label(case_index, factors)
    (at,) = np.nonzero((case_index[1:] == case_index[:-1]) & (labels[1:] != labels[:-1]))
    case, low, high = case_index[at], factors[at], factors[at + 1]
    below, above = labels[at], labels[at + 1]
    brackets: list[tuple[Any, ...]] = []
    while True:
        middle = 0.5 * (low + high)
        width = BRACKET * np.maximum(np.abs(low), np.abs(high))
        is_open = (high - low > width) & (low < middle) & (middle < high)
        inside = np.full(case.size, SURVIVES)
        if is_open.any():
            inside[is_open] = label(case[is_open], middle[is_open])
        is_third = (inside != below) & (inside != above)
        is_open &= ~is_third | (high - low > MIN_INTERVAL * resolution)
        closed = (a[~is_open].tolist() for a in (case, low, high, below, above))
        brackets += zip(*closed, strict=True)
        if not is_open.any():
            break
        left, right = is_open & (inside != below), is_open & (inside != above)
        case, low, high, below, above = (
            np.concatenate([a[left], b[right]])
            for a, b in (
                (case, case),
                (low, middle),
                (middle, high),
                (below, inside),
                (inside, above),
            )
        )
    intervals: list[list[FactorInterval]] = [[] for _ in grids]
    begins = [(float(grid[0]), float(grid[0])) for grid in grids]
    last = labels[np.searchsorted(case_index, np.arange(len(grids)))].tolist()
    for number, *boundary, before, after in sorted(brackets):
        if before != SURVIVES:
            intervals[number].append(FactorInterval(begins[number], tuple(boundary), before))
        begins[number], last[number] = tuple(boundary), after
    for number, label_at_end in enumerate(last):
        if label_at_end != SURVIVES:
            intervals[number].append(FactorInterval(begins[number], None, label_at_end))
    return intervals


def cases_of(
    structures: Sequence[Structure],
    excitation: Excitation,
    scale_range: tuple[float, float],
    vertical: Record | None = None,
    scale_vertical: bool = True,
) -> list[Case]:
    """Return structures under a motion as arguments of the kernel, or raise ValueError."""
    blocks = [as_block(structure) for structure in structures]
    if isinstance(excitation, Pulse | Record):
        for factor in scale_range:
            excitation.scaled(factor)  # refuses a factor that is too large
    scale_vertical = checks.truth("scale_vertical", scale_vertical)
    motion = Shaking.of(excitation, vertical, factors=scale_range if scale_vertical else 1.0)
    return [Case(oscillator(b), motion, motion.scale(b), scale_vertical) for b in blocks]


def outcomes_of_factors(
    cases: Sequence[Case],
    case_index: Indices,
    factors: Factors,
    *,
    tolerance: float = TOLERANCE,
    detail: int = IMPACTS,
) -> Outcomes:
    """Return peak rotation, overturning and impacts of each factor on its case.

    `case_index` has the place of each factor's case in `cases`; `detail` is that of `outcomes_of`.
    """
    peak = np.empty(case_index.size)
    overturned, impacts = np.empty(case_index.size, bool), np.empty(case_index.size, np.int64)
    waveforms = [case.motion.waveform for case in cases]
    motions = [(each.wave, each.last_phase, id(each.record)) for each in waveforms]
    # The first case under the same record, or under pulses of the same shape and cycles.
    group = np.array([motions.index(motion) for motion in motions])
    scale = np.array([case.scale for case in cases])
    amplitude = np.array([case.motion.amplitude for case in cases])
    scales_vertical = np.array([case.scale_vertical for case in cases])
    blocks = [case.block for case in cases]
    for member in np.unique(group):
        (at,) = np.nonzero(group[case_index] == member)
        case = case_index[at]
        peak[at], overturned[at], impacts[at] = outcomes_of(
            blocks,
            waveforms[member],
            case,
            scale[case],
            amplitude[case] * factors[at],
            vertical_factors=np.where(scales_vertical[case], factors[at], 1.0),
            tolerance=tolerance,
            detail=detail,
        )
    return peak, overturned, impacts
