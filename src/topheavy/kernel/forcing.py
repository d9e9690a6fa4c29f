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

from topheavy.ground.pulses import ANTISYMMETRIC_PEAK, unit_wave
from topheavy.ground.shapes import (
    CENTRE,
    CONSTANT,
    COSINE,
    RICKER_ANTISYMMETRIC,
    RICKER_SYMMETRIC,
    SHAPES,
    WAVES,
    PulseShape,
)
from topheavy.kernel.compiled import compiled

Array = NDArray[np.float64]
#: A record and no motion have numbers behind those of the waves.
RECORD, NONE = range(len(WAVES), len(WAVES) + 2)
#: The equation of each wave by the phase ωt; see `topheavy.ground.shapes`.
STIFFNESS = np.array([*(wave.stiffness for wave in WAVES.values()), 0.0, 0.0])
DRAG = np.array([*(wave.drag for wave in WAVES.values()), 0.0, 0.0])
#: Phases at which a Ricker wavelet turns, a row for each, filled up by infinity.
RICKER_TURNS = np.array(
    [(*WAVES[name].turns, math.inf)[:4] for name in ("ricker-symmetric", "ricker-antisymmetric")]
)
#: A Ricker wavelet has at most five monotone pieces, each of which rounding may cut in two. In as
#: many of a sine's or cosine's, |a| reaches its largest value more than once.
MAX_PIECES = 10
#: Newton's steps for a crossing, of which six are usual. As many halvings leave 2⁻⁶⁴ of a piece.
MAX_NEWTON_STEPS = 64
#: Samples of two records that are as near, relative to the duration, are at the same time.
SAME_TIME = 1e-9


class Waveform(NamedTuple):
    """What a ground motion is, apart from its scale in time and its amplitude."""

    wave: int  # the place of a pulse's wave in `shapes.WAVES`, or `RECORD`, or `NONE`
    last_phase: float  # the phase ωt at which a pulse ends
    record: Array  # as `prepare_record` returns it; `NO_RECORD` of a pulse


class Forcing(NamedTuple):
    """A ground motion in the time τ = p t."""

    wave: int
    amplitude: float  # of a pulse, g; of a record, the factor on it
    frequency: float  # ω/p of a pulse; 1 for a record
    end: float  # the τ at which the motion is over
    step: float  # p Δt of a record
    vertical_factor: float  # on the vertical record
    record: Array


NO_RECORD = np.empty((13, 0))
#: Pieces whose largest values are kept, so that a search for the next uplift can skip them.
RUN_LENGTH = 32
#: Rows of a record: a where a piece begins and where it ends; v there; the time at which it begins,
#: over that between two samples; the largest |a| and the largest |v| from there on; those of each
#: run; a bound on the integrals of |a| and |v| from there on, over the time between two samples;
#: the total variation of a and v up to there.
A_START, A_END, V_START, V_END, TIME, A_MAX, V_MAX, A_MAX_OF_RUN, V_MAX_OF_RUN = range(9)
A_IMPULSE, V_IMPULSE, A_VARIATION, V_VARIATION = range(9, 13)


NO_MOTION = Waveform(NONE, 0.0, NO_RECORD)


def pulse_waveform(shape: PulseShape, cycles: int = 1) -> Waveform:
    """Return the waveform of a pulse shape."""
    wave, half_periods = list(WAVES).index(SHAPES[shape].wave), SHAPES[shape].half_periods
    return Waveform(wave, cycles * half_periods * math.pi, NO_RECORD)


def record_waveform(samples: Array, vertical: Array | None = None, ratio: float = 1.0) -> Waveform:
    """Return the waveform of a record; see `prepare_record`."""
    return Waveform(RECORD, 0.0, prepare_record(samples, vertical, ratio))


@compiled
def forcing_of(waveform, scale, amplitude, vertical_factor):
    """Return the `Forcing` of a pulse with ω/p = `scale`, or of a record with p Δt = `scale`."""
    wave, last_phase, record = waveform
    if wave == RECORD:
        end = record[TIME, record.shape[1] - 1] * scale
        return Forcing(wave, amplitude, 1.0, end, scale, vertical_factor, record)
    return Forcing(wave, amplitude, scale, last_phase / scale, 1.0, 0.0, record)


def prepare_record(samples: Array, vertical: Array | None = None, ratio: float = 1.0) -> Array:
    """Return a horizontal and a vertical record (g) in pieces over which both are straight lines.

    Parameters
    ----------
    ratio : float
        The time between two samples of the vertical record over that of the horizontal one.

    Returns
    -------
    ndarray, shape (13, n)
        A column for each piece, and one for the end of both. A record is zero after its end.
    """
    time = np.arange(samples.size, dtype=float)
    a_start, a_end = np.append(samples[:-1], 0.0), np.append(samples[1:], 0.0)
    v_start = v_end = np.zeros(time.size)
    if vertical is not None:
        time = np.unique(np.concatenate([time, ratio * np.arange(vertical.size)]))
        # Samples that rounding alone keeps apart are one.
        time = time[np.append(True, np.diff(time) > SAME_TIME * time[-1])]
        a_start, a_end = _ends(time, samples, 1.0)
        v_start, v_end = _ends(time, vertical, ratio)
    a_max, a_max_of_run = _bounds(a_start, a_end)
    v_max, v_max_of_run = _bounds(v_start, v_end)
    ends = (a_start, a_end, v_start, v_end)
    bounds = (time, a_max, v_max, a_max_of_run, v_max_of_run)
    impulses = (_impulse(time, a_start, a_end), _impulse(time, v_start, v_end))
    return np.stack(
        [*ends, *bounds, *impulses, _variation(a_start, a_end), _variation(v_start, v_end)]
    )


def _impulse(time: Array, start: Array, end: Array) -> Array:
    """Return a bound on the integral of the modulus from each piece on: that of its chords."""
    pieces = 0.5 * (np.abs(start) + np.abs(end))[:-1] * np.diff(time)
    return np.append(np.cumsum(pieces[::-1])[::-1], 0.0)


def _variation(start: Array, end: Array) -> Array:
    """Return the total variation from the first piece to each, its jumps included."""
    return np.append(0.0, np.cumsum(np.abs(end - start)[:-1] + np.abs(start[1:] - end[:-1])))


def _ends(time: Array, record: Array, step: float) -> tuple[Array, Array]:
    """Return a record where each piece begins and where it ends; it is zero after its end."""
    value = np.interp(time / step, np.arange(record.size), record)
    is_over = 0.5 * (time[1:] + time[:-1]) >= step * (record.size - 1.0)
    first, last = np.where(is_over, 0.0, value[:-1]), np.where(is_over, 0.0, value[1:])
    return np.append(first, 0.0), np.append(last, 0.0)


def _bounds(start: Array, end: Array) -> tuple[Array, Array]:
    """Return the largest modulus from each piece on, and that of each run of `RUN_LENGTH`."""
    sizes = np.maximum(np.abs(start), np.abs(end))
    largest = np.maximum.reduceat(sizes, np.arange(0, sizes.size, RUN_LENGTH))
    runs = np.pad(largest, (0, sizes.size - largest.size))
    return np.maximum.accumulate(sizes[::-1])[::-1], runs


unit_pulse = compiled(unit_wave)


@compiled
def piece_of(forcing, time):
    """Return the number of the piece of a record that begins at or before `time`."""
    low, high = 0, forcing.record.shape[1]
    while high - low > 1:  # halved each time
        middle = (low + high) // 2
        if forcing.record[TIME, middle] * forcing.step <= time:
            low = middle
        else:
            high = middle
    return low


@compiled(forceinline=True, no_cpython_wrapper=False)
def piece_start(forcing, piece):
    """Return when a piece of a record begins."""
    return forcing.record[TIME, piece] * forcing.step


@compiled(forceinline=True, no_cpython_wrapper=False)
def ground_of_piece(forcing, piece):
    """Return a, a', G and G' where a piece of a record begins."""
    record, amplitude, vertical = forcing.record, forcing.amplitude, forcing.vertical_factor
    length = (record[TIME, piece + 1] - record[TIME, piece]) * forcing.step
    rate = amplitude * (record[A_END, piece] - record[A_START, piece]) / length
    change = vertical * (record[V_END, piece] - record[V_START, piece]) / length
    return amplitude * record[A_START, piece], rate, 1.0 + vertical * record[V_START, piece], change


@compiled
def ground(forcing, time):
    """Return a, a', G and G' at `time`; at a sample of a record, those of the next piece."""
    if forcing.wave == NONE or time >= forcing.end:
        return 0.0, 0.0, 1.0, 0.0
    if forcing.wave == RECORD:
        piece = min(piece_of(forcing, time), forcing.record.shape[1] - 2)
        value, rate, gravity, change = ground_of_piece(forcing, piece)
        after = time - piece_start(forcing, piece)
        return value + rate * after, rate, gravity + change * after, change
    value, rate = unit_pulse(forcing.wave, forcing.frequency * time)
    return forcing.amplitude * value, forcing.amplitude * forcing.frequency * rate, 1.0, 0.0


@compiled
def equation(forcing, time):
    """Return c, d₀, d₁ of the equation that the ground acceleration solves, about `time`."""
    square = forcing.frequency * forcing.frequency
    stiffness, drag = STIFFNESS[forcing.wave] * square, DRAG[forcing.wave]
    lag = forcing.frequency * time - CENTRE
    return stiffness, drag * lag * forcing.frequency, drag * square


@compiled
def bounds_after(forcing, time):
    """Return bounds on |a|/G and on G from `time` on."""
    if forcing.wave == NONE or time >= forcing.end:
        return 0.0, 1.0
    if forcing.wave == RECORD:
        k = piece_of(forcing, time)
        change = abs(forcing.vertical_factor) * forcing.record[V_MAX, k]
        if change >= 1.0:
            return np.inf, 1.0 + change
        return abs(forcing.amplitude) * forcing.record[A_MAX, k] / (1.0 - change), 1.0 + change
    return extent(forcing, time, forcing.end)[0], 1.0


@compiled
def extent(forcing, start, stop):
    """Return the largest |a| of a pulse from `start`, before its end, to `stop`; its variation.

    Between two turns a(τ) is monotone. A pulse drops to zero at its end. A sine or a cosine whose
    variation is cut short by `MAX_PIECES` has varied by sixteen times its amplitude.
    """
    value = forcing.amplitude * unit_pulse(forcing.wave, forcing.frequency * start)[0]
    largest, variation, time = abs(value), 0.0, start
    for _ in range(MAX_PIECES):
        if time >= min(stop, forcing.end):
            break
        time = min(next_turn(forcing, time), stop)
        turn = forcing.amplitude * unit_pulse(forcing.wave, forcing.frequency * time)[0]
        largest, variation, value = max(largest, abs(turn)), variation + abs(turn - value), turn
    return largest, variation + abs(value) if stop > forcing.end else variation


@compiled
def variation(forcing, start, stop, level):
    """Return a bound on the total variation of a plus `level` times that of v."""
    if forcing.wave == RECORD:
        return _variation_until(forcing, stop, level) - _variation_until(forcing, start, level)
    return extent(forcing, start, stop)[1]


@compiled
def _variation_until(forcing, time, level):
    piece, size, most = (
        piece_of(forcing, time),
        abs(forcing.amplitude),
        abs(forcing.vertical_factor),
    )
    total = size * forcing.record[A_VARIATION, piece]
    total += level * most * forcing.record[V_VARIATION, piece]
    if piece + 1 < forcing.record.shape[1]:
        _, rate, _, change = ground_of_piece(forcing, piece)
        total += (abs(rate) + level * abs(change)) * (time - piece_start(forcing, piece))
    return total


@compiled
def impulse_after(forcing, time, piece):
    """Return bounds on the integrals of |a| and of |v| over τ from `time` on.

    They are known of a record, from the beginning of its piece on, and of a Ricker wavelet behind
    its last zero. There, by the formulas of `pulses.unit_wave` with ω/p = κ,

        a = (1 − 2y²) e^(−y²) = (y e^(−y²))',             y = (κτ − CENTRE)/2,    y² > 1/2,
        a = x (x² − 3) e^(−x²/2) = ((1 − x²) e^(−x²/2))', x = (κτ − CENTRE)/√3,   x² > 3,

    where x and y are positive. Else the first bound is infinite.
    """
    wave, frequency = forcing.wave, forcing.frequency
    if wave == NONE or time >= forcing.end:
        return 0.0, 0.0
    if wave == RECORD:
        size, most = abs(forcing.amplitude), abs(forcing.vertical_factor)
        record, step = forcing.record, forcing.step
        return size * step * record[A_IMPULSE, piece], most * step * record[V_IMPULSE, piece]
    size, lag = abs(forcing.amplitude) / frequency, frequency * time - CENTRE
    if wave == RICKER_SYMMETRIC and lag > math.sqrt(2.0):
        y = lag / 2.0
        return size * 2.0 * y * math.exp(-y * y), 0.0
    if wave == RICKER_ANTISYMMETRIC and lag > 3.0:
        x = lag / math.sqrt(3.0)
        bell = math.exp(-0.5 * x * x) / ANTISYMMETRIC_PEAK
        return size * math.sqrt(3.0) * (x * x - 1.0) * bell, 0.0
    return np.inf, 0.0


@compiled
def next_turn(forcing, time):
    """Return the end of the monotone piece of a pulse that begins at `time` (or holds it)."""
    wave, frequency = forcing.wave, forcing.frequency
    if wave in (CONSTANT, NONE):
        return forcing.end
    if wave in (RICKER_SYMMETRIC, RICKER_ANTISYMMETRIC):
        for turn in RICKER_TURNS[wave - RICKER_SYMMETRIC]:
            if turn / frequency > time:
                return min(turn / frequency, forcing.end)
        return forcing.end
    return min(_crest(wave, frequency, time), forcing.end)


@compiled
def _crest(wave, frequency, time):
    """Return when a sine or a cosine turns next, be it cut off before."""
    shift = 0.0 if wave == COSINE else 0.5
    half_turns = math.floor(frequency * time / math.pi - shift) + 1
    turn = (half_turns + shift) * math.pi / frequency
    if turn <= time:
        turn = (half_turns + 1 + shift) * math.pi / frequency
    return turn


@compiled
def next_uplift(forcing, time, level):
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
    if forcing.wave == RECORD:
        return _next_uplift_of_record(forcing, time, level)
    value, rate, _, _ = ground(forcing, time)
    for _ in range(MAX_PIECES):
        if time >= forcing.end:
            break
        if abs(value) > level:
            sign = math.copysign(1.0, value)
            return time, abs(value) - level, sign * rate, -sign
        turn = next_turn(forcing, time)
        last = forcing.amplitude * unit_pulse(forcing.wave, forcing.frequency * turn)[0]
        if abs(last) > level:
            sign = math.copysign(1.0, last)
            time, rate = _crossing(forcing, time, turn, sign, level)
            if rate > 0.0:
                return time, 0.0, rate, -sign
        time, value, rate = turn, last, 0.0
    return np.inf, 0.0, 0.0, 1.0


@compiled
def _next_uplift_of_record(forcing, time, level):
    """Return the same for a record: on either side the push ±a − G level is a straight line."""
    record, last = forcing.record, forcing.record.shape[1] - 1
    size, most = abs(forcing.amplitude), abs(forcing.vertical_factor)
    k = piece_of(forcing, time)
    while k < last:  # k grows each time
        if k % RUN_LENGTH == 0:
            if size * record[A_MAX, k] <= level * (1.0 - most * record[V_MAX, k]):
                break
            run = k // RUN_LENGTH
            if size * record[A_MAX_OF_RUN, run] <= level * (1.0 - most * record[V_MAX_OF_RUN, run]):
                k += RUN_LENGTH
                continue
        level_at_start = level * (1.0 + forcing.vertical_factor * record[V_START, k])
        level_at_end = level * (1.0 + forcing.vertical_factor * record[V_END, k])
        is_low = size * abs(record[A_START, k]) <= level_at_start
        if is_low and size * abs(record[A_END, k]) <= level_at_end:
            k += 1
            continue
        begin, end = piece_start(forcing, k), piece_start(forcing, k + 1)
        time = max(time, begin)
        value, rate, weight, change = ground_of_piece(forcing, k)
        first = math.copysign(1.0, value + rate * (time - begin))  # only that push may lift now
        for sign in (first, -first):
            slope = sign * rate - level * change
            push = sign * value - level * weight + slope * (time - begin)
            if push > 0.0:
                return time, push, slope, -sign
            above = sign * forcing.amplitude * record[A_END, k] - level_at_end
            if above > 0.0:
                crossing = max(end - above / slope, time)
                if crossing < end:
                    return crossing, 0.0, slope, -sign
        k += 1  # a crossing that rounds to the end is that of the piece which begins there
    return np.inf, 0.0, 0.0, 1.0


@compiled
def _crossing(forcing, low, high, sign, level):
    """Return the time at which sign·a rises through `level` in a monotone piece, and its rate."""
    wave, strength = forcing.wave, abs(forcing.amplitude)
    if wave < RICKER_SYMMETRIC:  # |a| = A cos(distance from the turn)
        root = math.sqrt((strength - level) * (strength + level))
        crest = _crest(wave, forcing.frequency, low)
        time = crest - math.atan2(root, level) / forcing.frequency
        return max(time, low), forcing.frequency * root
    time = high
    for number in range(2 * MAX_NEWTON_STEPS):  # Newton's step where it stays inside, else halving
        value, rate = unit_pulse(wave, forcing.frequency * time)
        excess = sign * forcing.amplitude * value - level
        rate *= sign * forcing.amplitude * forcing.frequency
        if excess > 0.0:
            high = time
        else:
            low = time
        trial = time - excess / rate if rate > 0.0 else low
        if number >= MAX_NEWTON_STEPS or not low < trial < high:
            trial = 0.5 * (low + high)
        if abs(trial - time) <= 4e-16 * time or high - low <= 4e-16 * time:
            return trial, rate
        time = trial
    return time, rate
