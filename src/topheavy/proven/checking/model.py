"""Block and pulse of a certificate, in intervals computed from their decimals."""

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from . import intervals
from .intervals import Interval, NotProven, arctangent, cosine, dot, enclose, exponential, sine

MAX_WAVE = Fraction(10001, 10000)  # of |f|: the antisymmetric Ricker pulse peaks at 1.00002


class Block:
    """sin α, cos α, p² and √r of the structure of a certificate."""

    def __init__(self, structure: dict[str, str], linearised: bool) -> None:
        self.linearised, kind = linearised, structure["kind"]
        words = "kind", "mass_ratio"
        value = {key: Fraction(text) for key, text in structure.items() if key not in words}
        if kind == "block":
            self.alpha = enclose(value["slenderness"])
            self.sine, self.cosine = sine(self.alpha), cosine(self.alpha)
            self.p_squared = enclose(value["frequency_parameter"] ** 2)
            self.restitution = enclose(value["restitution"])
        else:
            base, height, inertia, root = _rigid(kind, value, structure["mass_ratio"])
            distance = enclose(base * base + height * height).root()
            self.sine, self.cosine = enclose(base) / distance, enclose(height) / distance
            self.p_squared = enclose(value["gravity"]) * distance / enclose(inertia)
            self.alpha, self.restitution = arctangent(enclose(base / height)), enclose(root)
        if not (self.restitution.low >= 0 and self.restitution.high <= intervals.UNIT + 1):
            raise NotProven("√r is outside of 0 to 1: the block does not rock after an impact")
        self.uplift_level = self.alpha if linearised else self.sine / self.cosine

    def pull(self, phi: Interval, push: Interval) -> Interval:
        """Return −φ''/κ² at a rotation φ under s a."""
        if self.linearised:
            return self.alpha - phi + push
        return sine(self.alpha - phi) + push * cosine(self.alpha - phi)

    def lever(self, phi: Interval) -> Interval:
        """Return ψ = sin α − sin(α − φ), linearised φ."""
        return phi if self.linearised else self.sine - sine(self.alpha - phi)

    def potential(self, phi: Interval, push: Interval) -> Interval:
        """Return Φ + s a ψ, where Φ = cos(α − φ) − cos α, linearised φ (α − φ/2)."""
        if self.linearised:
            return phi * (self.alpha - phi / 2 + push)
        return cosine(self.alpha - phi) - self.cosine + push * self.lever(phi)


def _rigid(
    kind: str, value: dict[str, Fraction], ratio: str
) -> tuple[Fraction, Fraction, Fraction, Fraction]:
    """Return half base, height of the centre, inertia over mass about the edge, and √r."""
    b, h = value["half_width"], value["half_height"]
    gamma = None if ratio == "infinite" else Fraction(ratio)
    if kind == "frame":  # a column whose inertia grows with R̂/R; its √r is Eq. (25)
        larger = Fraction(3, 2) if gamma is None else (1 + 3 * gamma) / (1 + 2 * gamma)
        sine_square = b * b / (b * b + h * h)
        root, of_cap = 1 - sine_square * Fraction(3, 2), 1 - 2 * sine_square
        root = of_cap if gamma is None else (root + 3 * gamma * of_cap) / (1 + 3 * gamma)
        return b, h, Fraction(4, 3) * (b * b + h * h) * larger, root
    cap = Fraction(1) if gamma is None else gamma / (1 + gamma)
    axis, width, depth = value["axis"], value["cap_width"], value["cap_depth"]
    base, top = axis + b, 2 * h + depth / 2
    height = (1 - cap) * h + cap * top
    inertia = (1 - cap) * (Fraction(1, 3) * (b * b + h * h) + base * base + axis * axis + h * h)
    inertia += cap * (Fraction(1, 12) * (width * width + depth * depth) + base * base + top * top)
    return base, height, inertia, 1 - 2 * base * base / inertia


class Ground:
    """The acceleration a(σ) of a pulse, in g, for all factors on it; σ = ωt is its phase."""

    def __init__(self, pulse: dict[str, Any], factor: Sequence[str], p_squared: Interval) -> None:
        low, high = (Fraction(pulse["amplitude"]) * Fraction(end) for end in factor)
        self.wave, self.amplitude = pulse["wave"], enclose(low).hull(enclose(high))
        self.kappa_squared = p_squared / enclose(
            Fraction(pulse["angular_frequency"]) ** 2
        )  # κ² = (p/ω)²
        first, second = (arctangent(enclose(Fraction(1, n))) for n in (5, 239))
        self.pi = 16 * first - 4 * second
        self.stop = self.pi * pulse["half_periods"]
        self.largest = enclose(MAX_WAVE) * self.amplitude.size()

    def series(self, sigma: Interval, h: Interval, terms: int) -> list[Interval]:
        """Return the coefficients of a(σ + hτ) by powers of τ."""
        if self.wave == "constant":
            return [self.amplitude, *[enclose(0)] * (terms - 1)]
        if self.wave.startswith("ricker"):
            return [self.amplitude * x for x in self._ricker(sigma, h, terms)]
        pair = [(sine(sigma), cosine(sigma))]
        if self.wave == "cosine":
            pair = [(cosine(sigma), -sine(sigma))]
        for k in range(terms - 1):
            pair.append((h * pair[k][1] / (k + 1), -h * pair[k][0] / (k + 1)))
        return [self.amplitude * x for x, _ in pair]

    def _ricker(self, sigma: Interval, h: Interval, terms: int) -> list[Interval]:
        is_even = self.wave == "ricker-symmetric"
        # (1 − 2y²) e^(−y²), or (y² − 3) y e^(−y²/2) over its peak, with y + step τ for y
        width = enclose(2) if is_even else enclose(3).root()
        y, step = (sigma - self.pi * 9 / 2) / width, h / width
        bell = [exponential(y * y / (1 if is_even else 2))]
        for k in range(terms - 1):
            before = bell[k - 1] if k else enclose(0)
            rate = step * (y * bell[k] + step * before) / (k + 1)
            bell.append(-rate * (2 if is_even else 1))
        if is_even:
            factors = [1 - 2 * (y * y), -4 * (y * step), -2 * (step * step)]
        else:
            cube = [(y * y - 3) * y, (3 * (y * y) - 3) * step, 3 * y * step * step]
            peak = enclose(Fraction(13801, 10000))
            factors = [x / peak for x in (*cube, step * step * step)]
        return [dot(factors, bell[k::-1]) for k in range(terms)]

    def at(self, sigma: Interval) -> Interval:
        """Return a(σ)."""
        return self.series(sigma, enclose(1), 1)[0]
