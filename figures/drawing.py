"""What the figures of this paper share: names, γ, and the areas of overturning spectra."""

import math
from collections.abc import Sequence

import pandas as pd
from matplotlib.axes import Axes

MODELS = {  # the simplifications of Allen et al. (1986), one at a time and together
    "linearised": "linearised",
    "massless frequency": r"$\hat{p}$ for $\gamma\to\infty$",
    "massless restitution": r"$\sqrt{r}$ for $\gamma\to\infty$",
    "all": "all three: Allen et al.",
}

RECORDS = {
    "el_centro_1940_NS": "El Centro 1940, NS",
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


def amplitude_axis(axis: Axes) -> None:
    """Set the axes of an overturning spectrum: ω/p from 0.5 to 8, a/(g tan α) to HIGHEST."""
    axis.set(yscale="log", xlim=(0.5, 8), ylim=(0.93, HIGHEST), xticks=(1, 2, 4, 6, 8))
    axis.set_yticks(ticks := (1, 2, 3, 5, 10), map(str, ticks))
    axis.set_yticks([], minor=True)


def bands(intervals: pd.DataFrame, mode: str, highest: float, narrowest: float) -> list[list]:
    """Return the areas of one spectrum and mode as bands: lists of (x, lower, upper).

    The table has the columns x, lower, upper and mode. An interval goes on in that of the next x
    which overlaps it most, and in which it overlaps most. Gaps and intervals that are narrower than
    `narrowest` are left out.
    """
    steps = sorted(intervals.x.unique())
    cells = intervals.assign(upper=intervals.upper.fillna(highest))[intervals["mode"] == mode]
    at = {
        x: _joined(ends[["lower", "upper"]].sort_values("lower").to_numpy().tolist(), narrowest)
        for x, ends in cells.groupby("x")
    }
    found, open_bands, before = [], [], None
    for x in steps:
        here, goes_on = at.get(x, []), []
        for band in open_bands:
            last, others = band[-1][1:], [other[-1][1:] for other in open_bands]
            best = max(here, key=lambda ends: _overlap(ends, last), default=(0.0, 0.0))
            if 0.0 < _overlap(best, last) == max(_overlap(best, other) for other in others):
                band.append((x, *best))
                goes_on.append(band)
            else:
                band += _branch(x, last, here)
        taken = [band[-1][1:] for band in goes_on]
        rest = [ends for ends in here if ends not in taken]
        starts = [[*_branch(before, ends, at.get(before, [])), (x, *ends)] for ends in rest]
        found += starts
        open_bands, before = goes_on + starts, x
    return [band for band in found if len(band) > 1]


def _branch(x: float | None, ends: Sequence[float], there: list) -> list[tuple]:
    """Return where a band that begins or ends at a fork meets the other one, if it does."""
    met = max(there, key=lambda other: _overlap(other, ends), default=(0.0, 0.0))
    if x is None or _overlap(met, ends) == 0.0:
        return []
    return [(x, max(met[0], ends[0]), min(met[1], ends[1]))]


def _joined(ends: list[list[float]], narrowest: float) -> list[tuple[float, float]]:
    joined: list[list[float]] = []
    for low, high in ends:
        if joined and low - joined[-1][1] < narrowest:
            joined[-1][1] = high
        else:
            joined.append([low, high])
    return [(low, high) for low, high in joined if high - low >= narrowest]


def _overlap(one: Sequence[float], other: Sequence[float]) -> float:
    return max(0.0, min(one[1], other[1]) - max(one[0], other[0]))
