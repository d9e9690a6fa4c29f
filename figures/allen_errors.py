"""Error of the peak rotation by the model of Allen et al., and by each of its simplifications."""

import numpy as np
from matplotlib.colors import BoundaryNorm

from figures.drawing import MODELS, gamma
from figures.palette import ERRORS, HATCHED
from replication.drawing import DOUBLE, INK, make_figure, sheet

LEVELS = [1, 2, 5, 10, 20, 50, 100]  # %


def panel(axis, cells, norm):
    """Draw |error| where frame and model survive, and mark the cells with the wrong outcome."""
    axis.patch.set(**HATCHED)
    of = {"index": "slenderness_deg", "columns": "amplitude_over_uplift", "dropna": False}
    errors = 100 * cells.pivot_table(values="relative_error", **of).abs()
    how = {"cmap": ERRORS, "norm": norm, "shading": "nearest", "rasterized": True}
    image = axis.pcolormesh(errors.columns, errors.index, errors, **how)
    wrong = cells[cells.exact_overturned != cells.overturned]
    axis.plot(wrong.amplitude_over_uplift, wrong.slenderness_deg, "x", color=INK, markersize=3.5)
    return image


def draw(allen_errors):
    ratios = sorted(allen_errors.mass_ratio.unique())
    figure, axes = sheet(DOUBLE, 86, nrows=len(ratios), ncols=len(MODELS), sharex=True, sharey=True)
    norm = BoundaryNorm(LEVELS, ERRORS.N, extend="both")
    for row, mass_ratio in zip(axes, ratios, strict=True):
        for axis, (model, words) in zip(row, MODELS.items(), strict=True):
            of = (allen_errors.mass_ratio == mass_ratio) & (allen_errors.model == model)
            image = panel(axis, allen_errors[of], norm)
            if mass_ratio == ratios[0]:
                axis.set_title(words)
            if mass_ratio == ratios[-1]:
                axis.set_xlabel(r"Amplitude, $a/(g\,\tan\alpha)$ (–)")
        row[0].set_ylabel(f"{gamma(mass_ratio)}\n" + r"Slenderness, $\alpha$ (°)")
    amplitudes = np.sort(allen_errors.amplitude_over_uplift.unique())
    half = (amplitudes[1] - amplitudes[0]) / 2
    axes[0, 0].set(xlim=(amplitudes[0] - half, amplitudes[-1] + half), xticks=range(2, 6))
    axes[0, 0].set_yticks(range(5, 31, 5))
    bar = figure.colorbar(image, ax=axes, ticks=LEVELS, pad=0.01)
    bar.set_label("Error of the peak rotation, absolute value (%)")
    bar.ax.set_yticks([], minor=True)
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
