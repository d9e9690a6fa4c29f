"""Check a certificate of an outcome, event by event, in interval arithmetic.

An event proposes a step, an impact or walls; nothing that it proposes is believed. Intervals prove
that no impact comes earlier than the proposed one, and how the motion ends.
"""

from collections.abc import Callable
from fractions import Fraction
from typing import Any

from . import intervals
from .bounds import Bound, rounded_up
from .intervals import Interval, NotProven, arctangent, cosine, enclose, point, sine
from .model import Block, Ground
from .schema import validated
from .taylor_model import TaylorModel, horner

MAX_PARTS = 2**30  # parts of a span: a sign that is unproven on such a small part stays unproven
N_HALVINGS = 6  # of either side of a bracket, towards the part where neither sign is proven

Test = Callable[[Interval], bool]


def _holds(test: Test, low: int, high: int, reason: str) -> None:
    """Prove a statement on a span of numbers (in units of 2^−P) by cutting it."""
    parts, finest = [(low, high)], max(1, (high - low) // MAX_PARTS)
    while parts:
        low, high = parts.pop()
        if not test(Interval(low, high)):
            if high - low <= finest:
                raise NotProven(reason)
            middle = (low + high) // 2
            parts += [(middle, high), (low, middle)]


def _bracket(hint: int, before: Test, behind: Test) -> tuple[int, int]:
    """Return close numbers around a hint at which one statement and the other are proven."""
    low, high = _reached(hint, before, -1), _reached(hint, behind, 1)
    while high - low > 1:
        middle = (low + high) // 2
        if before(point(middle)):
            low = middle
        elif behind(point(middle)):
            high = middle
        else:
            return _tightened(low, middle, before), _tightened(high, middle, behind)
    return low, high


def _reached(start: int, test: Test, sign: int) -> int:
    """Return a number at which a statement is proven, beyond the start by ever longer steps."""
    grow = 0
    while not test(point(start + sign * grow)):
        grow = 2 * grow + 1
        if grow > intervals.UNIT:
            raise NotProven("nothing changes its sign near the hint")
    return start + sign * grow


def _tightened(good: int, bad: int, test: Test) -> int:
    """Return a number closer to `bad` at which a statement is proven, as it is at `good`."""
    for _ in range(N_HALVINGS):
        middle = (good + bad) // 2
        good, bad = (middle, bad) if test(point(middle)) else (good, middle)
    return good


class Check:
    """The motion of a certificate, proven event by event."""

    def __init__(self, certificate: dict[str, Any]) -> None:
        validated(certificate)
        intervals.precision(certificate["bits"])
        self.block = Block(certificate["structure"], certificate["linearised"])
        self.ground = Ground(certificate["pulse"], certificate["factor"], self.block.p_squared)
        self.order = certificate["order"]
        self.quarter_turn = arctangent(enclose(1)) * 2
        self.sigma, self.phi, self.rate = enclose(0), enclose(0), enclose(0)
        self.energy = enclose(0)  # φ'²/2 + κ² (Φ + s a ψ): it encloses what state and time share
        self.side = self.impacts = self.zero_order = 0
        self.is_over = False  # the pulse
        self.bound: Bound | None = None  # in place of the state
        self.result = ""

    def verify_event(self, event: dict[str, Any]) -> None:
        """Prove the next event, or raise `NotProven`."""
        if self.result or self.is_over:
            raise NotProven("the motion is already decided")
        match event["event"]:
            case "uplift":
                self._uplift(Fraction(event["sigma"]))
            case "step":
                self._step(Fraction(event["h"]), event["impact"], is_last=event["last"])
            case "walls":
                self._walls(event["sigma"], event["walls"])
            case "gone":
                self._cannot_return()

    @property
    def proven_impacts(self) -> int | None:
        """The impacts of the motion until it is decided; None if it ends in a bound."""
        return None if self.bound else self.impacts

    def _followed(self, *, rests: bool) -> None:
        if self.bound:
            raise NotProven("the motion is bounded and no longer followed")
        if rests == bool(self.side):
            raise NotProven("the block is not at rest" if rests else "the block is at rest")

    def _uplift(self, hint: Fraction) -> None:
        """From rest: |a| stays below the level up to a bracket, in which it passes through it.

        The next step proves that |a| rises in all of the bracket: else φ''' may be zero.
        """
        self._followed(rests=True)
        if self._is_above(enclose(0)):
            self.sigma, self.zero_order = enclose(0), 2
        else:
            low, high = _bracket(enclose(hint).middle, self._is_below, self._is_above)
            if low < 0:
                raise NotProven("it begins earlier than the motion")
            if high >= self.ground.stop.low:
                raise NotProven("the pulse may have ended")
            self._still(low)
            self.sigma, self.zero_order = Interval(low, high), 3
        self.side = 1 if self.ground.at(point(self.sigma.high)) < 0 else -1

    def _still(self, until: int) -> None:
        """Prove |a| < level from 0 to a phase at which it is known to be."""

        def below(x: Interval) -> bool:
            if self._is_below(x):
                return True
            value, slope = self.ground.series(x, enclose(1), 2)
            return x.high == until and ((value > 0 and slope > 0) or (value < 0 and slope < 0))

        _holds(below, 0, until, "the ground may lift the block earlier")

    def _is_below(self, sigma: Interval) -> bool:
        return self.ground.at(sigma).size() < self.block.uplift_level

    def _is_above(self, sigma: Interval) -> bool:
        return self.ground.at(sigma).size() > self.block.uplift_level

    def _step(self, h: Fraction, impact: str | None, *, is_last: bool) -> None:
        self._followed(rests=False)
        if not self.sigma < self.ground.stop:
            raise NotProven("the pulse may have ended")
        left = self.ground.stop - self.sigma
        if is_last:
            h = max(h, Fraction(left.high, intervals.UNIT))
        elif not enclose(h) < left:
            raise NotProven("a step goes on beyond the pulse")
        if not h > 0:
            raise NotProven("a step goes back")
        model = TaylorModel(self, h)
        end = left / model.h if is_last else enclose(1)
        if impact is None:
            if self.zero_order or not model.box > 0:
                self._is_positive(model, end.high, falls=False)
        else:
            end = self._impact_in(model, enclose(Fraction(impact) / h).middle)
            if is_last and not end < left / model.h:
                raise NotProven("the impact may come after the end of the pulse")
        if not self._lies_flat(model, end):
            self.phi, self.rate = model.at(end)
            self.energy = self.energy + horner(model.gain, end)
            if impact is not None:
                self._lands(model.landing(end, self.zero_order), end * model.h)
            else:
                self.sigma = self.ground.stop if is_last else self.sigma + model.h
                self.zero_order, self.is_over = 0, is_last
                self._sharpen()

    def _lands(self, rate: Interval, after: Interval) -> None:
        self.energy = self.energy.common(rate * rate / 2)
        self.impacts, self.sigma, self.phi = self.impacts + 1, self.sigma + after, enclose(0)
        self.zero_order, self.side = 1, -self.side
        self.rate = -self.block.restitution * rate
        self.energy = self.block.restitution * self.block.restitution * self.energy
        if self.energy > 0 and self.rate > 0:
            self.rate = self.rate.common((2 * self.energy).root())

    def _sharpen(self) -> None:
        """Let energy and velocity narrow each other."""
        push = self.side * self.ground.at(self.sigma)
        potential = self.ground.kappa_squared * self.block.potential(self.phi, push)
        self.energy = self.energy.common(potential + self.rate * self.rate / 2)
        square = 2 * (self.energy - potential)
        if square > 0 and (self.rate > 0 or self.rate < 0):
            self.rate = self.rate.common((1 if self.rate > 0 else -1) * square.root())

    def bounded(self) -> Bound:
        """Return the bound on the motion, which holds the state if it has been followed so far."""
        state = self.phi, self.rate
        return self.bound or Bound.of_state(self.block, self.ground, self.sigma, self.side, state)

    def _walls(self, until: str, walls: list[str]) -> None:
        """Bound the motion from here on, or bound it further."""
        bound = self.bounded()
        if bound.sigma.low >= self.ground.stop.high:
            raise NotProven("a step comes after the pulse")
        one, other = map(rounded_up, walls)
        self.bound = bound.stepped(rounded_up(until), (one, other))

    def _impact_in(self, model: TaylorModel, hint: int) -> Interval:
        """Return the interval of the first τ > 0 with φ = 0."""
        low, high = _bracket(
            hint, lambda x: horner(model.phi, x) > 0, lambda x: horner(model.phi, x) < 0
        )
        if high > intervals.UNIT or low < 0:
            raise NotProven("the impact may come outside of the step")
        self._is_positive(model, high, falls=True)
        return Interval(low, high)

    def _is_positive(self, model: TaylorModel, until: int, *, falls: bool) -> None:
        """Prove φ > 0 from behind the start until a time; or, where it falls, one zero before."""
        quotient, slope = model.quotient(self.zero_order)

        def positive(x: Interval) -> bool:
            if horner(quotient, x) > 0:
                return True
            steep = horner(slope, x)
            return steep > 0 or (falls and x.high == until and steep < 0)

        if not quotient[0] > 0:
            raise NotProven("it may not leave the ground")
        _holds(positive, 0, until, "there may be an impact")  # in ascending order

    def _lies_flat(self, model: TaylorModel, end: Interval) -> bool:
        if self.block.linearised or model.box < self.quarter_turn:
            return False
        if not model.at(end)[0] > self.quarter_turn:
            raise NotProven("it may lie flat, or not")
        self.result = "overturns"
        return True

    def _cannot_return(self) -> None:
        """It moves outward with tan(φ − α) beyond any push that is still to come."""
        self._followed(rests=False)
        if not self.rate > 0:
            raise NotProven("it does not move outward")
        largest = self.ground.largest
        if self.block.linearised:
            beyond = self.phi - self.block.alpha > largest
        else:
            s, c = sine(self.phi), cosine(self.phi)
            across = self.block.cosine * s - self.block.sine * c  # sin(φ − α)
            along = self.block.cosine * c + self.block.sine * s
            beyond = across > 0 and (along < 0 or across > largest * along)
        if not beyond:
            raise NotProven("a later push may bring it back")
        self.result = "overturns"

    def end(self) -> str:
        """Return the outcome behind the pulse: at rest, by the bound, or by the energy."""
        if self.result:
            return self.result
        overturns = False
        if self.bound:
            if not self.bound.survives():
                raise NotProven("the energy may be beyond the barrier")
        elif self.side:
            overturns = self._overturns_freely()
        else:
            _holds(self._is_below, 0, self.ground.stop.high, "the ground may lift the block")
        self.result = "overturns" if overturns else "survives"
        return self.result

    def _overturns_freely(self) -> bool:
        """Return whether a motion overturns behind the pulse; an impact that it needs counts."""
        if not self.is_over:
            raise NotProven("the pulse has not ended")
        if not self.phi > 0:
            raise NotProven("it may be about to land")
        block, kinetic = self.block, self.rate * self.rate / (2 * self.ground.kappa_squared)
        off = block.alpha - self.phi
        if block.linearised:
            surplus, barrier = kinetic - off * off / 2, block.alpha * block.alpha / 2
        else:
            surplus, barrier = kinetic + cosine(off) - 1, 1 - block.cosine
        rebound = block.restitution * block.restitution * (surplus + barrier) - barrier
        inward = self.rate < 0 and (off > 0 or surplus > 0)
        if (surplus < 0 and off > 0) or (inward and rebound < 0):
            return False
        if (off < 0 and (surplus < 0 or self.rate > 0)) or (surplus > 0 and self.rate > 0):
            return True
        if inward and rebound > 0:
            self.impacts += 1
            return True
        raise NotProven("its energy is too near the barrier")


def check(certificate: dict[str, Any]) -> str:
    """Return the outcome that a certificate proves, or raise `NotProven` with the first gap.

    Parameters
    ----------
    certificate : dict
        As `topheavy.proven.certified` returns it, or its JSON.
    """
    motion = Check(certificate)
    for number, event in enumerate(certificate["events"]):
        try:
            motion.verify_event(event)
        except NotProven as reason:
            raise NotProven(f"event {number}, {event['event']}: {reason}") from None
    proven, named = (motion.end(), motion.proven_impacts), ("outcome", "impacts")
    for name, value in zip(named, proven, strict=True):
        if certificate[name] != value:
            raise NotProven(f"the {name} in the certificate: {certificate[name]}; proven: {value}")
    return motion.end()
