"""What every figure does at its edges: read its tables, wear the style, save the same bytes."""

import math
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import matplotlib as mpl

mpl.use("svg")

import matplotlib.pyplot as plt
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from replication.workbench import run

SINGLE, DOUBLE = 88.0, 180.0  # widths of one and of two columns, mm

# One hue by lightness for γ, the heavier the darker; one accent, for what leaves or misleads.
INK, GREY = "#1a1a1a", "#737373"
ACCENT = "#c8501a"
STONE, CAP = "#e8e5df", "#bcd0e3"
LIGHT, DARK = "#b3cde3", "#1d4770"  # two of that hue, for areas
LIGHTEST, DARKEST = (0.58, 0.77, 0.90), (0.02, 0.14, 0.36)

MODELS = {  # the simplifications of Allen et al. (1986), one at a time and together
    "linearised": "linearised",
    "massless frequency": r"$\hat{p}$ of massless columns",
    "massless restitution": r"$\sqrt{r}$ of massless columns",
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


def publish(job, draw: Callable[..., Figure]) -> None:
    """Draw the tables of a Snakemake job, each passed under its own name, and save the figure."""

    def picture(job) -> None:
        plt.style.use(job.input.style)
        tables = {Path(path).stem: pd.read_csv(path) for path in job.input.tables}
        draw(**tables).savefig(job.output[0], metadata={"Date": None})

    run(job, picture)


def sheet(width: float, height: float, mosaic: str = "", **grid) -> tuple[Figure, Any]:
    """Return a figure of a size in mm, and its axes: an array, or a dictionary for a mosaic."""
    size = (width / 25.4, height / 25.4)
    if mosaic:
        return plt.subplot_mosaic(mosaic, figsize=size, **grid)
    return plt.subplots(figsize=size, **grid)


def shades(count: int) -> list[tuple[float, float, float]]:
    """Return colours of one hue, from the lightest to the darkest."""
    steps = [i / max(count - 1, 1) for i in range(count)]
    pairs = list(zip(LIGHTEST, DARKEST, strict=True))
    return [tuple(low + (high - low) * step for low, high in pairs) for step in steps]


def gamma(value: float) -> str:
    """Return "γ = …" for a mass ratio."""
    return r"$\gamma=\infty$" if math.isinf(value) else f"$\\gamma$ = {value:g}"


def letter(axes: Sequence[Axes], titles: Sequence[str]) -> None:
    """Title the panels (a), (b), …"""
    for axis, mark, title in zip(axes, "abcdefgh", titles, strict=False):
        axis.set_title(f"({mark}) {title}")


def note(axis: Axes, text: str, at: tuple[float, float], **how) -> None:
    """Write a label at a point of the data, in the label's colour and place."""
    axis.annotate(text, at, **{"fontsize": 7.5, "va": "center"} | how)


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
