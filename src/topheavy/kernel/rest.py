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
from topheavy.kernel.forcing import (
    A_MAX,
    MAX_PIECES,
    RECORD,
    V_MAX,
    ground,
    ground_of_piece,
    next_turn,
    piece_of,
    piece_start,
)

#: A rotation below this, normalised by α, is no rocking: the impact that ends it is not counted.
MIN_COUNTED_PEAK = 1e-6
#: Pieces of a record over which the push is bounded piece by piece. A block with √r → 1 would rest
#: after so many that each bounce took the time of the whole record.
MAX_SCANNED_PIECES = 256
#: Of the speed of bounces by a pull that changes.
MAX_GROWTH = 1.4


@compiled
def comes_to_rest(block, forcing, state, peak, least):
    """Return whether a block that has just landed is sure to come to rest.

    True if all bounces stay below `least` α and below `peak`, the largest φ so far, and
    die out while |a| is below the uplift level. Let f = −s a range over [f₁, f₂] while they last.
    On the side s the block is pulled back by at least g and at most G,

        g = (level − f₂) cos α − φ̂ / cos α,    G = (level − f₁)(cos α + φ̂),

    and by the same with −f on the other side, φ̂ = v²/(level − f₂) cos α bounding φ as long as
    φ̂/cos α is at most half the first term of g. It lands with at most √(G/g) times the velocity
    that it left with, hence leaves with at most λ = √(r G/g) times that, is off the ground for
    2v/g at most, and all bounces together last 2v/g(1 − λ).

    Under a pulse the pull has a few monotone pieces. A constant pull keeps the energy E of a flight,
    a changing one changes it by |dE| ≤ |dg|/g E: over all bounces by a factor of at most G/g on
    either side for each piece, and an impact takes it to r²E. So they last 2v (G/g)^pieces/g(1 − r)
    at most.

    Under gravity Γ, level − f₂ and level − f₁ are the least and the largest Γ level − f, and the
    φ̂/cos α of g is times the largest Γ.
    """
    cosine, level, restitution = block.cosine, block.uplift_level, block.restitution
    time, velocity = state.time, state.velocity
    if velocity <= 0.0:
        return True
    weight = ground(forcing, time)[2]
    near, far = -state.push, state.push + 2 * level * weight
    weakest = min(near, far)
    if weakest <= 0.0 or restitution >= 1.0:
        return False
    slight = least * block.slenderness
    if velocity * velocity > weakest * cosine * slight:
        return False
    allowed, parts = 4 * velocity / (weakest * cosine * (1 - restitution)), 0
    max_near, max_far, heaviest = near, far, weight
    if time + allowed > time:
        if forcing.wave == RECORD:
            near, max_near, far, max_far, heaviest = _range_of_record(
                forcing, time, time + allowed, state.side, level
            )
        else:
            low, high, parts = _range(forcing, time, time + allowed, state.side)
            near, max_near, far, max_far = level - high, level - low, level + low, level + high
    if min(near, far) <= 0.0:
        return False
    bound = velocity * velocity / (min(near, far) * cosine)
    if parts > 0:
        bound *= MAX_GROWTH * MAX_GROWTH
    if 2 * bound * heaviest > min(near, far) * cosine * cosine or bound > min(peak, slight):
        return False
    lost = heaviest * bound / cosine
    pull_near, pull_far = near * cosine - lost, far * cosine - lost
    ratio = (cosine + bound) * max(max_near / pull_near, max_far / pull_far)
    if parts > 0:
        growth = ratio**parts
        lasts = 2 * velocity * growth <= allowed * min(pull_near, pull_far) * (1 - restitution)
        return growth <= MAX_GROWTH and lasts
    decay = restitution * math.sqrt(ratio)
    return decay < 1.0 and 2 * velocity <= allowed * min(pull_near, pull_far) * (1 - decay)


@compiled
def next_tick(time):
    """Return the first time after another: a train of bounces lasts as long at least."""
    return np.nextafter(time, np.inf)


@compiled
def _range(forcing, start, stop, side):
    """Return the least and the largest f = −s a of a pulse on [start, stop], and its pieces."""
    value = -side * ground(forcing, start)[0]
    low, high, time, parts = value, value, start, 0
    for _ in range(MAX_PIECES):
        if time >= stop:
            break
        parts += 1
        time = min(next_turn(forcing, time), stop) if time < forcing.end else stop
        value = -side * ground(forcing, time)[0]
        low, high = min(low, value), max(high, value)
        if time >= forcing.end:
            low, high = min(low, 0.0), max(high, 0.0)
            parts += 1
    return low, high, parts


@compiled
def _range_of_record(forcing, start, stop, side, level):
    """Return the least and largest Γ level − f and Γ level + f on [start, stop], and largest Γ.

    Over more than `MAX_SCANNED_PIECES` pieces these are bounds by the largest |a| and |v| to come.
    """
    record = forcing.record
    first, last = piece_of(forcing, start), record.shape[1] - 1
    beyond = first + MAX_SCANNED_PIECES
    if beyond <= last and piece_start(forcing, beyond) < stop:
        push = abs(forcing.amplitude) * record[A_MAX, first]
        change = abs(forcing.vertical_factor) * record[V_MAX, first]
        least, most = level * (1.0 - change) - push, level * (1.0 + change) + push
        return least, most, least, most, 1.0 + change
    near, max_near, far, max_far, heaviest = np.inf, -np.inf, np.inf, -np.inf, 0.0
    for piece in range(first, last + 1):
        begin, end = piece_start(forcing, piece), stop
        if begin > stop:
            break
        value, rate, weight, change = 0.0, 0.0, 1.0, 0.0  # the ground at rest after the last piece
        if piece < last:
            value, rate, weight, change = ground_of_piece(forcing, piece)
            end = min(piece_start(forcing, piece + 1), stop)
        for time in (max(begin, start), end):
            push, pull = side * (value + rate * (time - begin)), weight + change * (time - begin)
            near, max_near = min(near, pull * level + push), max(max_near, pull * level + push)
            far, max_far = min(far, pull * level - push), max(max_far, pull * level - push)
            heaviest = max(heaviest, pull)
    return near, max_near, far, max_far, heaviest
