"""The kind of a fault: each is found, and what no single mend saves has none."""

import pytest

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
