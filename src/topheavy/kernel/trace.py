"""One rocking history with samples, for a block that starts at rest or in motion.

The same steps and events as in `outcome`; but the free rocking is integrated too, so that it can be
drawn, and a block that is sure to overturn is followed on.

The energy at the end of the forcing decides how the free rocking continues (`tail`). The
integration gives the same outcome, unless this energy equals that of the barrier within its error.
Then the block is poised at φ = α and could leave it to the wrong side; the history ends there.
"""

import math

from topheavy.kernel.compiled import compiled
from topheavy.kernel.forcing import (
    CONSTANT,
    NONE,
    RECORD,
    RICKER_ANTISYMMETRIC,
    RICKER_SYMMETRIC,
    Forcing,
    gravity,
    ground,
    next_uplift,
    piece_of,
    piece_start,
)
from topheavy.kernel.outcome import (
    FLAT,
    HALT,
    LANDING,
    MAX_STEPS,
    PULSE_ORDER,
    advance,
    after_impact,
    at_sample,
    is_certain_to_overturn,
    renewed,
)
from topheavy.kernel.rest import LAST_BOUNCE, comes_to_rest, next_tick
from topheavy.kernel.tail import free_rocking
from topheavy.kernel.taylor import State, evaluate

NO_UPLIFT, RESTS, ROCKING, OVERTURNED, UNRESOLVED = range(5)
#: A history with more steps than this (and ten a sample) is given up as `UNRESOLVED`: those of the
#: forcing (`outcome.MAX_STEPS`) and of the free rocking. A free flight takes fewer than ten, as the
#: motion is a pendulum's, whose series converge over π/2 or more. There are at most twice
#: `LAST_IMPACT` of them or, in a history with an end of its own, as many as `impacts` has room for.
MOST_STEPS = 5 * MAX_STEPS
#: A free history without an end of its own ends after so many impacts.
LAST_IMPACT = 1000
#: Without an end of its own, a flight longer than this (in τ) is that of a block poised at α.
LONGEST_FLIGHT = 100.0
#: Over α: a block this far from φ = α, and going on, has left.
POISED = 1e-3


@compiled(nogil=True)
def trace(w, order, tolerance, block, forcing, record, course, results):
    """Follow a history from θ and θ' at τ = 0 to the first of its ends.

    Parameters
    ----------
    course : float, float, float
        Rotation and velocity, θ and dθ/dτ at τ = 0, and `until`.
    results : array, array, array
        `times`, `samples` and `impacts`.
    until : float
        Where the history ends; if infinite, where the block rests or |θ| = π/2, or after
        `LAST_IMPACT` impacts behind the forcing. In either case it ends before a step by which
        the block leaves φ = α to the other side than its energy says.
    times : array
        Ascending τ; `samples`, of shape (2, times.size), takes θ and dθ/dτ there, and keeps what it
        had beyond the end of a block that does not rest. The last may be infinite: the end.
    impacts : array
        Takes the times of impacts.

    Returns
    -------
    end : float
        The time at which the history ends.
    result : int
        `NO_UPLIFT`, `RESTS`, `ROCKING` or `OVERTURNED`, as the whole motion ends; `UNRESOLVED`
        if it takes more than `MOST_STEPS`, or more impacts than `impacts` has room for.
    peak : float
        The largest |θ| of the whole motion.
    counted : int
        The number of impacts until the forcing ended or the block was judged overturned.
    landed : int
        The number of all impacts: how many `impacts` holds. Neither counts those that end a
        rotation below `rest.LAST_BOUNCE` α.
    """
    (rotation, velocity, until), (times, samples, impacts) = course, results
    time, peak, sample, counted, landed = 0.0, abs(rotation), 0, 0, 0
    moves = rotation != 0.0 or velocity**2 > 0.0  # a speed without an energy is rest
    has_moved, is_low, is_forced, is_over = moves, rotation == 0.0, True, False
    is_record = forcing.shape == RECORD
    straight = is_record or forcing.shape == CONSTANT or forcing.shape == NONE
    side = math.copysign(1.0, rotation if rotation != 0.0 else velocity)
    state, zeros = _initial_state(block, forcing, record, rotation, velocity, side), 0
    if rotation == 0.0:
        zeros = 1
    piece, forcing_end, flight_start, landed_forced = 0, forcing.end, 0.0, 0
    landings_due, flights = 0, 0  # free ones, before it overturns; so far
    for _ in range(MOST_STEPS + 10 * record.shape[1]):
        if w[HALT, 0] != 0.0 or landed > impacts.size:
            break
        if is_forced and time >= forcing_end:  # the ground comes to rest: judge what follows
            is_forced, straight, order, forcing = False, True, PULSE_ORDER, still(forcing_end)
            is_record = False
            flight_start, landed_forced = time, landed
            state = State(
                state.rotation,
                state.velocity,
                state.sine,
                state.cosine,
                -block.level,
                0.0,
                1.0,
                0.0,
            )
            if moves:
                tail = free_rocking(block, state.rotation, state.velocity)
                is_over, counted = tail.overturned, counted + tail.impacts
                landings_due = tail.impacts
                peak = peak if is_over else max(peak, tail.peak)
        if not moves:
            uplift, push, rate, side = next_uplift(forcing, record, time, block.level)
            if uplift >= forcing_end:  # beyond the cut of a record
                uplift = math.inf
            # A motion that ends by rest has its end at the last landing or, later, at rest.
            stays = time < forcing_end or not has_moved
            while (
                sample < times.size
                and times[sample] <= uplift
                and (stays or times[sample] < math.inf)
            ):
                samples[0, sample], samples[1, sample] = 0.0, 0.0
                sample += 1
            if uplift == math.inf:
                result = RESTS if has_moved else NO_UPLIFT
                return max(time, forcing_end), result, peak, counted, landed
            time, moves, has_moved, is_low, flight_start = uplift, True, True, True, uplift
            weight = gravity(forcing, record, time)
            state = State(0.0, 0.0, 0.0, 1.0, push, rate, weight[0], weight[1])
            zeros = 2 if push > 0.0 else 3
            piece = piece_of(forcing, record, time) if is_record else 0
        is_far = block.linearised and is_over and state.rotation >= math.pi / 2
        is_endless = until == math.inf and not is_forced
        is_poised = is_endless and time - flight_start >= LONGEST_FLIGHT
        is_restless = is_endless and (
            landed - landed_forced >= LAST_IMPACT or flights >= 2 * LAST_IMPACT
        )
        if time >= until or is_far or is_poised or is_restless:
            return time, (OVERTURNED if is_over else ROCKING), peak, counted, landed

        piece_end = min(until, flight_start + LONGEST_FLIGHT) if is_endless else until
        if is_forced:
            piece_end = forcing_end
            if is_record:
                piece_end = min(piece_end, piece_start(forcing, record, piece + 1))
        start, longest, so_far = time, piece_end - time, (0.0 if is_low else peak)
        step, event, highest = advance(
            w, order, tolerance, block, forcing, time, longest, state, zeros, so_far, straight
        )
        ahead = evaluate(w, order, block, step, straight)
        if not is_forced and _leaves_wrongly(block, ahead, event, is_over, landings_due - flights):
            return time, (OVERTURNED if is_over else ROCKING), peak, counted, landed
        peak = max(peak, highest)
        is_low = is_low and highest <= LAST_BOUNCE * block.slenderness
        time = piece_end if step >= longest else time + step
        while sample < times.size and times[sample] <= time:
            there = evaluate(w, order, block, times[sample] - start, straight)
            samples[0, sample] = side * there.rotation
            samples[1, sample] = side * there.velocity
            sample += 1
        if sample < times.size and times[sample] == math.inf:
            samples[0, sample], samples[1, sample] = side * ahead.rotation, side * ahead.velocity
        state, zeros = ahead, 0
        if forcing.shape == RICKER_SYMMETRIC or forcing.shape == RICKER_ANTISYMMETRIC:
            state = renewed(block, forcing, record, time, side, state)
        if event == FLAT:
            return time, OVERTURNED, peak, counted, landed
        if event == LANDING or state.rotation <= 0.0:
            if not is_low:
                if landed < impacts.size:
                    impacts[landed] = time
                landed += 1
                counted += 1 if is_forced else 0
            is_low, flight_start, side = True, time, -side
            state, zeros = after_impact(block, state), 1
            if not is_forced:
                flights += 1
                bounce = free_rocking(block, 0.0, state.velocity)
                moves = is_over or bounce.peak > LAST_BOUNCE * block.slenderness
            elif time < forcing_end:
                moves = not comes_to_rest(
                    block, forcing, record, time, state.velocity, state.push, side, peak
                )
                time = time if moves else next_tick(time)
        elif is_forced and block.linearised and not is_over:
            is_over = is_certain_to_overturn(block, forcing, record, time, state)
        if is_record and time >= piece_end:
            piece += 1
            if moves and time < forcing_end:
                state = at_sample(block, forcing, record, piece, side, state)
    return time, UNRESOLVED, peak, counted, landed


@compiled
def _leaves_wrongly(block, state, event, is_over, landings_left):
    """Say whether a free step leads away from φ = α to the other side than was judged.

    A block that overturns moves outward for good once it has landed as often as it was to. Any
    other free motion passes α only inward.
    """
    if is_over and landings_left <= 0:
        falls_back = state.velocity < 0.0 and state.rotation < (1 - POISED) * block.slenderness
        return falls_back or event == LANDING
    escapes = state.velocity > 0.0 and state.rotation > (1 + POISED) * block.slenderness
    return escapes or event == FLAT


@compiled
def _initial_state(block, forcing, record, rotation, velocity, side):
    value, rate = ground(forcing, record, 0.0)
    phi = abs(rotation)
    sine, cosine = (0.0, 1.0) if block.linearised else (math.sin(phi), math.cos(phi))
    weight, change = gravity(forcing, record, 0.0)
    push, rate = -side * value - block.level * weight, -side * rate - block.level * change
    return State(phi, side * velocity, sine, cosine, push, rate, weight, change)


@compiled
def still(time):
    """Return the forcing of ground that has been at rest since `time`."""
    return Forcing(NONE, 0.0, 1.0, time, 1.0, 0.0)
