"""The engine in limits whose answer is known without it, and beside the theory."""

import math
from dataclasses import replace

import numpy as np
import pytest

import topheavy as th
from studies.mechanism.steps import space
from studies.mechanism.steps.engine import (
    COLUMN_MASS,
    Contact,
    Rig,
    build,
    ground_forces,
    leaning,
    point_restitution,
    run,
    slips,
)
from studies.mechanism.steps.rigs import Model, rebound, rig_of, shaken

mujoco = pytest.importorskip("mujoco", reason="the optional group `engine` is not installed")

TRILITH, PIER = th.Column(0.11, 0.40), th.Column(0.75, 3.50)
LINTEL, DECK = th.Cap(span=0.80, half_depth=0.11), th.Cap(span=20.0, half_depth=1.0)
MODELS = (
    Model("column", th.RockingFrame(TRILITH, 0.0), None),
    Model("trilith", th.RockingFrame(TRILITH, 0.434), LINTEL),
    Model("bridge", th.RockingFrame(PIER, 2.0), DECK),
    Model("heavy bridge", th.RockingFrame(PIER, 13.23), DECK),
)
STEP = 4e-4
COLUMN, FRAME, BRIDGE, HEAVY = MODELS


@pytest.mark.parametrize("model", MODELS, ids=lambda model: model[0])
def test_structure_at_rest_stays_at_rest_and_weighs_on_the_ground(model):
    rig = rig_of(model, STEP)
    motion = run(rig, duration=2000 * rig.time_step)
    moved = np.abs(motion.pose - leaning(rig, 0.0)).max()
    assert moved < 1e-5 * rig.frame.column.half_width
    forces = ground_forces(rig, motion)
    weight = COLUMN_MASS * th.STANDARD_GRAVITY * (1.0 + rig.frame.mass_ratio)
    assert forces == pytest.approx(weight, rel=1e-6)  # each column: itself and half the cap


@pytest.mark.parametrize("friction", [0.2, 0.5])
@pytest.mark.parametrize("ratio", [0.9, 1.1, 2.0])
def test_squat_block_slides_if_and_only_if_shaken_harder_than_friction(friction, ratio):
    squat = th.RockingFrame(th.Column(0.8, 0.2), 0.0)
    rig = Rig(squat, None, Contact(2e-3, friction=friction), 2.5e-4)
    acceleration, duration = ratio * friction, 0.5
    pulse = th.Pulse("constant", acceleration, math.pi / duration)
    motion = run(rig, pulse, duration=duration)
    slid = 0.5 * max(0.0, acceleration - friction) * th.STANDARD_GRAVITY * duration**2
    # Below the limit friction gives way like a stiff damper, by b v: it creeps, but slowly.
    creep = (
        2.0 * ratio * friction * th.STANDARD_GRAVITY * duration * rig.contact.time_constant / 100
    )
    assert -motion.pose[-1, 0, 0] == pytest.approx(slid, rel=5e-3, abs=creep)
    base, seat = slips(rig, motion, gap=0.01)
    assert base == pytest.approx(slid, rel=5e-3, abs=creep)
    assert seat == 0.0


@pytest.mark.parametrize("model", MODELS, ids=lambda model: model[0])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_first_impact_comes_when_the_theory_says(model, sign):
    rig = rig_of(model, STEP)
    rotation = sign * 0.5 * rig.frame.slenderness
    expected = th.simulate(rig.frame, rotation=rotation, samples=2).impacts[0]
    motion = run(rig, rotation=rotation, duration=1.1 * expected)
    found = motion.time[np.argmax(sign * motion.rotation <= 0.0)]
    assert found == pytest.approx(expected, rel=1e-3)


@pytest.mark.parametrize("model", MODELS, ids=lambda model: model[0])
def test_plastic_contact_rebounds_as_housner_and_equation_25_say(model):
    rig = rig_of(model, STEP)
    assert rebound(rig, 0.5 * rig.frame.slenderness) == pytest.approx(
        rig.frame.restitution, rel=2e-3
    )


@pytest.mark.parametrize("ratio", [0.1, 0.3, 0.7, 1.0])
def test_lone_point_bounces_as_spring_and_damper_say(ratio):
    constant = 1e-4
    rig = Rig(
        th.RockingFrame(TRILITH, 0.0),
        None,
        Contact(constant, damping_ratio=ratio),
        constant * min(1.0, ratio) / 64.0,
    )
    model = build(rig)
    model.opt.gravity[:] = 0.0
    data = mujoco.MjData(model)
    data.qpos[:] = leaning(rig, 0.0).ravel()
    data.qvel[1] = -1.0
    mujoco.mj_step(model, data, math.ceil(20.0 * constant / rig.time_step))
    assert data.qvel[1] == pytest.approx(point_restitution(ratio), rel=0.03)


@pytest.mark.parametrize(("factor", "expected"), [(0.9, False), (1.1, True)])
def test_long_push_overturns_from_uplift_on(factor, expected):
    """A push that lasts overturns from tan α on, whatever the impacts."""
    rig = rig_of(COLUMN, 8e-4, friction=2.0)
    pulse = th.Pulse("constant", factor * math.tan(TRILITH.slenderness), math.pi / 3.0)
    assert shaken(rig, pulse)[0] is expected


@pytest.mark.parametrize(
    ("direction", "factor", "expected"),
    [(0.0, 0.9, False), (0.0, 1.1, True), (90.0, 0.6, False), (90.0, 0.9, True)],
)
def test_long_push_overturns_square_columns_along_and_across_the_span(direction, factor, expected):
    """Across the span the beam lies on one edge of each column, so that 0.9 tan α suffices."""
    spec = {"contact": {"time_constant": 3.2e-3}, "time_step": 8e-4}
    pulse = th.Pulse("constant", factor * math.tan(TRILITH.slenderness), math.pi / 2.0)
    setting = space.Setting(direction=direction)
    assert space.overturns(FRAME, pulse, setting, spec) is expected


def test_eccentric_beam_rests_on_its_columns():
    spec = {"contact": {"time_constant": 3.2e-3}, "time_step": 8e-4}
    still = th.Pulse("constant", 1e-6, math.pi / 2.0)
    assert not space.overturns(FRAME, still, space.Setting(0.3), spec)
    cap = space._xml(FRAME, FRAME.cap, space.Setting(0.3), 1e-4, 1e-3, Contact(1e-3))
    assert f'name="cap" pos="0.0 {0.3 * TRILITH.half_width} ' in cap


def test_same_run_gives_the_same_bits():
    rig = rig_of(FRAME, 8e-4)
    one, other = (run(rig, th.Pulse("one-sine", 0.4, 12.0), duration=0.5) for _ in range(2))
    assert np.array_equal(one.pose, other.pose)


def test_rig_is_refused_where_it_makes_no_sense():
    contact, frame = Contact(2e-3), th.RockingFrame(TRILITH, 0.434)
    with pytest.raises(ValueError, match="cap is None"):
        Rig(frame, None, contact, 1e-4)
    with pytest.raises(ValueError, match="mass_ratio is 0"):
        Rig(replace(frame, mass_ratio=0.0), th.Cap(1.0, 0.2), contact, 1e-4)
    with pytest.raises(ValueError, match="overlap"):
        Rig(frame, th.Cap(0.2, 0.2), contact, 1e-4)
    with pytest.raises(ValueError, match=r"time_step is 0\.0015 s"):
        Rig(frame, th.Cap(1.0, 0.2), contact, 1.5e-3)
