"""One rocking history by Taylor steps: its outcome, and samples of it where they are wanted.

A history that is judged ends with the forcing, or where the block is sure to overturn: the energy
then decides what follows (`tail`). One with samples goes on, so that it can be drawn. Its free
rocking has the same outcome, unless this energy equals that of the barrier within its error. Then
the block is poised at φ = α and could leave it to the wrong side; the history ends there.
"""

import math
from typing import NamedTuple

import numpy as np

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
from topheavy.kernel.march import march
from topheavy.kernel.rest import LAST_BOUNCE, RATIO_BOUNCE, comes_to_rest, next_tick
from topheavy.kernel.step import (
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
from topheavy.kernel.tail import free_rocking
from topheavy.kernel.taylor import Oscillator, State, evaluate

NO_UPLIFT, RESTS, ROCKING, OVERTURNED, UNRESOLVED = range(5)
#: A history with more steps than this (and ten a sample) is given up as `UNRESOLVED`: those of the
#: forcing (`step.MAX_STEPS`) and of the free rocking. A free flight takes fewer than ten, as the
#: motion is a pendulum's, whose series converge over π/2 or more. There are at most twice
#: `LAST_IMPACT` of them or, in a history with an end of its own, as many as `impacts` has room for.
MOST_STEPS = 5 * MAX_STEPS
#: A free history without an end of its own ends after so many impacts.
LAST_IMPACT = 1000
#: Without an end of its own, a flight longer than this (in τ) is that of a block poised at α.
LONGEST_FLIGHT = 100.0
#: Over α: a block this far from φ = α, and going on, has left.
POISED = 1e-3


class Outcome(NamedTuple):
    """What became of a block: `peak` is max φ (NaN if overturned), `impacts` the number of those
    that end a rotation above `rest.LAST_BOUNCE` α; `resolved` is False if it took too many steps.
    """

    overturned: bool
    peak: float
    impacts: int
    resolved: bool


#: What stands for the ratios where every impact has the √r of the block, and for the times, samples
#: and impacts of a history that is judged. Arguments, as constants would have it compiled anew.
NO_RATIOS = np.empty(0)
NO_SAMPLES = np.empty(0), np.empty((2, 0)), np.empty(0)


@compiled(nogil=True)
def outcome(w, order, tolerance, block, forcing, record, ratios, no_samples):
    """Return the `Outcome` of a block that is at rest when the forcing begins.

    The k-th impact that counts has the k-th of the `ratios` as √r, and those after the last one
    that of the block. Where there are ratios, an impact counts above `RATIO_BOUNCE` α.
    """
    given = (w, order, tolerance, block, forcing, record, ratios)
    _, result, peak, counted, _ = trace(*given, (0.0, 0.0, math.inf), no_samples, True)
    overturned = result == OVERTURNED
    peak = math.nan if overturned or result == UNRESOLVED else peak
    return Outcome(overturned, peak, counted, result != UNRESOLVED)


@compiled
def at_impact(block, ratios, impacts):
    """Return the block with the √r of its next impact: its own after the last of the ratios."""
    alpha, ratio, level, cosine, sine, flat, linearised = block
    if impacts < ratios.size:
        ratio = ratios[impacts]
    return Oscillator(alpha, ratio, level, cosine, sine, flat, linearised)


@compiled(nogil=True)
def trace(w, order, tolerance, block, forcing, record, ratios, course, results, is_judged):
    """Follow a history from θ and θ' at τ = 0 to the first of its ends.

    Parameters
    ----------
    ratios : array
        As of `outcome`.
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
    is_judged : bool
        Whether the history ends as soon as its outcome is known; it then has no samples.

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
    block, own = at_impact(block, ratios, 0), block
    lowest = (RATIO_BOUNCE if ratios.size > 0 else LAST_BOUNCE) * block.slenderness
    for _ in range((MAX_STEPS if is_judged else MOST_STEPS) + 10 * record.shape[1]):
        if w[HALT, 0] != 0.0 or (landed > impacts.size and not is_judged):
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
                if is_judged:
                    return time, (OVERTURNED if is_over else ROCKING), peak, counted, landed
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
        is_low = is_low and highest <= lowest
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
                block = at_impact(own, ratios, landed)
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
        elif is_forced and (block.linearised or is_judged) and not is_over:
            is_over = is_certain_to_overturn(block, forcing, record, time, state)
            if is_over and is_judged:
                return time, OVERTURNED, peak, counted, landed
        if is_record and time >= piece_end:
            piece += 1
            if moves and time < forcing_end:
                state = at_sample(block, forcing, record, piece, side, state)
                if is_judged and not (is_low or block.linearised):
                    piece, state, peak = march(
                        block, forcing, record, piece, side, state, tolerance, peak
                    )
                    time = piece_start(forcing, record, piece)
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
