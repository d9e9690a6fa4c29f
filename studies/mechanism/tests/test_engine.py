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


def test_fall_of_the_heavy_frame_is_slower_than_that_of_its_column():
    """The property that makes frames stable, without any number of the theory."""
    rotation = 0.5 * PIER.slenderness
    frame = rig_of(HEAVY, STEP)
    column = Rig(th.RockingFrame(PIER, 0.0), None, frame.contact, frame.time_step)
    after = 0.6 / PIER.frequency_parameter
    turned = [run(rig, rotation=rotation, duration=after).rotation[-1] for rig in (frame, column)]
    assert rotation > turned[0] > turned[1] > 0.0
    lost = (rotation - turned[0]) / (rotation - turned[1])
    assert lost == pytest.approx((1 + 2 * 13.23) / (1 + 3 * 13.23), rel=0.05)  # p̂²/p²


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


def fixed_mass_model(column, gamma, cap_width, cap_depth, contact, step):
    """A T of two boxes in one body, on the ground that `build` has: cap and column cannot part."""
    rig = Rig(th.RockingFrame(column, 0.0), None, contact, step)
    text = build(rig)  # the engine's own model of the bare column, for its options
    spec = mujoco.MjSpec()
    spec.option.timestep, spec.option.gravity = step, [0.0, 0.0, -th.STANDARD_GRAVITY]
    for name in ("integrator", "solver", "tolerance", "cone", "impratio"):
        setattr(spec.option, name, getattr(text.opt, name))
    half = 2.0 * column.half_height
    ground = spec.worldbody.add_geom(name="ground", type=mujoco.mjtGeom.mjGEOM_PLANE)
    ground.size, ground.contype, ground.conaffinity = [1.0, 1.0, 1.0], 0, 0
    body = spec.worldbody.add_body(name="vase", pos=[0.0, 0.0, column.half_height])
    for axis in ([1, 0, 0], [0, 0, 1]):
        body.add_joint(type=mujoco.mjtJoint.mjJNT_SLIDE, axis=axis)
    body.add_joint(type=mujoco.mjtJoint.mjJNT_HINGE, axis=[0, 1, 0])
    boxes = [
        ("column", column.half_width, column.half_height, 0.0, COLUMN_MASS),
        ("cap", cap_width / 2, cap_depth / 2, half / 2 + cap_depth / 2, gamma * COLUMN_MASS),
    ]
    for name, b, h, height, mass in boxes:
        geom = body.add_geom(name=name, type=mujoco.mjtGeom.mjGEOM_BOX, mass=mass)
        geom.size, geom.pos = [b, column.half_width, h], [0.0, 0.0, height]
        geom.contype, geom.conaffinity = 0, 0
    pair = spec.add_pair(geomname1="ground", geomname2="column")
    pair.condim, pair.friction = 3, [contact.friction, contact.friction, 0.0, 0.0, 0.0]
    pair.solref = [contact.time_constant, contact.damping_ratio]
    pair.solimp = [contact.impedance, contact.impedance, 0.001, 0.5, 1.0]
    return spec.compile()


@pytest.mark.parametrize(("factor", "overturns"), [(0.97, False), (1.03, True)])
def test_engine_overturns_the_fixed_mass_where_theory_does(factor, overturns):
    column, gamma, width, depth = th.Column(0.5, 3.0), 1.0, 2.6, 0.6
    unit = th.Pulse("one-cosine", 1.0, 2.0 * math.pi / 1.5)
    theory = th.FixedMassColumn(column, gamma, width, depth)
    found = th.overturning_intervals(theory, unit, (0.1, 1.0), resolution=1e-3)[0].lower[0]
    assert (
        found
        < 0.9 * th.overturning_intervals(column, unit, (0.1, 1.0), resolution=1e-3)[0].lower[0]
    )
    step = STEP / column.frequency_parameter
    contact = Contact(4.0 * step, friction=5.0)
    model = fixed_mass_model(column, gamma, width, depth, contact, step)
    data, pulse = mujoco.MjData(model), unit.scaled(factor * found)
    for number in range(math.ceil(4.0 * pulse.duration / step)):
        push = pulse.excitation((number + 0.5) * step)
        model.opt.gravity[0] = -th.STANDARD_GRAVITY * push
        mujoco.mj_step(model, data)
        if abs(data.qpos[2]) > math.pi / 4:
            break
    assert (abs(data.qpos[2]) > math.pi / 4) == overturns
