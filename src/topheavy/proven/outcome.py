"""The outcome of a rocking motion from rest, proven: a march of verified steps from impact to impact.

    survives | overturns | undecided

A narrow problem that stays undecided is tried again with more digits and terms. A box of factors or
structures is not: its own width decides. Infinitely many impacts in a finite time end in rest.
"""

import math
from dataclasses import dataclass, field
from typing import Literal

from topheavy import checks
from topheavy.proven.balls import Undecided, arb, bounds, hull, power, precision, root, within
from topheavy.proven.blocks import Balls, BlockBox, Range, enclosed
from topheavy.proven.flight import Law, Step, step
from topheavy.proven.forcing import Forcing, Piece, RecordForcing, prepared
from topheavy.proven.rest import dies_out
from topheavy.pulses import Pulse
from topheavy.records import Record
from topheavy.simulate import no_excitation
from topheavy.structures import Structure

MOST_IMPACTS = 400
"""Since the block was last at rest."""

SHORTEST = 2.0**-80
"""Of the clock of a motion (the phase of a pulse, a sample): a shorter step is not tried."""

_LADDER = ((72, 1e-13), (136, 1e-28), (264, 1e-60))
"""Bits of the balls, and what the last terms of a step may amount to, relative to 1 rad."""


@dataclass(frozen=True)
class Outcome:
    """What is proven of a motion.

    Attributes
    ----------
    outcome : "survives", "overturns" or "undecided"
    impacts : int
        Those enclosed one by one, up to where the proof ended; trains that die out are not in it.
    peak : (float, float) or None
        Between these lies max|θ| (rad) over the whole motion of a survivor; None for others.
    cause : str
        Why it is undecided: "uplift", "graze", "flat", "end", "start", "enclosure", "impacts" or
        "separatrix"; empty for others.
    bits : int
        Precision with which it was decided, or at last tried.
    """

    outcome: Literal["survives", "overturns", "undecided"]
    impacts: int
    peak: tuple[float, float] | None = None
    cause: str = ""
    bits: int = 0


def outcome(
    structure: Structure | BlockBox,
    excitation: Pulse | Record,
    *,
    factor: Range = 1.0,
    linearised: bool = False,
    trace: list[dict] | None = None,
) -> Outcome:
    """Return whether a structure at rest survives a ground motion, proven, or that it is undecided.

    Parameters
    ----------
    structure : Structure or BlockBox
        Column, RockingFrame, FixedMassColumn and MonolithicPortal are enclosed from their
        dimensions; the numbers of a RockingBlock are exact; a BlockBox is a box of blocks.
    excitation : Pulse or Record
        One that ends. Each float stands for the decimal that it is printed as.
    factor : float or (float, float)
        On the acceleration; a pair asks for the outcome that all factors between share.
    linearised : bool
        Whether the structure obeys the linearised equation.
    trace : list, optional
        Filled with the steps of the proof, for a certificate (`topheavy.proven.certificate`).

    Returns
    -------
    Outcome
        "survives" and "overturns" are as defined in `topheavy.judge`; all impacts count.

    Raises
    ------
    ValueError
        For no or an endless excitation, a factor that is not finite or does not ascend, and a
        structure whose √r is negative.
    """
    if not isinstance(excitation, (Pulse, Record)):
        raise no_excitation(excitation)
    ends = factor if isinstance(factor, tuple) else (factor, factor)
    low, high = (checks.finite("factor", end) for end in ends)
    if low > high:
        raise ValueError(f"factor is ({low:.6g}, {high:.6g}); expected the lower end first")
    rungs = _LADDER[:1] if low < high or isinstance(structure, BlockBox) else _LADDER
    settings: dict[int, tuple[Balls, Forcing, arb]] = {}
    rest, height = Rest(arb(0)), 0
    while True:
        bits, accuracy = rungs[height]
        with precision(bits):
            if height not in settings:
                range_ = within((low, high))
                settings[height] = enclosed(structure, linearised), prepared(excitation), range_
            march = March(*settings[height], bits, accuracy, rest, trace)
            try:
                found = march.run(until_rest=height > 0)
            except Undecided as undecided:
                if height + 1 == len(rungs) or str(undecided) == "impacts":
                    return Outcome("undecided", march.impacts, None, str(undecided), bits)
                rest, height = march.rest, height + 1
                continue
        if found is not None:
            return found
        rest, height = march.rest, 0


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
    trace: list[dict] | None = None
    side: int = 0  # 0 at rest
    phi: arb = field(default_factory=lambda: arb(0))
    rate: arb = field(default_factory=lambda: arb(0))
    energy: arb = field(default_factory=lambda: arb(0))  # φ'²/2 + κ² (Φ + s a ψ)
    zeros: int = 0

    def __post_init__(self) -> None:
        self.sigma, self.impacts = self.rest.sigma, self.rest.impacts
        self.least, self.most = self.rest.peak  # bounds on the peak
        if self.trace is not None:
            del self.trace[self.rest.traced :]
        kappa = self.forcing.scale(self.block.frequency_parameter)
        self.law = Law(self.block, kappa * kappa)
        self.h = 1.0
        digits = -math.log2(self.accuracy)
        self.order = int(digits / 3) + 2
        if isinstance(self.forcing, RecordForcing):  # steps of one sample, of κ in radians
            self.order = min(self.order, max(4, int(digits / -math.log2(min(0.5, float(kappa)))) + 3))

    def run(self, until_rest: bool) -> Outcome | None:
        """Return the outcome, or None where the block comes to rest again; or raise Undecided."""
        before = self.rest
        for piece in self.forcing.pieces[before.number :]:
            while not self.side or self.sigma < piece.stop:
                if not self.side:
                    if until_rest and self.rest is not before:
                        return None
                    if not self._uplifts(piece):
                        break
                elif self._flies(piece):
                    return Outcome("overturns", self.impacts, bits=self.bits)
        return self._rocks_freely() if self.side else self._survives()

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
        self._note("uplift", sigma=self.sigma, side=self.side, jumps=jumps)
        return True

    def _flies(self, piece: Piece) -> bool:
        """Take one step; return whether the block has overturned."""
        made, end, impact, is_last = self._step(piece)
        self._note("step", h=made.h, box=made.box.phi, impact=impact, last=is_last)
        if self._may_lie_flat(made):
            return True  # _step has made sure that it does
        self._climb(made, end)
        if impact is not None:
            self._lands(piece, made, impact)
            return False
        self.phi, self.rate = made.at(end)
        self.sigma = piece.stop if is_last else self.sigma + end
        self.energy += made.gain(end)
        self._sharpen(piece)
        self.zeros = 0
        return self._is_gone(piece)

    def _step(self, piece: Piece) -> tuple[Step, arb, arb | None, bool]:
        """Return a step that is verified, when it ends, its impact, and if it ends the piece.

        A step in which the enclosures decide nothing is tried again, shorter. One that may end in
        an impact or before it goes on beyond the end of the piece, by the same formula.
        """
        left = piece.stop - self.sigma
        push = self._push(piece, self.sigma)
        start = self.law.series(self.phi, self.rate, push, self.order)
        h, stretch, cause = self._length(start[0]), 1.0, ""
        while h > SHORTEST:
            is_last = not left > h
            length = stretch * bounds(left)[1] if is_last else h
            try:
                over = self._push(piece, self.sigma + hull(0, length))
                made = step(self.law, start, (push, over), length, self.zeros)
                impact = made.impact()
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

    def _may_lie_flat(self, made: Step) -> bool:
        return not self.block.linearised and not made.box.phi < arb.pi() / 2

    def _push(self, piece: Piece, sigma: arb) -> list[arb]:
        factor = self.side * self.factor
        return [factor * x for x in self.forcing.series(piece, sigma, self.order)]

    def _length(self, terms: list[arb]) -> float:
        """Return a length at which the last terms are as small as the accuracy: a guess suffices."""
        h = 2.0 * self.h if self.zeros == 0 else 8.0
        for k in (self.order, self.order - 1):
            size = abs(float(terms[k].mid()))
            if size:
                h = min(h, (self.accuracy / size) ** (1.0 / k))
        if self.zeros == 1 and terms[2] < 0:  # a bounce that ends soon
            h = min(h, 1.25 * bounds(-terms[1] / terms[2])[1])
        return h

    def _climb(self, made: Step, end: arb) -> None:
        """Let the peak enclose that of a step."""
        if self.most > made.box.phi:
            return
        phi_end, rate_end = made.at(end)
        top, low = made.box.phi.upper(), phi_end.lower()
        if made.box.acceleration < 0 and made.coefficients[1] > 0 and rate_end < 0:
            peak = made.polynomial(root(made.rates, made.rates.derivative(), 0, end.upper()))
            top, low = peak.upper(), peak.lower()
        elif made.box.rate > 0:
            top = phi_end.upper()
        elif made.box.rate < 0:
            top = made.coefficients[0].upper()
        self.most, self.least = self.most.max(top), self.least.max(low)

    def _lands(self, piece: Piece, made: Step, time: arb) -> None:
        self.impacts += 1
        if self.impacts > self.rest.impacts + MOST_IMPACTS:
            raise Undecided("impacts")
        self.sigma = self.sigma + time
        landing = made.landing(time)
        self.energy = (self.energy + made.gain(time)).intersection(landing * landing / 2)
        self.energy *= power(self.block.restitution, 2)
        self.phi, self.rate = arb(0), -self.block.restitution * landing
        if self.energy > 0:
            self.rate = self.rate.intersection((2 * self.energy).sqrt())
        self.side, self.zeros = -self.side, 1
        if self.block.restitution == 0:
            self._rests(piece)
            return
        if not self.rate > 0:
            raise Undecided("start")
        rests = dies_out(
            self.law, self.forcing, self.factor, piece.number, self.sigma, self.rate
        )
        if rests is not None:
            self.sigma, highest = rests
            self.most = self.most.max(highest)
            self._rests(piece)

    def _rests(self, piece: Piece) -> None:
        self.side = 0
        self._note("rests", sigma=self.sigma)
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
        """Judge the motion behind the forcing by its energy: `topheavy.free_rocking.ending`."""
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
        if surplus < 0:
            if off < 0:
                return Outcome("overturns", self.impacts, bits=self.bits)
            if off > 0:
                return self._turns(rebound if self.rate < 0 else surplus + barrier, barrier)
        elif surplus > 0:
            if self.rate > 0:
                return Outcome("overturns", self.impacts, bits=self.bits)
            if self.rate < 0 and rebound > barrier:
                return Outcome("overturns", self.impacts + 1, bits=self.bits)
            if self.rate < 0 and rebound < barrier:
                return self._turns(rebound, barrier)
        raise Undecided("separatrix")

    def _turns(self, energy: arb, barrier: arb) -> Outcome:
        """Return a survivor that next turns at the φ < α of an energy below the barrier."""
        below = barrier - energy
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
            self.trace.append({"event": event, "phi": self.phi, "rate": self.rate, **values})

