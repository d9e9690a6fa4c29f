"""The same frame held against uplift, rigid or elastic, by columns that are fixed at their bases.

The cap beam is rigid and, held by two columns, it does not turn. What it does to the tops of the
columns is an assumption:

pinned
    It rests on them, as the cap beam that rocks does, and lets them turn. Each column is a
    cantilever under its own inertia and half that of the cap beam, at its top.
guided
    They are fixed to it, as in a portal. Each column bends as a beam that is guided at its top: it
    may move there and not turn. A column without a cap beam has nothing that guides it.

The rigid frame moves with the ground. The elastic one deflects in the shape ψ of a force at the
top, with x = z/2h: (3x² − x³)/2 pinned and 3x² − 2x³ guided. The period of that mode is
given, as stiffness cannot be known from three numbers. Forces are

    F(t) = (F_r − F_m) ü_g/g + F_m A(t)/g,

with F_r those of the rigid frame, F_m the part of the mode, and A the total acceleration of an
oscillator of the period. What the mode leaves out follows the ground: as the period goes to zero,
A → ü_g, and the frame is rigid. The weight's moment about displaced columns is left out.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, NamedTuple, TypeAlias, TypeVar, get_args

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.signal import lfilter

from topheavy import checks
from topheavy.bodies.structures import RockingFrame
from topheavy.checks import short
from topheavy.forces.contact import Cap
from topheavy.forces.frame import centre_height
from topheavy.ground.excitation import Excitation, Segment
from topheavy.ground.pulses import Pulse
from topheavy.ground.records import Record

Array = NDArray[np.float64]

Motion = TypeVar("Motion", bound=Excitation)
Top: TypeAlias = Literal["pinned", "guided"]

DAMPING = 0.05
"""ζ, of critical damping."""

STEPS = 200
"""Steps in a period, and in the period of a pulse; a peak between two is off by (π/200)²/2."""

SECOND_TOLERANCE = 1e-10
"""Of the second solver, relative to the acceleration of the ground."""


class Forces(NamedTuple):
    """Over the weight of the frame: a shear, and moments in m. Peaks are absolute.

    >>> frame = th.RockingFrame(th.Column(0.5, 3.0), mass_ratio=2.0)
    >>> fixed = th.FixedFrame(frame, th.Cap(span=5.0, half_depth=0.4), "pinned")
    >>> th.peak_rigid(fixed, th.Pulse("one-sine", 1.0, 2.0).scaled(0.1)).base_shear
    0.1
    """

    base_shear: float
    overturning_moment: float
    bending_moment: float


@dataclass(frozen=True)
class FixedFrame:
    """A frame whose columns are fixed to the ground, and pinned to the cap beam or guided by it.

    Parameters
    ----------
    frame : RockingFrame
    cap : Cap
    top : str
        "pinned" or "guided": whether the columns may turn at their tops.

    Raises
    ------
    ValueError
        For another top, and for guided columns without a cap beam (γ = 0).

    Examples
    --------
    >>> frame = th.RockingFrame(th.Column(0.5, 3.0), mass_ratio=2.0)
    >>> fixed = th.FixedFrame(frame, th.Cap(span=5.0, half_depth=0.4), "pinned")
    >>> fixed.top
    'pinned'
    """

    frame: RockingFrame
    cap: Cap
    top: Top

    def __post_init__(self) -> None:
        if self.top not in get_args(Top):
            raise ValueError(
                f"top is {self.top!r}; expected 'pinned', columns that may turn at their tops, "
                "or 'guided', columns that may not"
            )
        if self.top == "guided" and self.frame.mass_ratio == 0.0:
            raise ValueError(
                "top is 'guided' and the frame has no cap beam (γ = 0) that guides its columns; "
                "expected 'pinned', which makes them cantilevers, or γ > 0"
            )

    @property
    def _shares(self) -> tuple[float, float]:
        """Of the columns and of the cap beam in the weight."""
        gamma = self.frame.mass_ratio
        columns = 0.0 if gamma == math.inf else 1.0 / (1.0 + gamma)
        return columns, 1.0 - columns

    @property
    def rigid(self) -> Array:
        """F_r: base shear, overturning moment, bending moment at base and top; over ü_g/g.

        A force P at the top bends a column at the base by 2Ph if it is pinned there; by Ph, and at
        the top as well, if it is guided. A uniform load w over its length does so by 2wh² at the
        base of a pinned one; by 4wh²/3 at the base and 2wh²/3 at the top of a guided one.
        """
        columns, beam = self._shares
        h = self.frame.column.half_height
        if self.top == "pinned":
            foot, top = (beam + columns / 2.0) * h, 0.0
        else:
            foot, top = (beam / 2.0 + columns / 3.0) * h, (beam / 2.0 + columns / 6.0) * h
        return np.array([1.0, centre_height(self.frame, self.cap), foot, top])

    @property
    def mode(self) -> Array:
        """F_m: as `rigid`, of the load m ψ Γ of the mode.

        Over the length ∫ψ = 3/8, ∫ψ² = 33/140 and ∫ψx = 11/40 pinned; 1/2, 13/35 and 7/20 guided,
        with ∫ψ(x − x²/2) = 13/60 and ∫ψx²/2 = 2/15.
        """
        columns, beam = self._shares
        h = self.frame.column.half_height
        if self.top == "pinned":
            mean, square, first = 3.0 / 8.0, 33.0 / 140.0, 11.0 / 40.0
            foot, top = (beam + columns * first) * h, 0.0
        else:
            mean, square, first = 1.0 / 2.0, 13.0 / 35.0, 7.0 / 20.0
            foot = (beam / 2.0 + columns * 13.0 / 60.0) * h
            top = (beam / 2.0 + columns * 2.0 / 15.0) * h
        participation = (beam + columns * mean) / (beam + columns * square)  # Γ
        arm = beam * (2.0 * h + self.cap.half_depth) + columns * 2.0 * h * first
        return participation * np.array([beam + columns * mean, arm, foot, top])

    def forces(self, ground: Array, total: Array) -> Array:
        """Return the four forces of `rigid` as columns, for ü_g and A in g."""
        rigid, mode = self.rigid, self.mode
        found: Array = ground[:, None] * (rigid - mode) + total[:, None] * mode
        return found


def peak_rigid(fixed: FixedFrame, excitation: Pulse | Record) -> Forces:
    """Return the largest forces of the rigid frame: those of the peak ground acceleration.

    >>> column, pulse = th.Column(0.5, 3.0), th.Pulse("one-sine", 1.0, 2.0)
    >>> frame = th.RockingFrame(column, mass_ratio=2.0)
    >>> fixed = th.FixedFrame(frame, th.Cap(span=5.0, half_depth=0.4), "pinned")
    >>> round(th.peak_rigid(fixed, pulse.scaled(0.1)).overturning_moment, 4)
    0.5267
    """
    if isinstance(_ending(excitation), Record):
        largest = excitation.peak_acceleration
    else:
        largest = max(s.largest(s.start, s.stop) for s in excitation.segments(excitation.duration))
    return _peaks(fixed.rigid[None, :] * largest)


def peak_elastic(
    fixed: Sequence[FixedFrame], excitation: Pulse | Record, period: float, steps: int = STEPS
) -> list[Forces]:
    """Return the largest forces of elastic frames of one period, also after the ground is at rest.

    The oscillator is integrated exactly for a ground acceleration that is linear in each step: a
    record is; a pulse is followed to (2π/steps)²/8 of its amplitude.

    >>> column, pulse = th.Column(0.5, 3.0), th.Pulse("one-sine", 1.0, 2.0)
    >>> frame = th.RockingFrame(column, mass_ratio=2.0)
    >>> fixed = th.FixedFrame(frame, th.Cap(span=5.0, half_depth=0.4), "pinned")
    >>> round(th.peak_elastic([fixed], pulse, period=0.3)[0].base_shear, 3)
    1.04
    """
    start, end, step = _steps(_ending(excitation), checks.positive("period", period, "s"), steps)
    total = _total_acceleration(start, end, step, period)
    jumps = np.append(np.flatnonzero(end[:-1] != start[1:]), end.size - 1)  # else a point is twice
    course = _outermost(np.c_[np.r_[start, end[jumps]], np.r_[total[:-1], total[jumps + 1]]])
    return [_peaks(one.forces(*course.T)) for one in fixed]


def peak_elastic_by_scipy(
    fixed: FixedFrame, excitation: Excitation, period: float, steps: int = STEPS
) -> Forces:
    """Return the same by SciPy's integration of the equation of motion: the second solver.

    >>> column, pulse = th.Column(0.5, 3.0), th.Pulse("one-sine", 1.0, 2.0)
    >>> frame = th.RockingFrame(column, mass_ratio=2.0)
    >>> fixed = th.FixedFrame(frame, th.Cap(span=5.0, half_depth=0.4), "pinned")
    >>> round(th.peak_elastic_by_scipy(fixed, pulse, period=0.3).base_shear, 3)
    1.04
    """
    omega, found, state = 2.0 * math.pi / checks.positive("period", period, "s"), [], np.zeros(2)
    end = _ending(excitation).duration
    for segment in [*excitation.segments(end), Segment(end, end + period, _no_acceleration)]:
        first, last, push = segment.start, segment.stop, segment.acceleration

        def equation(t: float, y: Array, push=push) -> list[float]:  # type: ignore[no-untyped-def]
            return [y[1], -push(t) - 2.0 * DAMPING * omega * y[1] - omega**2 * y[0]]

        times = np.linspace(first, last, max(3, math.ceil((last - first) / period * steps)))
        scale = max(1e-200, *(abs(push(t)) for t in times))  # above what vanishes as a tolerance
        course = solve_ivp(
            equation,
            (first, last),
            state,
            method="DOP853",
            t_eval=times,
            max_step=(last - first),
            rtol=SECOND_TOLERANCE,
            atol=SECOND_TOLERANCE * scale * np.array([1.0 / omega**2, 1.0 / omega]),
        )
        state = course.y[:, -1]
        total = -2.0 * DAMPING * omega * course.y[1] - omega**2 * course.y[0]
        found.append(fixed.forces(np.array([push(t) for t in times]), total))
    return _peaks(np.vstack(found))


def _ending(excitation: Motion) -> Motion:
    """Return a ground motion that ends, or raise ValueError."""
    if not isinstance(excitation, Excitation) or excitation.duration == math.inf:
        raise ValueError(
            f"excitation is {short(excitation)}; expected a Pulse or a Record that ends"
        )
    return excitation


def _outermost(course: Array) -> Array:
    """Return the points (ü_g, A) of a course on which a force, linear in both, can be largest.

    Those inside the quadrilateral of the least and the largest ü_g and A are left out first.
    """
    from scipy.spatial import ConvexHull, QhullError  # here, as most users never need it

    x, y = course.T
    corners = course[[*course.argmin(axis=0), *course.argmax(axis=0)]]  # counterclockwise
    outside = np.zeros(x.size, dtype=bool)
    for (x0, y0), (x1, y1) in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        outside |= (x1 - x0) * (y - y0) <= (y1 - y0) * (x - x0)
    course = course[outside]
    try:
        outermost: Array = course[ConvexHull(course).vertices]
    except QhullError:  # the points lie on a line
        return course
    return outermost


def _peaks(forces: Array) -> Forces:
    shear, overturning, foot, top = (float(value) for value in np.abs(forces).max(axis=0))
    return Forces(shear, overturning, max(foot, top))


def _steps(excitation: Pulse | Record, period: float, steps: int) -> tuple[Array, Array, float]:
    """Return ü_g at the start and the end of every step, g, and the step, s; then one period."""
    if isinstance(excitation, Record):
        parts = max(1, math.ceil(excitation.time_step / period * steps))
        step = excitation.time_step / parts
        count = (excitation.acceleration.size - 1) * parts
    else:
        wave = 2.0 * math.pi / excitation.angular_frequency
        count = math.ceil(excitation.duration / min(wave, period) * steps)
        step = excitation.duration / count
    ground = np.asarray(excitation.excitation(np.arange(count) * step), dtype=float)
    last = np.asarray(excitation.excitation(excitation.duration * (1.0 - 1e-15)), dtype=float)
    rest = np.zeros(math.ceil(period / step))
    return np.r_[ground, rest], np.r_[ground[1:], last, rest], step


def _total_acceleration(start: Array, end: Array, step: float, period: float) -> Array:
    """Return A at the ends of all steps, g, from rest.

    z = ∫e^{λ(t−τ)} ü_g(τ) dτ with λ = −ζω + iω_d has the exact recurrence used here; the relative
    displacement is −Im z/ω_d, its rate −Im λz/ω_d, and A = −2ζω u̇ − ω² u.
    """
    omega = 2.0 * math.pi / period
    damped = omega * math.sqrt(1.0 - DAMPING**2)
    pole = complex(-DAMPING * omega, damped)
    growth = np.exp(pole * step)
    even = (growth - 1.0) / pole
    rising = (even / step - 1.0) / pole
    z = lfilter([1.0], [1.0, -growth], (even - rising) * start + rising * end)
    found: Array = np.imag((2.0 * DAMPING * omega * pole + omega**2) * z) / damped
    return np.append(0.0, found)


def _no_acceleration(time: float) -> float:
    """The ground at rest after a motion."""
    return 0.0
