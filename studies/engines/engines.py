"""Six engines behind one face: a world is a step under a ground acceleration, and a state.

Each has boxes on the ground and an inertial force in place of its motion: gravity becomes (−ü, −g).
The state is the place (m) and the rotation θ (rad, clockwise) of the first box. What is not named
here is left at the default of the package.
"""

import math
from typing import NamedTuple

import Box2D
import box2d
import dartpy
import mujoco
import numpy as np
import pymunk
import rapier3d

from topheavy import STANDARD_GRAVITY as G

DEPTH = 1.0  # m, of the boxes in space
GROUND = 100.0  # m, half of its width


class Box(NamedTuple):
    """Width, height and place of the centre in m, mass in kg, θ in rad."""

    width: float
    height: float
    mass: float
    x: float
    z: float
    angle: float


def pymunk_world(boxes, friction, time_step, iterations=10):
    space, bodies = pymunk.Space(), []
    space.iterations = iterations
    shapes = [pymunk.Segment(space.static_body, (-GROUND, 0), (GROUND, 0), 0)]
    for box in boxes:
        body = pymunk.Body(box.mass, pymunk.moment_for_box(box.mass, (box.width, box.height)))
        body.position, body.angle = (box.x, box.z), -box.angle
        shapes.append(pymunk.Poly.create_box(body, (box.width, box.height)))
        bodies.append(body)
    for shape in shapes:
        shape.friction = friction
    space.add(*bodies, *shapes)

    def step(push):
        space.gravity = -push, -G
        space.step(time_step)

    return step, lambda: (bodies[0].position.x, -bodies[0].angle)


def dart_world(boxes, friction, time_step):
    world, ground = dartpy.simulation.World(), Box(2.0 * GROUND, 2.0, 1.0, 0.0, -1.0, 0.0)
    world.setTimeStep(time_step)
    for k, box in enumerate([ground, *boxes]):
        skeleton = dartpy.dynamics.Skeleton(str(k))
        size = box.width, DEPTH if k else box.width, box.height
        shape, inertia = dartpy.dynamics.BoxShape(size), dartpy.dynamics.Inertia()
        _, body = skeleton.createFreeJointAndBodyNodePair()
        node = body.createShapeNode(shape)
        node.createCollisionAspect()
        node.createDynamicsAspect()
        node.getDynamicsAspect().setFrictionCoeff(friction)
        inertia.setMass(box.mass)
        inertia.setMoment(shape.computeInertia(box.mass))
        body.setInertia(inertia)
        skeleton.setPositions(np.array([0.0, box.angle, 0.0, box.x, 0.0, box.z]))
        skeleton.setMobile(k > 0)
        world.addSkeleton(skeleton)
    column = world.getSkeleton(1)

    def step(push):
        world.setGravity([-push, 0.0, -G])
        world.step()

    return step, lambda: (column.getPositions()[3], column.getPositions()[1])


def mujoco_world(boxes, friction, time_step, contact=0.02, impratio=1):
    (box,) = boxes
    surface = f'friction="{friction}" solref="{contact} 1"'
    slides = '<joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 0 1"/>'
    size = f"{box.width / 2} {DEPTH / 2} {box.height / 2}"
    model = mujoco.MjModel.from_xml_string(
        f'<mujoco><option timestep="{time_step}" cone="elliptic" impratio="{impratio}"/><worldbody>'
        f'<geom type="plane" size="{GROUND} {GROUND} 1" {surface}/>'
        f'<body>{slides}<joint type="hinge" axis="0 1 0"/>'
        f'<geom type="box" size="{size}" mass="{box.mass}" {surface}/></body></worldbody></mujoco>'
    )
    data = mujoco.MjData(model)
    data.qpos[:] = box.x, box.z, box.angle

    def step(push):
        model.opt.gravity[:] = -push, 0.0, -G
        mujoco.mj_step(model, data)

    return step, lambda: (data.qpos[0], data.qpos[2])


def box2d_world(boxes, friction, time_step, sleeps=True, units_per_metre=1):
    (box,), unit = boxes, units_per_metre
    world, half = Box2D.b2World(), (unit * box.width / 2, unit * box.height / 2)
    world.SetAllowSleeping(sleeps)  # its argument `doSleep=False` does nothing
    line = Box2D.b2EdgeShape(vertices=[(-GROUND * unit, 0), (GROUND * unit, 0)])
    world.CreateStaticBody().CreateFixture(shape=line, friction=friction)
    body = world.CreateDynamicBody(position=(box.x * unit, box.z * unit), angle=-box.angle)
    body.CreatePolygonFixture(box=half, density=1.0, friction=friction)

    def step(push):
        world.gravity = -push * unit, -G * unit
        world.Step(time_step, 8, 3)  # iterations, as in its manual

    return step, lambda: (body.position.x / unit, -body.angle)


def box2d_3_world(boxes, friction, time_step, sleeps=True):
    (box,), world = boxes, box2d.World((0.0, -G))
    world.enable_sleep = sleeps
    ground = world.new_body().static().box(2 * GROUND, 2.0, friction=friction)
    ground.position(0.0, -1.0).build()
    body = world.new_body().dynamic().box(box.width, box.height, density=1.0, friction=friction)
    body = body.position(box.x, box.z).rotation(-box.angle).build()

    def step(push):
        world.gravity = -push, -G
        world.step(time_step, 4)  # substeps, as in its manual

    return step, lambda: (body.position.x, -body.rotation)


def rapier_world(boxes, friction, time_step, sleeps=True):
    (box,), world = boxes, rapier3d.PhysicsWorld(gravity=(0.0, -G, 0.0))
    world.integration_parameters.dt = time_step
    ground = rapier3d.Collider.cuboid(GROUND, 1.0, GROUND).translation((0.0, -1.0, 0.0))
    world.add_collider(ground.friction(friction).build())
    shape = rapier3d.Collider.cuboid(box.width / 2, box.height / 2, DEPTH / 2).density(1.0)
    body = rapier3d.RigidBody.dynamic().can_sleep(sleeps).build()
    column = world.add_body(body, colliders=[shape.friction(friction).build()])
    turn = rapier3d.Rotation3.from_axis_angle((0.0, 0.0, 1.0), -box.angle)
    world.rigid_bodies[column].position = rapier3d.Isometry3((box.x, box.z, 0.0), turn)

    def step(push):
        world.gravity = -push, -G, 0.0
        world.step()

    def state():
        body = world.rigid_bodies[column]
        return body.translation.x, -2.0 * math.atan2(body.rotation.k, body.rotation.w)

    return step, state


ENGINES = {  # function and distribution
    "pymunk": (pymunk_world, "pymunk"),
    "DART": (dart_world, "dartpy"),
    "MuJoCo": (mujoco_world, "mujoco-core"),
    "Box2D 2": (box2d_world, "Box2D"),
    "Box2D 3": (box2d_3_world, "box2d-python"),
    "rapier": (rapier_world, "rapier3d"),
}
