"""What figures share: names of pulses, γ, and the axes of overturning spectra."""

import math

from matplotlib.axes import Axes

HIGHEST = 12.0  # a/(g tan α) of overturning spectra
PULSES = {
    "one-sine": "One sine",
    "one-cosine": "One cosine",
    "ricker-symmetric": "Symmetric Ricker",
    "ricker-antisymmetric": "Antisymmetric Ricker",
}


def gamma(value: float) -> str:
    """Return "γ = …" for a mass ratio."""
    return r"$\gamma=\infty$" if math.isinf(value) else f"$\\gamma$ = {value:g}"


def amplitude_axis(axis: Axes) -> None:
    """Set the axes of an overturning spectrum: ω/p from 0.5 to 8, a/(g tan α) to HIGHEST."""
    axis.set(yscale="log", xlim=(0.5, 8), ylim=(0.93, HIGHEST), xticks=(1, 2, 4, 6, 8))
    axis.set_yticks(ticks := (1, 2, 3, 5, 10), map(str, ticks))
    axis.set_yticks([], minor=True)
