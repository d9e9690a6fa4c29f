"""Verdicts on claims, from findings."""

import math

import pytest

from topheavy.claims import VERDICTS, judge, tally

NUMBER = {"id": "n", "printed": 0.275, "tolerance": 0.0005}
STATEMENT = {"id": "s"}


@pytest.mark.parametrize(
    ("finding", "verdict"),
    [
        ({"value": 0.2751, "error": 0.0}, "confirmed"),
        ({"value": 0.2754, "error": 0.00005}, "confirmed"),
        ({"value": 0.2756, "error": 0.0}, "refuted"),
        ({"value": 0.300, "error": 0.0, "meant_value": 0.275}, "misprint"),
        ({"value": 0.300, "error": 0.0, "meant_value": 0.290}, "refuted"),
        ({"value": 0.275, "error": 0.0, "meant_value": 0.290}, "confirmed"),
        (None, "not tested"),
        ({"not_tested": "a package is missing"}, "not tested"),
    ],
)
def test_a_printed_number_is_held_against_the_computed_one(finding, verdict):
    assert judge(NUMBER, finding) == verdict


@pytest.mark.parametrize(
    ("finding", "verdict"),
    [
        ({"holds": True}, "confirmed"),
        ({"holds": True, "meant_holds": None}, "confirmed"),
        ({"holds": False}, "refuted"),
        ({"holds": False, "meant_holds": True}, "misprint"),
        ({"holds": False, "meant_holds": False}, "refuted"),
        ({"holds": False, "holds_when": True}, "qualified"),
        ({"holds": False, "holds_when": False}, "refuted"),
        (None, "not tested"),
        ({"not_tested": "a package is missing"}, "not tested"),
    ],
)
def test_a_statement_is_judged_by_what_holds(finding, verdict):
    assert judge(STATEMENT, finding) == verdict


def test_a_value_too_uncertain_for_its_tolerance_gives_no_verdict():
    with pytest.raises(ValueError, match=r"claim n: the error is 5.1e-05; .* a tenth .* 0.0005"):
        judge(NUMBER, {"value": 0.275, "error": 5.1e-5})


def test_a_value_that_is_not_a_number_confirms_nothing():
    assert judge(NUMBER, {"value": math.nan, "error": 0.0}) == "refuted"
    with pytest.raises(ValueError, match="claim n: the error is nan"):
        judge(NUMBER, {"value": 0.275, "error": math.nan})


def test_a_number_needs_a_value():
    with pytest.raises(ValueError, match="claim n: the finding has no value; expected a number"):
        judge(NUMBER, {"holds": True})


def test_a_statement_needs_a_truth():
    with pytest.raises(ValueError, match="claim s: the finding has no truth; expected 'holds'"):
        judge(STATEMENT, {"value": 1.0, "error": 0.0})


def test_the_tally_names_every_verdict():
    verdicts = ["confirmed"] * 3 + ["misprint"] * 2 + ["qualified", "not tested"]
    assert tally(verdicts) == (
        "claims: 3 confirmed, 1 qualified, 2 misprints, 0 refuted, 1 not tested"
    )
    assert tally(VERDICTS) == (
        "claims: 1 confirmed, 1 qualified, 1 misprints, 1 refuted, 1 not tested"
    )
