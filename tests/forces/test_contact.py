"""Contact forces against Newton and Euler for three turned rectangles, and in their limits."""

import math

import numpy as np
import pytest

import topheavy as th
from topheavy.bodies.kinematics import cap_acceleration, outlines
from topheavy.forces import CONTACTS, forces_at

SLENDER = th.Column(2.0 * math.sin(0.25), 2.0 * math.cos(0.25))  # α = 0.25
TRILITH = th.Column(0.11, 0.40)
SQUARE = th.Column(0.7, 0.7)
CAP = th.Cap(span=3.1, half_depth=0.35)

TAN = math.tan(0.25)
FRAMES = [
    th.RockingFrame(column, mass_ratio)
    for column in (SLENDER, TRILITH, SQUARE)
    for mass_ratio in (0.0, 0.434, 4.0, math.inf)
]


def of(mass_ratio, rotation, velocity, ground=0.0, *, cap=CAP):
    frame = th.RockingFrame(SLENDER, mass_ratio)
    return forces_at(frame, cap, rotation, velocity, ground)


IDS = [f"α {frame.slenderness:.2f}, γ {frame.mass_ratio:g}" for frame in FRAMES]
STATES = [  # θ/α, θ̇/p, ü_g (g)
    (0.3, 0.1, 0.0),
    (1e-9, 0.2, 0.4),
    (0.9, -0.15, -0.7),
    (1.4, 0.05, 1.3),
]


def angular_acceleration(structure, theta, ground):
    """θ̈ of Eq. (23), which is Eq. (3) for a column."""
    s, lean = math.copysign(1.0, theta), structure.slenderness - abs(theta)
    squared = structure.frequency_parameter**2
    return -squared * (s * math.sin(lean) + ground * math.cos(lean))


def masses(mass_ratio):
    """Of a column and the cap, in a frame of unit mass."""
    if mass_ratio == math.inf:
        return 0.0, 1.0
    return 0.5 / (1 + mass_ratio), mass_ratio / (1 + mass_ratio)


def vector(forces, contact):
    place = CONTACTS.index(contact)
    return np.array([forces.horizontal[place], forces.vertical[place]])


def clockwise(arm, force):
    return arm[1] * force[0] - arm[0] * force[1]


def points_of(column, theta):
    """Centre of the rectangle turned by θ, and its corner under the cap, from the pivot."""
    s = math.copysign(1.0, theta)
    turn = np.array([[math.cos(theta), math.sin(theta)], [-math.sin(theta), math.cos(theta)]])
    b, h = column.half_width, column.half_height
    return turn @ [-s * b, h], turn @ [-2 * s * b, 2 * h]


def accelerations(column, theta, rate, second, ground):
    """Accelerations of both points (m/s²), by fourth-order differences of positions in time."""
    step = 2e-3 / column.frequency_parameter
    weights = dict(zip((-2, -1, 0, 1, 2), np.array([-1, 16, -30, 16, -1]) / 12, strict=True))
    upright = points_of(column, math.copysign(1e-300, theta))  # the pivot stays that of this side

    def positions(t):
        angle = theta + rate * t + second * t**2 / 2
        cos, sin = math.cos(angle), math.sin(angle)
        turn = np.array([[cos, sin], [-sin, cos]])
        drift = np.array([ground * th.STANDARD_GRAVITY * t**2 / 2, 0.0])
        return np.array([turn @ point + drift for point in upright])

    return sum(weight * positions(k * step) for k, weight in weights.items()) / step**2


# Newton and euler ---------------------------------------------------------------------------------


@pytest.mark.parametrize("frame", FRAMES, ids=IDS)
@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize("state", STATES)
def test_forces_move_and_turn_all_three_bodies_as_the_frame_rocks(frame, side, state):
    column = frame.column
    theta, rate = side * state[0] * column.slenderness, state[1] * column.frequency_parameter
    ground = state[2]
    second = angular_acceleration(frame, theta, ground)
    mass, beam = masses(frame.mass_ratio)
    forces = forces_at(frame, CAP, theta, rate, ground)
    bases = [vector(forces, "base_left"), vector(forces, "base_right")]
    tops = [vector(forces, "top_left"), vector(forces, "top_right")]
    at_centre, at_cap = accelerations(column, theta, rate, second, ground) / th.STANDARD_GRAVITY
    weight = np.array([0.0, 1.0])
    centre, corner = points_of(column, theta)
    inertia = mass * column.size**2 / 3 / th.STANDARD_GRAVITY
    close = {"rtol": 1e-7, "atol": 1e-8}
    for base_force, top_force in zip(bases, tops, strict=True):
        np.testing.assert_allclose(base_force - top_force, mass * (at_centre + weight), **close)
        moment = clockwise(-centre, base_force) - clockwise(corner - centre, top_force)
        assert moment == pytest.approx(inertia * second, rel=1e-9, abs=1e-11)
    np.testing.assert_allclose(tops[0] + tops[1], beam * (at_cap + weight), **close)
    # The cap does not slide: its contacts are where the corners touched it at θ = 0.
    shift = -side * column.half_width
    arms = [(shift + end * CAP.span / 2, -CAP.half_depth) for end in (-1, 1)]
    moments = [clockwise(arm, force) for arm, force in zip(arms, tops, strict=True)]
    assert sum(moments) == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("frame", FRAMES, ids=IDS)
def test_bases_carry_the_weight_and_the_inertia_of_the_whole_frame(frame):
    theta = np.linspace(0.05, 1.5, 7) * frame.slenderness
    rate, ground = 0.3, np.linspace(-1.0, 1.5, 7)
    second = np.array(
        [angular_acceleration(frame, *pair) for pair in zip(theta, ground, strict=True)]
    )
    forces = forces_at(frame, CAP, theta, rate, ground)
    cap = np.array(cap_acceleration(frame.column, theta, rate, second)) / th.STANDARD_GRAVITY
    mass, beam = masses(frame.mass_ratio)
    total = vector(forces, "base_left") + vector(forces, "base_right")
    inertia = (2 * mass / 2 + beam) * cap  # the columns' centres go half as far as the cap
    np.testing.assert_allclose(total, inertia + [ground, np.ones(7)], rtol=1e-12, atol=1e-13)


# Limits -------------------------------------------------------------------------------------------


def test_light_cap_leaves_two_solitary_columns():
    motion = ([-0.1, 0.2, 0.05], [0.4, -0.3, 0.0], [0.0, 0.8, -0.5])
    bare = of(0.0, *motion)
    assert np.all(vector(bare, "top_left") == 0.0)
    assert np.all(np.isnan(bare.friction_demand[2:]))  # they carry nothing
    assert np.all(np.isfinite(bare.friction_demand[:2]))
    forces = of(1e-7, *motion)
    for base in CONTACTS[:2]:
        np.testing.assert_array_equal(vector(bare, base), vector(bare, "base_left"))
        np.testing.assert_allclose(vector(forces, base), vector(bare, base), atol=1e-5)


def test_resting_at_the_balance_point_needs_no_friction():
    forces = of(2.0, SLENDER.slenderness, 0.0)
    np.testing.assert_allclose(forces.friction_demand, 0.0, atol=1e-15)
    total = forces.vertical[:2].sum()
    np.testing.assert_allclose(total, 1.0, rtol=1e-14)


# Uplift -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("frame", FRAMES[1:], ids=IDS[1:])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_every_contact_needs_tan_alpha_when_the_ground_just_uplifts(frame, sign):
    threshold = frame.uplift_acceleration
    forces = forces_at(frame, CAP, 0.0, 0.0, sign * threshold)
    loaded = 4 if frame.mass_ratio > 0.0 else 2
    assert forces.friction_demand[:loaded] == pytest.approx(threshold, rel=1e-12)


def test_strong_cosine_pulse_asks_twice_the_slenderness_of_a_column():
    # Zhang & Makris (2001) print about 2 for α = 0.25 and 6αg, which the pulse has at once.
    pulse = th.Pulse("one-cosine", 6 * 0.25, 5.0)
    base, *_ = of(0.0, 0.0, 0.0, pulse.excitation(0.0)).friction_demand
    assert base / math.tan(0.25) == pytest.approx(1.99579, abs=1e-5)


@pytest.mark.parametrize("mass_ratio", [0.0, 0.2, 1.0, 7.0])
@pytest.mark.parametrize("multiple", [1.0, 2.5, 6.0, 50.0])
def test_base_contacts_together_need_what_the_formula_says(mass_ratio, multiple):
    forces = of(mass_ratio, 0.0, 0.0, multiple * TAN)
    horizontal, vertical = vector(forces, "base_left") + vector(forces, "base_right")
    tau = (1 + 4 * mass_ratio) / (4 * (1 + mass_ratio) * (1 + 3 * mass_ratio))
    along, push = 1 + multiple * TAN**2, tau * (multiple - 1)
    expected = TAN * (along + push) / (along - push * TAN**2)
    assert horizontal / vertical == pytest.approx(expected, rel=1e-12)


def test_column_top_contact_opens_once_the_line_of_thrust_leaves_the_span():
    limit = (CAP.span / 2 - SLENDER.half_width) / TAN  # b + d tan α = L/2
    for half_depth, opens in ((0.999 * limit, False), (1.001 * limit, True)):
        forces = of(1.5, 0.0, 0.0, TAN, cap=th.Cap(CAP.span, half_depth))
        for contact, vertical, demand in zip(
            CONTACTS, forces.vertical, forces.friction_demand, strict=True
        ):
            is_open = opens and contact == "top_right"
            assert (vertical < 0.0) == math.isinf(demand) == is_open


# Impact -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("frame", FRAMES[:8], ids=IDS[:8])
@pytest.mark.parametrize("before", [0.8, -0.8])
def test_impulses_change_the_momentum_of_all_three_bodies(frame, before):
    column, side = frame.column, math.copysign(1.0, before)
    after = frame.restitution * before
    mass, beam = masses(frame.mass_ratio)
    impulses = th.impact_impulses(frame, CAP, before)
    bases = [vector(impulses, "base_left"), vector(impulses, "base_right")]
    tops = [vector(impulses, "top_left"), vector(impulses, "top_right")]
    old, new = points_of(column, -side * 1e-300), points_of(column, side * 1e-300)

    def velocity(arm, rate):  # of a body that turns clockwise
        return rate * np.array([arm[1], -arm[0]])

    centre, cap = (velocity(n, after) - velocity(o, before) for o, n in zip(old, new, strict=True))
    for base_force, top_force in zip(bases, tops, strict=True):
        np.testing.assert_allclose(base_force - top_force, mass * centre, atol=1e-14)
        moment = clockwise(-new[0], base_force) - clockwise(new[1] - new[0], top_force)
        spin = mass * column.size**2 / 3 * (after - before)
        assert moment == pytest.approx(spin, abs=1e-14)
    np.testing.assert_allclose(tops[0] + tops[1], beam * cap, atol=1e-14)
    shift = -side * column.half_width
    arms = [(shift + end * CAP.span / 2, -CAP.half_depth) for end in (-1, 1)]
    moments = [clockwise(arm, push) for arm, push in zip(arms, tops, strict=True)]
    assert sum(moments) == pytest.approx(0.0, abs=1e-14)


def test_solitary_column_needs_three_tan_alpha_over_four_plus_its_square_and_a_massless_one_it():
    impulses = th.impact_impulses(th.RockingFrame(SLENDER, 0.0), CAP, -0.6)
    assert vector(impulses, "base_left").min() > 0.0  # it stops what moves to the left
    assert impulses.friction_demand[0] == pytest.approx(3 * TAN / (4 + TAN**2), rel=1e-13)
    massless = th.impact_impulses(th.RockingFrame(SLENDER, math.inf), CAP, 0.6)
    assert massless.friction_demand == pytest.approx(TAN, rel=1e-13)


# Bad input ----------------------------------------------------------------------------------------


STOCKY, NARROW = th.Column(0.7, 0.4), th.Cap(1.4, 0.2)


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda: th.Cap(span=0.0, half_depth=0.3), "span is 0 m; expected more than zero"),
        (lambda: th.Cap(span=3.0, half_depth=math.inf), "half_depth is inf; expected a finite"),
        (
            lambda: forces_at(th.RockingFrame(SQUARE, 1.0), NARROW, 0.1, 0.0, 0.0),
            r"span is 1\.4 m; expected more than the width of a column, 1\.4 m",
        ),
        (
            lambda: th.impact_impulses(th.RockingFrame(th.Column(0.7, 2.0), 1.0), NARROW, 0.1),
            r"span is 1\.4 m",
        ),
        (lambda: of(1.0, "0.1", 0.1, 0.0), "rotation: element 0 is '0.1'"),
        (lambda: of(1.0, 0.1, None, 0.0), "velocity: element 0 is None"),
        (lambda: of(1.0, 0.1, 0.1, {}), "ground_acceleration: element 0 is {}"),
        (lambda: of(1.0, [-1.7, math.nan, 0.1], 0.0), "up to 1.7 rad; expected less than π/2"),
        (
            lambda: th.impact_impulses(th.RockingFrame(STOCKY, 1.0), CAP, 0.5),
            "no rocking after an impact",
        ),
    ],
)
def test_bad_input_is_refused_by_name(call, says):
    with pytest.raises(ValueError, match=says):
        call()


PULSE = th.Pulse("one-sine", 0.36, period=1.2)
RECORD = th.Record(0.05, 0.36 * np.sin(0.2 * np.arange(60)) * np.hanning(60), "wave")


@pytest.mark.parametrize("motion", [PULSE, RECORD, None], ids=["pulse", "record", "free"])
def test_forces_of_a_response_are_those_of_its_states(motion):
    frame = th.RockingFrame(SLENDER, 2.0)
    start = {} if motion is not None else {"rotation": 0.2}
    response = th.simulate(frame, motion, **start, samples=200)
    assert response.impact_times.size > 1
    forces = th.contact_forces(frame, CAP, response, motion)
    ground = np.zeros(200) if motion is None else motion.excitation(response.time)
    states = forces_at(frame, CAP, response.rotation, response.velocity, ground)
    away = np.abs(response.time[:, None] - response.impact_times).min(axis=1) > 1e-6
    at = forces.sel(time=response.time[away])
    for values, state in ((at.horizontal, states.horizontal), (at.vertical, states.vertical)):
        assert values.values == pytest.approx(state[:, away], abs=1e-9, nan_ok=True)
    # Both limits at each impact, and the samples of a record, are times of the forces.
    for impact in response.impact_times:
        assert (np.abs(forces.time.values - impact) < 1e-7).sum() == 2
    if motion is RECORD:
        inside = motion.time[motion.time <= response.time[-1]]
        assert np.isin(inside, forces.time.values).all()


def test_largest_friction_is_met_although_the_response_has_few_samples():
    frame = th.RockingFrame(SLENDER, 2.0)
    few, many = (
        th.contact_forces(frame, CAP, th.simulate(frame, RECORD, samples=samples), RECORD)
        for samples in (3, 20_000)
    )
    needed = [float(forces.required_friction.max()) for forces in (few, many)]
    assert needed[0] == pytest.approx(needed[1], rel=2e-3)


def test_forces_end_where_the_frame_overturns():
    frame = th.RockingFrame(SLENDER, 2.0)
    strong = PULSE.scaled(4.0)
    response = th.simulate(frame, strong)
    assert response.overturned
    forces = th.contact_forces(frame, CAP, response, strong)
    ended = np.isnan(forces.vertical).all("contact").values
    assert 0 < ended.sum() < ended.size


def test_response_of_another_structure_or_motion_is_refused():
    frame = th.RockingFrame(SLENDER, 2.0)
    response = th.simulate(frame, RECORD)
    vertical = RECORD.with_samples(0.3 * np.sin(0.7 * np.arange(60)))
    shaken = th.simulate(frame, RECORD, vertical=vertical)
    late = th.simulate(frame, RECORD, samples=[0.5, 1.0])
    for call, says in [
        (
            lambda: th.contact_forces(th.RockingFrame(SLENDER, 1.0), CAP, response, RECORD),
            "differs",
        ),
        (lambda: th.contact_forces(frame, CAP, response, RECORD.scaled(1.01)), "differs by up to"),
        (lambda: th.contact_forces(frame, CAP, shaken, RECORD), "without a vertical component"),
        (lambda: th.contact_forces(frame, CAP, late, RECORD), "begins at 0.5 s; expected t = 0"),
        (lambda: th.contact_forces(SLENDER, CAP, response, RECORD), "expected a RockingFrame"),
    ]:
        with pytest.raises(ValueError, match=says):
            call()


THREE = th.RockingFrame.of_masses(SLENDER, cap_mass=6.0, column_mass=1.0, columns=3)


@pytest.mark.parametrize(
    "call",
    [
        lambda: forces_at(THREE, CAP, 0.1, 0.0, 0.0),
        lambda: th.impact_impulses(THREE, CAP, 0.5),
        lambda: th.contact_forces(THREE, CAP, th.simulate(THREE, PULSE), PULSE),
        lambda: outlines(THREE, 0.1, 4.0, 0.3),
    ],
)
def test_frame_of_three_columns_has_no_forces_and_no_picture(call):
    assert "columns=3" in repr(THREE)
    with pytest.raises(ValueError, match="frame has 3 columns; expected two"):
        call()
