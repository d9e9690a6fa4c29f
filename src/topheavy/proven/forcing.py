"""The ground motion in balls: its Taylor series, its range, and where it first lifts a block.

Time runs in the phase σ = ωt of a pulse and in samples σ = t/Δt of a record. The motion then has no
parameters, and where it begins, bends and ends is known exactly or to the last bit.
"""

import math
from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache, reduce
from itertools import accumulate, cycle, pairwise
from operator import truediv

from topheavy.ground.pulses import Pulse
from topheavy.ground.records import Record
from topheavy.ground.shapes import SHAPES
from topheavy.proven.balls import Undecided, arb, bounds, exact, hull, power, root


@dataclass(frozen=True)
class Piece:
    """A span of σ over which the motion is analytic; between `turns` it is monotone."""

    start: arb
    stop: arb
    number: int
    turns: Sequence[arb] = ()


class Forcing(ABC):
    """A ground motion of unit factor, in g."""

    pieces: Sequence[Piece]

    @abstractmethod
    def series(self, piece: Piece, sigma: arb, terms: int) -> list[arb]:
        """Return that many Taylor coefficients at σ, a ball: all of them, none left out."""

    @abstractmethod
    def scale(self, frequency_parameter: arb) -> arb:
        """Return κ = p dt/dσ."""

    def value(self, piece: Piece, sigma: arb) -> arb:
        """Return the acceleration at σ."""
        return self.series(piece, sigma, 1)[0]

    @abstractmethod
    def largest(self, number: int) -> arb:
        """Return max|a| from a piece on, by its number."""

    @abstractmethod
    def range(self, number: int, start: arb, stop: arb) -> arb:
        """Return a ball of all accelerations between two σ, the first in the piece of a number."""

    def uplift(
        self, piece: Piece, factor: arb, level: arb, begin: arb
    ) -> tuple[arb, int, bool] | None:
        """Return the first σ from `begin` on with |factor · a| > level, a's sign, and if it jumps.

        None if it stays below. Only where the motion begins can it jump over the level.
        """
        edges = [piece.start, *piece.turns, piece.stop]
        begin = begin.max(piece.start)
        at_begin = factor * self.value(piece, begin)
        if abs(at_begin) > level:
            return begin, _sign(at_begin), True
        if not abs(at_begin) < level:
            raise Undecided("uplift")
        for low, high in pairwise(edges):
            if high < begin:
                continue
            at_high = factor * self.value(piece, high)
            if abs(at_high) < level:
                continue
            if not abs(at_high) > level:
                raise Undecided("uplift")
            sign = _sign(at_high)
            pushed = sign * factor
            crossing = root(
                lambda x: pushed * self.value(piece, x) - level,  # noqa: B023 - called here
                lambda x: pushed * self.series(piece, x, 2)[1],  # noqa: B023
                low.max(begin).lower(),
                high.upper(),
            )
            return crossing, sign, False
        return None


class PulseForcing(Forcing):
    """A pulse of the library in its phase."""

    def __init__(self, pulse: Pulse) -> None:
        half_periods = SHAPES[pulse.shape].half_periods
        if half_periods == math.inf:
            raise ValueError(f"{pulse.shape!r} goes on forever; expected a pulse that ends")
        self.wave = _WAVES[pulse.shape]
        self.amplitude, self.omega = exact(pulse.amplitude), exact(pulse.angular_frequency)
        turns = _turns(pulse.shape)
        self.pieces = [Piece(arb(0), int(half_periods) * arb.pi(), 0, turns)]
        piece = self.pieces[0]
        ends = [abs(self.value(piece, x)) for x in (piece.start, *turns, piece.stop)]
        self._largest = reduce(arb.max, ends)

    def scale(self, frequency_parameter: arb) -> arb:
        return frequency_parameter / self.omega

    def series(self, piece: Piece, sigma: arb, terms: int) -> list[arb]:
        return [self.amplitude * x for x in self.wave(sigma, terms)]

    def largest(self, number: int) -> arb:
        return self._largest

    def range(self, number: int, start: arb, stop: arb) -> arb:
        piece = self.pieces[number]
        found = self.value(piece, hull(start, stop.min(piece.stop)))
        return found if stop < piece.stop else found.union(arb(0))  # then it jumps


class RecordForcing(Forcing):
    """A record in its samples: straight lines from each to the next."""

    def __init__(self, record: Record) -> None:
        self.samples = [exact(x) for x in record.acceleration.tolist()]
        self.step = exact(record.time_step)
        self.pieces = [Piece(arb(k), arb(k + 1), k) for k in range(len(self.samples) - 1)]
        sizes = [abs(x) for x in reversed(self.samples)]
        self._largest = [*accumulate(sizes, arb.max)][::-1]

    def scale(self, frequency_parameter: arb) -> arb:
        return frequency_parameter * self.step

    def series(self, piece: Piece, sigma: arb, terms: int) -> list[arb]:
        first, second = self.samples[piece.number : piece.number + 2]
        slope = second - first
        return [first + slope * (sigma - piece.number), slope, *[arb(0)] * (terms - 2)][:terms]

    def range(self, number: int, start: arb, stop: arb) -> arb:
        last = int(bounds(stop)[1])
        is_over = last >= len(self.pieces)  # then it jumps
        at_stop = arb(0) if is_over else self.value(self.pieces[last], stop)
        found = self.value(self.pieces[number], start).union(at_stop)
        for sample in self.samples[number + 1 : last + 1]:  # lines between: no more than these
            found = found.union(sample)
        return found

    def largest(self, number: int) -> arb:
        return self._largest[number]


def prepared(excitation: Pulse | Record) -> Forcing:
    """Return a pulse or record that `judge` accepts as a forcing in balls."""
    if isinstance(excitation, Record):
        return RecordForcing(excitation)
    return PulseForcing(excitation)


def _sine(sigma: arb, terms: int) -> list[arb]:
    sine, cosine = sigma.sin_cos()
    return _cycle((sine, cosine, -sine, -cosine), terms)


def _cosine(sigma: arb, terms: int) -> list[arb]:
    sine, cosine = sigma.sin_cos()
    return _cycle((cosine, -sine, -cosine, sine), terms)


def _cycle(derivatives: Sequence[arb], terms: int) -> list[arb]:
    return list(map(truediv, cycle(derivatives), _factorials(terms)))


@cache
def _factorials(terms: int) -> tuple[arb, ...]:
    return tuple(arb(math.factorial(k)) for k in range(terms))  # exact in any precision


def _ricker(polynomial: Sequence[arb], slope: arb, sigma: arb, terms: int) -> list[arb]:
    """Return the series of P(z) exp(−z²) with z = slope · (σ − 9π/2), P by its powers of z."""
    z = slope * (sigma - 9 * arb.pi() / 2)
    bell = [(-z * z).exp()]  # E' = −2 z z' E, z = z₀ + slope t
    for k in range(terms - 1):
        before = bell[k - 1] if k else arb(0)
        bell.append(-2 * slope * (z * bell[k] + slope * before) / (k + 1))
    powers = [arb(0)] * len(polynomial)  # P(z₀ + slope t) by powers of t
    for n, coefficient in enumerate(polynomial):
        for j in range(n + 1):
            powers[j] += coefficient * math.comb(n, j) * power(z, n - j) * power(slope, j)
    return [
        sum((powers[j] * bell[k - j] for j in range(min(k, len(powers) - 1) + 1)), arb(0))
        for k in range(terms)
    ]


def _ricker_symmetric(sigma: arb, terms: int) -> list[arb]:
    return _ricker([arb(1), arb(0), arb(-2)], arb(1) / 2, sigma, terms)


def _ricker_antisymmetric(sigma: arb, terms: int) -> list[arb]:
    peak, root = exact(1.3801), arb(2).sqrt()  # x = (σ − 9π/2)/√3 = √2 z, with x²/2 = z²
    powers = [arb(0), -3 * root / peak, arb(0), 2 * root / peak]
    return _ricker(powers, 1 / arb(6).sqrt(), sigma, terms)


_WAVES = {
    "one-sine": _sine,
    "one-cosine": _cosine,
    "half-sine": _sine,
    "constant": lambda sigma, terms: [arb(1), *[arb(0)] * (terms - 1)],
    "ricker-symmetric": _ricker_symmetric,
    "ricker-antisymmetric": _ricker_antisymmetric,
}


def _around(offset: arb) -> tuple[arb, arb]:
    return 9 * arb.pi() / 2 - offset, 9 * arb.pi() / 2 + offset


def _turns(shape: str) -> list[arb]:
    """Return where the slope of a pulse is zero inside it: the turns of `ground.pulses`."""
    half = arb.pi() / 2
    if shape == "one-sine":
        return [half, 3 * half]
    if shape == "one-cosine":
        return [2 * half]
    if shape == "half-sine":
        return [half]
    if shape == "ricker-symmetric":
        low, high = _around(arb(6).sqrt())
        return [low, 9 * half, high]
    if shape == "ricker-antisymmetric":
        outer, inner = ((9 + 3 * s * arb(6).sqrt()).sqrt() for s in (1, -1))
        (a, d), (b, c) = _around(outer), _around(inner)
        return [a, b, c, d]
    return []


def _sign(ball: arb) -> int:
    return 1 if ball > 0 else -1
