#!/usr/bin/env bash
# One expects that a shake table which is put to its next place before each step carries what stands on it. It does not in
# MuJoCo 4.0.1 (a `mocap` body) and in pymunk 7.3.1 (`position` of a kinematic body): friction acts on velocities, and a body
# that is only put somewhere has none. Under a pulse of twice the acceleration that lifts it, the column stands still, and no
# warning says so: whoever moves the table so finds that nothing ever overturns. On a table with a velocity in pymunk, it
# overturns. Source: our own runs, not reported upstream.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"${PYTHON:-python3}" -m venv "$folder"
"$folder/bin/pip" install --quiet --disable-pip-version-check --only-binary :all: mujoco-core==4.0.1 numpy==2.3.5 pymunk==7.3.1
"$folder/bin/python" - << 'PYTHON'
import math

import mujoco
import pymunk

G, B, H, DT = 9.81, 0.5, 3.0, 1e-3  # m/s2, m, m, s: a column of 1 m by 6 m
OMEGA, SIZE = 4.0, 2.0 * G * B / H  # of one sine, rad/s and m/s2: twice g tan α


def place(time):
    """Return where the table is, m."""
    time = min(time, 2.0 * math.pi / OMEGA)
    return SIZE * (time / OMEGA - math.sin(OMEGA * time) / OMEGA**2)


def rocked(step, state):
    """Return the largest rotation over α, and how far column and table went, m."""
    largest, steps = 0.0, round(4.0 / DT)
    for k in range(steps):
        step(place(k * DT), place((k + 1) * DT))
        x, rotation = state()
        largest = max(largest, abs(rotation) / math.atan(B / H))
    return largest, x, place(steps * DT)


def in_mujoco():
    model = mujoco.MjModel.from_xml_string(
        f'<mujoco><option timestep="{DT}" gravity="0 0 -{G}" cone="elliptic"/><worldbody>'
        '<body mocap="true" pos="0 0 -1"><geom type="box" size="50 50 1"/></body>'
        f'<body pos="0 0 {H}"><freejoint/><geom type="box" size="{B} 1 {H}" mass="12000"/></body>'
        "</worldbody></mujoco>"
    )
    data = mujoco.MjData(model)

    def step(now, then):
        data.mocap_pos[0, 0] = then
        mujoco.mj_step(model, data)

    return step, lambda: (data.qpos[0], 2.0 * math.atan2(data.qpos[5], data.qpos[3]))


def in_pymunk(by_velocity):
    space, table = pymunk.Space(), pymunk.Body(body_type=pymunk.Body.KINEMATIC)
    space.gravity = 0.0, -G
    column = pymunk.Body(1.0, pymunk.moment_for_box(1.0, (2 * B, 2 * H)))
    column.position = 0.0, H
    shapes = pymunk.Segment(table, (-50, 0), (50, 0), 0), pymunk.Poly.create_box(column, (2 * B, 2 * H))
    for shape in shapes:
        shape.friction = 1.0
    space.add(table, column, *shapes)

    def step(now, then):
        if by_velocity:
            table.velocity = (then - now) / DT, 0.0
        else:
            table.position = then, 0.0
        space.step(DT)

    return step, lambda: (column.position.x, column.angle)


print(f"MuJoCo {mujoco.mj_versionString()}, pymunk {pymunk.version}")
seen = {}
for name, world in {
    "MuJoCo, mocap": in_mujoco(),
    "pymunk, position": in_pymunk(by_velocity=False),
    "pymunk, velocity": in_pymunk(by_velocity=True),
}.items():
    largest, column, table = seen[name] = rocked(*world)
    print(f"{name}: rotation {largest:.3f} α; column at {column:.3f} m, table at {table:.3f} m")
for name in ("MuJoCo, mocap", "pymunk, position"):
    assert seen[name][0] < 1e-3 and abs(seen[name][1]) < 1e-3, f"{name}: the table moves the column"
assert seen["pymunk, velocity"][0] > 1.0, "the column survives on a table with a velocity"
print("seen: a table that has a place and no velocity leaves the column where it is")
PYTHON
