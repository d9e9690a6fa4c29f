"""The cap's mass fixed to one column or both, against point masses and known values."""

import math

import numpy as np
import pytest

import topheavy as th
from tests.cases import COLUMN
from topheavy.second import reference

PULSE = th.Pulse("one-cosine", 1.0, 2 * math.pi / 1.5)
POINTS = 200  # of a lattice, along each side of a rectangle


def rectangle(mass, middle, width, depth):
    """Point masses at the centres of the cells of a lattice: x and z (m), and their mass (kg)."""
    cells = (np.arange(POINTS) + 0.5) / POINTS - 0.5
    x, z = np.meshgrid(middle[0] + width * cells, middle[1] + depth * cells)
    return np.stack([x.ravel(), z.ravel(), np.full(x.size, mass / x.size)])


def turning(points):
    """Moments of gravity and of inertia about the origin, and those of a unit ground acceleration.

    Every point of a body that turns clockwise about the origin by the rate 1 has the velocity
    (z, −x).
    """
    x, z, mass = points
    gravity = np.sum(mass * th.STANDARD_GRAVITY * x)
    push = np.sum(mass * th.STANDARD_GRAVITY * z)
    return gravity, push, np.sum(mass * (x**2 + z**2))


def three_numbers(points, half_base):
    """p, α and √r of point masses, placed about the middle of a base of 2 half_base."""
    x, z, mass = points
    gravity, push, inertia = turning(np.stack([x + half_base, z, mass]))
    # Before the impact they turn about the left edge, after it about the right one, at x = B.
    arm = x - half_base
    before = np.sum(mass * (z * z + arm * (x + half_base)))
    after = np.sum(mass * (z * z + arm * arm))
    return math.sqrt(math.hypot(gravity, push) / inertia), gravity / push, before / after


def column_points(axis):
    return rectangle(1.0, (axis, 3.0), 1.0, 6.0)


@pytest.mark.parametrize(
    ("width", "depth"), [(0.0, 0.0), (2.6, 0.6), (0.0, 3.0), (6.0, 0.0)], ids=str
)
@pytest.mark.parametrize("gamma", [0.3, 1.0, 4.0])
def test_fixed_mass_is_what_point_masses_are(gamma, width, depth):
    body = th.FixedMassColumn(COLUMN, gamma, width, depth)
    cap = rectangle(gamma, (0.0, 6.0 + depth / 2), width, depth)
    found = body.frequency_parameter, body.uplift_acceleration, body.restitution
    points = np.concatenate([column_points(0.0), cap], axis=1)
    np.testing.assert_allclose(found, three_numbers(points, 0.5), rtol=2.0 / POINTS**2)


@pytest.mark.parametrize(("depth", "overhang"), [(0.0, 0.0), (0.6, 0.4)])
@pytest.mark.parametrize("span", [1.2, 4.2])
@pytest.mark.parametrize("gamma", [0.3, 4.0])
def test_portal_is_what_point_masses_are(gamma, span, depth, overhang):
    body = th.MonolithicPortal(COLUMN, gamma, span, depth, overhang)
    half = span / 2
    cap = rectangle(2 * gamma, (0.0, 6.0 + depth / 2), span + 1.0 + 2 * overhang, depth)
    points = np.concatenate([column_points(-half), column_points(half), cap], axis=1)
    found = body.frequency_parameter, body.uplift_acceleration, body.restitution
    np.testing.assert_allclose(found, three_numbers(points, half + 0.5), rtol=2.0 / POINTS**2)


@pytest.mark.parametrize(
    ("structure", "p"),
    [
        *((th.FixedMassColumn(COLUMN, g), p) for g, p in ((1.0, 1.35221), (4.0, 1.30027))),
        *((th.RockingFrame(COLUMN, g), p) for g, p in ((1.0, 1.34698), (4.0, 1.29413))),
    ],
)
def test_frequency_parameter_is_the_known_one(structure, p):
    assert structure.frequency_parameter == pytest.approx(p, abs=1e-5)


KNOWN = [
    (COLUMN, 0.27282),
    (th.FixedMassColumn(COLUMN, 1.0), 0.20358),
    (th.FixedMassColumn(COLUMN, 4.0), 0.17634),
    (th.RockingFrame(COLUMN, 1.0), 0.31264),
    (th.RockingFrame(COLUMN, 4.0), 0.32830),
]


@pytest.mark.parametrize(("structure", "known"), KNOWN, ids=str)
def test_minimum_overturning_acceleration_is_the_known_one(structure, known):
    start = structure.uplift_acceleration
    first, *_ = th.overturning_intervals(structure, PULSE, (start, 0.5), resolution=1e-3)
    assert first.lower[0] == pytest.approx(known, abs=1e-4)
    for route in (th.judge, reference.judge):
        low, high = (PULSE.scaled(first.lower[i] * f) for i, f in ((0, 1 - 1e-6), (1, 1 + 1e-6)))
        assert not route(structure, low).overturned
        assert route(structure, high).overturned


@pytest.mark.parametrize("gamma", [0.5, 1.0, 2.0, 10.0])
def test_concentrated_mass_lowers_the_slenderness_by_its_formula(gamma):
    """At γ = 1 to a ninth; that of the frame stays at a sixth."""
    body = th.FixedMassColumn(COLUMN, gamma)
    expected = COLUMN.half_width * (1 + gamma) / (COLUMN.half_height * (1 + 2 * gamma))
    assert math.tan(body.slenderness) == pytest.approx(expected, rel=1e-14)
    assert body.uplift_acceleration == pytest.approx(expected, rel=1e-14)
    assert th.RockingFrame(COLUMN, gamma).uplift_acceleration == pytest.approx(1 / 6, rel=1e-14)


def test_no_fixed_mass_is_the_column():
    body = th.FixedMassColumn(COLUMN, 0.0, 2.6, 0.6)
    for name in ("slenderness", "frequency_parameter", "restitution", "uplift_acceleration"):
        assert getattr(body, name) == pytest.approx(getattr(COLUMN, name), rel=1e-14)
    assert body.equivalent_size == pytest.approx(COLUMN.size, rel=1e-14)


def test_narrow_portal_tends_to_the_column_with_fixed_mass():
    # Two columns that almost coincide, on a base that is wider by their second half width.
    portal = th.MonolithicPortal(th.Column(1e-9, 3.0), 1.0, 2.1e-9)
    column = th.FixedMassColumn(th.Column(1e-9, 3.0), 1.0)
    assert portal.frequency_parameter == pytest.approx(column.frequency_parameter, rel=1e-8)


MAKERS = [
    ("mass_ratio", lambda x: th.FixedMassColumn(COLUMN, x)),
    ("mass_ratio", lambda x: th.MonolithicPortal(COLUMN, x, 4.2)),
    ("cap_width", lambda x: th.FixedMassColumn(COLUMN, 1.0, cap_width=x)),
    ("cap_depth", lambda x: th.FixedMassColumn(COLUMN, 1.0, cap_depth=x)),
    ("span", lambda x: th.MonolithicPortal(COLUMN, 1.0, x)),
    ("cap_depth", lambda x: th.MonolithicPortal(COLUMN, 1.0, 4.2, cap_depth=x)),
    ("overhang", lambda x: th.MonolithicPortal(COLUMN, 1.0, 4.2, overhang=x)),
    ("column", lambda x: th.FixedMassColumn(x, 1.0)),
    ("column", lambda x: th.MonolithicPortal(x, 1.0, 4.2)),
]


@pytest.mark.parametrize(("name", "make"), MAKERS)
def test_impossible_part_is_refused_by_its_name(name, make):
    for value in (-0.1, math.nan, "1", *((math.inf,) if name != "mass_ratio" else ())):
        with pytest.raises(ValueError, match=rf"^{name} is .*; expected"):
            make(value)
