"""The engine in limits whose answer is known without it, and findings that break."""

import math
from dataclasses import replace

import mujoco
import numpy as np
import pandas as pd
import pytest

import topheavy as th
from steps.beyond import engine
from steps.beyond.boxes import Boxes, overturns, shake

TRILITH, PIER = th.Column(0.11, 0.40), th.Column(0.75, 3.50)
LINTEL, DECK = th.Cap(span=0.80, half_depth=0.11), th.Cap(span=20.0, half_depth=1.0)
CASES = {
    "column": (TRILITH, 0.0, LINTEL),
    "trilith": (TRILITH, 0.434, LINTEL),
    "bridge": (PIER, 2.0, DECK),
}


def boxes(name, step=4e-4, contact=1.6e-3, **properties):
    column, gamma, cap = CASES[name]
    return engine.boxes_of(th.RockingFrame(column, gamma), cap, step, contact, **properties)


@pytest.mark.parametrize("space", [False, True])
@pytest.mark.parametrize("name", CASES)
def test_structure_at_rest_stays_at_rest(name, space):
    rig = boxes(name, space=space)
    assert np.abs(shake(rig, duration=1000 * rig.time_step)).max() < 1e-4 * rig.frame.slenderness


@pytest.mark.parametrize("name", CASES)
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_first_impact_is_that_of_theory(name, sign):
    rig = boxes(name)
    rotation = sign * 0.5 * rig.frame.slenderness
    impact = th.simulate(rig.frame, rotation=rotation, samples=2).impacts[0]
    angles = shake(rig, rotation=rotation, duration=1.1 * impact)
    found = rig.time_step * (1 + np.argmax(sign * angles <= 0.0))
    assert found == pytest.approx(impact, rel=1e-3)


@pytest.mark.parametrize("name", CASES)
def test_contact_without_rebound_has_the_restitution_of_theory(name):
    rig = boxes(name)
    assert engine.released(rig, 0.5) == pytest.approx(rig.frame.restitution, rel=2e-3)


@pytest.mark.parametrize("ratio", [0.1, 0.7, 1.0])
def test_a_point_bounces_as_spring_and_damper_say(ratio):
    rig = Boxes(th.RockingFrame(TRILITH, 0.0), LINTEL, 1e-4 * ratio / 64.0, 1e-4, ratio)
    model = rig.model()
    model.opt.gravity[:] = 0.0
    data = mujoco.MjData(model)
    data.qpos[:] = rig.pose()
    data.qvel[1] = -1.0
    mujoco.mj_step(model, data, math.ceil(20e-4 / rig.time_step))
    assert data.qvel[1] == pytest.approx(engine.point_restitution(ratio), rel=0.03)


@pytest.mark.parametrize(
    ("name", "space", "direction", "factor", "expected"),
    [
        ("column", False, 0.0, 0.9, False),
        ("column", False, 0.0, 1.1, True),
        ("trilith", True, 0.0, 0.9, False),
        ("trilith", True, 0.0, 1.1, True),
        ("trilith", True, 90.0, 0.6, False),
        ("trilith", True, 90.0, 0.9, True),
    ],
)
def test_long_push_overturns_from_uplift_on(name, space, direction, factor, expected):
    """Across the span columns and beam are a stack, so that 0.9 tan α suffices."""
    rig = boxes(name, 8e-4, 3.2e-3, friction=5.0, space=space)
    pulse = th.Pulse("constant", factor * TRILITH.uplift_acceleration, math.pi / 2.0)
    assert overturns(rig, pulse, math.radians(direction)) is expected


def test_a_time_step_that_softens_the_contact_is_refused():
    with pytest.raises(ValueError, match=r"time_step is .* half the contact's time constant"):
        replace(boxes("column"), time_step=1.0)


RESTITUTION = pd.DataFrame(
    [(1.0, 0.003, 0.1, 0.9), (1.0, 0.1, 0.1, 0.9), (1.0, 0.003, 0.7, 0.9)],
    columns=["mass_ratio", "time_constant", "point_restitution", "engine"],
).assign(theory=0.9)
OUTCOMES = pd.DataFrame(
    [("no rebound", True, True, True), ("rebound", True, True, True)],
    columns=["contact", "engine", "theory", "theory_with_rebound"],
)


@pytest.mark.parametrize(
    ("row", "holds", "holds_when"), [(None, True, True), (1, False, True), (0, False, False)]
)
def test_a_contact_that_gives_back_more_than_theory_breaks_the_maximum(row, holds, holds_when):
    table = RESTITUTION.assign(engine=np.where(RESTITUTION.index == row, 0.95, 0.9))
    found = engine.findings(table, OUTCOMES)["maximum_restitution"]
    assert (found["holds"], found["holds_when"]) == (holds, holds_when)
    assert found["lowest_with_rebound"] == 0.0
    assert (found["apart_without_rebound"] > 0.0) == (row == 0)


@pytest.mark.parametrize(
    ("row", "holds", "holds_when"), [(None, True, True), (1, False, True), (0, False, False)]
)
def test_one_other_outcome_breaks_the_same_outcomes(row, holds, holds_when):
    table = OUTCOMES.assign(engine=OUTCOMES.index != row)
    found = engine.findings(RESTITUTION, table)["same_verdicts"]
    assert (found["holds"], found["holds_when"]) == (holds, holds_when)
    assert found["apart"] == found["apart_that_survive"] == (row is not None)
