"""The proofs hold, say something, and fail when what they prove is false."""

import pytest
import sympy as sp

from topheavy.derivation import impact_proofs as impact
from topheavy.derivation import motion_proofs as motion
from topheavy.derivation import theorems
from topheavy.derivation.notation import alpha, gamma


def test_every_theorem_holds_and_is_stated():
    proofs = theorems()
    assert [proof.id for proof in proofs if not proof.holds] == []
    assert len({proof.id for proof in proofs}) == len(proofs) >= 20
    assert all(proof.statement.endswith(".") for proof in proofs)


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
