"""What the figures of this paper share: names, γ, and the axes of overturning spectra."""

import math

import numpy as np
from matplotlib.axes import Axes

MODELS = {  # the simplifications of Allen et al. (1986), one at a time and together
    "linearised": "linearised",
    "massless frequency": r"$\hat{p}$ for $\gamma\to\infty$",
    "massless restitution": r"$\sqrt{r}$ for $\gamma\to\infty$",
    "all": "all three: Allen et al.",
}

RECORDS = {
    "el_centro_1940_NS": "El Centro 1940, NS",
    "napa_2014_68150_090": "South Napa 2014, 090",
    "napa_2014_68150_360": "South Napa 2014, 360",
    "ridgecrest_2019_CCC_090": "Ridgecrest 2019, CCC 090",
    "ridgecrest_2019_CCC_360": "Ridgecrest 2019, CCC 360",
    "ridgecrest_2019_CLC_090": "Ridgecrest 2019, CLC 090",
    "ridgecrest_2019_CLC_360": "Ridgecrest 2019, CLC 360",
}

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


def by_size(mass_ratio, ratios):
    """Return places of mass ratios on an axis by equal steps of R̂, from the table of Eq. (24)."""
    return np.interp(ratios, mass_ratio.mass_ratio, mass_ratio.share_of_size_gain)


def amplitude_axis(axis: Axes) -> None:
    """Set the axes of an overturning spectrum: ω/p from 0.5 to 8, a/(g tan α) to HIGHEST."""
    axis.set(yscale="log", xlim=(0.5, 8), ylim=(0.93, HIGHEST), xticks=(1, 2, 4, 6, 8))
    axis.set_yticks(ticks := (1, 2, 3, 5, 10), map(str, ticks))
    axis.set_yticks([], minor=True)
