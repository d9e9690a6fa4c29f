"""Check a certificate of an outcome: with the standard library alone, and no line of the search.

The search (`topheavy.proven.search`) is free to be clever: it chooses steps, brackets impacts and
finds a box for each step. All of this is a hint here. Intervals prove every claim anew: that the
box holds the motion, that no impact comes earlier, and how the motion ends. The enclosure of the
peak is not checked.
"""

from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any

from . import intervals
from .bounds import Bound, named
from .course import Course, horner
from .intervals import Interval, Refused, arctangent, between, cosine, of, sine
from .model import Block, Ground
from .schema import validated

GUARD = 40  # bits beyond those of the search
FINEST = 2**30  # a share of a span so small is not cut before a sign counts as unproven


def _holds(test: Callable[[Interval], bool], low: int, high: int, what: str) -> None:
    """Prove a statement on a span of numbers (in units of 2^−P) by cutting it."""
    parts, finest = [(low, high)], max(1, (high - low) // FINEST)
    while parts:
        low, high = parts.pop()
        if not test(Interval(low, high)):
            if high - low <= finest:
                raise Refused(what)
            middle = (low + high) // 2
            parts += [(middle, high), (low, middle)]


class Check:
    """The motion of a certificate, proven event by event."""

    def __init__(self, given: dict[str, Any]) -> None:
        self.block = Block(given["structure"], given["linearised"])
        self.ground = Ground(given["excitation"], given["factor"], self.block.square)
        self.order = given["order"]
        self.quarter_turn = arctangent(of(1)) * 2
        self.sigma, self.phi, self.rate = of(0), of(0), of(0)
        self.energy = of(0)  # φ'²/2 + κ² (Φ + s a ψ): it knows what state and time share
        self.side = self.piece = self.impacts = self.zeros = 0
        self.result = ""

    def run(self, events: Sequence[dict[str, Any]]) -> str:
        for number, event in enumerate(events):
            if self.result:
                raise Refused(f"event {number} comes after the outcome")
            try:
                getattr(self, "_" + event["event"])(event)
            except Refused as reason:
                raise Refused(f"event {number}, {event['event']}: {reason}") from None
        if not self.result:
            self._end()
        return self.result

    def _uplift(self, event: dict[str, Any]) -> None:
        """From rest: |a| stays below the level up to a bracket, in which it rises through it."""
        if self.side:
            raise Refused("the block is not at rest")
        side, level = event["side"], self.block.level
        bracket = between(*event["sigma"])
        piece = event["piece"]
        if not self.piece <= piece < len(self.ground.stops):
            raise Refused("the piece is over, or there is none")
        if event["jumps"]:
            if self.sigma.low or self.sigma.high or piece:
                raise Refused("only where the motion begins can it jump")
            if not -side * self.ground.at(0, of(0)) > level:
                raise Refused("the first acceleration is not beyond the level")
            self.zeros = 2
        else:
            low, high = self._widened(
                bracket,
                lambda x: -side * self.ground.at(piece, x) < level,
                lambda x: -side * self.ground.at(piece, x) > level,
            )
            begins = self.ground.stops[piece - 1].high if piece else 0
            if not low >= max(self.sigma.high, begins):
                raise Refused("it begins earlier than the piece, or than the block came to rest")
            if not self.ground.at(piece, Interval(low, low)).size() < level:
                raise Refused("the ground may have lifted it before")
            self._still(Interval(low, low), piece, -side)
            self.sigma, self.zeros = Interval(low, high), 3
        self.piece, self.side, self.phi, self.rate = piece, side, of(0), of(0)
        self.energy = of(0)

    def _still(self, until: Interval, piece: int, rising: int = 0) -> None:
        """Prove |a| < level from σ to `until` in a piece; close to the end by a rising a."""
        level = self.block.level
        for number in range(self.piece, piece + 1):
            low = self.sigma.high if number == self.piece else self.ground.stops[number - 1].low
            high = until.high if number == piece else self.ground.stops[number].high

            def below(x: Interval, number: int = number) -> bool:
                if self.ground.at(number, x).size() < level:
                    return True
                if not (rising and number == piece and x.high == until.high):
                    return False
                first = self.ground.at(number, Interval(x.low, x.low)).size() < level
                return first and rising * self.ground.series(number, x, of(1), 2)[1] > 0

            if low < high:
                _holds(below, low, high, "the ground may lift the block earlier")
        if rising and not rising * self.ground.at(piece, until) < level:
            raise Refused("the ground is beyond the level already")

    def _widened(
        self, bracket: Interval, before: Callable[[Interval], bool], behind: Callable[..., bool]
    ) -> tuple[int, int]:
        """Return a bracket at whose ends two statements are proven: that of the hint, wider."""
        grow = max(1, (bracket.high - bracket.low) // 64)
        while grow < intervals.UNIT:
            low, high = bracket.low - grow, bracket.high + grow
            if before(Interval(low, low)) and behind(Interval(high, high)):
                return low, high
            grow += grow // 2 + 1
        raise Refused("nothing changes its sign in the bracket")

    def _step(self, event: dict[str, Any]) -> None:
        if not self.side:
            raise Refused("the block is at rest")
        if self.piece == len(self.ground.stops):
            raise Refused("the forcing has ended")
        if not self.sigma < self.ground.stops[self.piece]:
            raise Refused("the piece of the motion has ended")
        if self.order < 4:
            raise Refused("the order is below 4")
        h, left = Fraction(event["h"]), self.ground.stops[self.piece] - self.sigma
        if event["last"]:
            h = max(h, Fraction(left.high, intervals.UNIT))  # it ends with the piece
        elif not of(h) < left:
            raise Refused("a step goes on beyond the piece of the motion")
        if not h > 0:
            raise Refused("a step goes back")
        course = Course(self, h, event["box"])
        end = left / course.h if event["last"] else of(1)
        if event["impact"] is None:
            self._stays_up(course, end)
        else:
            end = self._impact_in(course, between(*event["impact"]) / course.h)
            if event["last"] and not end < left / course.h:
                raise Refused("the impact may come after the end of the piece")
        self._lies_flat(course, end)
        if self.result:
            return
        self.phi, self.rate = course.at(end)
        self.energy = self.energy + horner(course.gain, end)
        if event["impact"] is not None:
            self._lands(course.landing(end, self.zeros), end * course.h)
        else:
            self.sigma = self.ground.stops[self.piece] if event["last"] else self.sigma + course.h
            self._sharpen()
            self.zeros = 0
            self.piece += event["last"]

    def _lands(self, rate: Interval, after: Interval) -> None:
        self.energy = self.energy.common(rate * rate / 2)
        self.impacts, self.sigma, self.phi = self.impacts + 1, self.sigma + after, of(0)
        self.zeros, self.side = 1, -self.side
        self.rate = -self.block.restitution * rate
        self.energy = self.block.restitution * self.block.restitution * self.energy
        if self.energy > 0 and self.rate > 0:
            self.rate = self.rate.common((2 * self.energy).root())

    def _sharpen(self) -> None:
        """Let energy and velocity narrow each other."""
        push = self.side * self.ground.at(self.piece, self.sigma)
        potential = self.ground.clock * self.block.potential(self.phi, push)
        self.energy = self.energy.common(potential + self.rate * self.rate / 2)
        square = 2 * (self.energy - potential)
        if square > 0 and (self.rate > 0 or self.rate < 0):
            self.rate = self.rate.common((1 if self.rate > 0 else -1) * square.root())

    def _bounded(self, event: dict[str, Any]) -> None:
        """Follow a bound on the motion to the end of the pulse."""
        if self.piece == len(self.ground.stops):
            raise Refused("the forcing has ended")
        bound = Bound(self.block, self.ground, self.sigma)
        bound.begin(event, self.side, self.phi, self.rate)
        for given in event["steps"]:
            if bound.sigma.low >= self.ground.stops[0].high:
                raise Refused("a step comes after the pulse")
            bound.step(*named(*given))
        if not bound.sigma.low >= self.ground.stops[0].high:
            raise Refused("the bound ends before the pulse")
        if not bound.survives():
            raise Refused("the energy may be beyond the barrier")
        self.result = "survives"

    def _stays_up(self, course: Course, end: Interval) -> None:
        if self.zeros == 0 and course.box > 0:
            return
        self._is_positive(course, end.high, falls=False)

    def _impact_in(self, course: Course, bracket: Interval) -> Interval:
        """Return the interval of the first τ > 0 with φ = 0, proven."""
        low, high = self._widened(
            bracket, lambda x: course.at(x)[0] > 0, lambda x: course.at(x)[0] < 0
        )
        if high > intervals.UNIT or low < 0:
            raise Refused("the impact may come outside of the step")
        self._is_positive(course, high, falls=True)
        return Interval(low, high)

    def _is_positive(self, course: Course, until: int, *, falls: bool) -> None:
        """Prove φ > 0 from behind the start until a time; or, where it falls, one zero before."""
        quotient, slope = course.quotient(self.zeros)

        def positive(x: Interval) -> bool:
            if horner(quotient, x) > 0:
                return True
            steep = horner(slope, x)
            return steep > 0 or (falls and x.high == until and steep < 0)

        if not quotient[0] > 0:
            raise Refused("it may not leave the ground")
        _holds(positive, 0, until, "there may be an impact")  # in ascending order

    def _lies_flat(self, course: Course, end: Interval) -> None:
        if self.block.linearised:
            return
        if course.box < self.quarter_turn:
            return
        if not course.at(end)[0] > self.quarter_turn:
            raise Refused("it may lie flat, or not")
        self.result = "overturns"

    def _gone(self, event: dict[str, Any]) -> None:
        """It moves outward with tan(φ − α) beyond any push that is still to come."""
        if not self.rate > 0:
            raise Refused("it does not move outward")
        largest = self.ground.largest
        if self.block.linearised:
            beyond = self.phi - self.block.alpha > largest
        else:
            s, c = sine(self.phi), cosine(self.phi)
            across = self.block.cosine * s - self.block.sine * c  # sin(φ − α)
            along = self.block.cosine * c + self.block.sine * s
            beyond = across > 0 and (along < 0 or across > largest * along)
        if not beyond:
            raise Refused("a later push may bring it back")
        self.result = "overturns"

    def _rests(self, event: dict[str, Any]) -> None:
        """The bounces die out before the ground can lift the block."""
        if not (self.side and self.zeros == 1 and of(1) > self.block.restitution):
            raise Refused("it has not just bounced, or loses nothing")
        if self.piece == len(self.ground.stops):
            raise Refused("the forcing has ended")
        if self.block.restitution.high == 0:
            if not self.ground.at(self.piece, self.sigma).size() < self.block.level:
                raise Refused("the ground may lift it at once")
            self.side = 0
            return
        until = of(Fraction(event["sigma"][1])) + of(Fraction(1, 2**60))
        ground = self.ground.over(self.piece, self.sigma, until)
        highest = of(Fraction(event["highest"][1]) * Fraction(1025, 1024))
        kappa, speed = self.ground.clock, self.rate
        pulls = [self.block.pull(highest.hull(0), side * ground) for side in (1, -1)]
        if any(not pull > 0 for pull in pulls):
            raise Refused("the ground may lift the block")
        least = min((Interval(pull.low, pull.low) for pull in pulls), key=lambda x: x.low)
        ratio = [(Interval(x.high, x.high) / Interval(x.low, x.low)).root() for x in pulls]
        loss = [1 - self.block.restitution * x for x in ratio]
        if any(not x > 0 for x in loss):
            raise Refused("the bounces may grow")
        lost = min(loss, key=lambda x: x.low)
        if not speed * speed / (2 * (kappa * least)) < highest:
            raise Refused("a bounce may be higher")
        if not 2 * speed / (kappa * least * lost) < until - self.sigma:
            raise Refused("the bounces may last longer")
        self.side, self.sigma = 0, Interval(until.high, until.high)
        while self.piece < len(self.ground.stops) and self.ground.stops[self.piece] < self.sigma:
            self.piece += 1

    def _end(self) -> None:
        """Judge the motion behind the forcing: at rest, or by its energy."""
        last = len(self.ground.stops)
        if not self.side:
            if self.piece < last:
                self._still(self.ground.stops[-1], last - 1)
            self.result = "survives"
            return
        if self.piece != last:
            raise Refused("the forcing has not ended")
        block, kinetic = self.block, self.rate * self.rate / (2 * self.ground.clock)
        if not self.phi > 0:
            raise Refused("it may be about to land")
        off = block.alpha - self.phi
        if block.linearised:
            surplus, barrier = kinetic - off * off / 2, block.alpha * block.alpha / 2
        else:
            surplus, barrier = kinetic + cosine(off) - 1, 1 - block.cosine
        rebound = block.restitution * block.restitution * (surplus + barrier) - barrier
        inward = self.rate < 0 and (off > 0 or surplus > 0)
        if (surplus < 0 and off > 0) or (inward and rebound < 0):
            self.result = "survives"
        elif (off < 0 and (surplus < 0 or self.rate > 0)) or (surplus > 0 and self.rate > 0):
            self.result = "overturns"
        elif inward and rebound > 0:
            self.result, self.impacts = "overturns", self.impacts + 1
        else:
            raise Refused("its energy is too near the barrier")


def check(certificate: dict[str, Any]) -> str:
    """Return the outcome that a certificate proves, or raise `Refused` with the first gap.

    Parameters
    ----------
    certificate : dict
        As `topheavy.proven.certificate.certified` returns it, or its JSON.
    """
    validated(certificate)
    intervals.precision(certificate["bits"] + GUARD)
    checked = Check(certificate)
    result = checked.run(certificate["events"])
    if (result, checked.impacts) != (certificate["outcome"], certificate["impacts"]):
        raise Refused(
            f"the certificate says {certificate['outcome']} after {certificate['impacts']} "
            f"impacts; its steps prove {result} after {checked.impacts}"
        )
    return result
