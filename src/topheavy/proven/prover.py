"""Search for the steps of a proof: floats propose them, the checker proves or refuses each.

The state of a motion is the checker's. From the middles of its intervals a Taylor series in floats
says how far the next step goes and about where the impact is; a refused step is tried shorter. A
motion that can no longer be followed is bounded by walls, which only proves that it survives.
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Iterator
from copy import copy
from fractions import Fraction
from typing import Any

from topheavy import checks
from topheavy.bodies.fixed_mass import FixedMassColumn, MonolithicPortal
from topheavy.bodies.structures import STANDARD_GRAVITY, Column, RockingFrame, Structure
from topheavy.ground.excitation import checked_excitation
from topheavy.ground.pulses import Pulse
from topheavy.ground.shapes import SHAPES
from topheavy.proven.checking.bounds import Bound, rounded_up
from topheavy.proven.checking.checker import Check
from topheavy.proven.checking.intervals import NotProven
from topheavy.proven.floats import Floats, crossing, ends, first_zero, middle

PRECISIONS = ((112, 1e-13), (144, 1e-20), (176, 1e-28))
"""Bits of the checker, and the largest size of the last terms of a step, rad."""

BOX_ACCURACY = 1e-6
"""Accuracy for a box of factors, normalised by its relative width, if that is coarser."""

NARROW_BOX = 1e-9
"""Relative width of a box of factors below which the search uses the second precision."""

MAX_BOX_TRIES, MIN_BOX_STEP = 100, 0.3
"""For a box of factors: number of steps to try, and the shortest one relative to the first try."""

MAX_POINT_TRIES = 5000
"""Number of steps to try for one factor at each precision. A proof of the run takes at most 100."""

MIN_STEP = 1e-18
"""Shortest step for one factor, in the phase of the pulse."""

MAX_IMPACT_SPREAD = 0.12
"""Phase over which the impacts of a box may spread; a wider box is bounded from before them."""

N_GRID = 32
"""Parts of half a period, at whose ends the search compares |a| with the uplift acceleration."""

FIRST_WALL_STEP, WALL_STEP_GROWTH, MAX_WALL_STEP = 2.0**-6, 1.3, math.pi / 48.0
"""Steps of a bound, in the phase of the pulse."""

ENERGY_MARGIN = 1.02
"""Factor on the gain of energy: the enclosures of the checker are wider."""

LEMMA_MARGIN = 1.0 + 1e-9
"""Factor on the inequalities of the lemma, for the same reason."""

FIRST_SLACK, MAX_SLACK = 2.0**-16, 0.05
"""Relative distance of a wall from the rotation that the block reaches: first and largest one."""

MIN_SLACK = 2.0**-40
"""Least distance, rad."""

MAX_TRIES = 40

MIN_BOX_WIDTH = 1e-11
"""Relative to the highest factor: a narrower box that is not proven stays undecided."""

AFTER_FAILURE, AFTER_RETRY, AFTER_SUCCESS = 0.7, 0.95, 1.1
"""Width of the next box over the last one, which was not proven, proven after a failure, or proven
at the first try."""


def certified(
    structure: Structure, pulse: Pulse, factor: float | tuple[float, float] = 1.0
) -> dict[str, Any] | None:
    """Return a certificate of whether a structure at rest survives a pulse, or None if undecided.

    `topheavy.proven.checking.check` verifies the certificate.

    Parameters
    ----------
    structure : Structure
        Column, RockingFrame, FixedMassColumn and MonolithicPortal stand for their dimensions, any
        other for the three numbers of its block. Each float stands for its shortest decimal.
    pulse : Pulse
        One that ends.
    factor : float or (float, float)
        On the acceleration; a pair stands for all factors between, if they share an outcome.

    Returns
    -------
    dict or None
        "outcome" is "survives" or "overturns", as `topheavy.judge` defines them. "impacts" is their
        number until the outcome is decided, or None if the motion is only bounded. None, with a
        warning, also where the search has tried its last step (MAX_POINT_TRIES).

    Raises
    ------
    ValueError
        For a ground motion that is no pulse or does not end, a factor that is not finite or does
        not ascend, a structure whose √r is negative, and dimensions beyond those of a certificate.
    """
    problem = problem_of(structure, pulse, factor)
    low, high = map(float, problem["factor"])
    width = (high - low) / max(abs(low), abs(high)) if high > low else 0.0
    precisions = list(PRECISIONS)
    if width:
        precisions = [PRECISIONS[1 if width < NARROW_BOX else 0]]
    for bits, accuracy in precisions:
        search = Search(problem, bits, max(accuracy, BOX_ACCURACY * width), is_box=width > 0.0)
        if search.run():
            return search.certificate
    if not width and search.tries == MAX_POINT_TRIES:
        message = (
            f"no proof within {MAX_POINT_TRIES} steps ({search.reason or 'all taken'}): undecided"
        )
        warnings.warn(message, UserWarning, stacklevel=2)
    return None


def survives_below(
    structure: Structure, pulse: Pulse, high: float
) -> tuple[list[dict[str, Any]], list[tuple[float, float]]]:
    """Prove, box by box, that a structure survives all factors from 0 to `high` on a pulse.

    Returns
    -------
    list of dict
        Certificates of boxes of factors that survive, in ascending order.
    list of (float, float)
        Boxes that are undecided or overturn; none if every factor is proven to survive.

    Raises
    ------
    ValueError
        As `certified`, and for a `high` that is not positive.
    """
    high = checks.positive("high", high)
    certificates, undecided = [], []
    low, width, growth = 0.0, high, AFTER_SUCCESS
    while low < high:
        top = min(low + width, high)
        width = top - low
        certificate = certified(structure, pulse, (low, top))
        if certificate and certificate["outcome"] == "survives":
            certificates.append(certificate)
        elif certificate or width < MIN_BOX_WIDTH * high:
            undecided.append((low, top))
        else:
            width, growth = AFTER_FAILURE * width, AFTER_RETRY
            continue
        low, width, growth = top, growth * width, AFTER_SUCCESS
    return certificates, undecided


def problem_of(
    structure: Structure, pulse: Pulse, factor: float | tuple[float, float]
) -> dict[str, Any]:
    """Return the entries of a certificate that say what it is about; see `certified`."""
    if not isinstance(pulse, Pulse):
        raise ValueError(f"pulse is {checks.short_repr(pulse)}; expected a Pulse")
    checked_excitation(pulse, ends=True)
    ends = factor if isinstance(factor, tuple) else (factor, factor)
    low, high = (checks.finite("factor", end) for end in ends)
    if low > high:
        raise ValueError(f"factor is ({low:.6g}, {high:.6g}); expected the lower end first")
    return {
        "structure": _dimensions(structure),
        "linearised": structure.block().linearised,
        "pulse": {
            "wave": SHAPES[pulse.shape].wave,
            "half_periods": int(pulse.half_periods),
            **_decimals(pulse, "amplitude", "angular_frequency"),
        },
        "factor": [_decimal(low), _decimal(high)],
    }


def _dimensions(structure: Structure) -> dict[str, str]:
    match structure:
        case Column() | RockingFrame():
            column = structure if isinstance(structure, Column) else structure.column
            ratio = 0.0 if isinstance(structure, Column) else structure.mass_ratio
            return {"kind": "frame", **_sides(column, ratio)}
        case FixedMassColumn(column=column, mass_ratio=ratio):
            axis, width = Fraction(0), Fraction(_decimal(structure.cap_width))
        case MonolithicPortal(column=column, mass_ratio=ratio):
            axis = Fraction(_decimal(structure.span)) / 2
            overhang = Fraction(_decimal(structure.overhang))
            width = 2 * (axis + Fraction(_decimal(column.half_width)) + overhang)
        case _:
            names = "slenderness", "frequency_parameter", "restitution"
            return {"kind": "block", **_decimals(structure.block(), *names)}
    cap = {"axis": str(axis), "cap_width": str(width), **_decimals(structure, "cap_depth")}
    return {"kind": "body", **_sides(column, ratio), **cap}


def _sides(column: Column, ratio: float) -> dict[str, str]:
    return {
        **_decimals(column, "half_width", "half_height"),
        "mass_ratio": "infinite" if ratio == math.inf else _decimal(ratio),
        "gravity": _decimal(STANDARD_GRAVITY),
    }


def _decimals(thing: Any, *names: str) -> dict[str, str]:
    return {name: _decimal(getattr(thing, name)) for name in names}


def _decimal(number: float) -> str:
    """Return the shortest decimal of a float, which it stands for in a proof."""
    return repr(float(number))


class Search:
    """The state of a motion in the checker, and the certificate of its steps so far."""

    def __init__(
        self, problem: dict[str, Any], bits: int, accuracy: float, *, is_box: bool
    ) -> None:
        self.accuracy, self.is_box = accuracy, is_box
        self.order = int(-math.log2(accuracy) / 3.0) + 2
        proof = {"bits": bits, "order": self.order, "events": []}
        self.certificate = problem | {"outcome": "survives", "impacts": None} | proof
        self.check = Check(self.certificate)
        self.floats = Floats(self.check)
        self.length, self.tries, self.reason = 1.0, 0, ""

    def run(self) -> bool:
        """Search for a proof, and return whether there is one."""
        try:
            self._follow()
            outcome = self.check.end()
        except NotProven:
            if not self._bound():
                return False
            outcome = self.check.end()
        self.certificate |= {"outcome": outcome, "impacts": self.check.proven_impacts}
        return True

    def _take(self, name: str, **event: Any) -> bool:
        """Return whether the checker accepts an event; if it does, add it to the certificate."""
        trial = copy(self.check)
        event = {"event": name} | event
        try:
            trial.verify_event(event)
        except NotProven as reason:
            self.reason = str(reason)
            return False
        self.check = trial
        self.certificate["events"].append(event)
        return True

    def _follow(self) -> None:
        """Follow the motion until it is decided, or raise `NotProven`."""
        if not self._uplift():
            return
        largest = ends(self.check.ground.largest)[1]
        while not (self.check.is_over or self.check.result):
            self._step()
            beyond = middle(self.check.phi) - self.floats.alpha
            if self.check.rate > 0 and beyond > 0.0 and math.tan(beyond) > largest:
                self._take("gone")

    def _uplift(self) -> bool:
        """Return whether the block uplifts, and take the event if it does."""

        def is_beyond(sigma: float) -> bool:
            return abs(self.floats.wave(sigma, 1)[0]) > self.floats.uplift_level

        stop = ends(self.check.ground.stop)[0]
        parts = N_GRID * self.certificate["pulse"]["half_periods"]
        grid = [stop * k / parts for k in range(parts + 1)]
        for k, sigma in enumerate(grid):
            if is_beyond(sigma):
                place = crossing(grid[k - 1], sigma, is_beyond) if k else 0.0
                if not self._take("uplift", sigma=repr(place)):
                    raise NotProven(self.reason)
                return True
        return False

    def _step(self) -> None:
        """Take a step, or raise `NotProven` where none is accepted."""
        check, zero_order = self.check, self.check.zero_order
        c = self._series()
        h = 2.0 * self.length if zero_order == 0 else 8.0
        for k in (self.order, self.order - 1):
            if c[k]:
                h = min(h, (self.accuracy / abs(c[k])) ** (1.0 / k))
        if zero_order == 1 and c[2] < 0.0:  # a bounce that ends soon
            h = min(h, -1.25 * ends(check.rate)[1] / c[2])
        low, left = ends(check.ground.stop - check.sigma)
        shortest = MIN_BOX_STEP * h if self.is_box else MIN_STEP
        limit = MAX_BOX_TRIES if self.is_box else MAX_POINT_TRIES
        while h > shortest and self.tries < limit:
            self.tries += 1
            is_last = low <= h
            length = left * (1.0 + 1e-12) if is_last else h
            time = first_zero(c[zero_order:], 1.02 * length)
            if time and is_last and time > left:
                time = None
            if self._take("step", h=repr(length), last=is_last, impact=time and repr(time)):
                self._undo_wide_impact(check, is_impact=time is not None)
                self.length = length
                return
            if "outside of the step" in self.reason and time and not is_last:
                h = 0.85 * time if time > 0.9 * length else 1.15 * h
                shortest *= 1.02
            elif "after the end of the pulse" in self.reason:
                break
            else:
                h = 0.5 * min(length, left)
        raise NotProven(self.reason or "too many steps")

    def _series(self) -> list[float]:
        """Return the coefficients of φ in floats."""
        check = self.check
        push = [check.side * x for x in self.floats.wave(middle(check.sigma), self.order)]
        c = self.floats.series(middle(check.phi), middle(check.rate), push, self.order)
        c[: check.zero_order] = [0.0] * check.zero_order
        if not c[check.zero_order] > 0.0:
            raise NotProven("it may not leave the ground")
        return c

    def _undo_wide_impact(self, before: Check, *, is_impact: bool) -> None:
        low, high = ends(self.check.sigma)
        low_before, high_before = ends(before.sigma)
        if self.is_box and is_impact and high - low > MAX_IMPACT_SPREAD + high_before - low_before:
            self.check = before
            self.certificate["events"].pop()
            raise NotProven("the impacts of the box are far apart")

    def _bound(self) -> bool:
        """Take walls up to the end of the pulse, and return whether they prove survival."""
        if self.check.is_over or self.check.result:
            return False
        stop = math.nextafter(ends(self.check.ground.stop)[1], math.inf)
        sigma, h = ends(self.check.sigma)[1], FIRST_WALL_STEP
        while sigma < stop:
            sigma = min(sigma + h, stop)
            for pair in proposed_walls(self.floats, self.check.bounded(), sigma):
                if self._take("walls", sigma=repr(sigma), walls=[repr(x) for x in pair]):
                    break
            else:
                return False
            h = min(WALL_STEP_GROWTH * h, MAX_WALL_STEP)
        try:
            return bool(self.check.end())
        except NotProven:
            return False


def proposed_walls(floats: Floats, bound: Bound, sigma: float) -> Iterator[tuple[float, float]]:
    """Yield pairs of walls up to a phase, each looser than the last, while they are below α."""
    h, grounds, rises = bound.pushes(rounded_up(repr(sigma)))
    sides = [
        _Side(floats, ends(h)[1], ends(before)[1], ends(ground)[0])
        for before, ground in zip(bound.walls, grounds, strict=True)
    ]
    gains = [max(0.0, ends(rise)[1]) for rise in rises]
    first = energy = ends(bound.energy)[1]
    slack = FIRST_SLACK
    for _ in range(MAX_TRIES):
        for side in sides:
            side.move(energy, slack)
        if any(side.wall >= floats.alpha for side in sides):
            return
        gain = max(rise * floats.lever(side.wall) for rise, side in zip(gains, sides, strict=True))
        energy = first + floats.kappa_squared * ENERGY_MARGIN * gain
        if all(side.holds(energy) for side in sides):
            yield sides[0].wall, sides[1].wall
        slack = min(1.5 * slack, MAX_SLACK)


class _Side:
    """X_s, Y_s and m_s of a step of length h."""

    def __init__(self, floats: Floats, h: float, before: float, least: float) -> None:
        self.floats, self.h, self.before, self.least = floats, h, before, least
        self.wall = before

    def move(self, energy: float, slack: float) -> None:
        """Move the wall a share beyond the rotation that the block reaches with an energy."""
        reached = min(self.before + self._way(energy), self.floats.turn(energy, self.least))
        self.wall = reached * (1.0 + slack) + MIN_SLACK

    def holds(self, energy: float) -> bool:
        """Return whether the lemma holds with a margin."""
        old, new = (self.floats.potential(x, self.least) for x in (self.before, self.wall))
        bound = LEMMA_MARGIN * energy
        if new > bound and (self.wall >= self.before or old > bound):
            return True
        return self.wall - self.before > LEMMA_MARGIN * self._way(energy)

    def _way(self, energy: float) -> float:
        potentials = (self.floats.potential(x, self.least) for x in (self.before, self.wall))
        rates = [math.sqrt(max(0.0, 2.0 * (energy - x))) for x in potentials]
        is_concave = self.least * self.floats.uplift_level < 1.0
        return self.h * (sum(rates) / 2.0 if is_concave else max(rates))
