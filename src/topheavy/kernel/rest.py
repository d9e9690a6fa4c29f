"""When a bouncing block may be called at rest.

With √r < 1 a block that bounces on level ground comes to rest after infinitely many impacts in a
finite time. Under a ground acceleration below the uplift level it does the same, provided that
the train of bounces is over before |a| exceeds the level again; this is decided here by a bound,
not by the smallness of a velocity.

A block that a record lifts at a sample by its last digit alone may land before the clock can tick
(time + bounce = time). The ground stands still during such a train of bounces, and the bound is
that of the push at once. The block rests from the next tick on, so that every history advances.
"""

import math

import numpy as np

from topheavy.kernel.compiled import compiled
from topheavy.kernel.forcing import variation
from topheavy.kernel.taylor import IMPACTS

#: A rotation below this, normalised by α, is no rocking: the impact that ends it is not counted.
MIN_COUNTED_PEAK = 1e-6
#: Normalised by α: the largest rotation of bounces that are left out where they are not counted.
MAX_UNCOUNTED_PEAK = 1e-2


@compiled
def first_bounce(block, state):
    """Return the lesser pull c back to φ = 0 on the two sides, at a landing, and φ̂ = v²/(c cos α).

    On level ground φ̂ is twice the height of a low bounce with the speed v.
    """
    pull = min(-state.push, state.push + 2 * block.uplift_level * state.gravity)
    square = state.velocity * state.velocity
    return pull, square / (pull * block.cosine) if pull > 0.0 else np.inf


@compiled
def may_rest(block, state, method, peak):
    """Return whether a block has landed so slowly that `comes_to_rest` may be true."""
    share = MIN_COUNTED_PEAK if method.detail == IMPACTS else MAX_UNCOUNTED_PEAK
    height = first_bounce(block, state)[1]
    return state.velocity <= 0.0 or height <= min(peak, share * block.slenderness)


@compiled
def comes_to_rest(block, forcing, state, method, peak):
    """Return whether a block that has just landed is sure to come to rest.

    True if all bounces stay below the φ̂ of `first_bounce`, which `may_rest` limits (`peak` is the
    largest φ so far), and die out while |a| is below the uplift level.

    On either side the block is pulled back by c = G level ∓ s a, which varies by at most V while
    the bounces last: φ'' = −(c cos(α − φ) − G sin φ / cos α). Let c₀ be the lesser c at the
    landing, and g = (c₀ − V) cos α − G φ̂ / cos α > 0 with the largest G. As long as φ ≤ φ̂, the
    energy of a flight, A being the integral of cos(α − φ) from 0 to φ,

        E = φ'²/2 + c A − G (1 − cos φ)/cos α ≥ φ'²/2 + g φ,    g A ≤ E cos α,

    changes with c and G only, by |dE| ≤ A dV ≤ E cos α dV/g, and an impact multiplies it by r.
    So after n impacts |φ'| ≤ u √rⁿ with u = v exp(V cos α/2g). Then φ ≤ u²/2g, which has to be at
    most φ̂. A flight lasts at most 2u √rⁿ/g: all bounces together 2u/g(1 − √r). Linearised,
    cosines are 1 and the sine is φ.
    """
    cosine, level, lost = block.cosine, block.uplift_level, 1.0 - block.restitution
    time, velocity, (pull, height) = state.time, state.velocity, first_bounce(block, state)
    if velocity <= 0.0:
        return True
    if lost <= 0.0 or not may_rest(block, state, method, peak):
        return False
    lasts, change = 4.0 * velocity / (pull * cosine * lost), 0.0
    if time + lasts > time:
        change = variation(forcing, time, time + lasts, level)
    pull = (pull - change) * cosine - (state.gravity + change / level) * height / cosine
    if pull <= 0.0:
        return False
    fastest = velocity * math.exp(change * cosine / (2.0 * pull))
    return fastest * fastest <= 2.0 * pull * height and 2.0 * fastest <= lasts * pull * lost


@compiled
def next_tick(time):
    """Return the first time after another: a train of bounces lasts as long at least."""
    return np.nextafter(time, np.inf)
