"""The proofs hold, say something, and fail when what they prove is false."""

import numpy as np
import pytest
import sympy as sp

from topheavy.derivation import column_restitution, restitution, theorems
from topheavy.derivation import impact_proofs as impact
from topheavy.derivation import motion_proofs as motion
from topheavy.derivation.notation import alpha, gamma


def test_every_theorem_holds_and_is_stated():
    proofs = theorems()
    assert [proof.id for proof in proofs if not proof.holds] == []
    assert len({proof.id for proof in proofs}) == len(proofs) >= 20
    assert all(proof.statement.endswith(".") for proof in proofs)


def test_statements_about_impacts_hold_over_a_grid():
    frame = sp.lambdify((alpha, gamma), restitution())
    column = sp.lambdify(alpha, column_restitution())
    angle, ratio = np.meshgrid(np.linspace(0.01, 1.56, 300), np.geomspace(1e-3, 1e3, 61))
    root, solitary, x = frame(angle, ratio), column(angle), np.tan(angle) ** 2
    deficit = 3 * ratio * np.sin(angle) ** 2 / (2 * (1 + 3 * ratio))
    np.testing.assert_allclose(solitary - root, deficit, rtol=1e-9, atol=1e-15)
    np.testing.assert_array_equal(root > 0, x < 2 * (1 + 3 * ratio) / (1 + 6 * ratio))
    np.testing.assert_array_equal(root**2 < solitary**2, x < 4 * (1 + 3 * ratio) / (2 + 9 * ratio))
    assert np.all(root**2 < 1)
    assert np.all(root**2 < solitary**2, where=root >= 0)
    assert np.any(root**2 > solitary**2)


_SMALL = gamma * sp.sin(alpha) ** 4 / 50

WRONG = [
    (motion, "size_ratio", lambda ratio: 1 / ratio, motion.size_grows_to_a_limit),
    (motion, "frequency_ratio", lambda ratio: ratio**2, motion.frequency_falls_to_a_limit),
    (motion, "quadratic_terms", lambda t: (t[0], 2 * t[1]), motion.quadratic_terms_cancel),
    (motion, "potential_energy", lambda v: 1.01 * v, motion.energy_is_conserved_between_impacts),
    (impact, "restitution", lambda r: r + _SMALL, impact.restitution_is_below_the_columns),
    (
        impact,
        "restitution",
        lambda r: r + _SMALL,
        impact.frame_rocks_on_below_its_largest_slenderness,
    ),
    (
        impact,
        "column_restitution",
        lambda r: r - _SMALL,
        impact.frame_loses_the_larger_share_when_slender,
    ),
    (impact, "largest_slenderness", lambda a: a / 2, impact.heavier_caps_need_slenderer_columns),
]


@pytest.mark.parametrize(
    ("module", "name", "spoil", "proof"), WRONG, ids=[row[-1].__name__ for row in WRONG]
)
def test_a_proof_fails_on_a_wrong_result(monkeypatch, module, name, spoil, proof):
    assert proof()
    right = getattr(module, name)
    monkeypatch.setattr(module, name, lambda *arguments: spoil(right(*arguments)))
    assert not proof()


@pytest.mark.parametrize(("share", "follows"), [("1", True), ("1/2", False), ("2", False)])
def test_equation_19_follows_for_one_reading_of_the_columns_mass(share, follows):
    assert motion.follows_if_a_column_weighs(sp.Rational(share)) is follows
