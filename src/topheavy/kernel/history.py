"""One rocking history by Taylor steps: `judge` returns its outcome, `sample` also fills samples.

`next_event` is the step of both. A history that is judged ends with the forcing, or where the block
is sure to overturn: its energy then decides what follows (`bodies.free_rocking`). One with samples
goes on, so that it can be drawn. Its free rocking has the same outcome, unless this energy equals
that of the barrier within its error. Then the block is poised at φ = α and could leave it to the
wrong side; the history ends there.
"""

import math
import sys
from typing import NamedTuple

from topheavy.bodies.free_rocking import outcome_of_energy
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
from topheavy.kernel.quiet_pieces import skip_quiet_pieces
from topheavy.kernel.rest import MIN_COUNTED_PEAK, comes_to_rest, next_tick
from topheavy.kernel.step import (
    FLAT,
    HALT,
    LANDING,
    MAX_STEPS,
    NOTHING,
    PULSE_ORDER,
    advance,
    after_impact,
    is_certain_to_overturn,
    is_certain_to_survive,
    with_ground,
)
from topheavy.kernel.taylor import IMPACTS, OUTCOME, Method, State, evaluate

NO_UPLIFT, RESTS, ROCKING, OVERTURNED, UNRESOLVED = range(5)
#: The event of a step that ends with a piece of a record, beside those of `step`.
PIECE_END = FLAT + 1
#: A history with samples that takes more steps than this (and ten a sample of the record) is given
#: up as `UNRESOLVED`, under the forcing or in free rocking. A free flight takes fewer than ten, as
#: the motion is a pendulum's, whose series converge over π/2 or more. There are at most twice
#: `MAX_FREE_IMPACTS` flights or, in a history with an end of its own, as many as
#: `Samples.impact_times` has room for.
MAX_STEPS_WITH_SAMPLES = 5 * MAX_STEPS
#: A free history without an end of its own ends after so many impacts.
MAX_FREE_IMPACTS = 1000
#: Without an end of its own, a flight longer than this (in τ) is that of a block poised at α.
MAX_FREE_FLIGHT = 100.0
#: Normalised by α: a block this far from φ = α, and going on, has left.
POISED_ROTATION = 1e-3

#: The largest time that is not infinite.
MAX_TIME = sys.float_info.max

free_rocking = compiled(outcome_of_energy)


class Samples(NamedTuple):
    """Arrays that a history fills."""

    times: Array  # ascending τ; the last may be infinite: the end
    motion: Array  # shape (2, times.size): θ and dθ/dτ, left as it was beyond an end without rest
    impact_times: Array


class History(NamedTuple):
    """How a history ended. Impacts after a rotation below `rest.MIN_COUNTED_PEAK` do not count."""

    end: float
    result: int
    """`NO_UPLIFT`, `RESTS`, `ROCKING` or `OVERTURNED`, as the whole motion ends; `UNRESOLVED` if it
    takes too many steps, or more impacts than `Samples.impact_times` has room for."""
    peak: float  # the largest |θ| of the whole motion
    impacts: int  # until the forcing ended or the block was judged overturned
    all_impacts: int  # how many `Samples.impact_times` holds


class RockingState(NamedTuple):
    """The motion of a block so far."""

    state: State
    zero_order: int  # how many of φ, φ', φ'' are zero; see `step.advance`
    piece: int  # of the record
    rocks: bool  # off the ground, or has just landed and does not come to rest
    is_low: bool  # the flight is below `rest.MIN_COUNTED_PEAK` α so far
    has_rocked: bool
    peak: float  # the largest φ
    impacts: int  # those that count


@compiled(inline="always")
def judge(w, method, block, forcing):
    """Follow a block from rest until its outcome is known and return its `History`."""
    state = State(0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0)
    least_peak = block.flat if method.detail == OUTCOME else 0.0  # no lower one is looked for
    motion = RockingState(state, 0, 0, False, True, False, least_peak, 0)
    for _ in range(MAX_STEPS + 10 * forcing.record.shape[1]):
        if w[HALT, 0] != 0.0:
            break
        if not motion.rocks:
            motion = lift_off(block, forcing, motion)
            if not motion.rocks:
                result = RESTS if motion.has_rocked else NO_UPLIFT
                return History(forcing.end, result, motion.peak, motion.impacts, motion.impacts)
        if method.detail != IMPACTS and is_certain_to_survive(
            block, forcing, motion.state, motion.piece, motion.peak
        ):
            return History(forcing.end, ROCKING, motion.peak, motion.impacts, motion.impacts)
        motion, event = next_event(w, method, block, forcing, motion, forcing.end)
        if event == PIECE_END and not (motion.is_low or block.linearised):
            motion = _march(w, method, block, forcing, motion)
        state, peak, impacts = motion.state, motion.peak, motion.impacts
        if event == FLAT or is_certain_to_overturn(block, forcing, state):
            return History(state.time, OVERTURNED, peak, impacts, impacts)
        if motion.rocks and state.time >= forcing.end:
            tail = free_rocking(block, state.rotation, state.velocity)
            result = OVERTURNED if tail.overturned else ROCKING
            peak = peak if tail.overturned else max(peak, tail.peak_rotation)
            return History(state.time, result, peak, impacts + tail.number_of_impacts, impacts)
    return History(motion.state.time, UNRESOLVED, motion.peak, motion.impacts, motion.impacts)


@compiled(nogil=True)
def sample(w, method, block, forcing, rotation, velocity, until, samples):
    """Follow a block, fill the samples and return its `History`.

    Parameters
    ----------
    rotation, velocity : float
        θ and dθ/dτ at τ = 0.
    until : float
        The τ at which it ends, not before the forcing; if infinite, where the block rests or
        |θ| = π/2, or after `MAX_FREE_IMPACTS` impacts behind the forcing. In either case it ends
        before a step by which the block leaves φ = α to the other side than its energy says.
    """
    motion, filled = _first_motion(block, forcing, rotation, velocity), 0
    for _ in range(MAX_STEPS_WITH_SAMPLES + 10 * forcing.record.shape[1]):
        if w[HALT, 0] != 0.0 or motion.impacts > samples.impact_times.size:
            break
        if motion.state.time >= forcing.end:
            return _sample_free(w, method.tolerance, block, forcing, motion, until, samples, filled)
        if not motion.rocks:
            motion = lift_off(block, forcing, motion)
            filled = _fill_rest(samples, filled, motion.state.time if motion.rocks else math.inf)
            if not motion.rocks:
                result = RESTS if motion.has_rocked else NO_UPLIFT
                return History(forcing.end, result, motion.peak, motion.impacts, motion.impacts)
        begin = motion
        motion, event = next_event(w, method, block, forcing, begin, forcing.end)
        filled = _fill(w, method, block, begin, motion, samples, filled)
        state = motion.state
        is_far = block.linearised and state.rotation >= math.pi / 2
        if event == FLAT or (is_far and is_certain_to_overturn(block, forcing, state)):
            return History(state.time, OVERTURNED, motion.peak, motion.impacts, motion.impacts)
    return History(motion.state.time, UNRESOLVED, motion.peak, motion.impacts, motion.impacts)


@compiled
def _sample_free(w, tolerance, block, forcing, motion, until, samples, filled):
    """Follow a block from the end of the forcing on, fill samples and return its `History`."""
    still = Forcing(NONE, 0.0, 1.0, forcing.end, 1.0, 0.0, forcing.record)
    method, begin, flights = Method(PULSE_ORDER, tolerance, True, IMPACTS), motion.state.time, 0
    state, forced, flight_start = motion.state, motion.impacts, begin
    if not motion.rocks:
        _fill_rest(samples, filled, math.inf if not motion.has_rocked else MAX_TIME)
        result = RESTS if motion.has_rocked else NO_UPLIFT
        return History(begin, result, motion.peak, forced, forced)
    tail = free_rocking(block, state.rotation, state.velocity)
    result = OVERTURNED if tail.overturned else ROCKING
    counted = forced + tail.number_of_impacts
    state = with_ground(block, state, begin, ground(still, begin))
    motion = RockingState(
        state, motion.zero_order, 0, True, motion.is_low, True, motion.peak, forced
    )
    for _ in range(MAX_STEPS_WITH_SAMPLES):
        before, time, landed = motion, motion.state.time, motion.impacts
        peak = motion.peak if tail.overturned else max(motion.peak, tail.peak_rotation)
        if w[HALT, 0] != 0.0 or landed > samples.impact_times.size:
            break
        is_far = block.linearised and tail.overturned and motion.state.rotation >= math.pi / 2
        is_poised = time - flight_start >= MAX_FREE_FLIGHT
        is_restless = landed - forced >= MAX_FREE_IMPACTS or flights >= 2 * MAX_FREE_IMPACTS
        if time >= until or is_far or (until == math.inf and (is_poised or is_restless)):
            return History(time, result, peak, counted, landed)
        stop = min(until, flight_start + MAX_FREE_FLIGHT) if until == math.inf else until
        motion, event = next_event(w, method, block, still, before, stop)
        if _leaves_wrongly(
            block, motion.state, event, tail.overturned, tail.number_of_impacts - flights
        ):
            return History(time, result, peak, counted, landed)
        filled = _fill(w, method, block, before, motion, samples, filled)
        if event == FLAT:
            return History(motion.state.time, OVERTURNED, peak, counted, motion.impacts)
        if event == LANDING:
            flights, flight_start = flights + 1, motion.state.time
            bounce = free_rocking(block, 0.0, motion.state.velocity)
            if not tail.overturned and bounce.peak_rotation <= MIN_COUNTED_PEAK * block.slenderness:
                _fill_rest(samples, filled, MAX_TIME)
                return History(flight_start, RESTS, peak, counted, motion.impacts)
    return History(motion.state.time, UNRESOLVED, motion.peak, counted, motion.impacts)


@compiled(inline="always")
def next_event(w, method, block, forcing, motion, until):
    """Take the next step of a block that rocks.

    Returns
    -------
    motion : RockingState
        At the end of the step, behind the impact if it ends with one.
    event : int
        `NOTHING`, `LANDING`, `FLAT` or, without any of these, `PIECE_END`.
    """
    begin, _, piece, _, is_low, _, peak, impacts = motion
    is_record, stop = forcing.wave == RECORD, until
    if is_record:
        stop = min(stop, piece_start(forcing, piece + 1))
    longest, flight_peak = stop - begin.time, 0.0 if is_low else peak
    step, event, flight_peak = advance(
        w, method, block, forcing, begin, motion.zero_order, longest, flight_peak
    )
    state = evaluate(w, method, block, begin, step)
    time = stop if step >= longest else state.time
    if forcing.wave == RICKER_SYMMETRIC or forcing.wave == RICKER_ANTISYMMETRIC:
        # over its many steps, the terms that its series leaves out would add up
        state = with_ground(block, state, time, ground(forcing, time))
    else:
        state = at_time(state, time)
    peak = max(peak, flight_peak)
    is_low = is_low and flight_peak <= MIN_COUNTED_PEAK * block.slenderness
    zero_order, rocks = 0, True
    if event == LANDING or (event == NOTHING and state.rotation <= 0.0):
        impacts += 0 if is_low else 1
        is_low = method.detail == IMPACTS or impacts == 0  # else no other count is asked for
        event, zero_order, state = LANDING, 1, after_impact(block, state)
        if time < forcing.end and comes_to_rest(block, forcing, state, method, peak):
            rocks, state = False, at_time(state, next_tick(time))
    if is_record and state.time >= stop:
        piece += 1
        if rocks and state.time < forcing.end:
            state = with_ground(block, state, state.time, ground_of_piece(forcing, piece))
            event = PIECE_END if event == NOTHING else event
    return RockingState(state, zero_order, piece, rocks, is_low, True, peak, impacts), event


@compiled
def lift_off(block, forcing, motion):
    """Return the motion at the next uplift of a block at rest; it rocks unless there is none."""
    time, push, rate, side = next_uplift(forcing, motion.state.time, block.uplift_level)
    if time >= forcing.end:
        return motion
    _, _, weight, change = ground(forcing, time)
    state = State(time, side, 0.0, 0.0, 0.0, 1.0, push, rate, weight, change)
    piece = piece_of(forcing, time) if forcing.wave == RECORD else 0
    zero_order = 2 if push > 0.0 else 3
    return RockingState(state, zero_order, piece, True, True, True, motion.peak, motion.impacts)


@compiled
def _first_motion(block, forcing, rotation, velocity):
    phi, side = abs(rotation), math.copysign(1.0, rotation if rotation != 0.0 else velocity)
    sine, cosine = (0.0, 1.0) if block.linearised else (math.sin(phi), math.cos(phi))
    state = State(0.0, side, phi, side * velocity, sine, cosine, 0.0, 0.0, 1.0, 0.0)
    state = with_ground(block, state, 0.0, ground(forcing, 0.0))
    rocks = rotation != 0.0 or velocity**2 > 0.0  # a speed without an energy is rest
    zero_order = 1 if rotation == 0.0 else 0
    return RockingState(state, zero_order, 0, rocks, rotation == 0.0, rocks, phi, 0)


@compiled
def _march(w, method, block, forcing, motion):
    """Return the motion after the pieces of a record that `skip_quiet_pieces` passes over."""
    state, piece, peak, impacts = skip_quiet_pieces(
        w, method, block, forcing, motion.state, motion.piece, motion.peak, motion.impacts
    )
    zero_order = 1 if state.rotation == 0.0 else 0
    return RockingState(state, zero_order, piece, True, False, True, peak, impacts)


@compiled
def _fill(w, method, block, begin, motion, samples, filled):
    """Fill the samples of a step from its series in `w`; return how many are filled."""
    start, time, (times, values, impact_times) = begin.state, motion.state.time, samples
    for k in range(filled, times.size):
        is_end = times[k] == math.inf
        if times[k] > time and not is_end:
            break
        state = evaluate(w, method, block, start, min(times[k], time) - start.time)
        values[0, k], values[1, k] = start.side * state.rotation, start.side * state.velocity
        filled += 0 if is_end else 1
    if begin.impacts < motion.impacts <= impact_times.size:
        impact_times[begin.impacts] = time
    return filled


@compiled
def _fill_rest(samples, filled, until):
    """Fill the samples of a block at rest up to a time; return how many are filled."""
    times, values, _ = samples
    while filled < times.size and times[filled] <= until:
        values[0, filled], values[1, filled] = 0.0, 0.0
        filled += 1
    return filled


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
def at_time(state, time):
    """Return the state at another time."""
    _, side, rotation, velocity, sine, cosine, push, rate, gravity, change = state
    return State(time, side, rotation, velocity, sine, cosine, push, rate, gravity, change)


@compiled
def is_straight(wave):
    """Return whether a and G are straight lines over each step."""
    return wave in (RECORD, CONSTANT, NONE)
