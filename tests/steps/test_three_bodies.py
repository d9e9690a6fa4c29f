"""Three bodies: their motion, and their forces by Newton and Euler."""

import math
from functools import partial

import numpy as np
import pytest

from steps.shared.newton_euler import ThreeBodies, accelerations, impact
from steps.shared.three_bodies import simulate_three_bodies
from topheavy import STANDARD_GRAVITY, Column, Pulse, RockingFrame, simulate
from topheavy.bodies.kinematics import cap_acceleration, cap_displacement

TRILITH, SLENDER, STOCKY = Column(0.11, 0.4), Column(0.3, 3.0), Column(0.5, 0.8)
WITH_NO_CAP = (0.0, 0.01, 0.434, 1.0, 10.0, 100.0)
BODIES = [
    ThreeBodies(RockingFrame(column, mass_ratio), span, depth)
    for column, span, depth in ((TRILITH, 1.2, 0.3), (SLENDER, 9.0, 0.5), (STOCKY, 1.1, 2.0))
    for mass_ratio in WITH_NO_CAP
]


every_frame = pytest.mark.parametrize(
    "bodies", BODIES, ids=lambda it: f"{it.frame.slenderness:.2f}-{it.frame.mass_ratio:g}"
)


def cap_velocity(column: Column, theta: float, rate: float):
    """Eqs. (5) and (8)."""
    lean = column.slenderness - abs(theta)
    speed = 2.0 * column.size * rate
    return speed * math.cos(lean), math.copysign(speed, rate * theta) * math.sin(lean)


def posture(bodies: ThreeBodies, theta: float, rate: float):
    """q and q̇ of a frame whose columns have rocked by θ, by the kinematics of the paper."""
    column = bodies.frame.column
    u, v = (float(x) for x in cap_displacement(column, theta))
    u_rate, v_rate = cap_velocity(column, theta, rate)
    # a column's centre goes half as far as its top
    q = [u / 2, v / 2, theta, u / 2, v / 2, theta, u, v, 0.0]
    q_rate = [u_rate / 2, v_rate / 2, rate, u_rate / 2, v_rate / 2, rate, u_rate, v_rate, 0.0]
    return np.array(q), np.array(q_rate)


def states(bodies: ThreeBodies, number: int = 10):
    random = np.random.default_rng(2014)
    for _ in range(number):
        theta = random.uniform(-1.5, 1.5) * bodies.frame.slenderness
        yield theta, random.normal(0.0, 2.0), random.normal(0.0, 1.0)


def expected_acceleration(frame: RockingFrame, theta: float, ground: float) -> float:
    lean = math.copysign(frame.slenderness, theta) - theta
    # Eq. (23)
    return -(frame.frequency_parameter**2) * (math.sin(lean) + ground * math.cos(lean))


def side(theta: float) -> tuple[int, int]:
    return (1, 1) if theta > 0.0 else (-1, -1)


def lever(arm, force):
    """Clockwise moment."""
    return arm[1] * force[0] - arm[0] * force[1]


@every_frame
def test_columns_accelerate_by_the_equation_of_motion_and_the_cap_by_its_kinematics(bodies):
    close = 1e-14 * (bodies.span + bodies.frame.column.size)  # the contacts, in this posture
    for theta, rate, ground in states(bodies):
        q, q_rate = posture(bodies, theta, rate)
        assert np.abs(bodies.gaps(side(theta), q)).max() < close
        found, _ = accelerations(bodies, side(theta), q, q_rate, ground)
        scale = bodies.frame.frequency_parameter**2 + rate**2
        expected = expected_acceleration(bodies.frame, theta, ground)
        assert found[[2, 5]] == pytest.approx([expected] * 2, abs=1e-12 * scale)
        assert found[8] == pytest.approx(0.0, abs=1e-12 * scale)
        cap = cap_acceleration(bodies.frame.column, theta, rate, expected)  # Eqs. (6), (9)
        scale = STANDARD_GRAVITY + bodies.frame.column.size * rate**2
        assert found[6:8] == pytest.approx([float(x) for x in cap], abs=1e-11 * scale)


@every_frame
def test_forces_carry_the_weight_the_push_and_the_moment_of_every_body(bodies):
    frame, column = bodies.frame, bodies.frame.column
    for theta, rate, ground in states(bodies, 4):
        q, q_rate = posture(bodies, theta, rate)
        second, forces = accelerations(bodies, side(theta), q, q_rate, ground)
        load = STANDARD_GRAVITY * np.array([ground, 1.0])
        scale = 1e-12 * (1.0 + frame.mass_ratio) * (STANDARD_GRAVITY + column.size * rate**2)
        # the pivot from the column's centre; the cap's contact is opposite; all turn clockwise
        corner = np.array([side(theta)[0] * column.half_width, -column.half_height])
        cos, sin = math.cos(theta), math.sin(theta)
        foot = np.array([[cos, sin], [-sin, cos]]) @ corner
        for at_ground, at_seat, first in ((0, 2, 0), (1, 3, 3)):
            net = forces[at_ground] - forces[at_seat]
            assert net == pytest.approx(second[first : first + 2] + load, abs=10 * scale)
            moment = lever(foot, forces[at_ground]) + lever(foot, forces[at_seat])
            inertia = column.size**2 / 3
            assert moment == pytest.approx(
                inertia * second[first + 2], abs=100 * scale * column.size
            )
        weight = 2 * frame.mass_ratio
        assert forces[2] + forces[3] == pytest.approx(weight * (second[6:8] + load), abs=10 * scale)
        shift = -side(theta)[0] * column.half_width
        seats = [
            np.array([shift + end * bodies.span / 2, -bodies.cap_depth / 2]) for end in (-1, 1)
        ]
        moment = sum(lever(seat, force) for seat, force in zip(seats, forces[2:], strict=True))
        assert moment == pytest.approx(0.0, abs=100 * scale * bodies.span)


@every_frame
@pytest.mark.parametrize("rate", [0.7, -1.9])
def test_velocity_ratio_at_impact_is_that_of_the_paper(bodies, rate):
    before = posture(bodies, -rate * 1e-300, rate)[1]  # at θ = 0, from the side it comes from
    after, _ = impact(bodies, side(rate), before)
    assert after[[2, 5]] / rate == pytest.approx([bodies.frame.restitution] * 2, abs=1e-12)
    u, v = cap_velocity(bodies.frame.column, rate * 1e-300, after[2])
    assert after[6:] == pytest.approx([u, v, 0.0], abs=1e-12 * bodies.span)


FRAME = RockingFrame(TRILITH, 0.434)
SHAPE = {"span": 1.2, "cap_depth": 0.3}
PULSES = (
    Pulse("one-sine", 0.6, 8.0),
    Pulse("one-cosine", -0.5, 20.0),
    Pulse("ricker-symmetric", 0.5, 12.0),
    Pulse("ricker-symmetric", 0.6, 6.0),
)
rocked = partial(simulate_three_bodies, FRAME, **SHAPE)


def off(history, frame, excitation, duration, **start):
    """Largest |θ − θ of the block| normalised by α, of both columns."""
    block = simulate(frame, excitation, duration=duration, samples=history.time, **start)
    assert np.array_equal(np.isnan(history.rotation[:, 0]), np.isnan(block.rotation))
    return np.nanmax(np.abs(history.rotation - block.rotation[:, None])) / frame.slenderness


def energy(history, frame):
    """Kinetic energy and that of the weight, J, for columns of 1 kg."""
    mass = ThreeBodies(frame, **SHAPE).mass
    lift = history.coordinates[:, [1, 4, 7]] @ mass[[1, 4, 7]]
    return history.velocity**2 @ mass / 2 + STANDARD_GRAVITY * lift


@pytest.mark.sampled(8)
@pytest.mark.parametrize("mass_ratio", WITH_NO_CAP[1:])
@pytest.mark.parametrize("pulse", PULSES, ids=lambda pulse: f"{pulse.shape}-{pulse.amplitude}")
def test_three_bodies_move_as_the_rocking_block(mass_ratio, pulse):
    frame = RockingFrame(TRILITH, mass_ratio)
    history = simulate_three_bodies(frame, pulse, **SHAPE, duration=3.0, samples=200)
    assert off(history, frame, pulse, 3.0) < 1e-7
    block = simulate(frame, pulse, duration=3.0, samples=200)
    assert np.nanmax(np.abs(history.rotation)) > 0.01 * frame.slenderness
    for time in block.impact_times:
        assert np.abs(history.impacts - time).min() < 1e-7
    assert (history.outcome == "overturned") == np.isnan(block.rotation[-1])


@pytest.mark.parametrize("mass_ratio", [0.0, 1.0, 100.0])
def test_three_bodies_rock_to_rest_as_the_rocking_block(mass_ratio):
    frame = RockingFrame(TRILITH, mass_ratio)
    start = {"rotation": -0.6 * frame.slenderness}
    history = simulate_three_bodies(frame, **SHAPE, duration=8.0, samples=200, **start)
    assert off(history, frame, None, 8.0, **start) < 1e-7
    assert history.outcome == "rests"
    # the last bounces are slower than their error, hence the first alone
    assert history.velocity_ratios[:10] == pytest.approx(frame.restitution, abs=1e-11)
    assert not history.velocity[-1].any()


def test_columns_stay_parallel_the_cap_level_and_the_contacts_pressed():
    history = rocked(PULSES[2], duration=3.0, samples=300)
    left, right = history.rotation.T
    assert np.abs(left - right).max() < 1e-11
    u, v = cap_displacement(TRILITH, left)  # Eqs. (4), (7)
    cap = np.stack([u, v, 0.0 * u], axis=1)
    np.testing.assert_allclose(history.coordinates[:, 6:], cap, atol=1e-11)
    assert history.outcome == "rocking"  # the contacts of a survivor press
    moving = np.isfinite(history.forces[:, 0, 0])
    assert history.forces[moving][:, :, 1].min() > 0.0


def test_energy_is_conserved_between_impacts_and_falls_by_the_square_of_the_ratio():
    history = rocked(duration=1.5, rotation=0.7 * FRAME.slenderness, samples=400)
    level = energy(history, FRAME)
    flight = np.searchsorted(history.impacts, history.time, side="right")
    assert flight[-1] >= 2
    means = []
    for number in range(flight[-1] + 1):
        inside = level[flight == number]
        assert np.ptp(inside) < 1e-10 * inside.mean()
        means.append(inside.mean())
    # the upright frame has no potential energy
    np.testing.assert_allclose(np.divide(means[1:], means[:-1]), FRAME.restitution**2, rtol=1e-9)


@pytest.mark.parametrize(("share", "outcome"), [(0.999999, "no uplift"), (1.01, "rests")])
def test_frame_uplifts_beyond_tan_alpha(share, outcome):
    pulse = Pulse("one-sine", share * math.tan(FRAME.slenderness), 10.0)
    history = rocked(pulse, duration=3.0, samples=50)
    assert history.outcome == outcome
    assert history.coordinates.any() == (outcome != "no uplift")


def test_tighter_tolerance_changes_next_to_nothing():
    usual, loose = (
        rocked(PULSES[2], duration=3.0, samples=100, tolerance=tolerance)
        for tolerance in (1e-12, 1e-10)
    )
    assert np.abs(usual.rotation - loose.rotation).max() < 1e-6 * FRAME.slenderness


def test_contacts_that_come_apart_are_an_error():
    with pytest.raises(ArithmeticError, match="a column is upright and another body is"):
        rocked(duration=3.0, rotation=0.9 * FRAME.slenderness, tolerance=1e-2)


def test_span_of_overlapping_columns_is_refused():
    with pytest.raises(ValueError, match=r"span is 0\.1 m; expected more than the width of a col"):
        rocked(duration=1.0, span=0.1)
