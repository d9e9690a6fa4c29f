"""The steady rocking of a block under a harmonic ground motion, one impact each half cycle.

A block leaves the ground at the phase σ with φ' = v, lands, and leaves it again. Half a cycle later
the harmonic is reversed: seen from the other side, the motion starts anew. The steady rocking is a
fixed point of the map (σ, v) ↦ (σ₁ − π, v₁). Distances are |T⁻¹ (x − y)|, with a fixed matrix T. If
the derivative of the map has a norm ≤ q < 1 over a disk of radius ρ, and the map moves the centre
by less than (1 − q) ρ, the disk contains one fixed point. Every motion that leaves the ground in
the disk stays in it and approaches this point, at each impact by the factor q or less (Banach).
"""

import math
from dataclasses import dataclass

import numpy as np

from topheavy.proven.balls import Undecided, arb, arb_mat, arb_poly, bounds, exact, hull, precision
from topheavy.proven.blocks import Balls, enclosed
from topheavy.proven.flight import Box, Law, Step, a_priori
from topheavy.proven.forcing import Piece, PulseForcing
from topheavy.proven.jets import Jet
from topheavy.proven.march import March, Rest
from topheavy.pulses import Pulse
from topheavy.structures import Structure

LADDER = ((72, 1e-13), (136, 1e-28), (264, 1e-60))
"""Bits of the balls, and what the last terms of a step may amount to, relative to 1 rad."""

BITS, ACCURACY = LADDER[1]
FINE = 24  # the order of a flight
COARSE = 8  # the order of a box of flights
IMPACTS = 60  # in which a start has to come into the disk
LONGEST = 1.2  # step that is tried, radians of the phase
LAST = 16  # half cycles in which a flight has to end
CYCLES = 400  # of the harmonic, for which a motion is followed at most
RADII = (0.06, 0.03, 0.01)  # of the disk, that are tried
WIDEST, FINEST = 2.0**-4, 2.0**-6  # of the radius: half the side of the cells of the disk that are tried
NEWTON = 12  # steps towards its centre


class Harmonic(PulseForcing):
    """A harmonic, for as many cycles as a motion is followed."""

    def __init__(self, pulse: Pulse) -> None:
        super().__init__(Pulse("one-sine", pulse.amplitude, pulse.angular_frequency))
        self.pieces = [Piece(arb(0), 2 * CYCLES * arb.pi(), 0)]


@dataclass(frozen=True)
class Shaken:
    """A block under a harmonic."""

    block: Balls
    forcing: Harmonic

    @property
    def law(self) -> Law:
        kappa = self.forcing.scale(self.block.frequency_parameter)
        return Law(self.block, kappa * kappa)

    def flight(self, start: arb_mat, order: int = FINE) -> tuple[Jet, Jet]:
        """Return the map at a start (σ, v), or over a box of starts, with its derivatives.

        Raises
        ------
        Undecided
            If not all starts land within two cycles, or the box is too wide to say when.
        """
        one, none = arb(1), arb(0)
        time, phi = Jet(start[0, 0], (one, none)), Jet(none, (none, none))
        rates = Jet(start[1, 0], (none, one))
        zeros, latest = 1, time.value + LAST * arb.pi()
        while time.value < latest:
            step, impact, derived = self._step(time, phi, rates, zeros, order)
            end = arb(step.h) if impact is None else impact
            values = step.at(end) if impact is None else (none, step.landing(impact))
            phi = Jet(values[0], tuple(x(end) for x in derived))
            rates = Jet(values[1], tuple(x.derivative()(end) for x in derived))
            if impact is not None:
                return self._landed(time, phi, rates, impact)
            time, zeros = time + end, 0
        raise Undecided("impacts")

    def _push(self, time: arb | Jet, terms: int) -> list:
        return self.forcing.series(self.forcing.pieces[0], time, terms)

    def _step(
        self, time: Jet, phi: Jet, rate: Jet, zeros: int, order: int
    ) -> tuple[Step, arb | None, list[arb_poly]]:
        """Return a step, when it ends in an impact, and the derivatives of φ over it."""
        start = self.law.series(phi, rate, self._push(time, order), order)[0]
        h = LONGEST
        while h > LONGEST / 64:
            over = self._push(time + hull(0, h), order)
            try:
                box = a_priori(self.law, phi, rate, over[0], h)
                last = self.law.series(box.phi, box.rate, over, order)[0][order]
                terms = [*start[:order], last]
                plain = Box(box.phi.value, box.rate.value, box.acceleration.value)
                step = Step(h, [term.value for term in terms], [], plain, zeros)
                derived = zip(*(term.slopes for term in terms), strict=True)
                return step, step.impact(), [arb_poly(list(each)) for each in derived]
            except Undecided as undecided:
                cause, h = str(undecided), 0.7 * h
        raise Undecided(cause)

    def _landed(self, time: Jet, phi: Jet, rate: Jet, impact: arb) -> tuple[Jet, Jet]:
        """Return the next start: φ vanishes at a time that depends on the last one."""
        root = self.block.restitution
        force = -self.law.square * self.law.pull(arb(0), self._push(time.value + impact, 1)[0])
        later = tuple(-x / rate.value for x in phi.slopes)
        faster = tuple(-root * (x + force * y) for x, y in zip(rate.slopes, later, strict=True))
        return time + Jet(impact - arb.pi(), later), Jet(-root * rate.value, faster)

    def march(
        self, sigma: arb, side: int, phi: arb, rate: arb, accuracy: tuple[int, float]
    ) -> March:
        """Return a motion on its way from a state."""
        march = March(self.block, self.forcing, arb(1), *accuracy, Rest(sigma))
        march.side, march.phi, march.rate = side, phi, rate
        push = side * self._push(sigma, 1)[0]
        march.energy = rate * rate / 2 + march.law.potential(phi, push)
        march.zeros = int(phi == 0)
        return march

    def lands(self, start: arb_mat, accuracy: tuple[int, float]) -> March:
        """Return a motion from a start on the positive side to its impact."""
        march = self.march(start[0, 0] + 2 * arb.pi(), 1, arb(0), start[1, 0], accuracy)
        while not march.impacts:
            if any(march.advance(self.forcing.pieces[0])):
                raise Undecided("end")
        return march


@dataclass(frozen=True)
class Steady:
    """A disk of starts that contains one steady rocking, and that this attracts.

    Attributes
    ----------
    phase, velocity : (float, float)
        Between these lie the phase σ (rad) of the harmonic and φ' = φ̇/ω with which the block leaves
        the ground on the positive side.
    peak : (float, float)
        Between these lies its largest |θ| (rad).
    contraction : float
        q: the largest factor on the distance from it, from one impact to the next.
    radius : float
        ρ: of the disk in phase, rad.
    """

    phase: tuple[float, float]
    velocity: tuple[float, float]
    peak: tuple[float, float]
    contraction: float
    radius: float
    shaken: Shaken
    centre: arb_mat
    frame: arb_mat

    def attracts(self, march: March) -> bool:
        """Return whether a block that has just landed comes into the disk, proven.

        Its start is known up to a distance of a centre. Of the next start, the march knows where
        the centre comes to, and the norm of the map's derivative how far the others are from it.
        """
        back, spread = self.frame.inv(), arb(0)
        for _ in range(IMPACTS):
            image = self._mirrored(march)
            start = image.mid()
            spread += _length(back * (image - start))
            if _length(back * (start - self.centre)) + spread < self.radius:
                return True
            around = self.frame * arb_mat(2, 1, [hull(-spread, spread)] * 2)
            try:
                slope = _slopes(self.shaken.flight(start + around, COARSE))
                march = self.shaken.lands(start, (march.bits, march.accuracy))
            except Undecided:
                break
            spread *= _norm(back * slope * self.frame)
        return False

    def _mirrored(self, march: March) -> arb_mat:
        """Return σ and v as on the positive side, in the cycle that follows that of the centre."""
        phase = march.sigma - (arb.pi() if march.side < 0 else 0)
        turns = round(float((phase - self.centre[0, 0]) / (2 * arb.pi())))
        return arb_mat(2, 1, [phase - 2 * turns * arb.pi(), march.rate])


def steady(structure: Structure, pulse: Pulse, near: tuple[float, float]) -> Steady:
    """Return the steady rocking under a harmonic, with the largest of `RADII` that is proven.

    Parameters
    ----------
    structure : Structure
        Enclosed from its dimensions.
    pulse : Pulse
        The harmonic.
    near : (float, float)
        Phase (rad) and φ̇/ω with which it leaves the ground on the positive side, about: where the
        search begins.

    Raises
    ------
    ValueError
        For a pulse that is no harmonic.
    Undecided
        If there is none near this start, or it is not proven to attract a disk of any radius.
    """
    if pulse.shape != "harmonic":
        raise ValueError(f"pulse is {pulse.shape!r}; expected 'harmonic', which goes on forever")
    with precision(BITS):
        shaken = Shaken(enclosed(structure, linearised=False), Harmonic(pulse))
        centre, frame = _search(shaken, near)
        for radius in RADII:
            factor = contraction(shaken, centre, frame, radius)
            image = _values(shaken.flight(centre))
            away = _length(frame.inv() * (image - centre)) / (1 - factor)
            if factor < 1 and away < radius:
                around = arb_mat(2, 1, [hull(-away, away)] * 2)
                phase, velocity = (centre + frame * around).entries()
                flight = shaken.lands(centre + frame * around, (BITS, ACCURACY))
                peak = bounds(flight.least)[0], bounds(flight.most)[1]
                ends = bounds(phase), bounds(velocity), peak, bounds(factor)[1]
                return Steady(*ends, radius, shaken, centre, frame)
    raise Undecided("contraction")


def contraction(shaken: Shaken, centre: arb_mat, frame: arb_mat, radius: float) -> arb:
    """Return a bound on the norm of the map's derivative over a disk, or 1 if none is below 1."""
    largest, cells = arb(0), [(0.0, 0.0, 1.0)]
    while cells:
        *middle, half = cells.pop()
        if sum(max(0.0, abs(x) - half) ** 2 for x in middle) > 1.0:
            continue  # outside
        if half < WIDEST:
            place = arb_mat(2, 1, [radius * hull(x - half, x + half) for x in middle])
            factor = _factor(shaken, centre + frame * place, frame)
            if factor < 1:
                largest = largest.max(factor)
                continue
            if half < FINEST:
                return arb(1)
        half /= 2
        cells += [(middle[0] + s * half, middle[1] + t * half, half) for s in (-1, 1) for t in (-1, 1)]
    return largest


def _factor(shaken: Shaken, box: arb_mat, frame: arb_mat) -> arb:
    """Return a bound on the norm of the derivative over a box; 1 if not all of it lands."""
    try:
        derivative = _slopes(shaken.flight(box, COARSE))
    except Undecided:
        return arb(1)
    return _norm(frame.inv() * derivative * frame)


def _search(shaken: Shaken, near: tuple[float, float]) -> tuple[arb_mat, arb_mat]:
    """Return a fixed point of the map, about, and a frame in which it turns and shrinks."""
    centre = np.array(near)
    for _ in range(NEWTON):
        found = shaken.flight(arb_mat(2, 1, centre.tolist()))
        value, slope = (
            np.array([[float(x.mid()) for x in row] for row in m.tolist()])
            for m in (_values(found), _slopes(found))
        )
        centre = centre + np.linalg.solve(np.eye(2) - slope, value[:, 0] - centre)
    vectors = np.linalg.eig(slope)[1]
    turns = np.iscomplexobj(vectors)
    frame = np.column_stack([vectors[:, 0].real, (vectors[:, 0].imag if turns else vectors[:, 1])])
    frame /= np.hypot(*frame[0])  # the radius is that in phase
    return arb_mat(2, 1, centre.tolist()), arb_mat(frame.tolist())


def _values(found: tuple[Jet, Jet]) -> arb_mat:
    return arb_mat(2, 1, [jet.value for jet in found])


def _slopes(found: tuple[Jet, Jet]) -> arb_mat:
    return arb_mat([list(jet.slopes) for jet in found])


def _hypotenuse(one: arb, other: arb) -> arb:
    """Return a bound from above: a square root of a ball around zero is none."""
    one, other = one.abs_upper(), other.abs_upper()
    return (one * one + other * other).sqrt().upper()


def _norm(matrix: arb_mat) -> arb:
    """Return a bound on the spectral norm."""
    a, b, c, d = matrix.entries()
    return (_hypotenuse(a + d, b - c) + _hypotenuse(a - d, b + c)) / 2


def _length(vector: arb_mat) -> arb:
    return _hypotenuse(*vector.entries())


def settles(found: Steady, quarters: int, rotation: float, velocity: float) -> str:
    """Return what is proven to become of a start: steady, rests, overturns, or undecided.

    Parameters
    ----------
    quarters : int
        The quarter cycles of the harmonic that have passed.
    rotation, velocity : float
        θ over α, not 0, and θ̇ over α p̂.

    Raises
    ------
    ValueError
        If the harmonic uplifts a block at rest: rest is then not the end.
    """
    shaken, side = found.shaken, 1 if rotation > 0 else -1
    if not shaken.forcing.largest(0) < shaken.block.level:
        raise ValueError("the harmonic uplifts a block at rest; expected a lower amplitude")
    kappa = shaken.forcing.scale(shaken.block.frequency_parameter)
    for accuracy in LADDER:
        with precision(accuracy[0]):
            scale = side * shaken.block.slenderness
            state = exact(rotation) * scale, exact(velocity) * scale * kappa
            march = shaken.march(quarters * arb.pi() / 2, side, *state, accuracy)
            try:
                return _end(found, march)
            except Undecided:
                continue
    return "undecided"


def _end(found: Steady, march: March) -> str:
    (piece,) = march.forcing.pieces
    while march.side:
        falls, ended = march.advance(piece)
        if falls:
            return "overturns"
        if ended:
            raise Undecided("impacts")
        if march.side and march.zeros == march.impacts == 1 and found.attracts(march):
            return "steady"
    return "rests"
