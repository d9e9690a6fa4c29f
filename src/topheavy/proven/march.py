"""A march of verified steps from impact to impact, which ends in an outcome or in Undecided."""

import math
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Any, Literal

from topheavy.proven.balls import Undecided, arb, bounds, hull, power, root
from topheavy.proven.blocks import Balls
from topheavy.proven.bounds import Bounded
from topheavy.proven.flight import Law, Step, step
from topheavy.proven.forcing import Forcing, Piece, RecordForcing
from topheavy.proven.rest import dies_out

MOST_IMPACTS = 400
"""Since the block was last at rest."""

MOST_STEPS = 2000
"""Tried between two samples of a record, or in all of a pulse."""

SHORTEST = 2.0**-80
"""Of the clock of a motion (the phase of a pulse, a sample): a shorter step is not tried."""

BOUNDED_STEPS, BOUNDED_SHORTEST, WIDEST = 100, 0.3, 0.06
"""Where a motion may be bounded instead: steps tried until then, the shortest over the first that
is tried, and the widest impact."""

OF_A_BOX = 1e-6
"""Of the relative width of a box of factors: what the last terms of a step may amount to."""

_PARTS = 8
"""Of a step without an isolated turning point, over each of which the peak is bounded."""


@dataclass(frozen=True)
class Outcome:
    """What is proven of a motion.

    Attributes
    ----------
    outcome : "survives", "overturns" or "undecided"
    impacts : int
        Those enclosed one by one, up to where the proof ended; trains that die out are not in it.
    peak : (float, float) or None
        Between these lies max|θ| (rad) over all of a survivor's motion, by this program alone; None
        for others.
    cause : str
        Why it is undecided: "uplift", "graze", "flat", "end", "start", "enclosure", "impacts",
        "steps", "separatrix" or "bound"; empty for others. Bounces multiply every error: under a
        record they end as "end", where an impact may come before or after a sample, or as "start".
    bits : int
        Precision with which it was decided, or at last tried.
    """

    outcome: Literal["survives", "overturns", "undecided"]
    impacts: int
    peak: tuple[float, float] | None = None
    cause: str = ""
    bits: int = 0


@dataclass(frozen=True)
class Rest:
    """A block at rest from σ on: the one state that is known without any error."""

    sigma: arb
    number: int = 0  # of the piece in which it comes to rest
    impacts: int = 0
    peak: tuple[arb, arb] = (arb(0), arb(0))
    traced: int = 0


@dataclass
class March:
    """A motion on its way: state φ, φ' at σ on a side, all balls, in a precision that is set."""

    block: Balls
    forcing: Forcing
    factor: arb
    bits: int
    accuracy: float
    rest: Rest
    trace: list[dict[str, Any]] | None = None
    side: int = 0  # 0 at rest
    phi: arb = field(default_factory=lambda: arb(0))
    rate: arb = field(default_factory=lambda: arb(0))
    energy: arb = field(default_factory=lambda: arb(0))  # φ'²/2 + κ² (Φ + s a ψ)
    zeros: int = 0
    bounded: bool = False  # whether it may be, instead of raising Undecided
    result: Outcome | None = None

    def __post_init__(self) -> None:
        self.sigma, self.impacts = self.rest.sigma, self.rest.impacts
        self.least, self.most = self.rest.peak  # bounds on the peak
        if self.trace is not None:
            del self.trace[self.rest.traced :]
        kappa = self.forcing.scale(self.block.frequency_parameter)
        self.law = Law(self.block, kappa * kappa)
        self.h, self.tried = 1.0, 0
        if not self.factor.contains(0):  # a box of factors is wider than its motions are accurate
            width = float(self.factor.rad() / abs(self.factor.mid()))
            self.accuracy = max(self.accuracy, OF_A_BOX * width)
        digits = -math.log2(self.accuracy)
        self.order = int(digits / 3) + 2
        if isinstance(self.forcing, RecordForcing):  # steps of one sample, of κ in radians
            self.order = min(
                self.order, max(4, int(digits / -math.log2(min(0.5, float(kappa)))) + 3)
            )

    def run(self, until_rest: bool) -> Outcome | None:
        """Return the outcome, or None where the block comes to rest again; or raise Undecided."""
        before = self.rest
        for piece in self.forcing.pieces[before.number :]:
            self.tried, stays = 0, True
            while stays:
                if until_rest and not self.side and self.rest is not before:
                    return None
                try:
                    stays = self._goes_on(piece)
                except Undecided:
                    if not self.bounded:
                        raise
                    self._is_bounded(piece)
                if self.result:
                    return self.result
        return self._survives()

    def _goes_on(self, piece: Piece) -> bool:
        """Take a step; return whether another of the same piece follows."""
        if not self.side and not self._uplifts(piece):
            return False
        falls, ended = self.advance(piece)
        if falls:
            self.result = Outcome("overturns", self.impacts, bits=self.bits)
        elif ended:
            if piece is self.forcing.pieces[-1]:
                self.result = self._rocks_freely()
            return False
        return True

    def _is_bounded(self, piece: Piece) -> None:
        """Bound the motion until the pulse has ended."""
        block = Bounded(self.law, self.forcing, piece, self.factor)
        bound = begin = block.start(self.sigma, self.side, self.phi, self.rate)
        steps = []
        for bound in block.carried(begin):
            steps.append((bound.sigma, bound.energy, bound.walls))
            self.most = self.most.max(arb(max(bound.walls)))
        self._note("bounded", energy=begin.energy, walls=begin.walls, steps=steps)
        energy, alpha = block.energy_behind(bound) / self.law.square, self.block.slenderness
        barrier = Law(self.block, arb(1)).potential(alpha, arb(0))
        if not energy < barrier:
            raise Undecided("bound")
        self.rate = arb(0)  # not known: the turn is a bound on the peak alone
        self.result = self._turns(energy, barrier)

    def advance(self, piece: Piece) -> tuple[bool, bool]:
        """Take a step of a block that has left the ground; return if it overturns, if it ends."""
        made, end, impact, is_last = self._step(piece)
        falls = self._flies(piece, made, end, impact, is_last)
        return falls, is_last and impact is None  # not by comparing σ: both are balls

    def _survives(self) -> Outcome:
        peak = bounds(self.least)[0], bounds(self.most)[1]
        return Outcome("survives", self.impacts, (max(0.0, peak[0]), peak[1]), bits=self.bits)

    def _uplifts(self, piece: Piece) -> bool:
        if self.sigma > piece.stop:
            return False
        lifted = self.forcing.uplift(piece, self.factor, self.block.level, self.sigma)
        if lifted is None:
            return False
        self.sigma, sign, jumps = lifted
        if not self.sigma < piece.stop:
            raise Undecided("uplift")
        self.side, self.zeros = -sign, 2 if jumps else 3
        self.phi = self.rate = self.energy = arb(0)
        self._note("uplift", sigma=lifted[0], side=self.side, jumps=jumps, piece=piece.number)
        return True

    def _flies(self, piece: Piece, made: Step, end: arb, impact: arb | None, is_last: bool) -> bool:
        """Take a step; return whether the block has overturned."""
        self._note("step", h=made.h, box=made.box.phi, impact=impact, last=is_last)
        if self._may_lie_flat(made):
            return True  # `_step` has made sure that it does
        self._climb(made, end)
        if impact is not None:
            self._lands(piece, made, impact)
            return False
        self.phi, self.rate = made.at(end)
        self.sigma = piece.stop if is_last else self.sigma + end
        self.energy += made.gain(end)
        self._sharpen(piece)
        self.zeros = 0
        if self._is_gone(piece):
            self._note("gone")
            return True
        return False

    def _step(self, piece: Piece) -> tuple[Step, arb, arb | None, bool]:
        """Return a step that is verified, when it ends, its impact, and if it ends the piece.

        A step in which the enclosures decide nothing is tried again, shorter. One that may end in
        an impact or before it goes on beyond the end of the piece, by the same formula.
        """
        left = piece.stop - self.sigma
        push = self._push(piece, self.sigma)
        start = self.law.series(self.phi, self.rate, push, self.order)
        h, stretch, cause = self._length(start[0]), 1.0, "enclosure"
        shortest = BOUNDED_SHORTEST * h if self.bounded else SHORTEST
        while h > shortest:
            self.tried += 1
            most = BOUNDED_STEPS if self.bounded else MOST_STEPS
            if self.tried > most:  # those of a wide box are shorter and shorter
                raise Undecided("steps")
            is_last = not left > h
            length = stretch * bounds(left)[1] if is_last else h
            try:
                over = self._push(piece, self.sigma + hull(0, length))
                made = step(self.law, start, (push, over), length, self.zeros)
                impact = self._impact(made)
                if impact is not None and is_last and not impact < left:
                    if not impact > left:
                        raise Undecided("end")
                    impact = None
                end = impact if impact is not None else left if is_last else arb(length)
                if self._may_lie_flat(made) and not made.at(end)[0] > arb.pi() / 2:
                    raise Undecided("flat")
                self.h = length
                return made, end, impact, is_last
            except Undecided as undecided:
                cause = str(undecided)
                if cause == "end" and is_last:
                    if stretch > 1.0:
                        raise
                    stretch = 1.1
                else:
                    h = length * (0.9 if cause == "end" else 0.5)
        raise Undecided(cause)

    def _impact(self, made: Step) -> arb | None:
        impact = made.impact()
        if self.bounded and impact is not None and impact.rad() > WIDEST:
            self.tried = BOUNDED_STEPS
            raise Undecided("graze")
        return impact

    def _may_lie_flat(self, made: Step) -> bool:
        return not self.block.linearised and not made.box.phi < arb.pi() / 2

    def _push(self, piece: Piece, sigma: arb) -> list[arb]:
        factor = self.side * self.factor
        return [factor * x for x in self.forcing.series(piece, sigma, self.order)]

    def _length(self, terms: list[arb]) -> float:
        """Guess a length at which the last terms are as small as the accuracy."""
        h = 2.0 * self.h if self.zeros == 0 else 8.0
        for k in (self.order, self.order - 1):
            size = abs(float(terms[k].mid()))
            if size:
                h = min(h, (self.accuracy / size) ** (1.0 / k))
        if self.zeros == 1 and terms[2] < 0:  # a bounce that ends soon
            h = min(h, 1.25 * bounds(-terms[1] / terms[2])[1])
        return h

    def _climb(self, made: Step, end: arb) -> None:
        """Let the peak enclose that of a step: at its turning point, or else by parts."""
        if self.most > made.box.phi:
            return
        start, (phi, rate) = made.coefficients, made.at(end)
        if made.box.acceleration < 0 and start[1] > 0 and rate < 0:
            turn = root(made.rates, made.rates.derivative(), arb(0), end.upper())
            tops = [made.polynomial(turn)]
        else:
            edges = [made.h * k / _PARTS for k in range(_PARTS + 1)]
            tops = [made.polynomial(hull(*pair)) for pair in pairwise(edges)] + [phi]
            self.least = self.least.max(phi)
        highest = max((top.upper() for top in tops), key=float)
        self.most = self.most.max(highest.min(made.box.phi.upper()).max(phi))
        if len(tops) == 1:
            self.least = self.least.max(tops[0])

    def _lands(self, piece: Piece, made: Step, time: arb) -> None:
        self.impacts += 1
        self.sigma = self.sigma + time
        landing = made.landing(time)
        self.energy = (self.energy + made.gain(time)).intersection(landing * landing / 2)
        self.energy *= power(self.block.restitution, 2)
        self.phi, self.rate = arb(0), -self.block.restitution * landing
        if self.energy > 0:
            self.rate = self.rate.intersection((2 * self.energy).sqrt())
        self.side, self.zeros = -self.side, 1
        if self.block.restitution == 0:
            before = self.rest
            self._rests(piece, arb(0))
            if not abs(self.factor * self.forcing.value(piece, self.sigma)) < self.block.level:
                self.rest = before  # it is lifted at once, at a time that is a ball
            return
        if not self.rate > 0:
            raise Undecided("start")
        if self.impacts > self.rest.impacts + MOST_IMPACTS:
            raise Undecided("impacts")
        rests = dies_out(self.law, self.forcing, self.factor, piece.number, self.sigma, self.rate)
        if rests is not None:
            self.sigma, highest = rests
            self.most = self.most.max(highest)
            self._rests(piece, highest)

    def _rests(self, piece: Piece, highest: arb) -> None:
        self.side = 0
        self._note("rests", sigma=self.sigma, highest=highest)
        traced = len(self.trace) if self.trace is not None else 0
        peak = self.least, self.most
        self.rest = Rest(self.sigma.upper(), piece.number, self.impacts, peak, traced)

    def _sharpen(self, piece: Piece) -> None:
        """Let energy and velocity narrow each other.

        Over many bounces the energy keeps what the state loses: an error of the velocity delays the
        impact, which changes the velocity of landing, and balls do not know that the two cancel.
        """
        push = self.side * self.factor * self.forcing.value(piece, self.sigma)
        potential = self.law.potential(self.phi, push)
        self.energy = self.energy.intersection(potential + self.rate * self.rate / 2)
        square = 2 * (self.energy - potential)
        if square > 0 and not self.rate.contains(0):
            sign = 1 if self.rate > 0 else -1
            self.rate = self.rate.intersection(sign * square.sqrt())

    def _is_gone(self, piece: Piece) -> bool:
        """Whether it moves outward beyond any push that is still to come."""
        beyond = self.phi - self.block.slenderness
        if not (beyond > 0 and self.rate > 0):
            return False
        largest = abs(self.factor) * self.forcing.largest(piece.number)
        return bool(beyond > (largest if self.block.linearised else largest.atan()))

    def _rocks_freely(self) -> Outcome:
        """Judge the motion behind the forcing by its energy: `bodies.free_rocking.ending`."""
        alpha, kinetic = self.block.slenderness, power(self.rate, 2) / (2 * self.law.square)
        off = alpha - self.phi
        if self.block.linearised:
            surplus, barrier = kinetic - off * off / 2, alpha * alpha / 2
        else:
            surplus, barrier = kinetic + off.cos() - 1, 1 - alpha.cos()
        if not self.phi > 0:
            raise Undecided("end")
        self.least = self.least.max(self.phi)
        self.most = self.most.max(self.phi)
        rebound = power(self.block.restitution, 2) * (surplus + barrier)
        beyond = off < 0 and (surplus < 0 or self.rate > 0)
        falls = beyond or (surplus > 0 and self.rate > 0)
        inward = self.rate < 0 and (surplus > 0 or off > 0)
        if falls or (inward and rebound > barrier):
            return Outcome("overturns", self.impacts + inward, bits=self.bits)
        if inward and rebound < barrier:
            return self._turns(rebound, barrier)
        if surplus < 0 and off > 0:
            return self._turns(surplus + barrier, barrier)
        raise Undecided("separatrix")

    def _turns(self, energy: arb, barrier: arb) -> Outcome:
        """Return a survivor that next turns at the φ < α of an energy below the barrier."""
        below = (barrier - energy).max(arb(0))
        if self.block.linearised:
            turn = self.block.slenderness - (2 * below).sqrt()
        else:
            turn = self.block.slenderness - 2 * (below / 2).sqrt().asin()
        self.most = self.most.max(turn)
        if self.rate < 0 or self.rate > 0:
            self.least = self.least.max(turn)
        return self._survives()

    def _note(self, event: str, **values: object) -> None:
        if self.trace is not None:
            made = {"bits": self.bits, "order": self.order}
            self.trace.append({"event": event, **values, **made})
