"""Structures: columns, frames, frames with γ → ∞, and columns that carry a fixed mass."""

import math
import sys

import numpy as np
import pytest

import topheavy as th
from tests.cases import COLUMN
from topheavy import STANDARD_GRAVITY as G
from topheavy import Column, RockingBlock, RockingFrame
from topheavy.bodies.structures import simplified

WIDE = Column(0.5, 2.0)  # tan α = 1/4
STOCKY = Column(2.0, 1.0)  # α = 63.4°: Housner's √r is 1 − 1.5 · 0.8 = −0.2
TRILITH = RockingFrame(Column(0.11, 0.40), 0.434)
RATIOS = [0.0, 1e-6, 0.1, 0.434, 1.0, 4.0, 13.23, 1e3, math.inf]
SLENDERNESSES = [math.radians(degrees) for degrees in (2.0, 5.0, 8.0, 14.0, 25.0, 40.0)]
EVERY_COLUMN = pytest.mark.parametrize("alpha", SLENDERNESSES)


def column_of(slenderness, size=2.0):
    return Column(size * math.sin(slenderness), size * math.cos(slenderness))


UNIT = RockingFrame(column_of(0.25), 1.0)
PRINTED = {  # value, as printed, relative tolerance
    "Eq. (25), α = 0.25, γ = 1: √r": (UNIT.restitution, 0.885234, 1e-6),
    "Eq. (23), γ = 1: p̂/p": (
        *(UNIT.frequency_parameter / UNIT.column.frequency_parameter, 0.866025, 1e-6),
    ),
    "Eq. (24), γ = 1: R̂/R": (UNIT.equivalent_size / UNIT.column.size, 4 / 3, 1e-6),
    "trilith: R (m)": (TRILITH.column.size, 0.41485, 1e-3),
    "trilith: p (rad/s)": (TRILITH.column.frequency_parameter, 4.211, 1e-3),
    "trilith: p̂ (rad/s)": (TRILITH.frequency_parameter, 3.794, 1e-3),
    "trilith: uplift (g)": (TRILITH.uplift_acceleration, 0.275, 1e-3),
    "trilith: α (degrees)": (math.degrees(TRILITH.slenderness), 15.38, 1e-3),
    "trilith: base acceleration (g)": (0.005 * (2 * math.pi * 3.3) ** 2 / G, 0.2191, 1e-3),
    "gravity (m/s²)": (G, 9.81, 0.0),
}


@pytest.mark.parametrize(("value", "printed", "tolerance"), PRINTED.values(), ids=PRINTED)
def test_printed_value_is_met(value, printed, tolerance):
    assert value == pytest.approx(printed, rel=tolerance)


# ---------------------------------------------------------------------------- the frame


@pytest.mark.parametrize("gamma", RATIOS[:-1])
@EVERY_COLUMN
def test_frame_follows_from_energy_and_momentum(alpha, gamma):
    """Of one column, which turns about a corner, and its half of the cap, on the corner across.

    The impulses of an impact act at the new contacts: about the new corner, only that of the cap
    changes the angular momentum of the column, by the change of the cap's momentum.
    """
    frame = RockingFrame(column_of(alpha), gamma)
    b, h = frame.column.half_width, frame.column.half_height
    inertia = 4 / 3 * 4.0 + gamma * 4.0**2
    p = math.sqrt(G * (2.0 + 2 * gamma * 2.0) / inertia)
    assert frame.frequency_parameter == pytest.approx(p, rel=1e-14)
    twin = column_of(alpha, frame.equivalent_size)
    assert twin.frequency_parameter == pytest.approx(p, rel=1e-14)

    def momentum(point, pivot):  # about the new corner, of a unit mass that turns about a pivot
        arm, lever = np.subtract(point, pivot), np.subtract(point, (b, 0.0))
        return lever @ arm

    before = 4.0 / 3 + momentum((0, h), (-b, 0)) + gamma * (-2 * b * 0 + 0)
    cap_before = gamma * (np.subtract((-b, 2 * h), (b, 0.0)) @ np.subtract((b, 2 * h), (-b, 0.0)))
    after = 4.0 / 3 + momentum((0, h), (b, 0)) + gamma * momentum((-b, 2 * h), (b, 0))
    assert frame.restitution == pytest.approx((before + cap_before) / after, rel=1e-11)
    assert (frame.restitution < frame.column.restitution) == (gamma > 0.0)


@pytest.mark.parametrize("gamma", [1e12, 1e160, sys.float_info.max, math.inf])
@EVERY_COLUMN
def test_frame_under_a_boundless_cap_reaches_the_massless_column_limit(alpha, gamma):
    column, frame = column_of(alpha), RockingFrame(column_of(alpha), gamma)
    numbers = (frame.frequency_parameter, frame.equivalent_size, frame.restitution)
    expected = (math.sqrt(2 / 3) * column.frequency_parameter, 3.0, math.cos(2 * alpha))
    assert numbers == pytest.approx(expected, rel=1e-10)


def test_masses_give_the_mass_ratio_of_any_number_of_columns():
    assert RockingFrame.of_masses(WIDE, 265.0, 305.3) == RockingFrame(WIDE, 265.0 / 610.6)
    six = RockingFrame.of_masses(WIDE, 6.0, 2.0, columns=np.int64(6))
    assert six == RockingFrame(WIDE, 0.5, 6)
    assert six.block() == RockingFrame(WIDE, 0.5).block()
    assert RockingFrame.of_masses(WIDE, 0.0, 2.0).mass_ratio == 0.0


# ---------------------------------------------------------------------------- the block


@pytest.mark.parametrize("structure", [WIDE, *(RockingFrame(WIDE, g) for g in RATIOS), STOCKY])
def test_block_has_the_three_numbers_of_its_structure(structure):
    p, alpha = structure.frequency_parameter, structure.slenderness
    if structure is not STOCKY:
        assert structure.block() == RockingBlock(p, alpha, structure.restitution, linearised=False)
    for restitution in (0.0, 0.5, 1.0):
        block = RockingBlock(p, alpha, restitution)
        assert structure.block(restitution=restitution) == block
        assert block.linear() == RockingBlock(p, alpha, restitution, linearised=True)
        assert block.linear().linear() == block.linear()
        assert block.linear().with_restitution(0.3) == RockingBlock(p, alpha, 0.3, linearised=True)
        lifts = block.uplift_acceleration, block.linear().uplift_acceleration
        assert lifts == pytest.approx((math.tan(alpha), alpha), rel=1e-15)


# ---------------------------------------------------------------------------- a fixed mass

POINTS = 200  # of a lattice, along each side of a rectangle


def rectangle(mass, middle, width, depth):
    """Point masses at the centres of the cells of a lattice: x and z (m), and their mass (kg)."""
    cells = (np.arange(POINTS) + 0.5) / POINTS - 0.5
    x, z = np.meshgrid(middle[0] + width * cells, middle[1] + depth * cells)
    return np.stack([x.ravel(), z.ravel(), np.full(x.size, mass / x.size)])


def three_numbers(points, half_base):
    """p, α and √r of point masses, placed about the middle of a base of 2 half_base."""
    x, z, mass = points
    # Before the impact they turn about the left edge, after it about the right one, at x = B.
    left, right = x + half_base, x - half_base
    gravity, push = np.sum(mass * left), np.sum(mass * z)  # their moments over g
    inertia, after = (np.sum(mass * (arm * arm + z * z)) for arm in (left, right))
    before = np.sum(mass * (z * z + right * left))
    p = math.sqrt(th.STANDARD_GRAVITY * math.hypot(gravity, push) / inertia)
    return p, gravity / push, before / after


def column_points(axis):
    return rectangle(1.0, (axis, 3.0), 1.0, 6.0)


@pytest.mark.parametrize(
    ("width", "depth"), [(0.0, 0.0), (2.6, 0.6), (0.0, 3.0), (6.0, 0.0)], ids=str
)
@pytest.mark.parametrize("gamma", [0.3, 1.0, 4.0])
def test_fixed_mass_is_what_point_masses_are(gamma, width, depth):
    body = th.FixedMassColumn(COLUMN, gamma, width, depth)
    cap = rectangle(gamma, (0.0, 6.0 + depth / 2), width, depth)
    numbers = body.frequency_parameter, body.uplift_acceleration, body.restitution
    points = np.concatenate([column_points(0.0), cap], axis=1)
    np.testing.assert_allclose(numbers, three_numbers(points, 0.5), rtol=2.0 / POINTS**2)


@pytest.mark.parametrize(("depth", "overhang"), [(0.0, 0.0), (0.6, 0.4)])
@pytest.mark.parametrize("span", [1.2, 4.2])
@pytest.mark.parametrize("gamma", [0.3, 4.0])
def test_portal_is_what_point_masses_are(gamma, span, depth, overhang):
    body = th.MonolithicPortal(COLUMN, gamma, span, depth, overhang)
    half = span / 2
    cap = rectangle(2 * gamma, (0.0, 6.0 + depth / 2), span + 1.0 + 2 * overhang, depth)
    points = np.concatenate([column_points(-half), column_points(half), cap], axis=1)
    numbers = body.frequency_parameter, body.uplift_acceleration, body.restitution
    np.testing.assert_allclose(numbers, three_numbers(points, half + 0.5), rtol=2.0 / POINTS**2)


def test_no_fixed_mass_is_the_column():
    body = th.FixedMassColumn(COLUMN, 0.0, 2.6, 0.6)
    for name in ("slenderness", "frequency_parameter", "restitution", "uplift_acceleration"):
        assert getattr(body, name) == pytest.approx(getattr(COLUMN, name), rel=1e-14)
    assert body.equivalent_size == pytest.approx(COLUMN.size, rel=1e-14)


FRAME = RockingFrame(WIDE, 1.0)


@pytest.mark.parametrize(
    ("simplification", "changed"),
    [
        ("linearised", {"linearised"}),
        ("massless frequency", {"frequency_parameter"}),
        ("massless restitution", {"restitution"}),
        ("all", {"linearised", "frequency_parameter", "restitution"}),
    ],
)
def test_each_simplification_changes_what_it_names_and_nothing_else(simplification, changed):
    exact, simple = FRAME.block(), simplified(FRAME)[simplification]
    names = RockingBlock.__dataclass_fields__
    assert {name for name in names if getattr(exact, name) != getattr(simple, name)} == changed


def test_massless_columns_have_the_limits_of_the_paper():
    simple = simplified(FRAME)["all"]
    p, alpha = WIDE.frequency_parameter, WIDE.slenderness
    assert simple.frequency_parameter == pytest.approx(p * math.sqrt(2 / 3), rel=1e-15)
    assert simple.restitution == pytest.approx(math.cos(2 * alpha), rel=1e-15)
    # the pendulum of two columns without mass: p̂² = g/2R
    assert simple.frequency_parameter**2 == pytest.approx(9.81 / (2 * WIDE.size), rel=1e-15)
