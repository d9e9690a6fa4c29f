"""Extensions by computer algebra: many columns, other shapes, a fixed mass."""

import math

import pytest
import sympy as sp

from derivation import extensions, fixed_mass, reversals
from derivation.fixed_mass import (
    I_b,
    fixed_motion,
    fixed_restitution,
    fixed_tangent,
)
from derivation.notation import (
    NEGATIVE,
    N,
    R,
    alpha,
    g,
    gamma,
    ground_acceleration,
    half_depth,
    m_c,
    vertical_acceleration,
)
from topheavy import STANDARD_GRAVITY, Column, FixedMassColumn, Pulse, RockingBlock, judge


def swapped(side):
    """The motion with a push that does not depend on the rotation."""
    return sp.sin(reversals._phi - alpha) - side.sign * reversals._a


def pushed_by_angle(side):
    return reversals._phi * (1 + reversals._a) - alpha


def doubled(side):
    """Twice the vertical acceleration."""
    return right(side).subs(vertical_acceleration, 2 * vertical_acceleration)


right = extensions.frame_of_columns
_CAP = gamma * sp.sin(alpha) ** 2 / 50
_LIGHTER = 1 / (1 + gamma)
REVERSALS = [
    ("exact", swapped, "mass_ratio_leaves_only_the_time_scale"),
    ("exact", swapped, "larger_rotation_feels_the_larger_push"),
    ("exact", swapped, "far_enough_out_nothing_brings_it_back"),
    ("exact", swapped, "push_in_one_direction_only_helps_that_side"),
    ("linearised", pushed_by_angle, "difference_is_driven_by_the_heavier_frame"),
    ("linearised", pushed_by_angle, "difference_grows_under_vertical_acceleration"),
    ("frequency_ratio", lambda: 1 + gamma, "mass_ratio_leaves_only_the_time_scale"),
]
EXTENSIONS = [
    ("frame_of_columns", lambda s: N * right(s), "columns_count_only_in_the_mass_ratio"),
    ("restitution_of_columns", lambda s: sp.cos(2 * alpha), "impacts_do_not_count_the_columns"),
    ("frame_of_columns", doubled, "vertical_acceleration_is_a_change_of_gravity_and_push"),
    ("equation_of_motion", lambda s: sp.Eq(0, R * right(s)), "size_only_slows_time"),
    ("fixed_tangent", lambda: sp.tan(alpha), "frame_across_its_plane_is_a_fixed_mass"),
    ("_HEIGHT", 2 * extensions._HEIGHT, "deep_columns_uplift_in_the_plane_first"),
    (
        "cap_contact",
        lambda side: sp.Matrix([-side.sign * R * sp.sin(alpha), 2 * R * sp.cos(alpha)]),
        "level_cap_has_no_balance_across",
    ),
    ("PULSES", extensions.PULSES[::-1], "short_pulses_gain_by_the_order_of_their_moment"),
]
fixed = {name: getattr(fixed_mass, name) for name in dir(fixed_mass) if name.startswith("fixed_")}
FIXED_MASS = [
    (name, lambda *side, name=name, spoil=spoil: spoil(fixed[name](*side)), proof)
    for name, spoil, proof in (
        ("fixed_tangent", lambda t: t / _LIGHTER, "fixed_mass_lowers_the_uplift_acceleration"),
        ("fixed_tangent", lambda t: t * (1 + _CAP), "fixed_mass_rocks_as_one_column"),
    )
]
WRONG = [
    (module, *row)
    for module, rows in ((reversals, REVERSALS), (extensions, EXTENSIONS), (fixed_mass, FIXED_MASS))
    for row in rows
]


@pytest.mark.parametrize(
    ("module", "name", "spoilt", "proof"), WRONG, ids=[f"{row[3]}-{row[1]}" for row in WRONG]
)
def test_proof_fails_for_what_is_false(monkeypatch, module, name, spoilt, proof):
    monkeypatch.setattr(module, name, spoilt)
    assert not getattr(module, proof)()


def values(body):
    """The body's lengths and masses in the symbols of the derivation, for a column of 1 kg."""
    column, ratio = body.column, body.mass_ratio
    spin = ratio * (body.cap_width**2 + body.cap_depth**2) / 12
    return {
        R: column.size,
        alpha: column.slenderness,
        g: STANDARD_GRAVITY,
        gamma: ratio,
        m_c: 1.0,
        half_depth: body.cap_depth / 2,
        I_b: spin,
    }


@pytest.mark.parametrize("slenderness", [0.05, 0.165, 0.6])
@pytest.mark.parametrize("ratio", [0.1, 1.0, 7.0])
@pytest.mark.parametrize("cap", [(0.0, 0.0), (2.6, 0.6)], ids=["concentrated", "rectangle"])
def test_library_follows_the_derivation(slenderness, ratio, cap):
    body = FixedMassColumn(Column(math.sin(slenderness), math.cos(slenderness)), ratio, *cap)
    given = values(body)
    assert body.uplift_acceleration == pytest.approx(float(fixed_tangent().subs(given)), rel=1e-12)
    # θ̈ at rest is p'² sin α', and its derivative by |θ| is −p'² cos α'
    free = fixed_motion(NEGATIVE).subs(given | {ground_acceleration: 0})
    ends = (NEGATIVE.upright(x).evalf() for x in (free, sp.diff(free, NEGATIVE.rotation)))
    assert body.frequency_parameter**2 == pytest.approx(math.hypot(*ends), rel=1e-12)
    assert body.restitution == pytest.approx(float(fixed_restitution().subs(given)), rel=1e-12)


@pytest.mark.parametrize("factor", [0.9999, 1.0001])
def test_kernel_has_the_minimum_of_the_growing_term(factor):
    """One cosine uplifts at once, and its integral is (1 − e^(−2πp/ω))/(1 + ω²/p²)."""
    block = RockingBlock(1.0, 0.1, 0.9, linearised=True)
    minimum = (1.0 + 12.0**2) / (1.0 - math.exp(-2.0 * math.pi / 12.0)) * 0.1
    found = judge(block, Pulse("one-cosine", factor * minimum, 12.0))
    assert found.overturned is (factor > 1.0)
