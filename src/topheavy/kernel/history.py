"""One rocking history by Taylor steps: its outcome, and samples of it where they are wanted.

A history that is judged ends with the forcing, or where the block is sure to overturn: its energy
then decides what follows (`bodies.free_rocking`). One with samples goes on, so that it can be
drawn. Its free rocking has the same outcome, unless this energy equals that of the barrier within
its error. Then the block is poised at φ = α and could leave it to the wrong side; the history ends
there.
"""

import math
from typing import NamedTuple

import numpy as np

from topheavy.bodies.free_rocking import ending
from topheavy.ground.shapes import CONSTANT, RICKER_ANTISYMMETRIC, RICKER_SYMMETRIC
from topheavy.kernel.compiled import compiled
from topheavy.kernel.forcing import (
    NONE,
    RECORD,
    Array,
    Forcing,
    ground,
    ground_of_piece,
    next_uplift,
    piece_of,
    piece_start,
)
from topheavy.kernel.march import march
from topheavy.kernel.rest import (
    MIN_COUNTED_PEAK,
    MIN_COUNTED_PEAK_WITH_RATIOS,
    comes_to_rest,
    next_tick,
)
from topheavy.kernel.step import (
    FLAT,
    HALT,
    LANDING,
    MAX_STEPS,
    PULSE_ORDER,
    advance,
    after_impact,
    is_certain_to_overturn,
    with_ground,
)
from topheavy.kernel.taylor import Method, Oscillator, State, evaluate

NO_UPLIFT, RESTS, ROCKING, OVERTURNED, UNRESOLVED = range(5)
#: A history with samples that takes more steps than this (and ten a sample of the record) is given
#: up as `UNRESOLVED`: the steps of the forcing (`step.MAX_STEPS`) and of the free rocking. A free
#: flight takes fewer than ten, as the motion is a pendulum's, whose series converge over π/2 or
#: more. There are at most twice `MAX_FREE_IMPACTS` flights or, in a history with an end of its own,
#: as many as `Samples.impacts` has room for.
MAX_STEPS_WITH_SAMPLES = 5 * MAX_STEPS
#: A free history without an end of its own ends after so many impacts.
MAX_FREE_IMPACTS = 1000
#: Without an end of its own, a flight longer than this (in τ) is that of a block poised at α.
MAX_FREE_FLIGHT = 100.0
#: Over α: a block this far from φ = α, and going on, has left.
POISED_ROTATION = 1e-3


class Course(NamedTuple):
    """Where a history begins and ends.

    Attributes
    ----------
    rotation, velocity : float
        θ and dθ/dτ at τ = 0.
    until : float
        The τ at which it ends; if infinite, where the block rests or |θ| = π/2, or after
        `MAX_FREE_IMPACTS` impacts behind the forcing. In either case it ends before a step by
        which the block leaves φ = α to the other side than its energy says.
    """

    rotation: float
    velocity: float
    until: float


class Samples(NamedTuple):
    """Arrays that a history fills.

    Attributes
    ----------
    times : array
        Ascending τ. The last may be infinite: the end.
    motion : array, shape (2, times.size)
        Takes θ and dθ/dτ at the times, and is left as it was beyond the end of a block that does
        not rest.
    impacts : array
        Takes the times of impacts.
    """

    times: Array
    motion: Array
    impacts: Array


class History(NamedTuple):
    """How a history ended.

    Attributes
    ----------
    end : float
        The time at which it ended.
    result : int
        `NO_UPLIFT`, `RESTS`, `ROCKING` or `OVERTURNED`, as the whole motion ends; `UNRESOLVED` if
        it takes too many steps, or more impacts than `Samples.impacts` has room for.
    peak : float
        The largest |θ| of the whole motion.
    impacts : int
        The number of impacts until the forcing ended or the block was judged overturned.
    all_impacts : int
        The number of all impacts: how many `Samples.impacts` holds. Neither counts those that end
        a rotation below `rest.MIN_COUNTED_PEAK` α.
    """

    end: float
    result: int
    peak: float
    impacts: int
    all_impacts: int


free_rocking = compiled(ending)
#: The ratios where every impact has the √r of the block; the course and the samples of a history
#: that is judged.
NO_RATIOS = np.empty(0)
FROM_REST = Course(0.0, 0.0, math.inf)
NO_SAMPLES = Samples(np.empty(0), np.empty((2, 0)), np.empty(0))


@compiled
def at_impact(block, ratios, impacts):
    """Return the block with the √r of its next impact: its own after the last of the ratios."""
    alpha, ratio, level, cosine, sine, flat, linearised = block
    if impacts < ratios.size:
        ratio = ratios[impacts]
    return Oscillator(alpha, ratio, level, cosine, sine, flat, linearised)


@compiled(nogil=True)
def follow(w, method, block, forcing, ratios, course, samples, is_judged):
    """Follow a block from τ = 0 to the first of its ends and return its `History`.

    Parameters
    ----------
    ratios : array
        √r of the impacts that count, in turn; those after the last one have that of the block.
        Where there are ratios, an impact counts above `rest.MIN_COUNTED_PEAK_WITH_RATIOS` α.
    is_judged : bool
        Whether the history ends as soon as its outcome is known; it then has no samples.
    """
    (rotation, velocity, until), (times, motion, impacts) = course, samples
    peak, sample, counted, landed = abs(rotation), 0, 0, 0
    moves = rotation != 0.0 or velocity**2 > 0.0  # a speed without an energy is rest
    has_moved, is_low, is_forced, is_over = moves, rotation == 0.0, True, False
    is_record = forcing.wave == RECORD
    is_ricker = forcing.wave == RICKER_SYMMETRIC or forcing.wave == RICKER_ANTISYMMETRIC
    state, zeros = _initial_state(block, forcing, course), 1 if rotation == 0.0 else 0
    piece, forcing_end, flight_start, landed_forced = 0, forcing.end, 0.0, 0
    landings_due, flights = 0, 0  # of free rocking: before it overturns; so far
    block, original = at_impact(block, ratios, 0), block
    has_ratios = ratios.size > 0
    lowest = (MIN_COUNTED_PEAK_WITH_RATIOS if has_ratios else MIN_COUNTED_PEAK) * block.slenderness
    most_steps = MAX_STEPS if is_judged else MAX_STEPS_WITH_SAMPLES
    for _ in range(most_steps + 10 * forcing.record.shape[1]):
        if w[HALT, 0] != 0.0 or (landed > impacts.size and not is_judged):
            break
        time, side = state.time, state.side
        if is_forced and time >= forcing_end:  # the ground comes to rest: judge what follows
            method, forcing = Method(PULSE_ORDER, method.tolerance, True), _at_rest(forcing)
            is_forced, is_record, is_ricker = False, False, False
            flight_start, landed_forced = time, landed
            state = with_ground(block, state, time, ground(forcing, time))
            if moves:
                tail = free_rocking(block, state.rotation, state.velocity)
                is_over, counted = tail.overturned, counted + tail.impacts
                landings_due = tail.impacts
                peak = peak if is_over else max(peak, tail.peak)
                if is_judged:
                    return History(time, OVERTURNED if is_over else ROCKING, peak, counted, landed)
        if not moves:
            uplift, push, rate, side = next_uplift(forcing, time, block.level)
            if uplift >= forcing_end:  # beyond the cut of a record
                uplift = math.inf
            # A motion that ends by rest has its end at the last landing or, later, at rest.
            stays = time < forcing_end or not has_moved
            while (
                sample < times.size
                and times[sample] <= uplift
                and (stays or times[sample] < math.inf)
            ):
                motion[0, sample], motion[1, sample] = 0.0, 0.0
                sample += 1
            if uplift == math.inf:
                result = RESTS if has_moved else NO_UPLIFT
                return History(max(time, forcing_end), result, peak, counted, landed)
            time, moves, has_moved, is_low, flight_start = uplift, True, True, True, uplift
            _, _, weight, change = ground(forcing, time)
            state = State(time, side, 0.0, 0.0, 0.0, 1.0, push, rate, weight, change)
            zeros = 2 if push > 0.0 else 3
            piece = piece_of(forcing, time) if is_record else 0
        is_far = block.linearised and is_over and state.rotation >= math.pi / 2
        is_endless = until == math.inf and not is_forced
        is_poised = is_endless and time - flight_start >= MAX_FREE_FLIGHT
        is_restless = is_endless and (
            landed - landed_forced >= MAX_FREE_IMPACTS or flights >= 2 * MAX_FREE_IMPACTS
        )
        if time >= until or is_far or is_poised or is_restless:
            return History(time, OVERTURNED if is_over else ROCKING, peak, counted, landed)

        piece_end = min(until, flight_start + MAX_FREE_FLIGHT) if is_endless else until
        if is_forced:
            piece_end = forcing_end
            if is_record:
                piece_end = min(piece_end, piece_start(forcing, piece + 1))
        start, longest, flight_peak = state, piece_end - time, 0.0 if is_low else peak
        step, event, flight_peak = advance(
            w, method, block, forcing, start, zeros, longest, flight_peak
        )
        state, zeros = evaluate(w, method, block, start, step), 0
        if not is_forced and _leaves_wrongly(block, state, event, is_over, landings_due - flights):
            return History(time, OVERTURNED if is_over else ROCKING, peak, counted, landed)
        peak = max(peak, flight_peak)
        is_low = is_low and flight_peak <= lowest
        time = piece_end if step >= longest else state.time
        while sample < times.size and times[sample] <= time:
            sampled = evaluate(w, method, block, start, times[sample] - start.time)
            motion[0, sample], motion[1, sample] = side * sampled.rotation, side * sampled.velocity
            sample += 1
        if sample < times.size and times[sample] == math.inf:
            motion[0, sample], motion[1, sample] = side * state.rotation, side * state.velocity
        if is_ricker:  # over its many steps, the terms that its series leaves out would add up
            state = with_ground(block, state, time, ground(forcing, time))
        else:
            state = at_time(state, time)
        if event == FLAT:
            return History(time, OVERTURNED, peak, counted, landed)
        if event == LANDING or state.rotation <= 0.0:
            if not is_low:
                if landed < impacts.size:
                    impacts[landed] = time
                landed += 1
                counted += 1 if is_forced else 0
                block = at_impact(original, ratios, landed)
            is_low, flight_start = True, time
            state, zeros = after_impact(block, state), 1
            if not is_forced:
                flights += 1
                bounce = free_rocking(block, 0.0, state.velocity)
                moves = is_over or bounce.peak > MIN_COUNTED_PEAK * block.slenderness
            elif time < forcing_end:
                moves = not comes_to_rest(block, forcing, state, peak)
                state = state if moves else at_time(state, next_tick(time))
        elif is_forced and (block.linearised or is_judged) and not is_over:
            is_over = is_certain_to_overturn(block, forcing, state)
            if is_over and is_judged:
                return History(time, OVERTURNED, peak, counted, landed)
        if is_record and state.time >= piece_end:
            piece += 1
            if moves and state.time < forcing_end:
                state = with_ground(block, state, state.time, ground_of_piece(forcing, piece))
                if is_judged and not (is_low or block.linearised):
                    piece, state, peak = march(block, forcing, state, piece, method.tolerance, peak)
    return History(state.time, UNRESOLVED, peak, counted, landed)


@compiled
def _leaves_wrongly(block, state, event, is_over, landings_left):
    """Return whether a free step leads away from φ = α to the other side than was judged.

    A block that overturns moves outward for good once it has landed as often as it was to. Any
    other free motion passes α only inward.
    """
    if is_over and landings_left <= 0:
        falls_back = (
            state.velocity < 0.0 and state.rotation < (1 - POISED_ROTATION) * block.slenderness
        )
        return falls_back or event == LANDING
    escapes = state.velocity > 0.0 and state.rotation > (1 + POISED_ROTATION) * block.slenderness
    return escapes or event == FLAT


@compiled
def _initial_state(block, forcing, course):
    rotation, velocity, _ = course
    phi, side = abs(rotation), math.copysign(1.0, rotation if rotation != 0.0 else velocity)
    sine, cosine = (0.0, 1.0) if block.linearised else (math.sin(phi), math.cos(phi))
    state = State(0.0, side, phi, side * velocity, sine, cosine, 0.0, 0.0, 1.0, 0.0)
    return with_ground(block, state, 0.0, ground(forcing, 0.0))


@compiled
def at_time(state, time):
    """Return the state at another time."""
    _, side, rotation, velocity, sine, cosine, push, rate, gravity, change = state
    return State(time, side, rotation, velocity, sine, cosine, push, rate, gravity, change)


@compiled
def _at_rest(forcing):
    """Return the forcing of ground that is at rest from its end on."""
    return Forcing(NONE, 0.0, 1.0, forcing.end, 1.0, 0.0, forcing.record)


@compiled
def is_straight(wave):
    """Return whether a and G are straight lines over each step."""
    return wave in (RECORD, CONSTANT, NONE)
