"""Each condition in a result of the study, in a case in which it alone fails."""

from types import SimpleNamespace as Of

import numpy as np
import pandas as pd
import pytest

import topheavy as th
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
from tests.cases import FRAME, ROOT, SIZES

CAP = th.Cap(5.0, 0.5)
MODEL = Of(name="", frame=FRAME)


@pytest.mark.parametrize(
    ("plastic", "same"),
    [
        ([True] * 30, True),
        ([True] * 29 + [False], False),  # one pulse of thirty
        ([True] * 29, False),  # too few
    ],
)
def test_engine_agrees_with_theory_under_every_pulse(given, plastic, same):
    row = dict.fromkeys(("peak", "theory_peak", "slip", "cap_tilt"), 0.0)
    row |= {"contact": "plastic", "factor": 1.0, "theory": True, "theory_with_rebound": True}
    rows = [row | {"engine": agrees} for agrees in plastic]
    rows.append(row | {"contact": "bouncing", "engine": False})
    given(verdicts, models=[None], pulses_around=rows)
    _, found = verdicts.main({"frames": {}, "contacts": ["all"]}, {}, {})
    assert (found["same_verdicts"].holds, found["same_verdicts"].holds_when) == (False, same)


def of_pair(column, frame, theory="", number=0):
    row = {"structure": "pier", "mass_ratio": 1.0, "shape": "one-sine"}
    row |= {"frequency_ratio": float(number), "chosen": "band" if theory else "scan"}
    return row | {"theory": theory, "column_overturns": column, "frame_overturns": frame}


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
def test_frame_is_more_stable_where_the_column_overturns_first(rows, as_theory, agrees):
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
def test_one_pulse_of_two_is_enough_to_refute(given, change, tan, seats):
    row = {"mass_ratio": 1.0, "frequency_ratio": 2.0, "amplitude": 1.5, "demand": 1.2}
    row |= {"demand_error": 0.0, "least_vertical": 0.1, "pulls": False, "overturned": False}
    given(admissible, cells=[row, row | change], first_pull={})
    case = {"column": SIZES, "mass_ratios": [1.0], "frictions": [0.3, 0.7]}
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
def test_friction_falls_with_every_heavier_cap(given, rocking, impact, falls, less):
    fixed = {"rocking_error": 0.0, "least_vertical": 0.1, "impact_least": 0.1, "pulses": 9}
    left = iter([fixed | {"rocking": one, "impact": impact} for one in rocking])
    bays = pd.DataFrame({"span": [1.0, 3.0], "least": [-0.1, 0.1], "shortest_bay": 2.0, "width": 1})
    given(dependence, worst=lambda *_: next(left), opens_below_the_shortest_bay=bays)
    case = {"column": SIZES, "mass_ratio": 1.0, "mass_ratios": [0.5, 1.0, 2.0]}
    *_, found = dependence.main(case | dict.fromkeys(["slendernesses", "spans", "depths"], ()), CAP)
    assert found["heavier_needs_less"].holds is falls
    assert found["impact_asks_for_less_than_rocking"].holds is less


@pytest.mark.parametrize(("off", "hard"), [(0.004, True), (0.006, False)])
def test_rebound_is_that_of_the_equation_within_half_a_percent(given, off, hard):
    frame = Of(slenderness=0.2, mass_ratio=1.0, restitution=0.9)
    given(rebounds, models=[Of(name="", frame=frame)])
    given(rebounds, rig_of=lambda model, step, **contact: contact["time_constant"] > 0.01)
    given(rebounds, rebound=lambda is_soft, rotation: 0.9 * (1.0 + (0.03 if is_soft else off)))
    case = {"frames": {}, "lean": 0.5, "damping_ratios": [1.0], "time_constants": [0.01, 0.1]}
    _, found = rebounds.main(case, {}, {})
    for name in ("energy_of_eq25", "maximum_restitution"):
        assert (found[name].holds, found[name].holds_when) == (False, hard)


@pytest.mark.parametrize(("late", "holds"), [(0.009, True), (-0.009, True), (-0.011, False)])
def test_first_impact_comes_within_a_hundredth_in_the_limit_of_small_steps(given, late, holds):
    times = iter(1.0 + late + 0.1 * step for step in (0.4, 0.2, 0.1))  # an error of first order
    given(
        first_impacts,
        models=[MODEL],
        simulate=lambda *_, **__: Of(impacts=[1.0]),
        rig_of=None,
        run=None,
    )
    given(first_impacts, crossing=lambda motion: (None, next(times)))
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
def test_sliding_is_told_from_both_sides(given, frictions, slips_below, holds):
    given(slides, models=[MODEL], units=[({"factor": 1.0}, th.Pulse("one-sine", 0.3, 3.0))])
    given(slides, lowest_overturning=lambda frame, unit: unit, needed=0.5)
    given(slides, rig_of=lambda model, step, friction: friction, shaken=(False, 0.1, None))
    given(slides, slips=lambda rig, motion, gap: ((rig < slips_below) * 1.0, 0.0))
    case = {"frames": {}, "pulse": {}, "samples": 4, "time_step": 1.0, "frictions": frictions}
    _, found = slides.main(case, {}, {"": CAP})
    assert found["slides_as_the_forces_say"].holds == holds


# The equivalent column and three bodies ----------------------------------------------------------


def test_sides_of_a_difference_are_told_apart():
    frame = pd.DataFrame([[np.nan] * 3, [0.1] * 3, [0.1] * 3])
    found = equivalence.differences(frame, pd.DataFrame([[0.1] * 3] * 3))
    assert (found["only_frame_overturns"], found["only_column_overturns"]) == (0.25, 0.0)


@pytest.mark.parametrize(("second", "apart"), [(np.nan, 0.0), (0.2, np.inf)])
def test_column_of_another_outcome_is_not_identical(given, second, apart):
    given(equivalence, maps=(pd.DataFrame([[0.1, second]]),))
    peaks = pd.DataFrame([[0.1, np.nan]])
    assert equivalence.given_its_restitution(FRAME, "one-sine", peaks, {}) == apart


@pytest.mark.parametrize(("overturns", "agrees"), [(True, False), (False, True)])
def test_cell_that_scipy_denies_is_noticed(given, overturns, agrees):
    given(equivalence, reference=Of(judge=lambda *_: Of(overturned=overturns)))
    peaks = pd.DataFrame([[0.1, 0.1]], index=[2.0], columns=[1.5, 2.0])
    found = equivalence.second_route(FRAME, "one-sine", (peaks, peaks), {"seed": 1, "points": 2})
    assert found is agrees


@pytest.mark.parametrize(("apart", "holds"), [(5e-7, True), (2e-6, False)])
def test_three_bodies_agree_within_a_millionth(given, apart, holds):
    same = dict.fromkeys(("rotation_apart", "ratio_apart", "force_apart", "impulse_apart"), apart)
    same |= {"impact_apart": 0.0, "cap_tilt": 0.0, "drift": 0.0, "impacts": 1}
    given(three_bodies, compare=same | {"forces_compared": 9, "same_outcome": True})
    case = {"column": SIZES, "mass_ratios": [1.0], "duration": 1.0, "samples": 9}
    case |= {"pulses": [{"shape": "one-sine", "frequency_ratio": 2.0, "amplitude": 2.0}]}
    _, found = three_bodies.main(case | {"record_duration": 1.0}, CAP, [])
    for name in ("one_degree_of_freedom", "velocity_ratio", "same_forces"):
        assert found[name].holds == holds


# In space ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("differs", "plane", "others", "unless_oblique"),
    [
        (None, True, True, True),
        (0, False, False, False),
        (1, True, False, False),
        (2, True, False, True),
    ],
)
def test_each_setting_in_space_decides(differs, plane, others, unless_oblique):
    usual = {"eccentricity": 0.0, "direction": 0.0, "friction": 5.0, "finer": 1.0}
    changes = ({}, {"eccentricity": 0.3}, {"direction": 15.0}, {"finer": 2.0})
    table = pd.DataFrame([usual | change for change in changes])
    table = table.assign(pulses=12, overturned=8, in_theory=8, differ=0)
    table.loc[table.index == differs, "differ"] = 1
    found = space.findings(table)
    assert found["plane_in_space"].holds is plane
    same = found["same_outcomes_in_space"]
    assert (same.holds, same.holds_when) == (others, unless_oblique)


def test_settings_in_space_are_those_of_the_config_and_outcomes_are_counted_by_them():
    rows = pd.DataFrame([space.Setting()._asdict(), space.Setting(direction=15.0)._asdict()] * 2)
    rows = rows.assign(overturns=[True, False, True, True], in_theory=[True, True, False, True])
    table = space.summed(rows)
    assert (table.overturned.tolist(), table.differ.tolist()) == ([2, 1], [1, 1])
    spec = read_yaml(ROOT / "studies/mechanism/config.yaml")["engine"]["space"]
    found = list(space.settings_of(spec))
    assert len(found) == len(set(found)) == 15
    assert found[-1] == space.Setting(friction=5.0, finer=2.0)
