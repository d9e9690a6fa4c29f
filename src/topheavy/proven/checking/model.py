"""What a certificate is about, in intervals: block and ground motion, from their decimals."""

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from . import intervals
from .intervals import Interval, Refused, arctangent, between, cosine, dot, exponential, of, sine
from .schema import HALF_TURNS

LARGEST_WAVE = Fraction(10001, 10000)  # of |f|: the antisymmetric Ricker pulse peaks at 1.00002


class Block:
    """sin α, cos α, p² and √r of the structure of a certificate, from its dimensions."""

    def __init__(self, given: dict[str, str], linearised: bool) -> None:
        self.linearised = linearised
        value = {key: Fraction(x) for key, x in given.items() if key not in ("kind", "mass_ratio")}
        if given["kind"] == "block":
            self.alpha = of(value["slenderness"])
            self.sine, self.cosine = sine(self.alpha), cosine(self.alpha)
            self.square = of(value["frequency_parameter"]) * of(value["frequency_parameter"])
            self.restitution = of(value["restitution"])
        else:
            ratio = given["mass_ratio"]
            base, height, inertia, self.restitution = _rigid(given["kind"], value, ratio)
            distance = of(base * base + height * height).root()
            self.sine, self.cosine = of(base) / distance, of(height) / distance
            self.square = of(value["gravity"]) * distance / of(inertia)
            self.alpha = arctangent(of(base / height))
        if not (self.restitution.low >= 0 and self.restitution.high <= intervals.UNIT + 1):
            raise Refused("√r is outside of 0 to 1: the block does not rock after an impact")
        self.level = self.alpha if linearised else self.sine / self.cosine

    def pull(self, phi: Interval, push: Interval) -> Interval:
        """−φ''/κ²."""
        if self.linearised:
            return self.alpha - phi + push
        return sine(self.alpha - phi) + push * cosine(self.alpha - phi)

    def lever(self, phi: Interval) -> Interval:
        """ψ = sin α − sin(α − φ), linearised φ."""
        if self.linearised:
            return phi
        return self.sine - sine(self.alpha - phi)

    def potential(self, phi: Interval, push: Interval) -> Interval:
        """Φ + s a ψ, Φ = cos(α − φ) − cos α, linearised φ (α − φ/2)."""
        if self.linearised:
            return phi * (self.alpha - phi / 2 + push)
        return cosine(self.alpha - phi) - self.cosine + push * self.lever(phi)


def _rigid(
    kind: str, of_: dict[str, Fraction], ratio: str
) -> tuple[Fraction, Fraction, Fraction, Interval]:
    """Return half base, height of the centre, inertia over mass about the edge, and √r."""
    b, h = of_["half_width"], of_["half_height"]
    gamma = None if ratio == "infinite" else Fraction(ratio)
    if kind == "frame":  # a column whose inertia grows with R̂/R; its √r is Eq. (25)
        larger = Fraction(3, 2) if gamma is None else (1 + 3 * gamma) / (1 + 2 * gamma)
        sine_square = b * b / (b * b + h * h)
        root, of_cap = 1 - sine_square * Fraction(3, 2), 1 - 2 * sine_square
        root = of_cap if gamma is None else (root + 3 * gamma * of_cap) / (1 + 3 * gamma)
        return b, h, Fraction(4, 3) * (b * b + h * h) * larger, of(root)
    cap = Fraction(1) if gamma is None else gamma / (1 + gamma)
    axis, width, depth = of_["axis"], of_["cap_width"], of_["cap_depth"]
    base, top = axis + b, 2 * h + depth / 2
    height = (1 - cap) * h + cap * top
    inertia = (1 - cap) * (Fraction(1, 3) * (b * b + h * h) + base * base + axis * axis + h * h)
    inertia += cap * (Fraction(1, 12) * (width * width + depth * depth) + base * base + top * top)
    return base, height, inertia, of(1 - 2 * base * base / inertia)


class Ground:
    """s a f and its pieces, in the phase of a pulse or the samples of a record."""

    def __init__(self, given: dict[str, Any], factor: Sequence[str], square: Interval) -> None:
        self.factor = between(*factor)
        self.shape = given.get("shape", "record")
        if self.shape == "record":
            self.samples = [Fraction(x) for x in given["acceleration"]]
            self.clock = square * of(Fraction(given["time_step"]) ** 2)
            self.stops = [of(k + 1) for k in range(len(self.samples) - 1)]
            peak = max(map(abs, self.samples))
        else:
            self.amplitude = Fraction(given["amplitude"])
            self.clock = square / of(Fraction(given["angular_frequency"]) ** 2)
            # π = 16 atan 1/5 − 4 atan 1/239
            pi = 16 * arctangent(of(Fraction(1, 5))) - 4 * arctangent(of(Fraction(1, 239)))
            self.pi, self.stops = pi, [pi * HALF_TURNS[self.shape]]
            peak = abs(self.amplitude) * LARGEST_WAVE
        self.largest = of(peak) * self.factor.size()

    def series(self, piece: int, sigma: Interval, h: Interval, terms: int) -> list[Interval]:
        """Return the coefficients of a f(σ + hτ) by powers of τ."""
        if self.shape == "record":
            first, second = self.samples[piece], self.samples[piece + 1]
            slope = of(second - first)
            wave = [of(first) + slope * (sigma - piece), slope * h]
            found = [*wave, *[of(0)] * (terms - 2)][:terms]
            return [self.factor * x for x in found]
        scale = self.factor * of(self.amplitude)
        if self.shape == "constant":
            return [scale, *[of(0)] * (terms - 1)]
        if self.shape.startswith("ricker"):
            return [scale * x for x in self._ricker(sigma, h, terms)]
        pair = [(sine(sigma), cosine(sigma))]
        if self.shape == "one-cosine":
            pair = [(cosine(sigma), -sine(sigma))]
        for k in range(terms - 1):
            pair.append((h * pair[k][1] / (k + 1), -h * pair[k][0] / (k + 1)))
        return [scale * x for x, _ in pair]

    def _ricker(self, sigma: Interval, h: Interval, terms: int) -> list[Interval]:
        is_even = self.shape == "ricker-symmetric"
        step = h / 2 if is_even else h / of(3).root()  # y = y₀ + step τ; (1 − 2y²) e^(−y²) or …
        start = sigma - self.pi * 9 / 2
        y = start / 2 if is_even else start / of(3).root()  # (y² − 3) y e^(−y²/2)
        bell = [exponential(y * y / (1 if is_even else 2))]
        for k in range(terms - 1):
            before = bell[k - 1] if k else of(0)
            rate = step * (y * bell[k] + step * before) / (k + 1)
            bell.append(-rate * (2 if is_even else 1))
        if is_even:
            factors = [1 - 2 * (y * y), -4 * (y * step), -2 * (step * step)]
        else:
            cube = [(y * y - 3) * y, (3 * (y * y) - 3) * step, 3 * y * step * step]
            peak = of(Fraction(13801, 10000))
            factors = [x / peak for x in (*cube, step * step * step)]
        return [dot(factors, bell[k::-1]) for k in range(terms)]

    def at(self, piece: int, sigma: Interval) -> Interval:
        return self.series(piece, sigma, of(1), 1)[0]

    def over(self, piece: int, start: Interval, stop: Interval) -> Interval:
        """Return all a f from one σ to another."""
        found = self.at(piece, start)
        for number in range(piece, len(self.stops)):
            begin = start if number == piece else self.stops[number - 1]
            if begin > stop:
                return found
            found = found.hull(self.at(number, begin.hull(_least(stop, self.stops[number]))))
        return found if stop < self.stops[-1] else found.hull(0)


def _least(one: Interval, other: Interval) -> Interval:
    return Interval(min(one.low, other.low), min(one.high, other.high))
