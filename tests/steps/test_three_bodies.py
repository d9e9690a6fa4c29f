"""Three bodies: their motion, and their forces by Newton and Euler."""

import math
from functools import partial

import numpy as np
import pytest

from steps.shared.newton_euler import ThreeBodies
from steps.shared.three_bodies import simulate_three_bodies
from topheavy import STANDARD_GRAVITY, Cap, Column, Pulse, RockingFrame, simulate
from topheavy.bodies.kinematics import cap_displacement

TRILITH = Column(0.11, 0.4)
FRAME = RockingFrame(TRILITH, 0.434)
CAP = Cap(span=1.2, half_depth=0.15)
PULSES = (
    Pulse("one-sine", 0.6, angular_frequency=8.0),
    Pulse("one-cosine", -0.5, angular_frequency=20.0),
    Pulse("ricker-symmetric", 0.5, angular_frequency=12.0),
    Pulse("ricker-symmetric", 0.6, angular_frequency=6.0),
)
rocked = partial(simulate_three_bodies, FRAME, CAP)


def off(history, frame, excitation, duration):
    """Largest |θ − θ of the block| normalised by α, of both columns."""
    block = simulate(frame, excitation, duration=duration, samples=history.time)
    assert np.array_equal(np.isnan(history.rotation[:, 0]), np.isnan(block.rotation))
    return np.nanmax(np.abs(history.rotation - block.rotation[:, None])) / frame.slenderness


def energy(history, frame):
    """Kinetic energy and that of the weight, J, for columns of 1 kg."""
    mass = ThreeBodies(frame, CAP).mass
    lift = history.coordinates[:, [1, 4, 7]] @ mass[[1, 4, 7]]
    return history.velocity**2 @ mass / 2 + STANDARD_GRAVITY * lift


@pytest.mark.sampled(8)
@pytest.mark.parametrize("mass_ratio", [0.01, 0.434, 1.0, 10.0, 100.0])
@pytest.mark.parametrize("pulse", PULSES, ids=lambda pulse: f"{pulse.shape}-{pulse.amplitude}")
def test_three_bodies_move_as_the_rocking_block(mass_ratio, pulse):
    frame = RockingFrame(TRILITH, mass_ratio)
    history = simulate_three_bodies(frame, CAP, pulse, duration=3.0, samples=200)
    assert off(history, frame, pulse, 3.0) < 1e-7
    block = simulate(frame, pulse, duration=3.0, samples=200)
    assert np.nanmax(np.abs(history.rotation)) > 0.01 * frame.slenderness
    for time in block.impact_times:
        assert np.abs(history.impacts - time).min() < 1e-7
    assert (history.outcome == "overturned") == np.isnan(block.rotation[-1])


@pytest.mark.parametrize("mass_ratio", [0.0, 1.0, 100.0])
def test_three_bodies_rock_to_rest_as_the_rocking_block(mass_ratio):
    frame = RockingFrame(TRILITH, mass_ratio)
    history = simulate_three_bodies(frame, CAP, PULSES[2], duration=12.0, samples=200)
    assert off(history, frame, PULSES[2], 12.0) < 1e-7
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
    pulse = PULSES[2]  # and it rocks freely when the pulse has ended
    history = rocked(pulse, duration=4.0, samples=np.linspace(pulse.duration + 1e-9, 4.0, 800))
    level = energy(history, FRAME)
    flight = np.searchsorted(history.impacts, history.time, side="right")
    means = []
    for number in range(flight[0], flight[0] + 4):
        inside = level[flight == number]
        assert np.ptp(inside) < 1e-10 * inside.mean()
        means.append(inside.mean())
    # the upright frame has no potential energy
    np.testing.assert_allclose(np.divide(means[1:], means[:-1]), FRAME.restitution**2, rtol=1e-9)


@pytest.mark.parametrize(("share", "outcome"), [(0.999999, "no uplift"), (1.01, "rests")])
def test_frame_uplifts_beyond_tan_alpha(share, outcome):
    pulse = Pulse("one-sine", share * math.tan(FRAME.slenderness), angular_frequency=10.0)
    history = rocked(pulse, duration=3.0, samples=50)
    assert history.outcome == outcome
    assert history.coordinates.any() == (outcome != "no uplift")


def test_contacts_that_come_apart_are_an_error(monkeypatch):
    monkeypatch.setattr("steps.shared.three_bodies.TOLERANCE", 1e-2)
    with pytest.raises(ArithmeticError, match="a column is upright and another body is"):
        rocked(PULSES[2], duration=3.0)
