"""The kind of a fault: each is found, and what no single mend saves has none."""

import pytest

from topheavy.derivation import NEGATIVE, POSITIVE
from topheavy.derivation.in_text import IN_TEXT
from topheavy.derivation.mends import KINDS, mended_quotient, mends
from topheavy.derivation.printed import EQUATIONS
from topheavy.derivation.verdicts import find_mend

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


def test_extent_of_a_radical_is_found():
    premises = RIGHT["eq24"].premises
    mend = find_mend("p̂ = √(1 + 2γ)/(1 + 3γ) p", premises, (NEGATIVE, POSITIVE))
    assert (mend.kind, mend.text) == ("radical", "p̂ = √((1 + 2γ)/(1 + 3γ)) p")


def test_fault_of_a_rectangle_is_found_although_its_slenderness_is_no_free_symbol():
    premises = next(one.premises for one in IN_TEXT if one.name == "text_size")
    mend = find_mend("R = √(b² − h²)", premises, (NEGATIVE,))
    assert (mend.kind, mend.text) == ("sign", "R = √(b² + h²)")


@pytest.mark.parametrize(
    ("name", "right", "wrong"),
    [
        ("eq1", "m g R sin(α + θ) − m ü_g", "−m g R sin(α + θ) + 2m ü_g"),
        ("eq24", "(1 + 3γ)/(1 + 2γ)", "(2 + 3γ)/(1 + 3γ)"),
        ("eq3", "sin(α sgn(θ) − θ)", "cos(α sgn(θ) − θ)"),
        ("eq5", "cos(α ± θ)", "cos(α ± 2θ) θ̇"),
    ],
)
def test_form_that_no_single_mend_saves_has_no_kind(name, right, wrong):
    sides = (NEGATIVE,) if RIGHT[name].split else None
    assert kind(name, right, wrong, sides) is None


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
