"""When bounces are sure to die out: infinitely many impacts in a finite time.

Let a lie in a ball over a window, and let the pull on the block (−φ''/κ²) be between g > 0 and G on
a side, for all φ up to the highest bounce. A bounce that starts with φ' = v rises to at most
v²/2κ²g, lasts at most 2v/κ²g and lands with at most √(G/g) v. With λ = √r √(G/g) < 1 all bounces
together last at most 2v/κ²g(1 − λ). If the window is as long, the block rests when it ends.
"""

from topheavy.proven.balls import arb, hull
from topheavy.proven.flight import Law
from topheavy.proven.forcing import Forcing


def dies_out(
    law: Law, forcing: Forcing, factor: arb, number: int, sigma: arb, rate: arb
) -> tuple[arb, arb] | None:
    """Return a σ from which on a block rests that leaves the ground with φ' at σ, and a bound on φ.

    None if that is not proven; `number` is that of the piece that contains σ. Over the window the
    ground acceleration stays below the level of uplift.
    """
    now = factor * forcing.value(forcing.pieces[number], sigma)
    weakest = min((law.pull(arb(0), side * now).lower() for side in (1, -1)), key=float)
    lost = 1 - law.block.restitution
    if not (weakest > 0 and lost > 0):
        return None
    square, speed = law.square.lower(), rate.upper()
    window = 4 * speed / (square * weakest * lost)
    highest = (speed * speed / (square * weakest)).upper()
    until = (sigma + window).upper()
    ground = factor * forcing.range(number, sigma, until)
    pulls = [law.pull(hull(0, highest), side * ground) for side in (1, -1)]
    if not all(pull > 0 for pull in pulls):
        return None
    slowest = pulls[0].lower().min(pulls[1].lower())
    ratios = [(pull.upper() / pull.lower()).sqrt() for pull in pulls]
    loss = law.block.restitution * ratios[0].max(ratios[1])
    lasts = 2 * speed / (square * slowest * (1 - loss))
    if loss < 1 and speed * speed / (2 * square * slowest) < highest and lasts < window:
        return until, highest
    return None
