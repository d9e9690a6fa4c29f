"""Checks of the arguments of `fragility`: structures, motions, intensities and levels."""

import math
from collections.abc import Callable, Hashable, Sequence
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from topheavy import checks
from topheavy.checks import short_repr
from topheavy.ground.pulses import Pulse
from topheavy.ground.records import MAX_RECORDED, Record

Motion = Pulse | Record
Measure = Literal["PGV", "PGA"] | Callable[[Any], float]

UNITS = {"PGV": "m/s", "PGA": "g"}
"""Units of the measures of intensity that have a name."""

USUAL_LEVELS = {"PGV": (checks.MAX_USUAL_VELOCITY, "cm/s"), "PGA": (MAX_RECORDED, "gal or m/s²")}
"""Half of the levels are usually below the first number; otherwise a warning asks the unit."""

MIN_RESAMPLES, MAX_RESAMPLES = 100, 1_000_000

PROPORTIONALITY = 1e-6
"""How far a measure may be from doubling with its motion, relative to its value."""


def checked_motions(motions: Sequence[Motion]) -> list[Motion]:
    """Return the motions as a list, or raise ValueError unless there are some and all end.

    Motions that are there twice are not independent: a warning names the first two.
    """
    if not isinstance(motions, Sequence) or not motions:
        raise ValueError(f"motions is {short_repr(motions)}; expected a list of motions, not empty")
    for place, motion in enumerate(motions):
        if not isinstance(motion, Motion) or not math.isfinite(motion.duration):
            raise ValueError(
                f"motions[{place}] is {short_repr(motion)}; expected a Record or a Pulse that ends"
            )
    places: dict[Hashable, int] = {}
    for place, motion in enumerate(motions):
        content: Hashable = motion
        if isinstance(motion, Record):
            content = motion.time_step, motion.acceleration.tobytes()
        first = places.setdefault(content, place)
        if first != place:
            checks.warn(
                f"motions[{place}] equals motions[{first}], and the intervals count both: expected "
                "each motion once"
            )
            break
    return list(motions)


def checked_vertical(vertical: Sequence[Record] | None, motions: int) -> list[Record | None]:
    """Return the vertical record of each motion, or raise ValueError unless there is one a motion.

    None stands for no vertical component of any motion.
    """
    if vertical is None:
        return [None] * motions
    if not isinstance(vertical, Sequence) or len(vertical) != motions:
        raise ValueError(
            f"vertical is {short_repr(vertical)}; expected {motions} Records, one a motion"
        )
    for place, record in enumerate(vertical):
        if not isinstance(record, Record):
            raise ValueError(
                f"vertical[{place}] is {short_repr(record)}; expected a Record for every motion: "
                "leave out the motions without one"
            )
    return list(vertical)


def intensities(motions: Sequence[Motion], measure: Measure) -> NDArray[np.float64]:
    """Return the intensity of each motion: PGV in m/s, PGA in g, or by a function.

    Raises
    ------
    ValueError
        For an unknown measure, a Pulse under one with a name, an intensity that is not positive,
        since no factor brings such a motion to a level, and a function whose value does not double
        with the motion.
    """
    if callable(measure) and not isinstance(measure, type):
        values = [measure(motion) for motion in motions]
        for place, (motion, value) in enumerate(zip(motions, values, strict=True)):
            _check_proportional(f"measure of motions[{place}]", measure, motion, value)
    elif not isinstance(measure, str) or measure not in UNITS:
        raise ValueError(
            f"measure is {short_repr(measure)}; expected 'PGV', 'PGA' or a function of a motion"
        )
    else:
        values = []
        for motion in motions:
            if not isinstance(motion, Record):
                raise ValueError(
                    f"a motion is {short_repr(motion)}, which has no {measure}; expected a Record, "
                    "or a function as measure"
                )
            values.append(motion.peak_velocity if measure == "PGV" else motion.peak_acceleration)
    return np.array(
        [checks.positive(f"measure of motions[{i}]", value) for i, value in enumerate(values)]
    )


def _check_proportional(
    name: str, measure: Callable[[Any], float], motion: Motion, value: float
) -> None:
    """Raise ValueError unless a measure doubles with its motion, as `fragility` scales motions."""
    value, doubled = checks.finite(name, value), checks.finite(name, measure(motion.scaled(2.0)))
    if value > 0.0 and abs(doubled / value - 2.0) <= 2.0 * PROPORTIONALITY:
        return
    step = checks.finite(name, measure(motion.scaled(4.0))) - doubled
    if step > 0.0 and abs(step - (doubled - value)) <= PROPORTIONALITY * step:
        raise ValueError(
            f"{name} grows by {step:.6g} with each factor of 2 on the motion, as a logarithm does; "
            f"expected a measure that doubles: take 10**(value/{step / math.log10(2.0):.6g}), with "
            "the value as it is before any rounding"
        )
    growth = checks.positive(name, doubled) / checks.positive(name, value)
    power = math.log2(growth)
    way_out = "another measure, in proportion to the scale"
    if abs(power) > PROPORTIONALITY and abs(power - round(power)) < 2.0 * PROPORTIONALITY:
        way_out = f"its value to the power 1/{round(power)}"
    raise ValueError(
        f"{name} grows by {growth:.6g} under a factor of 2 on the motion; expected 2: take "
        f"{way_out}"
    )


def checked_levels(levels: ArrayLike, measure: Measure) -> NDArray[np.float64]:
    """Return the levels as an array, or raise ValueError unless they are positive and increase.

    Levels that are probably in another unit than the measure are warned of.
    """
    result = checks.axis_values("levels", levels)
    if (np.diff(result) <= 0.0).any():
        raise ValueError(f"levels is {short_repr(result)}; expected levels that increase")
    if isinstance(measure, str) and measure in USUAL_LEVELS:
        usual, other = USUAL_LEVELS[measure]
        if (middle := float(np.median(result))) > usual:
            checks.warn(
                f"half of the levels exceed {middle:.6g} {UNITS[measure]}, and few ground motions "
                f"{usual:g} {UNITS[measure]}: are they in {other}?"
            )
    return result


def scale_factors(
    levels: NDArray[np.float64], measured: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return the factor of each motion at each level, and warn of factors that only noise needs."""
    factors = levels / measured[:, None]
    place = int(factors.max(axis=1).argmax())
    if (most := float(factors[place].max())) > checks.MAX_USUAL_FACTOR:
        checks.warn(f"motions[{place}] is scaled by up to {most:.3g}: is it noise?")
    return factors


def checked_resampling(confidence: float, resamples: int, seed: int) -> tuple[float, int, int]:
    """Return these numbers, or raise ValueError unless intervals can be computed with them."""
    if not 0.0 < (level := checks.fraction("confidence", confidence)) < 1.0:
        raise ValueError(f"confidence is {level:g}; expected more than 0 and less than 1")
    return (
        level,
        checks.whole("resamples", resamples, MIN_RESAMPLES, MAX_RESAMPLES),
        checks.whole("seed", seed, 0),
    )
