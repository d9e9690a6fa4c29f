"""The steady rocking of a block under a harmonic ground motion, one impact each half cycle.

It is a fixed point of the map of a flight (`shaken`). Let |T⁻¹(x − y)| be the distance of two
starts, with a fixed matrix T. If the derivative of the map has a norm of at most q < 1 over a disk
of radius ρ, and the map moves the centre by less than (1 − q) ρ, the disk contains one fixed point.
Every motion that leaves the ground in the disk does so at each impact, and each brings it closer to
this point, by q or less (Banach's theorem). To rest below uplift and to overturn is final, too.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from steps.orbit.shaken import Harmonic, Shaken
from topheavy.bodies.structures import Structure
from topheavy.ground.pulses import Pulse
from topheavy.proven.balls import Undecided, arb, arb_mat, bounds, exact, hull, precision
from topheavy.proven.blocks import enclosed
from topheavy.proven.march import March
from topheavy.proven.search import LADDER

FINE, COARSE = 24, 8  # the order of a flight, and of a box of flights
IMPACTS = 60  # in which a start has to come into the disk
RELAXED, NEWTON = 80, 8  # flights and steps towards its centre
RADII = (0.06, 0.03, 0.01)  # of the disk, that are tried
WIDEST, FINEST = 0.05, 0.01  # cells of the disk that are tried: half their side over the radius


@dataclass(frozen=True)
class SteadyRocking:
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
        ρ: the disk reaches as far in phase, rad.
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

        Its start is known up to a distance from a middle. The march knows where the middle comes
        to, and the norm of the map's derivative how far all others are from there.
        """
        back, spread = self.frame.inv(), arb(0)
        for _ in range(IMPACTS):
            image = self._mirrored(march)
            middle = image.mid()
            spread += _length(back * (image - middle))
            if _length(back * (middle - self.centre)) + spread < self.radius:
                return True
            box = middle + self.frame * _square(spread)
            try:
                slope = self.shaken.flight(box, COARSE)[1]
                march = self.shaken.lands(middle, (march.bits, march.accuracy))
            except Undecided:
                return False
            spread *= _norm(back * slope * self.frame)
        return False

    def _mirrored(self, march: March) -> arb_mat:
        """Return (σ, v) as on the positive side, in the cycle of the disk."""
        phase = march.sigma - (arb.pi() if march.side < 0 else 0)
        turns = round(float((phase - self.centre[0, 0]) / (2 * arb.pi())))
        return arb_mat(2, 1, [phase - 2 * turns * arb.pi(), march.rate])


def steady_rocking(structure: Structure, pulse: Pulse, start: tuple[float, float]) -> SteadyRocking:
    """Return the steady rocking under a harmonic, and a disk of starts that it attracts.

    Parameters
    ----------
    structure : Structure
        Enclosed from its dimensions.
    pulse : Pulse
        A harmonic.
    start : (float, float)
        Phase σ (rad) and φ̇/ω with which a motion that becomes steady leaves the ground on the
        positive side: where the search begins.

    Raises
    ------
    ValueError
        For a pulse that is no harmonic.
    Undecided
        If no steady rocking is found from this start, or it is not proven to attract a disk.
    """
    with precision(LADDER[-1][0]):
        shaken = Shaken(enclosed(structure, linearised=False), Harmonic(pulse))
    with precision(LADDER[2][0]):
        centre, frame = _search(shaken, arb_mat(2, 1, list(start)))
        for radius in RADII:
            factor = contraction(shaken, centre, frame, radius)
            off = _length(frame.inv() * (shaken.flight(centre, FINE)[0] - centre)) / (1 - factor)
            if factor < 1 and off < radius:
                found = centre + frame * _square(off)
                phase, velocity = (bounds(x) for x in found.entries())
                flight = shaken.lands(found, LADDER[2])
                peak, q = (bounds(flight.least)[0], bounds(flight.most)[1]), bounds(factor)[1]
                return SteadyRocking(phase, velocity, peak, q, radius, shaken, centre, frame)
    raise Undecided("contraction")


def settles(found: SteadyRocking, quarters: int, rotation: float, velocity: float) -> str:
    """Return what is proven to become of a start: "steady", "rests", "overturns" or "undecided".

    Parameters
    ----------
    found : SteadyRocking
        Under a harmonic that does not uplift a block at rest.
    quarters : int
        The quarter cycles of the harmonic that have passed.
    rotation, velocity : float
        θ over α, not 0, and θ̇ over α p̂.

    Raises
    ------
    ValueError
        If the harmonic uplifts a block at rest, which is then not the end.
    """
    shaken, side = found.shaken, 1 if rotation > 0 else -1
    if not shaken.forcing.largest(0) < shaken.block.level:
        raise ValueError("the harmonic uplifts a block at rest; expected a lower amplitude")
    for accuracy in LADDER:
        with precision(accuracy[0]):
            scale = side * shaken.block.slenderness
            state = exact(rotation) * scale, exact(velocity) * scale * shaken.kappa
            march = shaken.march(quarters * arb.pi() / 2, side, *state, accuracy)
            try:
                return _end(found, march)
            except Undecided:
                continue
    return "undecided"


def _end(found: SteadyRocking, march: March) -> str:
    while march.side:
        overturns, ends = march.advance(march.forcing.pieces[0])
        if overturns:
            return "overturns"
        if ends:
            raise Undecided("end")
        if march.side and march.zeros and march.impacts == 1 and found.attracts(march):
            return "steady"
    return "rests"


def contraction(shaken: Shaken, centre: arb_mat, frame: arb_mat, radius: float) -> arb:
    """Return a bound on the norm of the map's derivative over a disk, or 1 if none is below 1."""
    largest, cells = arb(0), [(0.0, 0.0, 1.0)]
    while cells:
        x, y, half = cells.pop()
        if max(abs(x) - half, 0.0) ** 2 + max(abs(y) - half, 0.0) ** 2 > 1.0:
            continue  # outside; no rounding, as all are sums of a few powers of two
        if half < WIDEST:
            place = arb_mat(2, 1, [radius * hull(z - half, z + half) for z in (x, y)])
            try:
                slope = shaken.flight(centre + frame * place, COARSE)[1]
                factor = _norm(frame.inv() * slope * frame)
            except Undecided:
                factor = arb(1)
            if factor < 1:
                largest = largest.max(factor)
                continue
            if half < FINEST:
                return arb(1)
        half /= 2
        cells += [(x + s * half, y + t * half, half) for s in (-1, 1) for t in (-1, 1)]
    return largest


def _search(shaken: Shaken, start: arb_mat) -> tuple[arb_mat, arb_mat]:
    """Return a fixed point of the map, about, and a frame in which it turns and shrinks."""
    for _ in range(RELAXED):
        march = shaken.lands(start, LADDER[0])
        if not march.side:
            raise Undecided("rests")
        start = arb_mat(2, 1, [march.sigma - 3 * arb.pi(), march.rate]).mid()
    centre = np.array(start.tolist(), float)
    for _ in range(NEWTON):
        image, slope = (
            np.array(x.mid().tolist(), float) for x in shaken.flight(arb_mat(centre.tolist()), FINE)
        )
        centre += np.linalg.solve(np.eye(2) - slope, image - centre)
    vectors = np.linalg.eig(slope)[1]
    turns = np.iscomplexobj(vectors)
    frame = np.column_stack([vectors[:, 0].real, (vectors[:, 0].imag if turns else vectors[:, 1])])
    frame /= np.hypot(*frame[0])  # the radius is that in phase
    return arb_mat(centre.tolist()), arb_mat(frame.tolist())


def _square(half: arb) -> arb_mat:
    return arb_mat(2, 1, [hull(-half, half)] * 2)


def _length(vector: arb_mat) -> arb:
    """Return a bound on the length: a square root of a ball around zero is none."""
    one, other = (x.abs_upper() for x in vector.entries())
    return (one * one + other * other).sqrt().upper()


def _norm(matrix: arb_mat) -> arb:
    """Return a bound on the spectral norm."""
    a, b, c, d = matrix.entries()
    one, other = (arb_mat(2, 1, list(pair)) for pair in ((a + d, b - c), (a - d, b + c)))
    return (_length(one) + _length(other)).upper() / 2
