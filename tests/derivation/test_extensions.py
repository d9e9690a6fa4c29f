"""Extensions by computer algebra: many columns, other shapes, a fixed mass."""

import math

import pytest
import sympy as sp

from topheavy import STANDARD_GRAVITY, Column, FixedMassColumn, Pulse, RockingBlock, judge
from topheavy.derivation import (
    contact_theorems,
    extension_theorems,
    extensions,
    fixed_fourth_power,
    fixed_restitution,
    fixed_tangent,
    reversal_theorems,
)
from topheavy.derivation import extension_proofs as extension
from topheavy.derivation import fixed_proofs as proofs
from topheavy.derivation import plane_proofs as plane
from topheavy.derivation import pulse_proofs as pulse
from topheavy.derivation import reversal_proofs as reversal
from topheavy.derivation.bodies import half_depth
from topheavy.derivation.fixed_mass import I_b
from topheavy.derivation.notation import SIDES, R, alpha, g, gamma, m_c


@pytest.mark.parametrize("proofs", [contact_theorems, reversal_theorems, extension_theorems])
def test_every_theorem_holds_and_is_stated(proofs):
    found = proofs()
    assert [proof.id for proof in found if not proof.holds] == []
    assert len({proof.id for proof in found}) == len(found) >= 7
    assert all(proof.statement.endswith(".") for proof in found)


def swapped(side):
    """The motion with a push that does not depend on the rotation."""
    return sp.sin(reversal._phi - alpha) - side.sign * reversal._a


WRONG = [
    (reversal, "exact", swapped, reversal.mass_ratio_leaves_only_the_time_scale),
    (reversal, "exact", swapped, reversal.larger_rotation_feels_the_larger_push),
    (reversal, "exact", swapped, reversal.far_enough_out_nothing_brings_it_back),
    (reversal, "exact", swapped, reversal.push_in_one_direction_only_helps_that_side),
    (
        reversal,
        "linearised",
        lambda side: reversal._phi * (1 + reversal._a) - alpha,
        reversal.difference_is_driven_by_the_heavier_frame,
    ),
    (
        reversal,
        "linearised",
        lambda side: reversal._phi * (1 + reversal._a) - alpha,
        reversal.difference_grows_under_vertical_acceleration,
    ),
    (
        reversal,
        "frequency_ratio",
        lambda: 1 + gamma,
        reversal.mass_ratio_leaves_only_the_time_scale,
    ),
    (
        extension,
        "frame_of_columns",
        lambda side: extensions.frame_of_columns(side) * (1 + gamma / extensions.N),
        extension.columns_count_only_in_the_mass_ratio,
    ),
    (
        extension,
        "lagrange_of_columns",
        lambda side: extensions.lagrange_of_columns(side).subs(gamma, 2 * gamma),
        extension.lagrange_agrees_for_columns,
    ),
    (
        extension,
        "restitution_of_columns",
        lambda side: sp.cos(2 * alpha),
        extension.impacts_do_not_count_the_columns,
    ),
    *(
        (
            extension,
            "frame_of_columns",
            lambda side: extensions.frame_of_columns(side).subs(
                extensions.vertical_acceleration, 2 * extensions.vertical_acceleration
            ),
            proof,
        )
        for proof in (
            extension.vertical_acceleration_adds_to_gravity,
            extension.vertical_acceleration_changes_the_uplift,
            extension.vertical_acceleration_is_a_change_of_gravity_and_push,
        )
    ),
    (
        extension,
        "equation_of_motion",
        lambda side: sp.Eq(0, extensions.printed_motion(side) * R),
        extension.size_only_slows_time,
    ),
    (pulse, "PULSES", pulse.PULSES[::-1], pulse.short_pulses_gain_by_the_order_of_their_moment),
    (plane, "fixed_tangent", lambda: sp.tan(alpha), plane.frame_across_its_plane_is_a_fixed_mass),
    (plane, "_HEIGHT", 2 * plane._HEIGHT, plane.deep_columns_uplift_in_the_plane_first),
    (
        plane,
        "cap_contact",
        lambda side: sp.Matrix([-side.sign * R * sp.sin(alpha), 2 * R * sp.cos(alpha)]),
        plane.level_cap_has_no_balance_across,
    ),
]


@pytest.mark.parametrize(
    ("module", "name", "spoilt", "proof"),
    WRONG,
    ids=[f"{row[3].__name__}-{row[1]}" for row in WRONG],
)
def test_proof_fails_for_what_is_false(monkeypatch, module, name, spoilt, proof):
    monkeypatch.setattr(module, name, spoilt)
    assert not proof()


def test_many_columns_move_as_three_bodies_do_for_two():
    """The equation of N columns against numbers: p̂², the push and the vertical acceleration."""
    values = {alpha: 0.2, gamma: 1.5, R: 2.0, g: 9.81, extensions.vertical_acceleration: -1.7}
    for side in SIDES:
        motion = extensions.frame_of_columns(side).subs(values)
        push = sp.Symbol(r"\ddot{u}_g", real=True)
        found = float(motion.subs({push: 3.0, side.rotation: side.sign * 0.05}))
        p_squared = 4.0 / 5.5 * 3.0 * 9.81 / 8.0
        stated = side.sign * math.sin(0.15) * (1.0 - 1.7 / 9.81) + 3.0 / 9.81 * math.cos(0.15)
        assert found == pytest.approx(-p_squared * stated)


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
    fourth = float(fixed_fourth_power().subs(given))
    assert body.frequency_parameter**4 == pytest.approx(fourth, rel=1e-12)
    assert body.restitution == pytest.approx(float(fixed_restitution().subs(given)), rel=1e-12)


_CAP = gamma * sp.sin(alpha) ** 2 / 50
_LIGHTER = 1 / (1 + gamma)
WRONG_FIXED_MASS = [
    (proofs.fixed_mass_lowers_the_uplift_acceleration, "fixed_tangent", lambda t: t / _LIGHTER),
    (proofs.fixed_mass_rocks_as_one_column, "fixed_tangent", lambda t: t * (1 + _CAP)),
    (proofs.fixed_mass_rocks_as_one_column, "fixed_fourth_power", lambda p: p * (1 + _CAP)),
    (proofs.fixed_mass_tends_to_the_column, "fixed_fourth_power", sp.sqrt),
    (
        proofs.energies_give_the_same_motion_of_the_fixed_mass,
        "fixed_lagrange",
        lambda motion: motion * (1 + _CAP),
    ),
    (
        proofs.impulses_give_the_restitution_of_the_fixed_mass,
        "fixed_restitution",
        lambda r: r - _CAP,
    ),
    (proofs.fixed_mass_tends_to_a_point_on_a_stalk, "fixed_restitution", lambda r: r * _LIGHTER),
    (proofs.fixed_mass_keeps_more_velocity, "fixed_restitution", lambda r: r - 10 * _CAP),
    (proofs.fixed_mass_slows_the_column, "fixed_fourth_power", lambda p: 3 * p),
    (proofs.freed_mass_slows_the_column_more, "fixed_fourth_power", lambda p: p / 3),
]


@pytest.mark.parametrize(
    ("prove", "name", "spoil"),
    WRONG_FIXED_MASS,
    ids=[f"{row[0].__name__}, {row[1]}" for row in WRONG_FIXED_MASS],
)
def test_a_proof_fails_on_a_wrong_result(monkeypatch, prove, name, spoil):
    right = getattr(proofs, name)
    monkeypatch.setattr(proofs, name, lambda *arguments: spoil(right(*arguments)))
    assert not prove()


@pytest.mark.parametrize("factor", [0.9999, 1.0001])
def test_kernel_has_the_minimum_of_the_growing_term(factor):
    """One cosine uplifts at once, and its integral is (1 − e^(−2πp/ω))/(1 + ω²/p²)."""
    block = RockingBlock(1.0, 0.1, 0.9, linearised=True)
    minimum = (1.0 + 12.0**2) / (1.0 - math.exp(-2.0 * math.pi / 12.0)) * 0.1
    found = judge(block, Pulse("one-cosine", factor * minimum, 12.0))
    assert found.overturned is (factor > 1.0)
