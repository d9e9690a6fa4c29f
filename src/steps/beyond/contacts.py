"""Contacts along the quoted motions: are they pressed, and how much friction do they require?

The equation of motion presumes that no contact opens or slides. A quoted minimum, fall or picture
compares structures under a motion: both have to keep their contacts up to |θ| = α, where an
overturning structure is lost. On the maps of rule spectra this is so on a part of the area.
"""

import math
from collections.abc import Iterator
from itertools import pairwise, product
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from replication.step import check, run, truth, value
from steps.shared import plain, poses
from steps.shared.cases import column_of, pulse_on
from steps.shared.cycles import SHAPE, pair_of_pulses
from topheavy import (
    Cap,
    Column,
    MonolithicPortal,
    Pulse,
    Record,
    RockingFrame,
    contact_forces,
    impact_impulses,
    simulate,
)
from topheavy.forces.contacts import Bearing, forces_at, static_shares

BESIDE = 1e-4  # over a minimum: how far above or below it the motions are
AGREE = 1e-3  # over the weight: vertical forces by the states of both solvers
AWAY = 1e-5  # of an impact, over 1/p: closer, its sides are not compared
SAMPLE = 2  # rows that the plain solver computes again
TIMES = 400  # of a cell of a map: three times as many change the shares by less than 0.01
LATER = 1.5  # over the duration of a pulse: the end of these times
SIDES = "base", "beam"
PORTAL = "portal"
TWO_PULSES = "two pulses"


class Case(NamedTuple):
    """A quoted comparison: structures by name, a motion of 1 g, and amplitudes (g)."""

    name: str
    structures: dict[str, Bearing]
    motion: Pulse | Record
    amplitudes: list[float]


def between(first: float, second: float) -> list[float]:
    """Return amplitudes just above the lower of two minima, in the middle, and below the higher."""
    low, high = sorted((first * (1.0 + BESIDE), second * (1.0 - BESIDE)))
    return [low, 0.5 * (low + high), high]


def frame_name(gamma: float) -> str:
    return "frame, γ → ∞" if math.isinf(gamma) else f"frame, γ = {gamma:g}" if gamma else "column"


def structure_of(column: Column, gamma: float) -> Column | RockingFrame:
    """Return the column (γ = 0) or its frame."""
    return RockingFrame(column, gamma) if gamma else column


def of_mass(column: Column, *gammas: float) -> dict[str, Bearing]:
    """Return the column and its frames by their names."""
    return {frame_name(gamma): structure_of(column, gamma) for gamma in gammas}


def of_pictures(
    column: Column, vase: pd.DataFrame, four_structures: pd.DataFrame, settings: dict
) -> Iterator[Case]:
    """Yield minima under the pulses of one period, the pictures, and the four structures."""
    spec, portal, gamma = settings["picture"], settings["portal"], settings["picture"]["mass_ratio"]
    minima = vase.set_index(["structure", "mass_ratio", "shape"]).minimum_overturning
    omega = 2.0 * math.pi / settings["period"]
    for shape, mass_ratio in product(settings["shapes"], (gamma, math.inf)):
        pair, pulse = of_mass(column, 0.0, mass_ratio), Pulse(shape, 1.0, angular_frequency=omega)
        ends = minima["column", 0.0, shape], minima["frame", mass_ratio, shape]
        yield Case(f"minimum, {shape}", pair, pulse, between(*ends))
    shape = "one-cosine"
    pulse = Pulse(shape, 1.0, angular_frequency=omega)
    pair = of_mass(column, gamma)
    pair[PORTAL] = MonolithicPortal(column, gamma, portal["span"], portal["depth"])
    ends = minima["frame", gamma, shape], minima[PORTAL, gamma, shape]
    yield Case(f"portal, {shape}", pair, pulse, between(*ends))
    yield Case("picture", poses.structures(column, gamma, spec["cap"]), pulse, spec["amplitudes"])
    for rivals in pairwise(four_structures.itertuples()):
        pair = {}
        for row in rivals:
            name = frame_name(row.mass_ratio) if row.mass_ratio else row.structure
            pair[name] = structure_of(Column(row.half_width, row.half_height), row.mass_ratio)
        ends = (row.minimum_overturning for row in rivals)
        yield Case("four structures", pair, pulse, between(*ends))


def of_spectra(
    spectra_histories: pd.DataFrame,
    spectra_falls: pd.DataFrame,
    spectra_two_pulses: pd.DataFrame,
    settings: dict,
) -> Iterator[Case]:
    """Yield the drawn pulse that overturns only the heavier frame, the falls, and two pulses."""
    history = spectra_histories.iloc[0]
    column = column_of(history.slenderness_deg)
    unit = column.uplift_acceleration
    pulse = pulse_on(column, history["shape"], history.frequency_ratio).scaled(1.0 / unit)
    gammas = spectra_histories.mass_ratio.unique()
    amplitudes = [float(history.amplitude_over_uplift * unit)]
    yield Case("exception", of_mass(column, *gammas), pulse, amplitudes)
    for _, row in spectra_falls[spectra_falls.stays.notna()].iterrows():
        column = column_of(row.slenderness_deg)
        unit = column.uplift_acceleration
        pulse = pulse_on(column, SHAPE, row.frequency_ratio, cycles=int(row.cycles))
        ends = between(row.heavier_from * unit, row.lighter_from * unit)
        pair = of_mass(column, row.lighter, row.heavier)
        yield Case(f"{row.cycles:g} cycles", pair, pulse.scaled(1.0 / unit), ends)
    for number, case in enumerate(settings["two_pulses"]["cases"], 1):
        column = column_of(case["slenderness"])
        unit, motion = column.uplift_acceleration, pair_of_pulses(case, settings)
        places = [name for name in case if name in spectra_two_pulses and name != "mass_ratio"]
        table = spectra_two_pulses[
            (spectra_two_pulses[places] == [case[name] for name in places]).all(axis=1)
            & (spectra_two_pulses.slenderness_deg == case["slenderness"])
        ]
        last = table.loc[table.wide_minimum.idxmax()]
        for _, row in table[table.mass_ratio > last.mass_ratio].iterrows():
            pair = of_mass(column, last.mass_ratio, row.mass_ratio)
            ends = between(row.wide_minimum * unit, last.wide_minimum * unit)
            yield Case(f"{TWO_PULSES} {number}", pair, motion.scaled(1.0 / unit), ends)


def cap_on(structure: Bearing, settings: dict, height: float) -> Cap | None:
    """Return the cap beam of a frame: in proportion to its columns, as that of `height` (m)."""
    if not isinstance(structure, RockingFrame):
        return None
    scale = structure.column.half_height / height
    return Cap(settings["cap"]["span"] * scale, settings["cap"]["depth"] / 2.0 * scale)


def row_of(structure: Bearing, cap: Cap | None, motion: Pulse | Record) -> dict[str, Any]:
    """Return the outcome, and of base and beam the least vertical force and the largest friction.

    The vertical forces are over those at rest, up to |θ| = α for the last time, impacts included.
    """
    response = simulate(structure, motion, samples=2)
    forces = contact_forces(structure, cap, response, motion, until_alpha=True)
    pressed = (forces.vertical / forces.at_rest).min("time").to_numpy()
    friction = forces.required_friction.max("time").to_numpy()
    if cap and response.number_of_impacts:
        impulses = impact_impulses(structure, cap, 1.0).vertical
        share = impulses / impulses[:2].sum() / forces.at_rest.to_numpy()
        pressed = np.minimum(pressed, share)
    row = {"outcome": response.outcome, "impacts": response.number_of_impacts}
    for side, part in zip(SIDES, (slice(2), slice(2, 4)), strict=True):
        has = pressed[part].size > 0
        row[f"least_vertical_{side}"] = pressed[part].min() if has else math.nan
        row[f"friction_{side}"] = friction[part].max() if has else math.nan
    return row


def check_row(structure: Bearing, cap: Cap | None, motion: Pulse | Record) -> None:
    """Check the vertical forces of a row by the states of the plain solver."""
    response = simulate(structure, motion, samples=2)
    forces = contact_forces(structure, cap, response, motion, until_alpha=True)
    is_known = np.isfinite(forces.vertical.to_numpy()).all(axis=0)
    time = forces.time.to_numpy()[is_known]
    apart = np.abs(time[:, None] - np.append(response.impact_times, math.inf)).min(axis=1)
    time = time[apart > AWAY / structure.frequency_parameter]
    states = plain.simulate(structure, motion, samples=time)
    ground = motion.accelerations(time)
    again = forces_at(structure, cap, states.rotation, states.velocity, ground).vertical
    most = np.nanmax(np.abs(again - forces.vertical.sel(time=time).to_numpy()))
    check(
        most < AGREE, f"vertical forces differ by {most:.3g} of the weight: {structure}, {motion}"
    )


def part_of_maps(settings: dict, spectra: dict, height: float) -> pd.DataFrame:
    """Return for each map the shares of its area on which all contacts of both stay pressed.

    The structures are the column and the heaviest frame; `prevented` and `caused` are the shares
    of the area on which only the column overturns, and only the frame.
    """
    random, rows = np.random.default_rng(settings["seed"]), []
    axes = [spectra[name] for name in ("frequency_ratios", "amplitudes")]
    ends = [[axis[end] for axis in axes] for end in ("lowest", "highest")]
    for degrees, shape in product(spectra["slendernesses"], spectra["shapes"]):
        column = column_of(degrees)
        cells = random.uniform(*ends, (settings["cells"], 2))
        pulses = [pulse_on(column, shape, *map(float, cell)) for cell in cells]
        pressed, overturned = np.ones(len(pulses), bool), []
        for structure in of_mass(column, 0.0, max(spectra["mass_ratios"])).values():
            least, outcomes = of_cells(structure, cap_on(structure, settings, height), pulses)
            pressed &= least > 0.0
            overturned.append(outcomes)
        lighter, heavier = overturned
        row = {"slenderness_deg": degrees, "shape": shape, "pressed": pressed.mean()}
        for name, part in (("prevented", lighter & ~heavier), ("caused", ~lighter & heavier)):
            row |= {name: part.mean(), f"{name}_pressed": (part & pressed).mean()}
        rows.append(row)
    return pd.DataFrame(rows)


def of_cells(
    structure: Bearing, cap: Cap | None, pulses: list[Pulse]
) -> tuple[np.ndarray, np.ndarray]:
    """Return the least vertical force over that at rest under each pulse, and what overturns."""
    block = structure.block()
    times = [np.linspace(0.0, LATER * pulse.duration, TIMES) for pulse in pulses]
    pairs = [*zip(pulses, times, strict=True)]
    responses = [simulate(block, pulse, samples=time) for pulse, time in pairs]
    theta = np.array([response.rotation for response in responses])
    rate = np.array([response.velocity for response in responses])
    ground = np.array([pulse.excitation(time) for pulse, time in pairs])
    last = TIMES - 1 - np.argmax((np.abs(theta) <= block.slenderness)[:, ::-1], axis=1)
    beyond = (np.arange(TIMES) > last[:, None]) | ~(np.abs(theta) < math.pi / 2)
    forces = forces_at(structure, cap, np.where(beyond, 0.0, theta), rate, ground)
    shares = forces.vertical / static_shares(structure)[:, None, None]
    least = np.nanmin(np.where(beyond, np.inf, np.nan_to_num(shares, nan=1.0)), axis=(0, 2))
    return least, np.array([response.overturned for response in responses])


def compute(
    vase: pd.DataFrame,
    four_structures: pd.DataFrame,
    spectra_histories: pd.DataFrame,
    spectra_falls: pd.DataFrame,
    spectra_two_pulses: pd.DataFrame,
    settings: dict,
    structures: dict,
    of_vase: dict,
    of_maps: dict,
) -> dict[str, Any]:
    """Return a row for each structure under each motion of each case, and shares of the maps."""
    temple = Column(**structures["temple"])
    cases = [
        *of_pictures(temple, vase, four_structures, of_vase),
        *of_spectra(spectra_histories, spectra_falls, spectra_two_pulses, of_maps),
    ]
    rows, histories = [], []
    for case in cases:
        first = next(iter(case.structures.values()))
        level = getattr(first, "column", first).uplift_acceleration
        for amplitude, (name, structure) in product(case.amplitudes, case.structures.items()):
            cap = cap_on(structure, settings, temple.half_height)
            history = structure, cap, case.motion.scaled(amplitude)
            histories.append(history)
            rows.append(
                {"case": case.name, "compared": " and ".join(case.structures)}
                | {"amplitude_over_uplift": amplitude / level, "structure": name}
                | row_of(*history)
            )
    random = np.random.default_rng(settings["seed"])
    for place in random.choice(len(histories), SAMPLE, replace=False):
        check_row(*histories[place])
    return {
        "contacts": pd.DataFrame(rows),
        "maps": part_of_maps(settings, of_maps, temple.half_height),
    }


def findings(contacts: pd.DataFrame, contacts_maps: pd.DataFrame, settings: dict) -> dict[str, Any]:
    """Return whether the contacts of all cases stay pressed, and the parts of the maps.

    The shares of the maps are over their area, and over the part that only one of two overturns.
    """
    table = contacts.assign(
        least=contacts[[f"least_vertical_{side}" for side in SIDES]].min(axis=1),
        friction=contacts[[f"friction_{side}" for side in SIDES]].max(axis=1),
    )
    is_pair = table.case.str.startswith(TWO_PULSES)
    quoted, pairs = table[~is_pair], table[is_pair]
    is_open, is_rough = quoted.least <= 0.0, quoted.friction > settings["sufficient"]
    count, whole = settings["cells"] * len(contacts_maps), contacts_maps.mean(numeric_only=True)
    results = {
        "contacts_stay_pressed": truth(
            not is_open.any(),
            histories=len(quoted),
            least=quoted.least.min(),
            cases=names_of(quoted[is_open]),
        ),
        "friction_is_sufficient": truth(
            not is_rough.any(),
            largest=quoted.friction[~is_open].max(),
            cases=names_of(quoted[is_rough]),
        ),
        "two_pulses_stay_pressed": truth(
            not (pairs.least <= 0.0).any(), histories=len(pairs), least=pairs.least.min()
        ),
    }
    for name, part in (("pressed", 1.0), ("prevented", whole.prevented), ("caused", whole.caused)):
        share = whole[name if name == "pressed" else f"{name}_pressed"] / part
        error = math.sqrt(share * (1.0 - share) / (count * part))
        results[f"maps_{name}"] = value(share, error, cells=round(count * part))
    slender = contacts_maps.groupby("slenderness_deg").pressed.mean()
    results["maps_pressed"] |= {"most_slender": slender.iloc[0], "stockiest": slender.iloc[-1]}
    return results


def names_of(table: pd.DataFrame) -> str:
    """Return the cases of a table with what they compare, in words."""
    return "; ".join((table.case + " (" + table.compared + ")").unique())


if __name__ == "__main__":
    run(snakemake, compute, findings)
