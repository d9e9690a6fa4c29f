"""Ends of the portal's columns against sums over particles, least work, and known limits."""

import math

import numpy as np
import pytest

from topheavy import STANDARD_GRAVITY, Column, MonolithicPortal
from topheavy.forces.portal import resting_portal_forces, rocking_portal_forces

COLUMN = Column(0.5, 3.0)
PORTALS = [
    MonolithicPortal(COLUMN, gamma, span, 0.6, overhang)
    for gamma, span, overhang in ((0.0, 2.4, 0.0), (1.0, 4.2, 0.4), (math.inf, 5.0, 0.0))
]
STATES = [(0.05, 0.2, 0.1), (-0.03, 0.1, -0.4), (0.12, -0.3, 0.5), (0.0, -0.4, 0.2)]


def particles(share, middle, width, depth):
    """Gauss points of a homogeneous rectangle: places across and up, and weights."""
    nodes, weights = np.polynomial.legendre.leggauss(4)
    across, up = np.meshgrid(middle[0] + width / 2 * nodes, middle[1] + depth / 2 * nodes)
    return across.ravel(), up.ravel(), share * np.outer(weights, weights).ravel() / 4


def resultant(portal, bodies, about, state):
    """Transverse and axial force and moment that these bodies take, in the portal's own axes.

    θ̈ is that of the portal's moments about its pivot, not that of its p' and α'.
    """
    theta, rate, ground = state
    side = math.copysign(1.0, theta or rate)

    def moved(parts):
        across, up, mass = np.concatenate(parts, axis=1)
        arm = across - side * portal.half_base
        x, z = (
            arm * math.cos(theta) + up * math.sin(theta),
            up * math.cos(theta) - arm * math.sin(theta),
        )
        return x, z, mass

    x, z, mass = moved(whole(portal))
    second = STANDARD_GRAVITY * (mass @ (x - ground * z)) / (mass @ (x * x + z * z))
    x, z, mass = moved(bodies)
    pull_x = mass * (ground + (second * z - rate**2 * x) / STANDARD_GRAVITY)
    pull_z = mass * (1.0 - (second * x + rate**2 * z) / STANDARD_GRAVITY)
    (at_x,), (at_z,), _ = moved([np.array([[about[0]], [about[1]], [0.0]])])
    moment = ((x - at_x) * pull_z - (z - at_z) * pull_x).sum()
    cos, sin = math.cos(theta), math.sin(theta)
    force_x, force_z = pull_x.sum(), pull_z.sum()
    return force_x * cos - force_z * sin, force_x * sin + force_z * cos, moment


def whole(portal):
    """Left column, right column and cap beam."""
    cap = 1.0 if portal.mass_ratio == math.inf else portal.mass_ratio / (1 + portal.mass_ratio)
    half, depth = portal.span / 2, portal.cap_depth
    columns = [particles((1 - cap) / 2, (end * half, 3.0), 1.0, 6.0) for end in (-1, 1)]
    width = 2 * (portal.half_base + portal.overhang)
    return [*columns, particles(cap, (0.0, 6.0 + depth / 2), width, depth)]


@pytest.mark.parametrize("state", STATES)
@pytest.mark.parametrize("portal", PORTALS, ids=str)
def test_rocking_ends_carry_all_that_is_above_them(portal, state):
    """The free column hangs from its joint; the joint of the other carries beam and free column."""
    found, (left, right, cap) = rocking_portal_forces(portal, *state), whole(portal)
    bears = int((state[0] or state[1]) > 0)
    hangs, place = 1 - bears, [(end * portal.span / 2, 6.0) for end in (-1, 1)]
    free = (left, right)[hangs]
    above = {
        ("joint", hangs): -np.array(resultant(portal, [free], place[hangs], state)),
        ("joint", bears): resultant(portal, [free, cap], place[bears], state),
        ("base", hangs): np.zeros(3),
        ("base", bears): resultant(portal, [left, right, cap], (place[bears][0], 0.0), state),
    }
    for (end, column), expected in above.items():
        ours = [part[column] for part in getattr(found, end)]
        np.testing.assert_allclose(ours, expected, atol=1e-12)


def by_least_work(portal, bases, ground):
    """Shear, axial force and moment of both bases, whose columns store the least bending energy."""
    cap = 1.0 if portal.mass_ratio == math.inf else portal.mass_ratio / (1 + portal.mass_ratio)
    nodes, weights = np.polynomial.legendre.leggauss(6)
    z, root, span = 3.0 * (1 + nodes), np.sqrt(weights), portal.span
    load = (1 - cap) / 2 * ground / 6.0 * z**2 / 2
    # Unknown T, N, M of the left base; those of the right one are left over by equilibrium.
    overturning = -ground * portal.centre_height - span / 2
    left = np.stack([z, 0 * z, 1 + 0 * z], axis=1)
    right = np.stack([-z, span + 0 * z, -1 + 0 * z], axis=1)
    energy = root[:, None] * left, root[:, None] * right
    given = root * load, root * (load - ground * z - overturning)
    tight = 1e6 if bases == "pinned" else 0.0  # how hard both moments at the bases are held at 0
    tied = tight * np.array([[0, 0, 1], [0, span, -1]]), tight * np.array([0, -overturning])
    unknown, *_ = np.linalg.lstsq(
        np.vstack([*energy, tied[0]]), np.concatenate([*given, tied[1]]), rcond=None
    )
    shear, axial, moment = unknown
    other = [ground - shear, 1 - axial, overturning + span * axial - moment]
    return np.stack([unknown, other], axis=1)


@pytest.mark.parametrize("bases", ["fixed", "pinned"])
@pytest.mark.parametrize("portal", PORTALS, ids=str)
def test_resting_bases_are_those_of_least_work(portal, bases):
    found = resting_portal_forces(portal, bases, 0.3)
    np.testing.assert_allclose(found.base, by_least_work(portal, bases, 0.3), atol=1e-9)


@pytest.mark.parametrize("bases", ["fixed", "pinned"])
@pytest.mark.parametrize("portal", PORTALS, ids=str)
def test_resting_cap_beam_is_in_balance(portal, bases):
    joint = resting_portal_forces(portal, bases, 0.3).joint
    cap = 1.0 if portal.mass_ratio == math.inf else portal.mass_ratio / (1 + portal.mass_ratio)
    assert joint.shear.sum() == pytest.approx(0.3 * cap, abs=1e-14)
    assert joint.axial.sum() == pytest.approx(cap, abs=1e-14)
    couple = portal.span / 2 * np.diff(joint.axial) + joint.moment.sum()
    assert couple + 0.3 * cap * 0.3 == pytest.approx(0.0, abs=1e-14)  # depth/2 over the joints


@pytest.mark.parametrize("bases", ["fixed", "pinned"])
@pytest.mark.parametrize("sign", [-1, 1])
@pytest.mark.parametrize("portal", PORTALS, ids=str)
def test_both_descriptions_have_the_same_resultants_at_uplift(portal, sign, bases):
    """Where the ground's force reaches the corner, quasi-statically."""
    ground = sign * portal.uplift_acceleration
    rocking = rocking_portal_forces(portal, 0.0, 0.0, ground).base
    resting = resting_portal_forces(portal, bases, ground).base
    for base in (rocking, resting):
        overturning = base.moment.sum() + portal.span / 2 * np.diff(base.axial)
        assert base.shear.sum() == pytest.approx(ground, rel=1e-12)
        assert base.axial.sum() == pytest.approx(1.0, rel=1e-12)
        assert overturning == pytest.approx(-ground * portal.centre_height, rel=1e-12)
    assert np.isnan(rocking_portal_forces(portal, 0.0, 0.0, 0.999 * ground).joint).all()


def test_other_feet_are_refused():
    with pytest.raises(ValueError, match=r"bases is 'guided'; expected 'fixed'.*or 'pinned'"):
        resting_portal_forces(PORTALS[1], "guided", 0.1)
