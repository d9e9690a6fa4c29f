"""Pictures of results with Matplotlib: `pip install "topheavy[plot]"`.

Each function draws into `axes`, or into a new figure, and returns the Axes.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray

from topheavy import checks
from topheavy.bodies.fixed_mass import FixedMassColumn, MonolithicPortal
from topheavy.bodies.kinematics import outlines
from topheavy.bodies.response import Response
from topheavy.bodies.structures import RockingFrame, Structure
from topheavy.outcomes.capacity import WINDOW, Capacity
from topheavy.risk.fragility import Fragility

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = [
    "capacity",
    "forces",
    "fragility",
    "history",
    "map",
    "rotations",
    "spectrum",
    "structure",
]


def __dir__() -> list[str]:
    return __all__


OVERTURNED = "0.75"
"""Grey of the cells that overturn."""
MODES = {"after an impact (mode 1)": "0.5", "without an impact (mode 2)": "none"}
"""How the points of a spectrum are filled."""
MAX_SHOWN = 1.5
"""|θ|/α at which the picture of a history ends."""


def history(response: Response, *, label: str = "", axes: Axes | None = None) -> Axes:
    """Draw the rotation normalised by α against time (s), with the impacts; |θ| = α is dotted.

    The label, for a legend, is by default the outcome.
    """
    _check_result("history", response)
    axes, rotation = _axes(axes), response.rotation / response.slenderness
    (line,) = axes.plot(response.time, rotation, label=label or response.outcome)
    shown = response.impact_times[response.impact_times <= response.time[-1]]
    axes.plot(shown, np.zeros(shown.size), "|", color=line.get_color())
    for limit in (-1.0, 1.0):
        axes.axhline(limit, color="0.5", linestyle=":", linewidth=0.8)
    axes.set(xlabel="Time, $t$ (s)", ylabel=r"Rotation, $\theta/\alpha$ (–)")
    if np.abs(axes.get_ylim()).max() > MAX_SHOWN:
        axes.set_ylim(-MAX_SHOWN, MAX_SHOWN)
    return axes


def forces(result: xarray.Dataset, *, axes: Axes | None = None) -> Axes:
    """Draw the required friction of each contact over time (s), as `contact_forces` returns it.

    Where a contact opens, its line has a gap.
    """
    _check_result("forces", result)
    axes = _axes(axes)
    for name in result.contact.to_numpy():
        friction = result.required_friction.sel(contact=name)
        axes.plot(result.time, friction, label=name.replace("_", " "))
    axes.set(xlabel="Time, $t$ (s)", ylabel="Required coefficient of friction (–)")
    axes.legend()
    return axes


def map(outcomes: xarray.Dataset, *, axes: Axes | None = None) -> Axes:
    """Draw the peak rotations of a map, normalised by α; cells that overturn are grey."""
    _check_result("map", outcomes)
    axes = _axes(axes)
    across, up = (outcomes[name] for name in outcomes.peak_rotation.dims)
    peaks = outcomes.peak_rotation.T / outcomes.attrs["slenderness"]
    axes.set_facecolor(OVERTURNED)
    shown = axes.pcolormesh(across, up, peaks, shading="nearest", cmap="Blues", vmin=0.0, vmax=1.0)
    axes.figure.colorbar(
        shown, ax=axes, label="Peak rotation, $\\max|\\theta|/\\alpha$ (–)\ngrey: overturns"
    )
    axes.set_title(
        outcomes.attrs.get("shape", "") or outcomes.attrs.get("record", ""), fontsize="medium"
    )
    axes.set(xlabel=_axis_label(across), ylabel=_axis_label(up))
    return axes


def spectrum(minima: xarray.Dataset, *, axes: Axes | None = None) -> Axes:
    """Draw an `overturning_spectrum`; points are filled where an impact precedes overturning."""
    _check_result("spectrum", minima)
    axes = _axes(axes)
    minima = minima.sortby("period")
    for name in np.atleast_1d(minima.structure):
        one = minima.sel(structure=name) if minima.structure.ndim else minima
        (line,) = axes.plot(one.period, one.acceleration, label=str(name))
        for filled in (True, False):
            of_mode = one.acceleration.where(one.after_impact == filled)
            face = line.get_color() if filled else axes.get_facecolor()
            axes.plot(one.period, of_mode, "o", ms=4, color=line.get_color(), markerfacecolor=face)
    for label, face in MODES.items():
        axes.plot([], [], "o", ms=4, color="0.5", markerfacecolor=face, label=label)
    axes.set_title(minima.attrs["shape"], fontsize="medium")
    axes.set(xlabel=_axis_label(minima.period), ylabel=_axis_label(minima.acceleration))
    axes.legend()
    return axes


def rotations(peaks: xarray.DataArray, *, axes: Axes | None = None) -> Axes:
    """Draw `peak_rotations`, normalised by α: the curves of an incremental dynamic analysis.

    A tick on the right stands for each factor that overturns.
    """
    _check_result("rotations", peaks)
    axes = _axes(axes)
    peaks = peaks.sortby("factor")
    for place, name in enumerate(np.atleast_1d(peaks.structure)):
        one = peaks.sel(structure=name) if peaks.structure.ndim else peaks
        (line,) = axes.plot(one / one.slenderness, one.peak_acceleration, ".", label=str(name))
        overturned = one.peak_acceleration[np.isnan(one)]
        beside = np.full(overturned.size, 1.02 + 0.03 * place)
        axes.plot(
            *(beside, overturned, "_"),
            color=line.get_color(),
            transform=axes.get_yaxis_transform(),
            clip_on=False,
        )
    axes.set(
        xlabel=r"Peak rotation, $\max|\theta|/\alpha$ (–); ticks on the right: overturns",
        ylabel=_axis_label(peaks.peak_acceleration),
        xlim=(0.0, None),
    )
    axes.legend()
    return axes


def capacity(result: Capacity, *, label: str = "", axes: Axes | None = None) -> Axes:
    """Draw the share of the factors in a window that overturn, over the first factor of the window.

    A line marks the capacity, a band its range over windows of 2.5 to 20 %.
    """
    _check_result("capacity", result)
    axes = _axes(axes)
    (line,) = axes.plot(result.factors, result.shares(WINDOW), label=label or "record")
    axes.axhline(result.share, color="0.5", linestyle=":", linewidth=0.8)
    low, high = result.range
    if not math.isnan(result.factor):
        axes.axvline(result.factor, color=line.get_color(), linestyle="--")
        last = float(result.factors[-1]) if math.isnan(high) else high
        axes.axvspan(low, last, color=line.get_color(), alpha=0.15, linewidth=0.0)
    axes.set(
        xlabel="Factor on the record (–)",
        ylabel=f"Share that overturns\nwithin {100.0 * WINDOW:g} % (–)",
        ylim=(-0.02, 1.02),
    )
    axes.legend()
    return axes


def fragility(result: Fragility, *, axes: Axes | None = None) -> Axes:
    """Draw the probability of overturning: points, their intervals as bands, the fitted curves."""
    _check_result("fragility", result)
    axes = _axes(axes)
    for name in result.curves.structure.to_numpy():
        curve = result.curves.sel(structure=name)
        (points,) = axes.plot(curve.level, curve.probability, ".", label=str(name))
        colour = points.get_color()
        ends = curve.probability_low, curve.probability_high
        # Bands may overlap, and their edges still show where each is.
        shades: dict[str, Any] = {"facecolor": (colour, 0.1), "edgecolor": (colour, 0.6)}
        axes.fill_between(curve.level, *ends, linewidth=0.6, **shades)
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
        Dimensions of the cap beam, m. By default those of the structure, and if it has none: the
        height of a column wide for each, or three times the width of a single column; 0.15 of the
        height of a column deep.

    Raises
    ------
    ValueError
        For a block, which has no bodies.
    """
    rotation = checks.within("rotation", rotation, -math.pi / 2.0, math.pi / 2.0)
    cap_width, cap_depth = (
        None if value is None else checks.positive(name, value, "m")
        for name, value in (("cap_width", cap_width), ("cap_depth", cap_depth))
    )
    width = depth = 0.0
    if isinstance(shown, FixedMassColumn | MonolithicPortal | RockingFrame):
        column = shown.column
        usual = 6.0 * column.half_width
        if isinstance(shown, RockingFrame):
            usual = 2.0 * shown.columns * column.half_height
        elif isinstance(shown, MonolithicPortal):
            usual = shown.span + 2.0 * (column.half_width + shown.overhang)
        width = cap_width or getattr(shown, "cap_width", 0.0) or usual
        depth = cap_depth or getattr(shown, "cap_depth", 0.0) or 0.3 * column.half_height
    bodies = outlines(shown, rotation, width, depth)
    axes = _axes(axes)
    for name, corners in bodies.items():
        axes.fill(*corners.T, facecolor="0.9" if "column" in name else "0.6", edgecolor="0.1")
    axes.axhline(0.0, color="0.1", linewidth=1.0, zorder=0)
    axes.set(xlabel="$x$ (m)", ylabel="$z$ (m)", aspect="equal")
    axes.locator_params(axis="x", nbins=3)
    axes.set_title(rf"$\theta$ = {math.degrees(rotation):.2f}°", fontsize="medium")
    return axes


def _axis_label(values: xarray.DataArray) -> str:
    """Return the name of values, with a capital, and their unit."""
    name = values.attrs.get("long_name", str(values.name).replace("_", " "))
    return f"{name[0].upper()}{name[1:]} ({values.attrs['units']})"


def _check_result(function: str, result: object) -> None:
    """Raise ValueError unless a function draws this result, and name the one that does."""
    variables = set(getattr(result, "data_vars", ()))
    is_rotations = getattr(result, "name", None) == "peak_rotation"
    drawn = {
        "history": ("Response, from simulate", isinstance(result, Response)),
        "forces": ("Dataset of contact_forces", {"required_friction"} <= variables),
        "map": ("Dataset of overturning_map", {"peak_rotation", "overturned"} <= variables),
        "spectrum": ("Dataset of overturning_spectrum", {"after_impact"} <= variables),
        "rotations": ("DataArray of peak_rotations", is_rotations),
        "capacity": ("Capacity, from capacity", isinstance(result, Capacity)),
        "fragility": ("Fragility, from fragility", isinstance(result, Fragility)),
    }
    expected, fits = drawn[function]
    if not fits:
        others = [f"; plot.{name} draws this one" for name, (_, is_it) in drawn.items() if is_it]
        raise ValueError(
            f"result is a {type(result).__name__}; expected the {expected}{''.join(others)}"
        )


def _axes(axes: Axes | None) -> Axes:
    try:
        import matplotlib.pyplot as plt
        from matplotlib.axes import Axes
    except ImportError as missing:
        raise ImportError(
            "topheavy.plot draws with Matplotlib, which is not installed; expected the extra: "
            'pip install "topheavy[plot]", in a clone pip install ".[plot]"'
        ) from missing
    if axes is None:
        return plt.figure(layout="constrained").add_subplot()
    if not isinstance(axes, Axes):
        raise ValueError(f"axes is {checks.short_repr(axes)}; expected Axes of Matplotlib, one")
    return axes
