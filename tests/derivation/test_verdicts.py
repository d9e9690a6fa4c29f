"""Verdicts on printed equations: what follows, what mends the others, and the theorem."""

import re

import numpy as np
import pytest
import sympy as sp

from derivation import check_printed, consequences, theorems
from derivation.notation import NEGATIVE, POSITIVE, alpha, gamma, read
from derivation.printed import EQUATIONS, IN_TEXT, follows, residuals

KINDS = {
    "eq9_positive": "sign",
    "eq19": "sign",
    "eq20": "sign",
    "eq21": "sign",
    "eq22": "sign",
    "text_p_hat": "radical",
    "text_p_hat_trilith": "bracket",
}


@pytest.fixture(scope="module")
def checks():
    found = check_printed()
    named = {check.id: check for check in found}
    assert len(named) == len(found)
    return named


def numerically_zero(equation, premises, side):
    """Whether an equation holds at random values of everything that it is left with."""
    random = np.random.default_rng(7)
    left = [residual.subs(premises(side)) for residual in residuals(equation, side)]
    for _ in range(3):
        for residual in left:
            names = sorted(residual.free_symbols, key=str)
            values = dict(zip(names, random.uniform(0.1, 0.7, len(names)), strict=True))
            if side.rotation in values:
                values[side.rotation] *= side.sign
            scale = sum(
                abs(complex(sp.N(term.subs(values)))) for term in sp.Add.make_args(residual)
            )
            if abs(complex(sp.N(residual.subs(values)))) > 1e-9 * scale:
                return False
    return True


def test_every_equation_of_the_paper_is_there_and_named_once(checks):
    assert {check.equation for check in checks.values()} == {None, *range(1, 26)}
    assert all(re.fullmatch(r"[a-z][a-z0-9_]*", name) for name in checks)


def test_double_signs_are_tested_on_both_sides(checks):
    for number in range(4, 10):
        parts = [check.part for check in checks.values() if check.equation == number]
        assert parts == ["θ < 0", "θ > 0"]


SIGNS, BRACKETS = str.maketrans("", "", "+−±∓ "), str.maketrans("", "", "() ")


def test_these_and_no_other_discrepancies_are_found(checks):
    wrong = [check for check in checks.values() if not check.follows]
    assert {check.id: check.kind for check in wrong} == KINDS
    for check in wrong:
        assert check.meant_follows
        gone = BRACKETS if check.kind in ("bracket", "radical") else SIGNS
        assert check.printed.translate(gone) == check.meant.translate(gone)
        assert ("√" in check.printed) == (check.kind in ("bracket", "radical"))


@pytest.mark.parametrize("statement", [*EQUATIONS, *IN_TEXT], ids=lambda s: s.name)
def test_verdicts_agree_with_numbers(statement):
    for side in statement.sides:
        for equation in filter(None, (statement.printed, statement.meant)):
            exact = follows(equation, statement.premises, [side])
            assert exact == numerically_zero(equation, statement.premises, side)


@pytest.mark.parametrize("statement", EQUATIONS, ids=lambda s: s.name)
def test_one_wrong_sign_anywhere_is_caught(statement):
    right = statement.meant or statement.printed
    places = list(re.finditer(r" [+−] ", right))
    for place in places:
        other = " − " if place.group() == " + " else " + "
        wrong = right[: place.start()] + other + right[place.end() :]
        assert not follows(wrong, statement.premises, statement.sides), wrong


@pytest.mark.parametrize(
    ("name", "right", "wrong"),
    [
        ("eq24", "(1 + γ/(1 + 2γ)) R", "(1 + γ/(1 + 3γ)) R"),  # its second form alone
        ("eq13", "F_x1 + F_x2", "F_x1 − F_x2"),
        ("eq13", "ü_g + ü", "ü_g ± ü"),  # right for θ < 0 alone
        ("eq16", "g + v̈", "g ± v̈"),
    ],
)
def test_no_member_and_no_side_is_left_out(name, right, wrong):
    (statement,) = (s for s in EQUATIONS if s.name == name)
    assert right in statement.printed
    other = statement.printed.replace(right, wrong)
    assert not follows(other, statement.premises, statement.sides)


class TestReading:
    def test_top_sign_is_for_negative_rotation(self):
        assert read("α ± 1 = ∓1", NEGATIVE) == [alpha + 1, -1]
        assert read("α ± 1 = ∓1", POSITIVE) == [alpha - 1, 1]

    def test_a_radical_covers_only_its_brackets(self):
        x = sp.Symbol("x")
        assert read("√(1 + 2x)/(1 + 3x) = 1 + 2x/1 + 3x", POSITIVE) == [
            sp.sqrt(1 + 2 * x) / (1 + 3 * x),
            1 + 5 * x,
        ]

    def test_an_unknown_letter_stays_one(self):
        assert read("sin(a) = 0", POSITIVE)[0] != sp.sin(alpha)


def test_every_theorem_holds_and_is_stated():
    proofs = theorems()
    assert [proof.theorem for proof in proofs if not proof.holds] == []
    assert len({proof.theorem for proof in proofs}) == len(proofs)
    assert all(proof.statement.endswith(".") for proof in proofs)


_SMALL = gamma * sp.sin(alpha) ** 4 / 50
WRONG = [
    ("size_ratio", lambda ratio: 1 / ratio, consequences.size_grows_to_a_limit),
    ("quadratic_terms", lambda t: (t[0], 2 * t[1]), consequences.quadratic_terms_cancel),
    ("potential_energy", lambda v: 1.01 * v, consequences.energy_is_conserved_between_impacts),
    ("restitution", lambda r: r + _SMALL, consequences.restitution_is_below_the_columns),
    (
        "restitution",
        lambda r: r + _SMALL,
        consequences.frame_rocks_on_below_its_largest_slenderness,
    ),
]


@pytest.mark.parametrize(("name", "spoil", "proof"), WRONG, ids=[row[-1].__name__ for row in WRONG])
def test_a_proof_fails_on_a_wrong_result(monkeypatch, name, spoil, proof):
    assert proof()
    right = getattr(consequences, name)
    monkeypatch.setattr(consequences, name, lambda *arguments: spoil(right(*arguments)))
    assert not proof()
