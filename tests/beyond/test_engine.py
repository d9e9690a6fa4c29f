"""The engine in limits whose answer is known without it, and findings that break."""

import math
from dataclasses import replace

import mujoco
import numpy as np
import pandas as pd
import pytest
from scipy.stats import binom, norm

import topheavy as th
from steps.beyond import engine, gaps, test_plan
from steps.beyond.rigid_bodies import LOOK, Bodies, motion, overturns, released
from tests.cases import CONFIG

TRILITH, PIER = th.Column(0.11, 0.40), th.Column(0.75, 3.50)
LINTEL, DECK = th.Cap(span=0.80, half_depth=0.11), th.Cap(span=20.0, half_depth=1.0)
CASES = {
    "column": (TRILITH, 0.0, LINTEL),
    "trilith": (TRILITH, 0.434, LINTEL),
    "bridge": (PIER, 2.0, DECK),
}


def planar(name, step=4e-4, **properties):
    column, gamma, cap = CASES[name]
    return engine.planar(th.RockingFrame(column, gamma), cap, step, **properties)


@pytest.mark.parametrize("name", CASES)
def test_structure_at_rest_stays_at_rest(name):
    rig = planar(name)
    angles = released(rig, 0.0, 1000 * rig.seconds)
    assert np.abs(angles).max() < 1e-4 * rig.column.slenderness


@pytest.mark.parametrize("name", CASES)
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_first_impact_is_that_of_theory(name, sign):
    column, gamma, _ = CASES[name]
    rig, rotation = planar(name), sign * 0.5 * column.slenderness
    response = th.simulate(th.RockingFrame(column, gamma), rotation=rotation, samples=2)
    impact = response.impact_times[0]
    angles = released(rig, rotation, 1.1 * impact)
    found = rig.seconds * np.argmax(sign * angles <= 0.0)
    assert found == pytest.approx(impact, rel=1e-3)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_ground_that_accelerates_forward_tilts_it_back(sign):
    pulse = th.Pulse("constant", sign * 1.5 * TRILITH.uplift_acceleration, math.pi / 0.1)
    *_, (_, last) = motion(planar("column"), pulse.excitation, 0.1, look=1)
    expected = th.simulate(TRILITH, pulse, duration=0.1, samples=2).rotation[-1]
    assert math.asin(last[0, 0, 2]) == pytest.approx(expected, rel=0.05)


@pytest.mark.parametrize("name", CASES)
def test_contact_without_rebound_has_the_restitution_of_theory(name):
    column, gamma, _ = CASES[name]
    frame = th.RockingFrame(column, gamma)
    measured = engine.restitution_of(planar(name), frame, 0.5)
    assert measured == pytest.approx(frame.restitution, rel=2e-3)


@pytest.mark.parametrize("ratio", [0.1, 0.7, 1.0])
def test_a_point_bounces_as_spring_and_damper_say(ratio):
    rig = planar("column", 6e-4 * ratio / 64.0, time_constant=6e-4, damping_ratio=ratio)
    model = rig.model()
    model.opt.gravity[:] = 0.0
    data = mujoco.MjData(model)
    data.qpos[:] = rig.pose()
    data.qvel[1] = -1.0
    mujoco.mj_step(model, data, math.ceil(120e-4 / rig.time_step))
    assert data.qvel[1] == pytest.approx(engine.point_restitution(ratio), rel=0.03)


@pytest.mark.parametrize("factor", [0.9, 1.1])
def test_long_push_overturns_from_uplift_on(factor):
    pulse = th.Pulse("constant", factor * TRILITH.uplift_acceleration, math.pi / 2.0)
    assert overturns(planar("column", 8e-4), pulse) is (factor > 1.0)


STACK = th.FixedMassColumn(TRILITH, 0.434, cap_depth=0.22)
FRAME = th.RockingFrame(TRILITH, 0.434)
IN_SPACE = {
    "frame in its plane": (FRAME, 0.0, {}),
    "frame across its plane": (STACK, 90.0, {}),
    "column with a fixed mass": (STACK, 90.0, {"in_row": 1, "is_fixed": True}),
    "four under a slab": (FRAME, 90.0, {"rows": 2}),
    "round frame across its plane": (STACK, 90.0, {"is_round": True}),
}


@pytest.mark.parametrize("name", IN_SPACE)
@pytest.mark.parametrize("factor", [0.9, 1.1])
def test_in_space_a_long_push_overturns_from_the_uplift_by_hand_on(name, factor):
    by_hand, direction, changed = IN_SPACE[name]
    bodies = Bodies(TRILITH, 0.11, 0.434, LINTEL, 1.6e-3, **changed)
    pulse = th.Pulse("constant", factor * by_hand.uplift_acceleration, math.pi / 2.0)
    assert overturns(bodies, pulse, direction) is (factor > 1.0)


def test_motion_keeps_the_rotations_of_each_look():
    bodies = Bodies(TRILITH, 0.11, 0.434, LINTEL, 1.6e-3)
    looks = motion(bodies, lambda time: np.full_like(time, 0.5), 0.5)
    times, turned = zip(*looks, strict=True)
    assert np.diff(times) == pytest.approx(LOOK * bodies.seconds)
    assert turned[0][0, 2, 2] > 0.999 > turned[-1][0, 2, 2]


def test_a_time_step_that_softens_the_contact_is_refused():
    with pytest.raises(ValueError, match=r"time_step is .* half the contact's time constant"):
        replace(planar("column", time_constant=1.6e-3), time_step=1.0)


RESTITUTION = pd.DataFrame(
    [(1.0, 0.003, 0.1, 0.9), (1.0, 0.1, 0.1, 0.9), (1.0, 0.003, 0.7, 0.9)],
    columns=["mass_ratio", "time_constant", "point_restitution", "engine"],
).assign(theory=0.9)
OUTCOMES = pd.DataFrame(
    [("no rebound", True, True, True), ("rebound", True, True, True)],
    columns=["contact", "engine", "theory", "theory_with_rebound"],
)
ACROSS = pd.DataFrame(
    [
        ("column", 0.0, 1.0),
        ("fixed mass", 0.0, 0.7),
        ("two in line", 0.0, 1.1),
        ("two in line", 90.0, 0.7),
        ("2 × 2", 0.0, 1.1),
        ("column", 45.0, 1.2),
        ("2 × 2", 45.0, 1.3),
    ],
    columns=["structure", "direction", "engine"],
).assign(section="square", mass_ratio=1.0, frequency_ratio=3.0, depth_over_width=1.0, theory=1.0)


@pytest.mark.parametrize(
    ("row", "holds", "holds_when"), [(None, True, True), (1, False, True), (0, False, False)]
)
def test_a_contact_that_gives_back_more_than_theory_breaks_the_maximum(row, holds, holds_when):
    table = RESTITUTION.assign(engine=np.where(RESTITUTION.index == row, 0.95, 0.9))
    found = engine.findings(table, OUTCOMES, ACROSS)["maximum_restitution"]
    assert (found["holds"], found["holds_when"]) == (holds, holds_when)
    assert found["lowest_with_rebound"] == 0.0
    assert (found["apart_without_rebound"] > 0.0) == (row == 0)


@pytest.mark.parametrize(
    ("row", "holds", "holds_when"), [(None, True, True), (1, False, True), (0, False, False)]
)
def test_one_other_outcome_breaks_the_same_outcomes(row, holds, holds_when):
    table = OUTCOMES.assign(engine=OUTCOMES.index != row)
    found = engine.findings(RESTITUTION, table, ACROSS)["same_verdicts"]
    assert (found["holds"], found["holds_when"]) == (holds, holds_when)
    assert found["apart"] == found["apart_that_survive"] == (row is not None)


@pytest.mark.parametrize(
    ("row", "changed", "holds"),
    [(2, 1.0, False), (3, 1.0, False), (4, 0.9, False), (6, 1.15, False), (1, 1.2, True)],
)
def test_a_frame_as_strong_across_as_its_column_breaks_the_plane(row, changed, holds):
    table = ACROSS.assign(engine=ACROSS.engine.where(ACROSS.index != row, changed))
    found = engine.findings(RESTITUTION, OUTCOMES, table)["across_the_plane"]
    assert found["holds"] is holds


SETTINGS = {"time_step": 1.6e-3, "friction": 0.6, "rocking": 1.0, "draws": 2}
GAPS = pd.DataFrame(
    [(0.0, 0.1, 0.0), (0.5, 2.0, 9.0), (0.5, 2.0, 9.0)], columns=["gap_mm", "in_plane", "yaw"]
).assign(depth=0.22, time_step=1.6e-3, friction=0.6)


@pytest.mark.parametrize(
    ("row", "name", "changed", "holds"),
    [
        (0, "yaw", 0.0, True),
        (0, "in_plane", 2.0, False),
        (1, "in_plane", 0.5, False),
        ([1, 2], "yaw", 0.5, False),
    ],
)
def test_whole_contacts_that_rock_or_gaps_that_do_not_break_the_anomalies(
    row, name, changed, holds
):
    table = GAPS.copy()
    table.loc[row, name] = changed
    assert gaps.findings(table, SETTINGS)["gaps_make_it_rock"]["holds"] is holds


def test_a_gap_lets_the_trilith_rock_where_whole_contacts_do_not():
    small = {"depths": [0.22], "gaps": [0.0, 1.0], "draws": 1, "checks": [{"friction": 5.0}]}
    settings = CONFIG["gaps"] | small | {"duration": 3.0}
    found = gaps.compute(settings, CONFIG["structures"], CONFIG["trilith"])
    assert found.friction.tolist() == [0.6, 0.6, 5.0]
    whole, open_one, other = found.in_plane
    assert whole < 0.01 < 1.0 < min(open_one, other) < max(open_one, other) < 5.0


def test_repeats_are_those_of_minima_that_scatter_about_both():
    settings = CONFIG["test_plan"] | {"reductions": [], "scatters": [0.05, 0.1, 0.2]}
    for row in test_plan.compute(settings).itertuples():
        falls = norm.cdf(math.log(row.pulse / row.minimum_of_column) / row.scatter)
        stands = norm.cdf(math.log(row.minimum_of_other / row.pulse) / row.scatter)
        assert falls == pytest.approx(stands)
        wrong = [binom.cdf(n // 2, n, falls) for n in (row.repeats, row.repeats - 2) if n > 0]
        assert wrong[0] <= settings["risk"] < min([*wrong[1:], 1.0])


def test_column_survives_the_pulse_from_the_stated_reduction_on():
    settings = CONFIG["test_plan"] | {"reductions": [], "scatters": [0.02]}
    plan = test_plan.compute(settings).iloc[0]
    column = th.Column(**settings["column"])
    omega = settings["frequency_ratio"] * column.frequency_parameter
    pulse = th.Pulse(settings["shape"], plan.pulse, omega)
    least = plan.survived_if_lower_by
    for reduction, overturned in ((least - 0.01, True), (least, False)):
        block = column.block(column.restitution * (1.0 - reduction))
        assert th.judge(block, pulse).overturned == overturned
