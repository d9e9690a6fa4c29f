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
    MOST_PIECES,
    MOST_UP,
    RECORD,
    STRONGEST,
    gravity,
    ground,
    lines,
    next_turn,
    piece_of,
    piece_start,
)

#: A rotation below this, over α, is no rocking: the impact that ends it is not counted.
LAST_BOUNCE = 1e-6
#: Pieces of a record over which the push is bounded piece by piece. A block with √r → 1 would rest
#: after so many that each bounce took the time of the whole record.
MOST_SCANNED = 256
#: `LAST_BOUNCE` where each impact has a √r of its own: the order of smaller ones is not known.
RATIO_BOUNCE = 1e-3


@compiled
def comes_to_rest(block, forcing, record, time, velocity, push, side, peak):
    """Say whether a block that leaves the ground at `velocity` is sure to come to rest.

    True if all bounces stay below `LAST_BOUNCE` α, and die out while |a| is below the uplift
    level. Let f = −s a range over [f₁, f₂] while they last. Standing on the side s the block is
    pulled back by at least g and at most G,

        g = (level − f₂) cos α − φ̂ / cos α,    G = (level − f₁)(cos α + φ̂),

    and by the same with −f on the other side, φ̂ = v²/(level − f₂) cos α bounding φ as long as
    φ̂/cos α is at most half the first term of g. It lands with at most √(G/g) times the velocity
    that it left with, hence leaves with at most λ = √(r G/g) times that, is off the ground for
    2v/g at most, and all bounces together last 2v/g(1 − λ).

    Under gravity Γ, level − f₂ and level − f₁ are the least and the largest Γ level − f, and the
    φ̂/cos α of g is times the largest Γ.

    Parameters
    ----------
    velocity : float
        φ' after the impact.
    push : float
        q = −s a − Γ level on the side that it moves to.
    side : float
        That side.
    peak : float
        The largest φ so far: the bounces must not exceed it.
    """
    cosine, level, restitution = block.cosine, block.level, block.restitution
    if velocity <= 0.0:
        return True
    weight = gravity(forcing, record, time)[0]
    weakest = -max(push, -push - 2 * level * weight)
    if weakest <= 0.0 or restitution >= 1.0:
        return False
    if velocity * velocity > weakest * cosine * LAST_BOUNCE * block.slenderness:
        return False
    allowed = 4 * velocity / (weakest * cosine * (1 - restitution))
    slight = LAST_BOUNCE * block.slenderness
    near, far = -push, push + 2 * level * weight
    most_near, most_far, heaviest = near, far, weight
    if time + allowed > time:
        if forcing.shape == RECORD:
            near, most_near, far, most_far, heaviest = _range_of_record(
                forcing, record, time, time + allowed, side, level
            )
        else:
            low, high = _range(forcing, record, time, time + allowed, side)
            near, most_near, far, most_far = level - high, level - low, level + low, level + high
    if min(near, far) <= 0.0:
        return False
    bound = velocity * velocity / (min(near, far) * cosine)
    if 2 * bound * heaviest > min(near, far) * cosine * cosine or bound > min(peak, slight):
        return False
    lost = heaviest * bound / cosine
    pull_near, pull_far = near * cosine - lost, far * cosine - lost
    ratio = (cosine + bound) * max(most_near / pull_near, most_far / pull_far)
    decay = restitution * math.sqrt(ratio)
    return decay < 1.0 and 2 * velocity <= allowed * min(pull_near, pull_far) * (1 - decay)


@compiled
def next_tick(time):
    """Return the first time after another: a train of bounces lasts as long at least."""
    return np.nextafter(time, np.inf)


@compiled
def _range(forcing, record, start, stop, side):
    """Return the least and the largest f = −s a on [start, stop].

    See `MOST_PIECES`; of a record `_range_of_record`.
    """
    value = -side * ground(forcing, record, start)[0]
    low, high = value, value
    time = start
    for _ in range(MOST_PIECES):
        if time >= stop:
            break
        time = min(next_turn(forcing, time), stop) if time < forcing.end else stop
        value = -side * ground(forcing, record, time)[0]
        low, high = min(low, value), max(high, value)
        if time >= forcing.end:
            low, high = min(low, 0.0), max(high, 0.0)
    return low, high


@compiled
def _range_of_record(forcing, record, start, stop, side, level):
    """Return the least and largest Γ level − f and Γ level + f on [start, stop], and largest Γ.

    Over more than `MOST_SCANNED` pieces these are bounds by the largest |a| and |v| to come.
    """
    first = piece_of(forcing, record, start)
    beyond = first + MOST_SCANNED
    if beyond < record.shape[1] and piece_start(forcing, record, beyond) < stop:
        push = abs(forcing.amplitude) * record[STRONGEST, first]
        heavier = abs(forcing.lift) * record[MOST_UP, first]
        least, most = level * (1.0 - heavier) - push, level * (1.0 + heavier) + push
        return least, most, least, most, 1.0 + heavier
    near, most_near, far, most_far, heaviest = np.inf, -np.inf, np.inf, -np.inf, 0.0
    last = record.shape[1] - 1
    for piece in range(first, last + 1):
        begin, end = piece_start(forcing, record, piece), stop
        if begin > stop:
            break
        value, rate, weight, change = 0.0, 0.0, 1.0, 0.0  # the ground at rest after the last piece
        if piece < last:
            value, rate, weight, change = lines(forcing, record, piece)
            end = min(piece_start(forcing, record, piece + 1), stop)
        for time in (max(begin, start), end):
            push, heavy = side * (value + rate * (time - begin)), weight + change * (time - begin)
            near, most_near = min(near, heavy * level + push), max(most_near, heavy * level + push)
            far, most_far = min(far, heavy * level - push), max(most_far, heavy * level - push)
            heaviest = max(heaviest, heavy)
    return near, most_near, far, most_far, heaviest
