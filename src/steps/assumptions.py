"""What the paper leaves open, chosen otherwise: which numbers and which verdicts would change?

Each alternative of paper/assumptions.yaml replaces one of our choices, and every quantity that it
reaches is computed anew, at the library's tolerance and once more at the tightened one. A quantity
with a claim is judged as the ledger judges it, though from fewer pulses than the rule of the claim.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import cache
from itertools import combinations, pairwise
from pathlib import Path
from typing import Any, NamedTuple, TypeAlias

import numpy as np
import yaml
from choices import (
    Choices,
    beyond_after,
    beyond_slenderness,
    by_energy,
    curved,
    flat_after,
    flights,
    from_uplift,
    held,
    ramped,
    section_factors,
    settled,
    solitary_restitution,
)
from workbench import grid, log_to, truth, value, write_table

from topheavy import Column, Pulse, RockingFrame, judge, overturning_map, read_record, simulate
from topheavy.claims import judge as judge_claim
from topheavy.shaking_table import abrupt_start, table_acceleration, table_motion
from topheavy.structures import STANDARD_GRAVITY

EPS = 1e-14
STEP = 0.05  # of g tan α: of the amplitudes among which the lowest is sought
FINER = 0.001  # of g tan α: the same on the map, where a band may be narrow
HALVINGS = 14  # of STEP
APART = 1e-4  # of an amplitude: what is closer is not told apart
ALIKE = 1e-3  # of α: histories that are this close are called identical

Cases: TypeAlias = dict[str, Any]
"""The sections of the config, by name, and the records."""


class Found(NamedTuple):
    """A quantity's number, and the finding by which its claim is judged."""

    number: float
    finding: dict[str, Any]


def alternatives(case: Cases) -> dict[str, dict[str, Choices]]:
    """Return every alternative, by its assumption and its own name in paper/assumptions.yaml."""
    g, root, ramp, rest = (case[name] for name in ("gravity", "restitution", "ramp", "rest"))
    section, masses, wait = case["section"], case["masses"], case["wait"]
    return {
        "gravity": {
            "standard": Choices(gravity=g["standard"]),
            "ten": Choices(gravity=g["ten"]),
        },
        "restitution": {
            "fixed": Choices(restitution=lambda structure: root["fixed"]),
            "solitary": Choices(restitution=solitary_restitution),
            "lower": Choices(restitution=lambda s: root["lower"] * s.restitution),
            "higher": Choices(restitution=lambda s: min(1.0, root["higher"] * s.restitution)),
        },
        "pulse_start": {
            "quick_ramp": Choices(shaking=ramped(ramp["quick"])),
            "slow_ramp": Choices(shaking=ramped(ramp["slow"])),
            "from_uplift": Choices(shaking=from_uplift),
        },
        "table_start": {
            "smooth": Choices(table_starts=(0.0,)),
            "abrupt": Choices(table_starts=(1.0,)),
        },
        "rest": {
            "early": Choices(rest=rest["early"], overturned=settled(rest["early"])),
            "coarse": Choices(rest=rest["coarse"], overturned=settled(rest["coarse"])),
        },
        "end": {
            "flat_at_once": Choices(overturned=flat_after(0.0)),
            "flat_in_time": Choices(overturned=flat_after(wait["short"])),
            "flat_at_last": Choices(overturned=flat_after(wait["long"])),
            "beyond_at_once": Choices(overturned=beyond_after(0.0)),
        },
        "overturning": {"beyond": Choices(overturned=beyond_slenderness)},
        "masses": {
            name: Choices(masses=(masses[name]["cap"], masses[name]["columns"])) for name in masses
        },
        "counted_impacts": {
            "small": Choices(counted=case["counted"]["small"]),
            "large": Choices(counted=case["counted"]["large"]),
        },
        "equation": {"linearised": Choices(linearised=True)},
        "section": {name: Choices(section=section[name]) for name in section},
        "record": {"held": Choices(resampled=held), "curved": Choices(resampled=curved)},
        "allen_impact": {
            "exact_frames": Choices(massless_restitution=lambda frame: frame.restitution),
            "housners": Choices(massless_restitution=solitary_restitution),
        },
        "digits": {"carried": Choices(carried=True)},
        "stable": {"pulse_by_pulse": Choices(sense="pulse"), "lowest": Choices(sense="lowest")},
    }


# The trilith -------------------------------------------------------------------------------------


def trilith(choices: Choices, cases: Cases) -> RockingFrame:
    case = cases["trilith"]
    gamma = case["mass_ratio"]
    if choices.masses is not None:
        cap, columns = choices.masses
        gamma = cap / columns
    return RockingFrame(Column(**case["column"]), gamma)


def table_level(choices: Choices, cases: Cases) -> float:
    """The table's peak acceleration, in the g that is chosen."""
    if choices.carried:
        return 2.15 / STANDARD_GRAVITY  # p. 4
    case = cases["trilith"]
    level = table_acceleration(case["table_amplitude"], case["table_frequency"])
    return level * STANDARD_GRAVITY / choices.gravity


def exact(number: float) -> Found:
    return Found(number, value(number, EPS))


def column_frequency(choices: Choices, cases: Cases) -> Found:
    if choices.carried:
        return exact(math.sqrt(3.0 * STANDARD_GRAVITY / (4.0 * 0.415)))  # p. 4
    return exact(choices.block(trilith(choices, cases).column).frequency_parameter)


def frequency_ratio(choices: Choices, cases: Cases) -> Found:
    frame = trilith(choices, cases)
    p, p_hat = (choices.block(item).frequency_parameter for item in (frame.column, frame))
    return exact(p_hat / p)


def frame_frequency(choices: Choices, cases: Cases) -> Found:
    if choices.carried:
        return exact(0.9 * 4.21)  # p. 4
    return exact(choices.block(trilith(choices, cases)).frequency_parameter)


def base_acceleration(choices: Choices, cases: Cases) -> Found:
    return exact(table_level(choices, cases))


def uplift_acceleration(choices: Choices, cases: Cases) -> Found:
    if choices.carried:
        return exact(math.tan(math.radians(15.38)))  # p. 4
    return exact(choices.block(trilith(choices, cases)).uplift_acceleration)


def stays_below_uplift(choices: Choices, cases: Cases) -> Found:
    share = table_level(choices, cases) / uplift_acceleration(choices, cases).number
    return Found(share, truth(share < 1.0))


def mass_ratio(choices: Choices, cases: Cases) -> Found:
    cap, columns = choices.masses or cases["trilith"]["printed_masses"]
    meant = cases["trilith"]["mass_ratio"]
    return Found(cap / columns, value(cap / columns, EPS, meant_value=meant))


def no_pure_rocking(choices: Choices, cases: Cases) -> Found:
    """The steady rotation over α after the most abrupt of the starts, and whether each rests."""
    case, frame = cases["trilith"], trilith(choices, cases)
    u, f, duration = case["table_amplitude"], case["table_frequency"], case["duration"]
    block = choices.block(frame)
    # In the chosen g the same motion of the table has another acceleration; p̂² takes g along.
    motion = table_motion(u, f).scaled(STANDARD_GRAVITY / choices.gravity)
    full = abrupt_start(block, u, f) * STANDARD_GRAVITY / choices.gravity
    steady, rests = 0.0, {}
    for share in choices.table_starts:
        response = simulate(
            block,
            motion,
            velocity=share * full,
            duration=duration,
            samples=2401,
            tolerance=choices.tolerance,
        )
        late = np.abs(response.rotation[response.time > 0.75 * duration]).max() / block.slenderness
        rests[share] = response.outcome in ("no uplift", "rests") or late < choices.rest
        steady = max(steady, float(late))
    smoothly = rests.get(0.0, False)
    return Found(steady, truth(all(rests.values()), holds_when=smoothly))


# One pulse ---------------------------------------------------------------------------------------


def a_pulse(case: Cases) -> Pulse:
    spec = case["pulse"]
    return Pulse(spec["shape"], spec["amplitude"], 2.0 * math.pi / spec["period"])


def lowest(choices: Choices, structure: Column | RockingFrame, pulse: Pulse, most: float) -> float:
    """Return the lowest factor on a pulse of 1 g tan α that overturns, or infinity up to `most`.

    Found on a grid, so that narrower bands than its step are missed, and halved.
    """

    def falls(factor: float) -> bool:
        return choices.falls(structure, pulse.scaled(factor))

    factors = np.arange(0.95, most, STEP)
    first = next((float(factor) for factor in factors if falls(factor)), math.inf)
    if first == math.inf:
        return first
    low, high = first - STEP, first
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if falls(middle) else (middle, high)
    return high


def heavier_survives_more(choices: Choices, cases: Cases) -> Found:
    case = cases["heavier"]
    column = Column(**case["column"])
    pulse = replace(a_pulse(case), amplitude=column.uplift_acceleration)
    frames = [RockingFrame(column, gamma) for gamma in case["mass_ratios"]]
    found = [lowest(choices, frame, pulse, 12.0) for frame in frames]
    rise = found[-1] / found[0] - 1.0
    return Found(rise, truth(all(low < high for low, high in pairwise(found))))


def column_falls(choices: Choices, cases: Cases) -> Found:
    case = cases["heavier"]
    column, pulse = Column(**case["column"]), a_pulse(case)
    found = lowest(choices, column, replace(pulse, amplitude=column.uplift_acceleration), 12.0)
    lowest_g = found * column.uplift_acceleration
    return Found(lowest_g, truth(choices.falls(column, pulse)))


def heaviest_stands(choices: Choices, cases: Cases) -> Found:
    case = cases["heavier"]
    frame, pulse = RockingFrame(Column(**case["column"]), case["mass_ratios"][-1]), a_pulse(case)
    ending = judge(choices.block(frame), choices.motion(frame, pulse), tolerance=choices.tolerance)
    return Found(ending.peak / frame.slenderness, truth(not choices.falls(frame, pulse)))


def _scale_effect(choices: Choices, cases: Cases, larger: bool) -> Found:
    case = cases["scale_effects"]
    b, h = case["column"]["half_width"], case["column"]["half_height"]
    small, short = Column(b, h), a_pulse(case)
    long = replace(short, angular_frequency=short.angular_frequency / case["longer"])
    survivor = Column(case["larger"] * b, case["larger"] * h) if larger else small
    pulse = long if larger else short
    block, motion = choices.block(survivor), choices.motion(survivor, pulse)
    peak = judge(block, motion, tolerance=choices.tolerance).peak / block.slenderness
    holds = choices.falls(small, long) and not choices.falls(survivor, pulse)
    return Found(peak, truth(holds))


def size_effect(choices: Choices, cases: Cases) -> Found:
    return _scale_effect(choices, cases, larger=True)


def duration_effect(choices: Choices, cases: Cases) -> Found:
    return _scale_effect(choices, cases, larger=False)


# Many pulses -------------------------------------------------------------------------------------

Trial: TypeAlias = tuple[Column | RockingFrame, float]
"""A structure, and the frequency of the pulse that shakes it, over p of the column."""


@cache
def overturned(
    choices: Choices, column: Column, shape: str, amplitudes: tuple[float, ...], trial: Trial
) -> np.ndarray:
    """Which amplitudes (over g tan α) of a pulse overturn a trial."""
    structure, ratio = trial
    # p in the chosen g, so that ω/p is what it is said to be
    pulse = Pulse(
        shape, column.uplift_acceleration, ratio * choices.block(column).frequency_parameter
    )
    return np.array([choices.falls(structure, pulse.scaled(factor)) for factor in amplitudes])


def ranking(choices: Choices, cases: Cases, order: list[list[Trial]]) -> Found:
    """Count the amplitudes at which the trial that should be the more stable falls alone."""
    case = cases["stability"]
    column, amplitudes = Column(**case["column"]), tuple(map(float, grid(case["amplitudes"])))

    # The sense is a matter of reading the scan, not of making it.
    made = replace(choices, sense="both")

    def over(trial: Trial) -> np.ndarray:
        return overturned(made, column, case["shape"], amplitudes, trial)

    def first(trial: Trial) -> float:
        return amplitudes[int(over(trial).argmax())] if over(trial).any() else math.inf

    against = sum(
        int((over(stronger) & ~over(weaker)).sum())
        for trials in order
        for weaker, stronger in combinations(trials, 2)
    )
    rises = all(first(a) <= first(b) for trials in order for a, b in pairwise(trials))
    every = against == 0
    finding = {
        "both": truth(every, holds_when=rises),
        "pulse": truth(every),
        "lowest": truth(rises),
    }[choices.sense]
    return Found(against, finding)


def _scan(cases: Cases) -> tuple[Column, list[RockingFrame], list[float]]:
    case = cases["stability"]
    column = Column(**case["column"])
    frames = [RockingFrame(column, gamma) for gamma in case["mass_ratios"]]
    return column, frames, case["frequency_ratios"]


def heavier_is_more_stable(choices: Choices, cases: Cases) -> Found:
    _, frames, ratios = _scan(cases)
    return ranking(choices, cases, [[(frame, ratio) for frame in frames] for ratio in ratios])


def frame_is_more_stable(choices: Choices, cases: Cases) -> Found:
    column, frames, ratios = _scan(cases)
    order = [[(column, ratio), (frame, ratio)] for ratio in ratios for frame in frames]
    return ranking(choices, cases, order)


def larger_is_more_stable(choices: Choices, cases: Cases) -> Found:
    column, _, ratios = _scan(cases)
    b, h = column.half_width, column.half_height
    columns = [Column(scale * b, scale * h) for scale in cases["stability"]["sizes"]]
    return ranking(choices, cases, [[(item, ratio) for item in columns] for ratio in ratios])


def longer_is_more_dangerous(choices: Choices, cases: Cases) -> Found:
    column, _, ratios = _scan(cases)
    return ranking(choices, cases, [[(column, ratio) for ratio in ratios]])


def lowest_rises(choices: Choices, cases: Cases) -> Found:
    """Count the steps of γ over which the lowest amplitude that overturns falls."""
    case = cases["assumptions"]["spectra"]
    column = Column(**cases["stability"]["column"])
    p = choices.block(column).frequency_parameter
    frames = [RockingFrame(column, gamma) for gamma in case["mass_ratios"]]
    exceptions = 0
    for shape in case["shapes"]:
        for ratio in case["frequency_ratios"]:
            pulse = Pulse(shape, column.uplift_acceleration, ratio * p)
            found = [lowest(choices, frame, pulse, case["most"]) for frame in frames]
            exceptions += sum(high < low * (1.0 - APART) for low, high in pairwise(found))
    return Found(exceptions, truth(exceptions == 0))


def heavier_falls_alone_on_the_map(choices: Choices, cases: Cases) -> Found:
    """Count the pulses of a dense map at which the heavier of two neighbouring frames falls alone.

    The map knows two criteria; the pulses that it finds are judged again, one by one.
    """
    case = cases["assumptions"]["map"]
    beyond = choices.overturned is beyond_slenderness
    if not beyond and choices.overturned is not by_energy:
        raise ValueError(f"{choices.overturned} is no criterion of a map")
    column = Column(**cases["stability"]["column"])
    p, level = column.frequency_parameter, column.uplift_acceleration
    omegas, amplitudes = grid(case["frequency_ratios"]) * p, grid(case["amplitudes"]) * level
    frames = [RockingFrame(column, gamma) for gamma in case["mass_ratios"]]
    count, rises = 0, True
    for shape in case["shapes"]:
        maps = [overturning_map(choices.block(f), shape, omegas, amplitudes) for f in frames]
        falls = [found.overturned.values for found in maps]
        if beyond:
            limit = column.slenderness
            falls = [
                over | (found.peak_rotation.values > limit)
                for over, found in zip(falls, maps, strict=True)
            ]
        for number, (light, heavy) in enumerate(pairwise(falls)):
            for i, j in np.argwhere(heavy & ~light):
                pulse = Pulse(shape, amplitudes[j], omegas[i])
                alone = choices.falls(frames[number + 1], pulse)
                count += alone and not choices.falls(frames[number], pulse)
            falling = (
                heavy.any(axis=1)
                & ~np.logical_or.accumulate(light, axis=1)[
                    np.arange(len(omegas)), heavy.argmax(axis=1)
                ]
            )
            for i in np.flatnonzero(falling):  # so it seems: bands near uplift are narrow
                finer = np.arange(
                    case["amplitudes"]["lowest"] * level,
                    amplitudes[heavy[i].argmax()],
                    FINER * level,
                )
                pulse = Pulse(shape, 1.0, omegas[i])
                rises &= any(choices.falls(frames[number], pulse.scaled(a)) for a in finer)
    return Found(count, truth(count == 0, holds_when=rises))


def told_with_impact(choices: Choices, cases: Cases) -> Found:
    """The share of overturning pulses that are told to overturn after an impact."""
    column, frames, ratios = _scan(cases)
    case = cases["stability"]
    level, p = column.uplift_acceleration, column.frequency_parameter
    overturning = after_impact = 0
    for frame in frames:
        for ratio in ratios:
            for factor in grid(case["amplitudes"]):
                block, pulse = frame.block(), Pulse(case["shape"], factor * level, ratio * p)
                ending = judge(block, pulse, tolerance=choices.tolerance)
                if not ending.overturned:
                    continue
                overturning += 1
                count = ending.impacts
                if count and choices.counted:
                    peaks = flights(block, pulse, choices.tolerance)
                    count -= sum(peak < choices.counted for _, peak in peaks)
                after_impact += count > 0
    share = after_impact / overturning
    return Found(share, truth(0.0 < share < 1.0))


# The impact, the history -------------------------------------------------------------------------


def restitution_is_smaller(choices: Choices, cases: Cases) -> Found:
    """The least deficit of √r of the frame against that of its column."""
    pairs = list(_restitutions(choices, cases))
    least = min(column - frame for column, frame in pairs)
    return Found(least, truth(least > 0.0))


def more_energy_is_dissipated(choices: Choices, cases: Cases) -> Found:
    """The number of frames that lose no more than their column; a condition is that both rock."""
    pairs = list(_restitutions(choices, cases))
    against = [pair for pair in pairs if not pair[1] ** 2 < pair[0] ** 2]
    rocking = [pair for pair in against if min(pair) >= 0.0]
    return Found(len(against), truth(not against, holds_when=not rocking))


def _restitutions(choices: Choices, cases: Cases) -> Iterator[tuple[float, float]]:
    """√r of column and frame, over slenderness and γ > 0."""
    case = cases["restitution"]
    for degrees in np.linspace(1.0, case["largest_slenderness"], 60):
        alpha = math.radians(degrees)
        column = Column(math.sin(alpha), math.cos(alpha))
        for gamma in case["mass_ratios"]:
            if gamma > 0.0:
                yield tuple(
                    _restitution(choices, item) for item in (column, RockingFrame(column, gamma))
                )


def _restitution(choices: Choices, structure: Column | RockingFrame) -> float:
    """√r as a formula gives it, negative for stocky columns, of which no block is made."""
    if choices.section is not None:
        return section_factors(structure, choices.section)[1]
    return choices.restitution(structure)


def identical_response(choices: Choices, cases: Cases) -> Found:
    """How far the frame is from the equivalent column with that column's own √r, over α.

    The equivalent column has the size that gives it the frame's p̂: of Eq. (24) for rectangles.
    """
    case = cases["statements"]
    frame, pulse = RockingFrame(Column(**case["column"]), case["mass_ratio"]), a_pulse(case)
    block, alone = choices.block(frame), choices.block(frame.column)
    scale = (alone.frequency_parameter / block.frequency_parameter) ** 2
    equivalent = choices.block(
        Column(scale * frame.column.half_width, scale * frame.column.half_height)
    )
    times = np.linspace(0.0, 6.0, 601)

    def apart(other) -> float:
        histories = [
            simulate(
                item,
                choices.motion(frame, pulse),
                samples=times,
                tolerance=choices.tolerance,
            ).rotation
            for item in (block, other)
        ]
        return float(np.nanmax(np.abs(histories[0] - histories[1]))) / block.slenderness

    own = apart(equivalent)
    given = apart(equivalent.with_restitution(block.restitution))
    return Found(own, truth(own < ALIKE, holds_when=given < ALIKE))


# Allen et al., records ---------------------------------------------------------------------------


def allen_error(choices: Choices, cases: Cases) -> Found:
    """The median error of their model's peak; is p̂ of massless columns the leading part of it?"""
    case = cases["allen_errors"]
    errors: dict[str, list[float]] = {"linear": [], "frequency": [], "impact": [], "all": []}
    for degrees in grid(case["slendernesses"]):
        alpha = math.radians(degrees)
        column = Column(math.sin(alpha), math.cos(alpha))
        omega = case["frequency_ratio"] * choices.block(column).frequency_parameter
        for gamma in case["mass_ratios"]:
            frame = RockingFrame(column, gamma)
            whole, limit = choices.block(frame), choices.block(RockingFrame(column, math.inf))
            root = choices.massless_restitution
            massless = limit.restitution if root is None else root(frame)
            models = {
                "linear": whole.linear(),
                "frequency": limit.with_restitution(whole.restitution),
                "impact": whole.with_restitution(massless),
                "all": limit.with_restitution(massless).linear(),
            }
            for ratio in grid(case["amplitudes"]):
                pulse = Pulse(case["shape"], ratio * column.uplift_acceleration, omega)
                peak = judge(whole, pulse, tolerance=choices.tolerance).peak
                for name, model in models.items():
                    other = judge(model, pulse, tolerance=choices.tolerance).peak
                    errors[name].append(other / peak - 1.0)
    median = {name: float(np.nanmedian(np.abs(found))) for name, found in errors.items()}
    leads = median["frequency"] > max(median["linear"], median["impact"])
    return Found(median["all"], truth(leads))


def heavier_falls_alone(choices: Choices, cases: Cases) -> Found:
    """The number of sizes and records under which the frame falls and the lighter one stands."""
    case = cases["rocking_spectra"]
    similar, spec = Column(**case["column"]), cases["assumptions"]["record_sizes"]
    count = 0
    for record in map(choices.resampled, cases["records"]):
        for size in np.geomspace(spec["lowest"], spec["highest"], spec["points"]):
            scale = size / similar.size
            column = Column(scale * similar.half_width, scale * similar.half_height)
            falls = [
                judge(RockingFrame(column, g), record, tolerance=choices.tolerance).overturned
                for g in case["mass_ratios"]
            ]
            count += sum(heavy and not light for light, heavy in pairwise(falls))
    return Found(count, truth(count == 0))


# All of them -------------------------------------------------------------------------------------


class Quantity(NamedTuple):
    """What an assumption may reach: its claim in the ledger if it has one, its unit, its maker."""

    claim: str | None
    unit: str
    find: Callable[[Choices, Cases], Found]


QUANTITIES = {
    "trilith: p": Quantity("trilith_frequency_parameter", "rad/s", column_frequency),
    "trilith: p̂/p": Quantity("trilith_frequency_ratio", "", frequency_ratio),
    "trilith: p̂": Quantity("trilith_frame_frequency_parameter", "rad/s", frame_frequency),
    "trilith: γ": Quantity("trilith_mass_ratio", "", mass_ratio),
    "trilith: base acceleration": Quantity(
        "trilith_base_acceleration_in_g", "g", base_acceleration
    ),
    "trilith: uplift": Quantity("trilith_uplift_acceleration", "g", uplift_acceleration),
    "trilith: below uplift": Quantity(
        "trilith_stays_below_uplift", "of uplift", stays_below_uplift
    ),
    "trilith: steady rocking": Quantity("trilith_no_pure_rocking", "α", no_pure_rocking),
    "one pulse: gain of the heaviest": Quantity(
        "one_pulse_heavier_survives_more", "", heavier_survives_more
    ),
    "one pulse: lowest of the column": Quantity("fig1_structures", "g", column_falls),
    "one pulse: peak of the heaviest": Quantity("fig1_heaviest_frame", "α", heaviest_stands),
    "size effect: peak of the larger": Quantity("size_effect", "α", size_effect),
    "duration effect: peak": Quantity("duration_effect_by_example", "α", duration_effect),
    "heavier falls alone": Quantity("heavier_is_more_stable", "pulses", heavier_is_more_stable),
    "frame falls alone": Quantity(
        "frame_is_more_stable_than_its_column", "pulses", frame_is_more_stable
    ),
    "larger falls alone": Quantity("larger_is_more_stable", "pulses", larger_is_more_stable),
    "shorter overturns alone": Quantity("duration_effect", "pulses", longer_is_more_dangerous),
    "map: heavier falls alone": Quantity(
        "heavier_is_more_stable", "pulses", heavier_falls_alone_on_the_map
    ),
    "lowest amplitude falls with γ": Quantity(
        "lowest_amplitude_rises_with_mass", "cases", lowest_rises
    ),
    "least deficit of √r": Quantity("restitution_is_smaller", "", restitution_is_smaller),
    "frames that lose no more": Quantity(
        "more_energy_is_dissipated", "cases", more_energy_is_dissipated
    ),
    "frame and equivalent column": Quantity("identical_response", "α", identical_response),
    "Allen et al.: median error": Quantity(None, "of the peak", allen_error),
    "told to fall after an impact": Quantity(None, "of pulses", told_with_impact),
    "records: heavier falls alone": Quantity(None, "cases", heavier_falls_alone),
}


def verdict(name: str, found: Found, ledger: dict[str, dict]) -> str:
    """Judge a quantity as the ledger judges its claim."""
    claim = QUANTITIES[name].claim
    return judge_claim(ledger[claim] if claim else {"id": name}, found.finding)


def looked_at_again(choices: Choices, tightened: float) -> Choices:
    """Return the same choices under a tightened tolerance, with pulses sampled twice as finely."""
    return replace(choices, tolerance=tightened, samples=2 * choices.samples - 1)


def main(assumptions: list[dict], ledger: dict[str, dict], cases: Cases, tightened: float):
    """Return the rows of the table: each quantity, ours and by each alternative that reaches it."""

    @cache
    def found(name: str, choices: Choices) -> tuple[Found, float, str]:
        first, again = (
            QUANTITIES[name].find(option, cases)
            for option in (choices, looked_at_again(choices, tightened))
        )
        if verdict(name, first, ledger) != verdict(name, again, ledger):
            raise ArithmeticError(f"{name}, {choices}: the verdict hangs on the tolerance")
        nothing = math.isnan(first.number) and math.isnan(again.number)
        error = 0.0 if nothing else abs(first.number - again.number)
        return first, error, verdict(name, first, ledger)

    rows = []
    made = alternatives(cases["assumptions"])
    for assumption in assumptions:
        for alternative in assumption["alternatives"]:
            choices = made[assumption["id"]][alternative["id"]]
            for name in assumption["reaches"]:
                quantity = QUANTITIES[name]
                ours, error, before = found(name, Choices())
                other, other_error, after = found(name, choices)
                claim = ledger.get(quantity.claim or "", {})
                if claim and before != claim["expected"]:
                    raise ArithmeticError(
                        f"{name}: {before}, and {claim['expected']} in the ledger"
                    )
                rows.append(
                    {
                        "assumption": assumption["id"],
                        "alternative": alternative["id"],
                        "quantity": name,
                        "claim": quantity.claim or "",
                        "unit": quantity.unit,
                        "ours": ours.number,
                        "with_alternative": other.number,
                        "error": max(error, other_error),
                        "tolerance": claim.get("tolerance", math.nan),
                        "before": before,
                        "after": after,
                        "changed": before != after,
                    }
                )
                print(*rows[-1].values(), sep="; ", flush=True)
    return rows


if __name__ == "__main__":
    with log_to(snakemake.log[0]):
        assumptions, claims = (
            yaml.safe_load(Path(path).read_text(encoding="utf-8"))
            for path in (snakemake.input.assumptions, snakemake.input.ledger)
        )
        cases = dict(snakemake.params.cases)
        cases["records"] = [read_record(path) for path in snakemake.input.records]
        rows = main(
            assumptions,
            {claim["id"]: claim for claim in claims},
            cases,
            snakemake.params.solver["tightened"],
        )
        write_table(snakemake.output.table, rows)
