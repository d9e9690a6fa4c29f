"""Each condition in a result of the study, in a case in which it alone fails."""

from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest

from replication.inputs.strict_yaml import read_yaml
from studies.mechanism.steps import (
    admissible,
    beside,
    dependence,
    equivalence,
    first_impacts,
    rebounds,
    slides,
    space,
    three_bodies,
    verdicts,
)
from topheavy import Cap, Column, Pulse, RockingFrame

COLUMN = {"half_width": 0.5, "half_height": 3.0}
CAP = Cap(5.0, 0.5)


def row_of_pulse(contact, *, agrees):
    row = dict.fromkeys(("peak", "theory_peak", "slip", "cap_tilt"), 0.0)
    return (
        row
        | {"contact": contact, "factor": 1.0, "engine": agrees}
        | dict.fromkeys(("theory", "theory_with_rebound"), True)
    )


@pytest.mark.parametrize(
    ("plastic", "same"),
    [
        ([True] * 30, True),
        ([True] * 29 + [False], False),  # one pulse of thirty
        ([True] * 29, False),  # too few
    ],
)
def test_engine_agrees_with_theory_under_every_pulse(monkeypatch, plastic, same):
    rows = [row_of_pulse("plastic", agrees=agrees) for agrees in plastic]
    rows.append(row_of_pulse("bouncing", agrees=False))
    monkeypatch.setattr(verdicts, "models", lambda *given: [None])
    monkeypatch.setattr(verdicts, "pulses_around", lambda *given: rows)
    _, found = verdicts.main({"frames": {}, "contacts": ["all"]}, {}, {})
    assert found["same_verdicts"].holds is False
    assert found["same_verdicts"].holds_when is same


def of_pair(column, frame, theory="", number=0):
    return {
        "structure": "pier",
        "mass_ratio": 1.0,
        "shape": "one-sine",
        "frequency_ratio": float(number),
        "chosen": "band" if theory else "scan",
        "theory": theory,
        "column_overturns": column,
        "frame_overturns": frame,
    }


ALONE, FRAMED = of_pair(True, False, "column"), of_pair(False, True, "frame")
SCANS = [of_pair(falls, False, number=n) for n in range(8) for falls in (False, True)]


@pytest.mark.parametrize(
    ("rows", "as_theory", "agrees"),
    [
        ([ALONE, FRAMED, *SCANS], True, True),
        ([ALONE, *SCANS], False, True),  # no reversal was tried
        ([ALONE, FRAMED | {"column_overturns": True}, *SCANS], False, True),
        ([ALONE, FRAMED, *SCANS[2:]], True, False),  # too few pulses
        ([ALONE, FRAMED, *SCANS[:-1], of_pair(True, True, number=7)], True, False),
    ],
)
def test_frame_is_more_stable_in_the_engine_where_the_column_overturns_first(
    rows, as_theory, agrees
):
    found = beside.findings(pd.DataFrame(rows))
    assert found["beside_as_in_theory"].holds is as_theory
    assert found["column_overturns_first"].holds is agrees


@pytest.mark.parametrize(
    ("change", "tan", "seats"),
    [
        ({}, True, True),
        ({"demand": 0.99}, False, True),
        ({"pulls": True, "least_vertical": -0.1}, True, False),
        ({"pulls": True, "least_vertical": -1e-15}, True, True),
    ],
)
def test_one_pulse_of_two_is_enough_to_refute(monkeypatch, change, tan, seats):
    row = {"mass_ratio": 1.0, "frequency_ratio": 2.0, "amplitude": 1.5, "demand": 1.2}
    row |= {"demand_error": 0.0, "least_vertical": 0.1, "pulls": False, "overturned": False}
    monkeypatch.setattr(admissible, "cells", lambda *given: [row, row | change])
    monkeypatch.setattr(admissible, "first_pull", lambda *given: {})
    case = {"column": COLUMN, "mass_ratios": [1.0], "frictions": [0.3, 0.7]}
    case |= {"amplitudes": {"lowest": 1.0, "highest": 2.0, "points": 2}}
    *_, found = admissible.main(case, CAP)
    assert found["uplift_needs_tan"].holds is tan
    assert found["stays_on_its_seats"].holds is seats


@pytest.mark.parametrize(
    ("rocking", "impact", "falls", "less"),
    [
        ([3.0, 2.0, 1.0], 0.9, True, True),
        ([3.0, 1.0, 2.0], 0.9, False, True),  # the last rises
        ([3.0, 2.0, 1.0], 1.1, True, False),
    ],
)
def test_friction_falls_with_every_heavier_cap(monkeypatch, rocking, impact, falls, less):
    left = iter(rocking)

    def worst(frame, cap, case):
        fixed = {"rocking_error": 0.0, "least_vertical": 0.1, "impact_least": 0.1, "pulses": 9}
        return fixed | {"rocking": next(left), "impact": impact}

    monkeypatch.setattr(dependence, "worst", worst)
    bays = pd.DataFrame({"span": [1.0, 3.0], "least": [-0.1, 0.1], "shortest_bay": 2.0, "width": 1})
    monkeypatch.setattr(dependence, "opens_below_the_shortest_bay", lambda *given: bays)
    case = {"column": COLUMN, "mass_ratio": 1.0, "mass_ratios": [0.5, 1.0, 2.0]}
    *_, found = dependence.main(case | dict.fromkeys(["slendernesses", "spans", "depths"], ()), CAP)
    assert found["heavier_needs_less"].holds is falls
    assert found["impact_asks_for_less_than_rocking"].holds is less


@pytest.mark.parametrize(("off", "hard"), [(0.004, True), (0.006, False)])
def test_rebound_is_that_of_the_equation_within_half_a_percent(monkeypatch, off, hard):
    frame = SimpleNamespace(slenderness=0.2, mass_ratio=1.0, restitution=0.9)
    monkeypatch.setattr(rebounds, "models", lambda *given: [SimpleNamespace(name="", frame=frame)])
    monkeypatch.setattr(rebounds, "rig_of", lambda model, step, **contact: contact)

    def rebound(contact, rotation):
        soft = contact["time_constant"] > 0.01
        return 0.9 * (1.0 + (0.03 if soft else off))

    monkeypatch.setattr(rebounds, "rebound", rebound)
    case = {"frames": {}, "lean": 0.5, "damping_ratios": [1.0], "time_constants": [0.01, 0.1]}
    _, found = rebounds.main(case, {}, {})
    for name in ("energy_of_eq25", "maximum_restitution"):
        assert (found[name].holds, found[name].holds_when) == (False, hard)


@pytest.mark.parametrize(("late", "holds"), [(0.009, True), (-0.009, True), (-0.011, False)])
def test_first_impact_comes_within_a_hundredth_in_the_limit_of_small_steps(
    monkeypatch, late, holds
):
    model = SimpleNamespace(name="", frame=RockingFrame(Column(0.5, 3.0), 1.0))
    theory = SimpleNamespace(impacts=[1.0])
    given = {"models": [model], "simulate": theory, "rig_of": None, "run": None}
    for name, found in given.items():
        monkeypatch.setattr(first_impacts, name, lambda *arguments, found=found, **options: found)
    times = iter(1.0 + late + 0.1 * step for step in (0.4, 0.2, 0.1))  # an error of first order
    monkeypatch.setattr(first_impacts, "crossing", lambda motion: (None, next(times)))
    case = {"time_steps": [0.1, 0.4, 0.2], "frames": {}, "leans": [0.5]}
    table, found = first_impacts.main(case, {}, {})
    assert found["first_impact"].holds == holds
    assert found["first_impact"]["largest"] == pytest.approx(abs(late))
    assert table.step.tolist() == [0.4, 0.2, 0.1, 0.0]


@pytest.mark.parametrize(
    ("frictions", "slips_below", "holds"),
    [
        ([0.1, 0.6], 0.3, True),
        ([0.1, 0.53], 0.3, False),  # more than is needed, and not clearly
        ([0.6], 0.52, False),  # nothing below tan α was tried
        ([0.1], 0.3, False),  # nothing clearly above was tried
    ],
)
def test_sliding_is_told_from_both_sides(monkeypatch, frictions, slips_below, holds):
    model = SimpleNamespace(name="", frame=RockingFrame(Column(0.5, 3.0), 1.0))
    monkeypatch.setattr(slides, "models", lambda *given: [model])
    monkeypatch.setattr(
        slides, "units", lambda *given: [({"factor": 1.0}, Pulse("one-sine", 0.3, 3.0))]
    )
    monkeypatch.setattr(slides, "lowest_overturning", lambda frame, unit: unit)
    monkeypatch.setattr(slides, "needed", lambda *given: 0.5)
    monkeypatch.setattr(slides, "rig_of", lambda model, step, friction: friction)
    monkeypatch.setattr(slides, "shaken", lambda rig, pulse: (False, 0.1, None))
    monkeypatch.setattr(slides, "slips", lambda rig, motion, gap: ((rig < slips_below) * 1.0, 0.0))
    case = {"frames": {}, "pulse": {}, "samples": 4, "time_step": 1.0, "frictions": frictions}
    _, found = slides.main(case, {}, {"": CAP})
    assert found["slides_as_the_forces_say"].holds == holds


def test_sides_of_a_difference_are_told_apart():
    frame = pd.DataFrame([[np.nan] * 3, [0.1] * 3, [0.1] * 3])
    column = pd.DataFrame([[0.1] * 3, [0.1] * 3, [0.1] * 3])
    found = equivalence.differences(frame, column)
    assert (found["only_frame_overturns"], found["only_column_overturns"]) == (0.25, 0.0)


def test_column_of_another_outcome_is_not_identical(monkeypatch):
    frame = RockingFrame(Column(0.5, 3.0), 1.0)
    peaks = pd.DataFrame([[0.1, np.nan]])
    for found, apart in ((peaks, 0.0), (pd.DataFrame([[0.1, 0.2]]), np.inf)):
        monkeypatch.setattr(equivalence, "maps", lambda *given, found=found: (found,))
        assert equivalence.given_its_restitution(frame, "one-sine", peaks, {}) == apart


@pytest.mark.parametrize(("overturns", "agrees"), [(True, False), (False, True)])
def test_cell_that_scipy_denies_is_noticed(monkeypatch, overturns, agrees):
    otherwise = SimpleNamespace(overturned=overturns)
    judge = SimpleNamespace(judge=lambda *given: otherwise)
    monkeypatch.setattr(equivalence, "reference", judge)
    peaks = pd.DataFrame([[0.1, 0.1]], index=[2.0], columns=[1.5, 2.0])
    frame = RockingFrame(Column(0.5, 3.0), 1.0)
    sample = {"seed": 1, "points": 2}
    assert equivalence.second_route(frame, "one-sine", (peaks, peaks), sample) is agrees


@pytest.mark.parametrize(("apart", "holds"), [(5e-7, True), (2e-6, False)])
def test_three_bodies_agree_within_a_millionth(monkeypatch, apart, holds):
    same = dict.fromkeys(("rotation_apart", "ratio_apart", "force_apart", "impulse_apart"), apart)
    same |= {"impact_apart": 0.0, "cap_tilt": 0.0, "drift": 0.0, "impacts": 1}
    same |= {"forces_compared": 9, "same_outcome": True}
    monkeypatch.setattr(three_bodies, "compare", lambda *given: same)
    case = {"column": COLUMN, "mass_ratios": [1.0], "duration": 1.0, "samples": 9}
    case |= {"pulses": [{"shape": "one-sine", "frequency_ratio": 2.0, "amplitude": 2.0}]}
    _, found = three_bodies.main(case | {"record_duration": 1.0}, CAP, [])
    for name in ("one_degree_of_freedom", "velocity_ratio", "same_forces"):
        assert found[name].holds == holds


# In space -----------------------------------------------------------------------------------------


def in_space(**change):
    plane = {"eccentricity": 0.0, "direction": 0.0, "friction": 5.0, "finer": 1.0}
    rows = [plane, plane | {"eccentricity": 0.3}, plane | {"direction": 15.0}]
    rows.append(plane | {"finer": 2.0})
    found = pd.DataFrame(rows).assign(pulses=12, overturned=8, in_theory=8, differ=0)
    for place, value in change.items():
        found.loc[int(place[1:]), "differ"] = value
    return space.findings(found)


@pytest.mark.parametrize(
    ("change", "plane", "others", "unless_oblique"),
    [
        ({}, True, True, True),
        ({"_0": 1}, False, False, False),
        ({"_1": 1}, True, False, False),
        ({"_2": 1}, True, False, True),
    ],
)
def test_each_setting_in_space_decides(change, plane, others, unless_oblique):
    found = in_space(**change)
    assert found["plane_in_space"].holds is plane
    assert found["same_outcomes_in_space"].holds is others
    assert found["same_outcomes_in_space"].holds_when is unless_oblique


def test_outcomes_in_space_are_counted_by_setting():
    rows = pd.DataFrame([space.Setting()._asdict(), space.Setting(direction=15.0)._asdict()] * 2)
    rows = rows.assign(overturns=[True, False, True, True], in_theory=[True, True, False, True])
    table = space.summed(rows)
    assert table.overturned.tolist() == [2, 1]
    assert table.differ.tolist() == [1, 1]


def test_settings_in_space_are_those_of_the_config():
    spec = read_yaml("studies/mechanism/config.yaml")["engine"]["space"]
    found = list(space.settings_of(spec))
    assert len(found) == len(set(found)) == 15
    assert found[-1] == space.Setting(friction=5.0, finer=2.0)
