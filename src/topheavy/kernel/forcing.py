"""The ground motion as the kernel sees it: smooth pieces, and when it lifts a block at rest.

Time is τ = p t and the ground acceleration a(τ) is in g. Every pulse solves one linear equation,

    a'' = −c a − (d₀ + d₁ (τ − τ₀)) a',

so that a Taylor step needs no sine and no exponential: c = (ω/p)² and d = 0 make the sine and the
cosine, c = d = 0 the constant and the straight line between two samples of a record, and d₁ > 0 the
derivatives of the Gaussian bell that Ricker's wavelets are (the second and the third: Hermite's
equation).

Beside a record there may be a vertical one, v (g, upward): gravity is G = 1 + v, a straight line
over a piece, too. The pieces lie between the samples of either record; without a vertical record
v = 0. A block at rest is lifted by |a| > G tan α.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from topheavy.ground import shapes
from topheavy.kernel.compiled import compiled

Array = NDArray[np.float64]
#: The number of each shape of `topheavy.ground.shapes`; a record and no motion have numbers, too.
SHAPES = {name: number for number, name in enumerate(shapes.SHAPES)}
ONE_SINE, ONE_COSINE, HALF_SINE = SHAPES["one-sine"], SHAPES["one-cosine"], SHAPES["half-sine"]
CONSTANT, HARMONIC = SHAPES["constant"], SHAPES["harmonic"]
RICKER_SYMMETRIC, RICKER_ANTISYMMETRIC = SHAPES["ricker-symmetric"], SHAPES["ricker-antisymmetric"]
RECORD, NONE = range(len(SHAPES), len(SHAPES) + 2)
#: Phase ωt at which each shape ends (a record ends by its own time, no motion at once).
LAST_PHASE = np.array([*(each.half_periods for each in shapes.SHAPES.values()), 0, 0]) * math.pi
RICKER_CENTRE = 4.5 * math.pi
#: y = κ (ωt − centre) is the variable in which a Ricker wavelet is a derivative of exp(−y²).
KAPPA = np.zeros(len(SHAPES))
KAPPA[RICKER_SYMMETRIC], KAPPA[RICKER_ANTISYMMETRIC] = 1 / 2, 1 / math.sqrt(6)
#: The order of that derivative.
DERIVATIVE = np.zeros(len(SHAPES), dtype=np.int64)
DERIVATIVE[RICKER_SYMMETRIC], DERIVATIVE[RICKER_ANTISYMMETRIC] = 2, 3
#: The amplitude of the antisymmetric wavelet is normalised by its own peak, to five digits.
ANTISYMMETRIC_PEAK = 1.3801
#: A pulse that ends has at most five monotone pieces, each of which rounding may cut in two. In as
#: many of a harmonic's, |a| reaches its largest value more than once.
MOST_PIECES = 10
#: Newton's steps for a crossing, of which six are usual. As many halvings leave 2⁻⁶⁴ of a piece.
MOST_NEWTON_STEPS = 64
#: No shape of unit amplitude exceeds this (the antisymmetric wavelet does exceed 1, by 1.4e-5).
UNIT_BOUND = 1.0001
#: Samples of two records that are as near, over the duration, are at the same time.
SAME = 1e-9

#: Phases at which a Ricker wavelet turns: roots of the next Hermite polynomial.
_SYMMETRIC = 2 * math.sqrt(1.5)
_INNER, _OUTER = (math.sqrt(6) * math.sqrt((3 + sign * math.sqrt(6)) / 2) for sign in (-1, 1))
RICKER_TURNS = RICKER_CENTRE + np.array(
    [[-_SYMMETRIC, 0.0, _SYMMETRIC, np.inf], [-_OUTER, -_INNER, _INNER, _OUTER]]
)


class Forcing(NamedTuple):
    """A ground motion in the time τ = p t: its shape, amplitude (g, or the factor on a record),
    ω/p (1 for a record), the time at which it is over, the time between two samples, and the factor
    on the vertical record."""

    shape: int
    amplitude: float
    frequency: float
    end: float
    step: float
    lift: float = 0.0


#: What stands for the record where there is none.
NO_RECORD = np.empty((10, 0))
#: Samples whose largest is kept, so that a wait for the next uplift passes over them at once.
RUN = 32
#: Rows of a record: a where a piece begins; the largest |a| from there on; that of each run; the
#: sum of |a| over the pieces from there on (∞ with a vertical record); v and the time (over that
#: between two samples) where a piece begins; a and v where it ends; the largest |v| from there on,
#: and that of each run.
START, STRONGEST, RUNS, IMPULSE, UP, AT, STOP, UP_STOP, MOST_UP, UP_RUNS = range(10)


@compiled
def pulse_forcing(shape, amplitude, frequency):
    """Return the pulse of a shape (a value of `SHAPES`) at ω/p = `frequency`."""
    return Forcing(shape, amplitude, frequency, LAST_PHASE[shape] / frequency, 1.0, 0.0)


def prepare_record(samples: Array, vertical: Array | None = None, ratio: float = 1.0) -> Array:
    """Return a horizontal and a vertical record (g) in pieces over which both are straight lines.

    Parameters
    ----------
    ratio : float
        The time between two samples of the vertical record over that of the horizontal one.

    Returns
    -------
    ndarray, shape (10, n)
        A column for each piece, and one for the end of both. A record is zero after its end.
    """
    at = np.arange(samples.size, dtype=float)
    start, stop = np.append(samples[:-1], 0.0), np.append(samples[1:], 0.0)
    begin = end = np.zeros(at.size)
    if vertical is not None:
        at = np.unique(np.concatenate([at, ratio * np.arange(vertical.size)]))
        # Samples that rounding alone keeps apart are one.
        at = at[np.append(True, np.diff(at) > SAME * at[-1])]
        start, stop = _ends(at, samples, 1.0)
        begin, end = _ends(at, vertical, ratio)
    sizes = [np.maximum(np.abs(one), np.abs(two)) for one, two in ((start, stop), (begin, end))]
    impulse = np.cumsum(0.5 * (np.abs(start) + np.abs(stop))[::-1])[::-1]
    impulse = impulse if vertical is None else np.full(at.size, np.inf)
    return np.stack([start, *_bounds(sizes[0]), impulse, begin, at, stop, end, *_bounds(sizes[1])])


def _ends(at: Array, record: Array, step: float) -> tuple[Array, Array]:
    """Return a record where each piece begins and where it ends; it is zero after its end."""
    value = np.interp(at / step, np.arange(record.size), record)
    over = 0.5 * (at[1:] + at[:-1]) >= step * (record.size - 1.0)
    first, last = np.where(over, 0.0, value[:-1]), np.where(over, 0.0, value[1:])
    return np.append(first, 0.0), np.append(last, 0.0)


def _bounds(sizes: Array) -> tuple[Array, Array]:
    """Return the largest size from each on, and the largest of each run (the first n/RUN)."""
    runs = np.zeros_like(sizes)
    largest = np.maximum.reduceat(sizes, np.arange(0, sizes.size, RUN))
    runs[: largest.size] = largest
    return np.maximum.accumulate(sizes[::-1])[::-1], runs


@compiled
def record_forcing(record, step, factor, lift):
    """Return the `record` that was prepared, `step` apart in τ, times `factor`; see `Forcing`."""
    return Forcing(RECORD, factor, 1.0, record[AT, record.shape[1] - 1] * step, step, lift)


@compiled
def unit_pulse(shape, phase):
    """Return the pulse of unit amplitude and its derivative by the phase ωt."""
    if shape in (ONE_SINE, HALF_SINE, HARMONIC):
        return math.sin(phase), math.cos(phase)
    if shape == ONE_COSINE:
        return math.cos(phase), -math.sin(phase)
    if shape == CONSTANT:
        return 1.0, 0.0
    y = KAPPA[shape] * (phase - RICKER_CENTRE)
    bell = math.exp(-y * y)
    if shape == RICKER_SYMMETRIC:
        return (1 - 2 * y * y) * bell, KAPPA[shape] * y * (4 * y * y - 6) * bell
    scale = math.sqrt(2) / ANTISYMMETRIC_PEAK * bell
    return (scale * y * (2 * y * y - 3), scale * KAPPA[shape] * (-3 + y * y * (12 - 4 * y * y)))


@compiled
def piece_of(forcing, record, time):
    """Return the number of the piece of a record that begins at or before `time`."""
    low, high = 0, record.shape[1]
    while high - low > 1:  # halved each time
        middle = (low + high) // 2
        if record[AT, middle] * forcing.step <= time:
            low = middle
        else:
            high = middle
    return low


@compiled
def piece_start(forcing, record, piece):
    """Return when a piece of a record begins."""
    return record[AT, piece] * forcing.step


@compiled
def lines(forcing, record, piece):
    """Return a, a', G and G' where a piece of a record begins."""
    length = (record[AT, piece + 1] - record[AT, piece]) * forcing.step
    push, lift = forcing.amplitude, forcing.lift
    rate = push * (record[STOP, piece] - record[START, piece]) / length
    gravity_rate = lift * (record[UP_STOP, piece] - record[UP, piece]) / length
    return push * record[START, piece], rate, 1.0 + lift * record[UP, piece], gravity_rate


@compiled
def gravity(forcing, record, time):
    """Return G = 1 + v and G' at `time`; at a sample of a record, G' is that of the next piece."""
    if forcing.shape != RECORD or time >= forcing.end:
        return 1.0, 0.0
    piece = min(piece_of(forcing, record, time), record.shape[1] - 2)
    _, _, value, rate = lines(forcing, record, piece)
    return value + rate * (time - piece_start(forcing, record, piece)), rate


@compiled
def ground(forcing, record, time):
    """Return a and a' at `time`; at a sample of a record, a' is that of the piece that begins."""
    if forcing.shape == NONE or time >= forcing.end:
        return 0.0, 0.0
    if forcing.shape == RECORD:
        piece = min(piece_of(forcing, record, time), record.shape[1] - 2)
        value, rate, _, _ = lines(forcing, record, piece)
        return value + rate * (time - piece_start(forcing, record, piece)), rate
    value, rate = unit_pulse(forcing.shape, forcing.frequency * time)
    return forcing.amplitude * value, forcing.amplitude * forcing.frequency * rate


@compiled
def equation(forcing, time):
    """Return c, d₀, d₁ of the equation that the ground acceleration solves, about `time`."""
    shape = forcing.shape
    if shape in (CONSTANT, RECORD, NONE):
        return 0.0, 0.0, 0.0
    square = forcing.frequency * forcing.frequency
    if shape in (RICKER_SYMMETRIC, RICKER_ANTISYMMETRIC):
        kappa2 = KAPPA[shape] * KAPPA[shape]
        offset = forcing.frequency * time - RICKER_CENTRE
        return (
            2 * (DERIVATIVE[shape] + 1) * kappa2 * square,
            2 * kappa2 * offset * forcing.frequency,
            2 * kappa2 * square,
        )
    return square, 0.0, 0.0


@compiled
def strongest_after(forcing, record, time):
    """Return bounds on |a|/G and on G from `time` on."""
    if forcing.shape == NONE or time >= forcing.end:
        return 0.0, 1.0
    if forcing.shape == RECORD:
        k = piece_of(forcing, record, time)
        most = abs(forcing.lift) * record[MOST_UP, k]
        if most >= 1.0:
            return np.inf, 1.0 + most
        return abs(forcing.amplitude) * record[STRONGEST, k] / (1.0 - most), 1.0 + most
    return UNIT_BOUND * abs(forcing.amplitude), 1.0


@compiled
def next_turn(forcing, time):
    """Return the end of the monotone piece of a pulse that begins at `time` (or holds it)."""
    shape, frequency = forcing.shape, forcing.frequency
    if shape in (CONSTANT, NONE):
        return forcing.end
    if shape in (RICKER_SYMMETRIC, RICKER_ANTISYMMETRIC):
        for turn in RICKER_TURNS[shape - RICKER_SYMMETRIC]:
            if turn / frequency > time:
                return min(turn / frequency, forcing.end)
        return forcing.end
    return min(_crest(shape, frequency, time), forcing.end)


@compiled
def _crest(shape, frequency, time):
    """Return when a sine or a cosine turns next, be it cut off before."""
    shift = 0.0 if shape == ONE_COSINE else 0.5
    half_turns = math.floor(frequency * time / math.pi - shift) + 1
    turn = (half_turns + shift) * math.pi / frequency
    if turn <= time:
        turn = (half_turns + 1 + shift) * math.pi / frequency
    return turn


@compiled
def next_uplift(forcing, record, time, level):
    """Return when |a| first exceeds `level`, from `time` on, for a block at rest.

    Between two turns a(τ) is monotone, hence |a| > level either at the start of a piece (the
    forcing jumps, or the block came to rest under it), or from one crossing that can be
    bracketed, or not at all.

    Returns
    -------
    time : float
        `inf` if the forcing ends first.
    push : float
        |a| − G level at that time: exactly zero at a crossing.
    rate : float
        The derivative of the push.
    side : float
        The side s = −sgn a to which the block rocks.
    """
    if forcing.shape == RECORD:
        return _next_uplift_of_record(forcing, record, time, level)
    if forcing.shape == HARMONIC and abs(forcing.amplitude) <= level:
        return np.inf, 0.0, 0.0, 1.0
    value, rate = ground(forcing, record, time)
    for _ in range(MOST_PIECES):
        if time >= forcing.end:
            break
        if abs(value) > level:
            sign = math.copysign(1.0, value)
            return time, abs(value) - level, sign * rate, -sign
        turn = next_turn(forcing, time)
        last = forcing.amplitude * unit_pulse(forcing.shape, forcing.frequency * turn)[0]
        if abs(last) > level:
            sign = math.copysign(1.0, last)
            time, rate = _crossing(forcing, time, turn, sign, level)
            if rate > 0.0:
                return time, 0.0, rate, -sign
        time, value, rate = turn, last, 0.0
    return np.inf, 0.0, 0.0, 1.0


@compiled
def _next_uplift_of_record(forcing, record, time, level):
    """The same for a record: on either side the push ±a − G level is a straight line."""
    size, lift, last = abs(forcing.amplitude), abs(forcing.lift), record.shape[1] - 1
    k = piece_of(forcing, record, time)
    while k < last:  # k grows each time
        if k % RUN == 0:
            if size * record[STRONGEST, k] <= level * (1.0 - lift * record[MOST_UP, k]):
                break
            if size * record[RUNS, k // RUN] <= level * (1.0 - lift * record[UP_RUNS, k // RUN]):
                k += RUN
                continue
        is_low = size * abs(record[START, k]) <= level * (1.0 + forcing.lift * record[UP, k])
        if is_low and size * abs(record[STOP, k]) <= level * (
            1.0 + forcing.lift * record[UP_STOP, k]
        ):
            k += 1
            continue
        begin, end = piece_start(forcing, record, k), piece_start(forcing, record, k + 1)
        time = max(time, begin)
        value, rate, weight, weight_rate = lines(forcing, record, k)
        here = math.copysign(1.0, value + rate * (time - begin))  # only that push may lift now
        for sign in (here, -here):
            slope = sign * rate - level * weight_rate
            push = sign * value - level * weight + slope * (time - begin)
            if push > 0.0:
                return time, push, slope, -sign
            above = sign * forcing.amplitude * record[STOP, k]
            above -= level * (1.0 + forcing.lift * record[UP_STOP, k])
            if above > 0.0:
                crossing = max(end - above / slope, time)
                if crossing < end:
                    return crossing, 0.0, slope, -sign
        k += 1  # a crossing that rounds to the end is that of the piece which begins there
    return np.inf, 0.0, 0.0, 1.0


@compiled
def _crossing(forcing, low, high, sign, level):
    """Return the time at which sign·a rises through `level` in a monotone piece, and its rate."""
    shape, strength = forcing.shape, abs(forcing.amplitude)
    if shape < RICKER_SYMMETRIC:  # |a| = A cos(distance from the turn)
        root = math.sqrt((strength - level) * (strength + level))
        crest = _crest(shape, forcing.frequency, low)
        time = crest - math.atan2(root, level) / forcing.frequency
        return max(time, low), forcing.frequency * root
    time = high
    for number in range(2 * MOST_NEWTON_STEPS):  # Newton's step where it stays inside, else halving
        value, rate = unit_pulse(shape, forcing.frequency * time)
        excess = sign * forcing.amplitude * value - level
        rate *= sign * forcing.amplitude * forcing.frequency
        if excess > 0.0:
            high = time
        else:
            low = time
        trial = time - excess / rate if rate > 0.0 else low
        if number >= MOST_NEWTON_STEPS or not low < trial < high:
            trial = 0.5 * (low + high)
        if abs(trial - time) <= 4e-16 * time or high - low <= 4e-16 * time:
            return trial, rate
        time = trial
    return time, rate
