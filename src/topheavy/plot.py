"""Pictures of results with Matplotlib: `pip install "topheavy[plot]"`.

Each function draws into `axes`, or into a new figure, and returns the Axes.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from topheavy.bodies.fixed_mass import FixedMassColumn, MonolithicPortal
from topheavy.bodies.kinematics import outlines
from topheavy.bodies.response import Response
from topheavy.bodies.structures import RockingFrame, Structure, as_block
from topheavy.risk.estimate import Fragility

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes

OVERTURNED = "0.75"
"""Grey of the cells that overturn."""
MAX_SHOWN = 1.5
"""|θ|/α at which the picture of a history ends."""


def history(
    response: Response, structure: Structure, *, label: str = "", axes: Axes | None = None
) -> Axes:
    """Draw the rotation normalised by α against time (s), with the impacts; |θ| = α is dotted.

    Parameters
    ----------
    response : Response
    structure : Structure
        Its slenderness is α.
    label : str
        For a legend; by default the outcome.
    """
    axes = _axes(axes)
    alpha = as_block(structure).slenderness
    (line,) = axes.plot(response.time, response.rotation / alpha, label=label or response.outcome)
    shown = response.impact_times[response.impact_times <= response.time[-1]]
    axes.plot(shown, np.zeros(shown.size), "|", color=line.get_color())
    for limit in (-1.0, 1.0):
        axes.axhline(limit, color="0.5", linestyle=":", linewidth=0.8)
    axes.set(xlabel="Time, $t$ (s)", ylabel=r"Rotation, $\theta/\alpha$ (–)")
    if max(map(abs, axes.get_ylim())) > MAX_SHOWN:
        axes.set_ylim(-MAX_SHOWN, MAX_SHOWN)
    return axes


def spectrum(outcomes: xarray.Dataset, *, axes: Axes | None = None) -> Axes:
    """Draw the peak rotations of a map, normalised by α; cells that overturn are grey."""
    axes = _axes(axes)
    across, up = (outcomes[name] for name in outcomes.peak_rotation.dims)
    peaks = outcomes.peak_rotation.T / outcomes.attrs["slenderness"]
    axes.set_facecolor(OVERTURNED)
    shown = axes.pcolormesh(across, up, peaks, shading="nearest", cmap="Blues", vmin=0.0, vmax=1.0)
    axes.figure.colorbar(
        shown, ax=axes, label=r"Peak rotation, $\max|\theta|/\alpha$ (–); grey: overturns"
    )
    axes.set_title(
        outcomes.attrs.get("shape", "") or outcomes.attrs.get("record", ""), fontsize="medium"
    )
    for side, axis in (("x", across), ("y", up)):
        name = axis.attrs.get("long_name", axis.name.replace("_", " "))
        axes.set(**{f"{side}label": f"{name[0].upper()}{name[1:]} ({axis.attrs['units']})"})
    return axes


def fragility(result: Fragility, *, axes: Axes | None = None) -> Axes:
    """Draw the probability of overturning: points, their intervals as bands, the fitted curves."""
    axes = _axes(axes)
    for name in result.curves.structure.to_numpy():
        curve = result.curves.sel(structure=name)
        (points,) = axes.plot(curve.level, curve.probability, ".", label=str(name))
        colour = points.get_color()
        ends = curve.probability_low, curve.probability_high
        axes.fill_between(curve.level, *ends, color=colour, alpha=0.15, linewidth=0.0)
        axes.plot(curve.level, curve.fitted, color=colour)
    unit = result.curves.level.attrs.get("units", "its unit")
    limit = result.rotation_limit
    event = "overturning" if limit is None else rf"$\max|\theta|$ > {limit:.3g} rad"
    axes.set(
        xlabel=f"{result.measure} ({unit})",
        ylabel=f"Probability of {event} (–)",
        ylim=(-0.02, 1.02),
    )
    axes.legend()
    return axes


def structure(
    shown: Structure,
    rotation: float = 0.0,
    *,
    cap_width: float | None = None,
    cap_depth: float | None = None,
    axes: Axes | None = None,
) -> Axes:
    """Draw a structure to scale, rocked by θ.

    Parameters
    ----------
    shown : Column, FixedMassColumn, RockingFrame or MonolithicPortal
    rotation : float
        θ, rad.
    cap_width, cap_depth : float, optional
        Dimensions of the cap beam, m. By default those of the structure, and if it has none: twice
        the height of a column wide, or three times the width of a single column; 0.15 of the
        height of a column deep.

    Raises
    ------
    ValueError
        For a block, which has no bodies.
    """
    axes = _axes(axes)
    width = depth = 0.0
    if isinstance(shown, FixedMassColumn | MonolithicPortal | RockingFrame):
        column = shown.column
        only = isinstance(shown, FixedMassColumn)
        usual = 6.0 * column.half_width if only else 4.0 * column.half_height
        if isinstance(shown, MonolithicPortal):
            usual = shown.span + 2.0 * (column.half_width + shown.overhang)
        width = cap_width or getattr(shown, "cap_width", 0.0) or usual
        depth = cap_depth or getattr(shown, "cap_depth", 0.0) or 0.3 * column.half_height
    bodies = outlines(shown, rotation, width, depth)
    for name, corners in bodies.items():
        axes.fill(*corners.T, facecolor="0.9" if "column" in name else "0.6", edgecolor="0.1")
    axes.axhline(0.0, color="0.1", linewidth=1.0, zorder=0)
    axes.set(xlabel="$x$ (m)", ylabel="$z$ (m)", aspect="equal")
    axes.locator_params(axis="x", nbins=3)
    axes.set_title(rf"$\theta$ = {math.degrees(rotation):.2f}°", fontsize="medium")
    return axes


def _axes(axes: Axes | None) -> Axes:
    try:
        import matplotlib.pyplot as plt
    except ImportError as missing:
        raise ImportError(
            "topheavy.plot draws with Matplotlib, which is not installed; expected the extra: "
            'pip install "topheavy[plot]", in a clone pip install ".[plot]"'
        ) from missing
    return axes if axes is not None else plt.figure(layout="constrained").add_subplot()
