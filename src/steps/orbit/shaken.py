"""Flights of a block under a harmonic ground motion, from an impact to the next, with derivatives.

A block leaves the ground at the phase σ with φ' = v, lands, and leaves it again. Half a cycle later
the harmonic is reversed: seen from the other side, the motion starts anew. So every flight is
described as on the positive side, and is a map (σ, v) ↦ (σ₁ − π, v₁).
"""

from dataclasses import dataclass
from typing import Any

from steps.orbit.jets import Jet
from topheavy.ground.pulses import Pulse
from topheavy.proven.balls import Undecided, arb, arb_mat, arb_poly, hull
from topheavy.proven.blocks import Balls
from topheavy.proven.flight import Box, Law, Step, a_priori
from topheavy.proven.forcing import Piece, PulseForcing
from topheavy.proven.march import March, Rest

LONGEST = 1.2  # step that is tried, radians of the phase; one of a 64th is the shortest
LAST = 16  # half cycles in which a flight has to end
CYCLES = 400  # of the harmonic, for which a motion is followed at most

Accuracy = tuple[int, float]
"""Bits of the balls, and what the last terms of a step may amount to, relative to 1 rad."""


class Harmonic(PulseForcing):
    """A harmonic, for as many cycles as a motion is followed."""

    def __init__(self, pulse: Pulse) -> None:
        if pulse.shape != "harmonic":
            raise ValueError(f"pulse is {pulse.shape!r}; expected 'harmonic', which goes on")
        super().__init__(Pulse("one-sine", pulse.amplitude, pulse.angular_frequency))
        self.pieces = [Piece(arb(0), 2 * CYCLES * arb.pi(), 0)]


@dataclass(frozen=True)
class Shaken:
    """A block under a harmonic."""

    block: Balls
    forcing: Harmonic

    @property
    def kappa(self) -> arb:
        """p/ω, in the precision that is set."""
        return self.forcing.scale(self.block.frequency_parameter)

    @property
    def law(self) -> Law:
        return Law(self.block, self.kappa * self.kappa)

    def march(self, sigma: arb, side: int, phi: arb, rate: arb, accuracy: Accuracy) -> March:
        """Return a motion on its way from a state."""
        march = March(self.block, self.forcing, arb(1), *accuracy, Rest(sigma))
        march.side, march.phi, march.rate = side, phi, rate
        push = side * self._push(sigma, 1)[0]
        march.energy = rate * rate / 2 + march.law.potential(phi, push)
        march.zeros = int(phi == 0)
        return march

    def lands(self, start: arb_mat, accuracy: Accuracy) -> March:
        """Return a motion from a start (σ, v) on the positive side to behind its impact."""
        march = self.march(start[0, 0] + 2 * arb.pi(), 1, arb(0), start[1, 0], accuracy)
        while not march.impacts:
            if any(march.advance(self.forcing.pieces[0])):
                raise Undecided("end")
        return march

    def flight(self, start: arb_mat, order: int) -> tuple[arb_mat, arb_mat]:
        """Return the map at a start (σ, v), or over a box of starts, and its derivative.

        The order is that of the Taylor series. `lands` is quicker, and knows no derivative.

        Raises
        ------
        Undecided
            If a start lands too late, or the box is too wide to say when.
        """
        one, none = arb(1), arb(0)
        time, phi = Jet(start[0, 0], (one, none)), Jet(none, (none, none))
        rate, zeros = Jet(start[1, 0], (none, one)), 1
        latest = time.value + LAST * arb.pi()
        while time.value < latest:
            step, impact, slopes = self._step(time, phi, rate, zeros, order)
            end = arb(step.h) if impact is None else impact
            values = step.at(end) if impact is None else (none, step.landing(impact))
            phi = Jet(values[0], tuple(x(end) for x in slopes))
            rate = Jet(values[1], tuple(x.derivative()(end) for x in slopes))
            if impact is not None:
                found = self._landed(time, phi, rate, impact)
                return (
                    arb_mat(2, 1, [jet.value for jet in found]),
                    arb_mat([list(jet.slopes) for jet in found]),
                )
            time, zeros = time + end, 0
        raise Undecided("impacts")

    def _push(self, time: Any, terms: int) -> list[Any]:
        return self.forcing.series(self.forcing.pieces[0], time, terms)

    def _step(
        self, time: Jet, phi: Any, rate: Any, zeros: int, order: int
    ) -> tuple[Step, arb | None, list[arb_poly]]:
        """Return a step, when it ends in an impact, and the derivatives of φ over it.

        Of a jet the law makes jets, as it makes balls of a ball.
        """
        law = self.law
        start: list[Any] = law.series(phi, rate, self._push(time, order), order)[0]
        h, cause = LONGEST, ""
        while h > LONGEST / 64:
            over = self._push(time + hull(0, h), order)
            try:
                box: Any = a_priori(law, phi, rate, over[0], h)
                last: Any = law.series(box.phi, box.rate, over, order)[0][order]
                terms = [*start[:order], last]
                plain = Box(box.phi.value, box.rate.value, box.acceleration.value)
                step = Step(h, [term.value for term in terms], [], plain, zeros)
                slopes = zip(*(term.slopes for term in terms), strict=True)
                return step, step.impact(), [arb_poly(list(each)) for each in slopes]
            except Undecided as undecided:
                cause, h = str(undecided), 0.7 * h
        raise Undecided(cause)

    def _landed(self, time: Jet, phi: Jet, rate: Jet, impact: arb) -> tuple[Jet, Jet]:
        """Return the next start: where φ vanishes depends on the last one, too."""
        root = self.block.restitution
        force = -self.law.square * self.law.pull(arb(0), self._push(time.value + impact, 1)[0])
        later = tuple(-x / rate.value for x in phi.slopes)
        faster = tuple(-root * (x + force * y) for x, y in zip(rate.slopes, later, strict=True))
        return time + Jet(impact - arb.pi(), later), Jet(-root * rate.value, faster)
