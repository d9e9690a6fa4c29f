"""The derived fixed mass against the library, and the proofs against wrong results."""

import math

import pytest
import sympy as sp

from topheavy import STANDARD_GRAVITY, Column, FixedMassColumn
from topheavy.derivation import (
    fixed_fourth_power,
    fixed_restitution,
    fixed_tangent,
)
from topheavy.derivation import fixed_proofs as proofs
from topheavy.derivation.bodies import half_depth
from topheavy.derivation.fixed_mass import I_b
from topheavy.derivation.notation import R, alpha, g, gamma, m_c


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

WRONG = [
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
    ("prove", "name", "spoil"), WRONG, ids=[f"{row[0].__name__}, {row[1]}" for row in WRONG]
)
def test_a_proof_fails_on_a_wrong_result(monkeypatch, prove, name, spoil):
    right = getattr(proofs, name)
    monkeypatch.setattr(proofs, name, lambda *arguments: spoil(right(*arguments)))
    assert not prove()
