"""Verdicts on printed equations: what follows, what mends the others, and the theorem."""

import re

import numpy as np
import pytest
import sympy as sp

from topheavy.derivation import NEGATIVE, POSITIVE, check_printed, theorems
from topheavy.derivation import impact_proofs as impact
from topheavy.derivation import motion_proofs as motion
from topheavy.derivation.in_text import IN_TEXT
from topheavy.derivation.mends import KINDS, mended_quotient, mends
from topheavy.derivation.notation import alpha, gamma, read
from topheavy.derivation.printed import EQUATIONS
from topheavy.derivation.verdicts import find_mend, follows, residuals

FAULTS = {
    "eq9_positive": "sign",
    "eq19": "sign",
    "eq20": "convention",
    "eq21": "convention",
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


def test_these_and_no_other_faults_are_found(checks):
    found = {name: check.fault for name, check in checks.items() if not check.follows}
    assert found == FAULTS


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


RIGHT = {statement.name: statement for statement in EQUATIONS}


def kind(name, right, wrong, sides=None):
    """The kind of a fault that is put into an equation as it is meant."""
    statement = RIGHT[name]
    text = statement.meant or statement.printed
    assert text.count(right) >= 1
    mend = find_mend(text.replace(right, wrong), statement.premises, sides or statement.sides)
    return mend.kind if mend else None


@pytest.mark.parametrize(
    ("expected", "name", "right", "wrong"),
    [
        ("bracket", "eq24", "(1 + γ/(1 + 2γ)) R", "(1 + γ/1 + 2γ) R"),
        ("bracket", "eq17", "(v̈ sin(α + θ) − ü cos(α + θ))", "(v̈ sin(α + θ)) − ü cos(α + θ)"),
        ("sign", "eq1", "− m ü_g", "+ m ü_g"),
        ("sign", "eq16", "g + v̈", "g − v̈"),
        ("sign", "eq5", "u̇ = 2R", "u̇ = −2R"),
        ("number", "eq24", "(1 + 3γ)/(1 + 2γ)", "(1 + 3γ)/(1 + 4γ)"),
        ("number", "eq18", "2m_b R", "4m_b R"),
        ("convention", "eq13", "F_x1 + F_x2", "−F_x1 − F_x2"),
    ],
)
def test_each_kind_is_found(expected, name, right, wrong):
    assert kind(name, right, wrong) == expected


def test_the_smallest_mends_are_tried_first():
    found = [mend.kind for mend in mends("u = √(1 + 2α)/(3 + γ)")]
    order = [KINDS.index(name) for name in found[: found.index("number")]]
    assert order == sorted(order)
    assert set(found) == set(KINDS)


def test_mass_over_the_same_mass_takes_another_number():
    mend, value = mended_quotient(265.0, 265.0, "0.434")
    assert (mend.kind, mend.text) == ("number", "115/265")
    assert abs(value - 0.434) < 0.0005


def test_quotient_that_no_single_number_mends_has_no_kind():
    assert mended_quotient(265.0, 265.0, "0.0434") is None


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
