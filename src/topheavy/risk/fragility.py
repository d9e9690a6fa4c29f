"""Fragility of structures under scaled motions, from outcomes to curves, intervals and pairs."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Any, Literal

import numpy as np
import pandas
import xarray
from numpy.typing import ArrayLike, NDArray
from scipy.special import bdtr, betaincinv

from topheavy import checks
from topheavy.bodies.structures import RockingBlock, Structures, named_blocks
from topheavy.ground.pulses import Pulse
from topheavy.ground.records import Record
from topheavy.kernel.taylor import OUTCOME, PEAK
from topheavy.outcomes.search import peaks_and_outcomes
from topheavy.risk import inputs
from topheavy.risk.curve import curve, dispersions, fit, medians, points_between, rises_past
from topheavy.risk.resampling import Ensemble

Array = NDArray[np.float64]
Outcomes = NDArray[np.bool_]
Variables = dict[str, tuple[tuple[str, ...], Any]]


@dataclass(frozen=True, eq=False, repr=False)
class Fragility:
    """Probability of overturning of structures over the intensity of motions.

    If there is a rotation limit, every "overturn" below means a larger rotation than this limit.

    Attributes
    ----------
    curves : xarray.Dataset
        Over (structure, level): overturned, the number of motions; probability, with its exact
        interval probability_low, probability_high (Clopper & Pearson 1934); fitted, the curve.
        Over structure: term_a, term_b, term_c of the curve Φ(a + b ln s + c ln² s);
        median_capacity, in the unit of the levels, and dispersion, half of ln(s₈₄/s₁₆), with
        resampled intervals (dispersion_low, dispersion_high).
    pairs : xarray.Dataset
        Over (pair, level): less, the probability of the first structure less that of the second,
        with its resampled interval (less_low, less_high); only_first and only_second, the motions
        that overturn one of both alone; sign_test, the two-sided p-value of the exact test that
        these are equally likely. Over pair: gain, the median of the second over that of the first,
        less 1, with its resampled interval (gain_low, gain_high).
    outcomes : ndarray of bool, shape (motions, structures, levels)
        Which motions overturn each structure of `curves` at each level.
    measure : str
        Of the intensity.
    confidence : float
        Of each interval for itself, not of several together.
    factors : (float, float)
        The least and the greatest factor on a motion.
    rotation_limit : float or None
        rad.

    Examples
    --------
    >>> phases = 0.01 * np.pi * np.arange(201)
    >>> motions = [th.Record(0.02, 0.1 * np.sin(n * phases)) for n in (1, 2, 4, 8)]
    >>> result = th.fragility([th.Column(0.5, 3.0)], motions, [0.5, 1.0, 2.0], resamples=100)
    >>> result.curves.probability.values
    array([[0.  , 0.25, 0.5 ]])
    >>> result.to_frame().loc[:, ["structure", "level", "probability"]]
      structure  level  probability
    0  Column 1    0.5         0.00
    1  Column 1    1.0         0.25
    2  Column 1    2.0         0.50

    A measure Sa(T₁) in g, exact at eight times a sample for samples that straight lines join; here
    its value after 40 cycles of 0.1 g in resonance, which is 0.1/(2ζ) g:

    >>> from scipy.signal import lsim
    >>> def sa(motion, period=1.0, damping=0.05):
    ...     w = 2.0 * np.pi / period
    ...     oscillator = [[0, 1], [-w * w, -2 * damping * w]], [[0], [-1]], [[w * w, 0]], [[0]]
    ...     time = np.linspace(0, motion.duration, 8 * motion.time.size - 7)
    ...     return np.abs(lsim(oscillator, motion.accelerations(time), time)[1]).max()
    >>> round(float(sa(th.Record(0.01, 0.1 * np.sin(0.02 * np.pi * np.arange(4001))))), 2)
    1.0
    >>> th.fragility([th.Column(0.5, 3.0)], motions, [0.5, 1.0, 2.0], sa, resamples=100).measure
    'sa'
    """

    curves: xarray.Dataset
    pairs: xarray.Dataset
    outcomes: Outcomes
    measure: str
    confidence: float
    factors: tuple[float, float]
    rotation_limit: float | None = None

    def to_frame(self) -> pandas.DataFrame:
        """Return a table with a row for each structure and level: counts, probabilities, curve."""
        at_levels = [name for name, values in self.curves.items() if "level" in values.dims]
        return self.curves[at_levels].to_dataframe(["structure", "level"]).reset_index()

    def __repr__(self) -> str:
        """Return the median of each structure and the gain of each pair, with intervals.

        Of a median that is NaN it says why.
        """
        unit = self.curves.level.attrs.get("units", "")
        first, last = (f"{float(self.curves.level[at]):.4g}" for at in (0, -1))
        levels = f"{self.measure} from {first} to {last} {unit}".rstrip()
        motions = f"{self.outcomes.shape[0]} motions"
        scaled = "scaled by {:.3g} to {:.3g}".format(*self.factors)
        intervals = f"{self.confidence:.0%} intervals, sampling of {motions}"
        lines = [f"{motions}, {levels}, {scaled}; {intervals}"]
        for place in range(self.curves.sizes["structure"]):
            row = self.curves.isel(structure=place)
            why = self._why_no_median(row) if np.isnan(row.median_capacity) else ""
            median = _line(row, "median_capacity", unit, why)
            lines.append(f"{row.structure.item()}: median {median}")
        for place in range(self.pairs.sizes["pair"]):
            row = self.pairs.isel(pair=place)
            both = f"{row['second'].item()} over {row['first'].item()}"
            lines.append(f"{both}: gain {_line(row, 'gain', '', 'a median is')}")
        values = (self.curves, "median_capacity"), (self.pairs, "gain")
        ends = ((of[name], of[f"{name}_{end}"]) for of, name in values for end in ("low", "high"))
        if any((np.isnan(end) & ~np.isnan(value)).any() for value, end in ends):
            lines.append("unknown ends: too many resamples have no median; add levels or motions")
        return "\n".join(lines)

    def _why_no_median(self, row: xarray.Dataset) -> str:
        """Return in words why a structure, a row of `curves`, has no median."""
        share, event = row.probability.to_numpy(), "overturning"
        if self.rotation_limit is not None:
            event = "rotation beyond the limit"
        unit = self.curves.level.attrs.get("units", "")
        if share.min() == 1.0:
            is_in = f": levels are in {unit}" if unit else ""
            return f"{event} under all motions at every level{is_in}; begin lower"
        if share.max() == 0.0:
            return f"no {event} at any level; go higher"
        if len(self.outcomes) == 1:
            return "one motion has none; take more motions"
        terms = np.array([row[f"term_{name}"] for name in "abc"])
        if np.isnan(terms).any():
            between = int(points_between(share))
            return f"too few levels, {between}, with a probability between 0 and 1; take more"
        median = float(rises_past(0.5, terms))
        if math.isnan(median):
            return "the fitted curve does not rise past 1/2"
        return f"the fitted curve rises past 1/2 at {median:.3g}, outside the levels; add some"


def _line(row: xarray.Dataset, name: str, unit: str, why_unknown: str) -> str:
    """Return a value with its interval and unit, or why it is NaN."""
    values = (float(row[part]) for part in (name, f"{name}_low", f"{name}_high"))
    value, low, high = ("unknown" if math.isnan(x) else f"{x:.3g}" for x in values)
    interval = f"{value} ({low} to {high}) {unit}".strip()
    return f"unknown: {why_unknown}" if value == "unknown" else interval


def fragility(
    structures: Structures,
    motions: Sequence[Pulse | Record],
    levels: ArrayLike,
    measure: Literal["PGV", "PGA"] | Callable[[Any], float] = "PGV",
    *,
    vertical: Sequence[Record] | None = None,
    scale_vertical: bool = True,
    rotation_limit: float | None = None,
    skewed: bool = False,
    confidence: float = 0.95,
    resamples: int = 2000,
    seed: int = 0,
) -> Fragility:
    """Return the probability of overturning, or of a rotation, under motions scaled to levels.

    Each motion is scaled to each level of the intensity and acts on each structure. Resamples draw
    motions with all their outcomes: structures stay paired, and so do levels. The intervals are
    percentiles of resamples, which are too narrow for few motions. In a simulation, the 95 %
    interval of a median misses the true one in 11 % of samples of 7 motions and in 8 % of 40; that
    of a dispersion in 32 % and in 13 %. `sign_test` is exact for any number of motions.

    A curve is fitted where two levels at least (three if skewed) have a probability between 0 and
    1: choose levels from where no motion overturns up to where all do. A median is NaN if no curve
    is fitted or if it is outside the levels; an end of an interval is NaN if too many resamples
    have no value.

    OpenQuake (3.24.1) takes mean and standard deviation of the intensity itself: with the median m
    and the dispersion β these are m e^(β²/2), and √(e^(β²) − 1) of this mean. It has PGV in cm/s.
    Below its lowest level its probability stays what it is there, where a block does not uplift:
    export a discrete function whose first value is 0.

    Parameters
    ----------
    structures : Structure, or several in a list or a mapping from names
    motions : sequence of Record
        Also of Pulse, if measure is a function.
    levels : array_like, shape (n,)
        Of the intensity: positive and increasing. A motion may overturn a structure at one level
        and not at the next, so that medians depend on the levels; take fifty.
    measure : {"PGV", "PGA"} or callable
        PGV in m/s, integrated from rest without baseline correction; PGA in g; or a function that
        returns the intensity of a motion, in proportion to its scale: of Arias intensity, take the
        square root; of an intensity I = 2 log₁₀ a + c, 10^(I/2). `Fragility` has an example for
        Sa(T₁). Compare a package's spectrum with it: some return relative accelerations, which are
        in proportion too.
    vertical : sequence of Record, optional
        The vertical component of each motion, which starts with it: g, positive upward.
    scale_vertical : bool
        Whether a motion is scaled with its vertical component. The measure is that of the motion.
    rotation_limit : float, optional
        rad. The probability is then that of a larger |θ|; overturning counts as larger.
    skewed : bool
        Whether the curve has a term c ln² s. Otherwise it is lognormal.
    confidence : float
        Of the intervals.
    resamples, seed : int
        Of the intervals that are resampled.

    Returns
    -------
    Fragility

    Raises
    ------
    ValueError
        For an argument that is not as above, and for a vertical acceleration of −1 g or less at a
        level.

    Warns
    -----
    UserWarning
        If half of the levels are beyond what motions have in the unit of the measure, if a motion
        is there twice, and if one is scaled by more than 1000.

    Examples
    --------
    >>> column = th.Column.of_dimensions(width=1.0, height=6.0)  # m
    >>> structures = {"column": column, "frame": th.RockingFrame(column, mass_ratio=2.0)}
    >>> from pathlib import Path
    >>> paths = sorted(Path("data/records").glob("*[0S].AT2"))  # the horizontal components
    >>> motions = [th.read_record(path) for path in paths]
    >>> result = th.fragility(structures, motions, np.geomspace(0.3, 3.0, 50))  # PGV in m/s
    >>> print(result)
    7 motions, PGV from 0.3 to 3 m/s, scaled by 0.362 to 9.68; 95% intervals, sampling of 7 motions
    column: median 0.734 (0.648 to 0.823) m/s
    frame: median 1.01 (0.869 to 1.17) m/s
    frame over column: gain 0.376 (0.225 to 0.58)
    >>> axes = th.plot.fragility(result)
    """
    blocks = named_blocks(structures)
    shaking = inputs.checked_motions(motions)
    steps = inputs.checked_levels(levels, measure)
    confidence, resamples, seed = inputs.checked_resampling(confidence, resamples, seed)
    scales = inputs.scale_factors(steps, inputs.intensities(shaking, measure))
    ups = inputs.checked_vertical(vertical, len(shaking))
    skewed = checks.truth("skewed", skewed)
    scale_vertical = checks.truth("scale_vertical", scale_vertical)
    if rotation_limit is not None:
        rotation_limit = checks.within_quarter_turn("rotation_limit", rotation_limit)
    question = [*blocks.values()], scale_vertical, rotation_limit
    cases = zip(shaking, scales, ups, strict=True)
    outcomes = np.array([exceeded(*case, *question) for case in cases])
    ensemble = Ensemble(outcomes, None, resamples, seed, confidence)
    curves, pairs, places = tables(ensemble, steps, skewed=skewed)
    names = list(blocks)
    unit = {} if callable(measure) else {"units": inputs.UNITS[measure]}
    level = ("level", steps, unit)
    return Fragility(
        curves=curves.assign_coords(structure=names, level=level),
        pairs=pairs.assign_coords(
            first=("pair", [names[i] for i, _ in places]),
            second=("pair", [names[j] for _, j in places]),
            level=level,
        ),
        outcomes=outcomes,
        measure=getattr(measure, "__name__", repr(measure)) if callable(measure) else measure,
        confidence=confidence,
        factors=(float(scales.min()), float(scales.max())),
        rotation_limit=rotation_limit,
    )


def exceeded(
    motion: Pulse | Record,
    factors: Array,
    vertical: Record | None,
    blocks: Sequence[RockingBlock],
    scale_vertical: bool,
    limit: float | None,
) -> Outcomes:
    """Return which blocks overturn or rotate beyond a limit (rad), shape (blocks, factors)."""
    detail = OUTCOME if limit is None else PEAK
    peaks, overturned = peaks_and_outcomes(
        blocks, motion, factors, vertical=vertical, scale_vertical=scale_vertical, detail=detail
    )
    return overturned if limit is None else ~(peaks <= limit)  # also where it is NaN


def tables(
    ensemble: Ensemble, levels: Array, *, skewed: bool
) -> tuple[xarray.Dataset, xarray.Dataset, list[tuple[int, int]]]:
    """Return `curves` and `pairs` of a `Fragility` without their coordinates, and the pairs.

    Of arrays with resamples the first axis holds the ensemble and then its resamples.
    """
    outcomes, means = ensemble.outcomes, ensemble.means()
    if len(outcomes) == 1:
        means[1:] = np.nan  # a resample of one motion is that motion, and shows no scatter
    terms, counts = fit(levels, means, skewed=skewed), outcomes.sum(axis=0)
    middles = medians(levels, terms)
    low, high = exact_interval(counts, len(outcomes), ensemble.confidence)

    def resampled(name: str, dims: tuple[str, ...], values: Array) -> Variables:
        return {key: (dims, ends) for key, ends in ensemble.bounds(name, values).items()}

    at, one = ("structure", "level"), ("structure",)
    curves: Variables = {
        "overturned": (at, counts),
        "probability": (at, counts / len(outcomes)),
        "probability_low": (at, low),
        "probability_high": (at, high),
        "fitted": (at, curve(levels, terms[0])),
    }
    curves |= {f"term_{name}": (one, term) for name, term in zip("abc", terms[0].T, strict=True)}
    curves |= resampled("median_capacity", one, middles)
    curves |= resampled("dispersion", one, dispersions(terms))

    places = [*combinations(range(outcomes.shape[1]), 2)]
    first, second = np.array(places, dtype=int).reshape(-1, 2).T
    only_first = (outcomes[:, first] & ~outcomes[:, second]).sum(axis=0)
    only_second = (outcomes[:, second] & ~outcomes[:, first]).sum(axis=0)
    at, one = ("pair", "level"), ("pair",)
    pairs: Variables = {
        "only_first": (at, only_first),
        "only_second": (at, only_second),
        "sign_test": (at, sign_test(only_first, only_second)),
    }
    pairs |= resampled("less", at, means[:, first] - means[:, second])
    pairs |= resampled("gain", one, middles[:, second] / middles[:, first] - 1.0)
    return xarray.Dataset(curves), xarray.Dataset(pairs), places


def exact_interval(
    counts: NDArray[np.int64], trials: int, confidence: float
) -> tuple[Array, Array]:
    """Return the exact interval of a probability from counts (Clopper & Pearson 1934).

    `trials` is the number of trials of each count; both ends have the shape of the counts.
    """
    tail, left = 0.5 * (1.0 - confidence), trials - counts
    low = np.where(counts > 0, betaincinv(counts, left + 1, tail), 0.0)
    high = np.where(left > 0, betaincinv(counts + 1, left, 1.0 - tail), 1.0)
    return low, high


def sign_test(ones: NDArray[np.int64], others: NDArray[np.int64]) -> Array:
    """Return the two-sided p-value of the exact test that both outcomes are equally likely.

    The exact test of McNemar: of pairs that differ, the `ones` are binomial with 1/2.
    """
    p_values: Array = 2.0 * bdtr(np.minimum(ones, others), ones + others, 0.5)
    return np.minimum(1.0, p_values)
