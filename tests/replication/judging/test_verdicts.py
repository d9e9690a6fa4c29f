"""Verdicts, the digits of numbers, and misprints."""

import math
from dataclasses import replace

import pytest

from replication.judging.claim import Claim
from replication.judging.digits import beside_print, by_error, numbers
from replication.judging.findings import Finding
from replication.judging.ledger import with_verdict
from replication.judging.misprints import one_slip_apart
from replication.judging.verdicts import (
    KINDS,
    VERDICTS,
    print_rounding,
    tallies,
    tolerance_fault,
    verdict_on,
)

STATEMENT = Claim(id="s", where="p. 1", statement="It is so.", expected="confirmed")
NUMBER = replace(STATEMENT, id="n", printed=0.275, tolerance=0.0005)
UNTESTED = with_verdict(replace(STATEMENT, expected="not tested"), {})


def verdict(claim, finding):
    return verdict_on(claim, None if finding is None else Finding.of(finding))


@pytest.mark.parametrize(
    ("finding", "expected"),
    [
        ({"value": 0.2751, "error": 0.0}, "confirmed"),
        ({"value": 0.2754, "error": 0.00005}, "confirmed"),
        ({"value": 0.2756, "error": 0.0}, "refuted"),
        ({"value": 0.300, "error": 0.0, "meant_value": 0.275}, "misprint"),
        ({"value": 0.300, "error": 0.0, "meant_value": 0.275, "kind": "letter"}, "slip"),
        ({"value": 0.300, "error": 0.0, "meant_value": 0.275, "kind": "convention"}, "qualified"),
        ({"value": 0.300, "error": 0.0, "meant_value": 0.290}, "refuted"),
        ({"value": 0.300, "error": 0.0, "meant_value": 0.290, "kind": "letter"}, "refuted"),
        # the print itself is wrong: 0.275 for 0.257
        ({"value": 0.25702, "error": 0.0, "meant_value": 0.257}, "misprint"),
        ({"value": 0.25702, "error": 0.0, "meant_value": 0.25702, "kind": "number"}, "misprint"),
        ({"value": 0.25702, "error": 0.0, "meant_value": 0.257, "kind": "convention"}, "qualified"),
        ({"value": 0.26102, "error": 0.0, "meant_value": 0.257}, "refuted"),
        ({"value": 0.300, "error": 0.0, "meant_value": 0.300, "kind": "number"}, "refuted"),
        ({"value": math.nan, "error": 0.0, "meant_value": 0.257}, "refuted"),
        ({"value": 0.25702, "error": 0.0, "meant_value": math.nan}, "refuted"),
        ({"value": 0.27451, "error": 0.0}, "confirmed"),
        ({"value": 0.27449, "error": 0.0}, "refuted"),
        ({"value": 0.275, "error": 0.0, "meant_value": 0.290}, "confirmed"),
        (None, "not tested"),
        ({"not_tested": "a package is missing"}, "not tested"),
    ],
)
def test_a_printed_number_is_held_against_the_computed_one(finding, expected):
    assert verdict(NUMBER, finding) == expected


@pytest.mark.parametrize(
    ("finding", "expected"),
    [
        ({"holds": True}, "confirmed"),
        ({"holds": True, "meant_holds": None}, "confirmed"),
        ({"holds": False}, "refuted"),
        ({"holds": True, "kind": "sign"}, "confirmed"),
        ({"holds": False, "meant_holds": True, "kind": "sign"}, "misprint"),
        ({"holds": False, "meant_holds": True, "kind": "number"}, "misprint"),
        ({"holds": False, "meant_holds": True, "kind": "letter"}, "slip"),
        ({"holds": False, "meant_holds": True, "kind": "bracket"}, "slip"),
        ({"holds": False, "meant_holds": True, "kind": "radical"}, "slip"),
        ({"holds": False, "meant_holds": True, "kind": "convention"}, "qualified"),
        ({"holds": False, "meant_holds": False, "kind": "letter"}, "refuted"),
        ({"holds": False, "meant_holds": False}, "refuted"),
        ({"holds": False, "meant_holds": False, "holds_when": True}, "qualified"),
        ({"holds": False, "holds_when": True}, "qualified"),
        ({"holds": False, "holds_when": False}, "refuted"),
        (None, "not tested"),
        ({"not_tested": "a package is missing"}, "not tested"),
    ],
)
def test_a_statement_is_judged_by_what_holds(finding, expected):
    assert verdict(STATEMENT, finding) == expected


def test_digits_that_the_tolerance_tells_of_are_compared_too():
    claim = replace(NUMBER, printed=3.57, tolerance=5e-5)  # 3.5700 in print
    for found, expected in [(3.5699457, "misprint"), (3.56, "misprint")]:
        finding = Finding.of({"value": found, "error": 0.0, "meant_value": found})
        assert verdict_on(claim, finding) == expected
    finding = Finding.of({"value": 3.5698457, "error": 0.0, "meant_value": 3.5698457})
    assert verdict_on(claim, finding) == "refuted"


def test_a_value_too_uncertain_for_its_tolerance_gives_no_verdict():
    with pytest.raises(ValueError, match=r"claim n: the error is 5.1e-05; .* a tenth .* 0.0005"):
        verdict(NUMBER, {"value": 0.275, "error": 5.1e-5})


def test_a_value_that_is_not_a_number_confirms_nothing():
    assert verdict(NUMBER, {"value": math.nan, "error": 0.0}) == "refuted"
    with pytest.raises(ValueError, match="claim n: the error is nan"):
        verdict(NUMBER, {"value": 0.275, "error": math.nan})


def test_a_number_needs_a_value_and_a_statement_a_truth():
    with pytest.raises(ValueError, match="claim n: the finding has no value; expected a number"):
        verdict(NUMBER, {"holds": True})
    with pytest.raises(ValueError, match="claim s: the finding has no truth; expected 'holds'"):
        verdict(STATEMENT, {"value": 1.0, "error": 0.0})


@pytest.mark.parametrize("kind", [None, "condition", "brackets", "", "Sign"])
def test_discrepancy_of_no_known_kind_gives_no_verdict(kind):
    finding = {"holds": False, "meant_holds": True, "kind": kind}
    with pytest.raises(ValueError, match=f"claim s: .* is {kind!r}; expected one of sign, number"):
        verdict(STATEMENT, finding)


def test_every_kind_has_a_verdict_that_is_one():
    assert set(KINDS.values()) == {"misprint", "slip", "qualified"}
    assert set(KINDS.values()) < set(VERDICTS)


def test_claim_that_cannot_be_false_is_not_confirmed():
    assert verdict(replace(STATEMENT, by_definition=True), None) == "by definition"
    with pytest.raises(ValueError, match="claim s holds by definition; expected no finding"):
        verdict(replace(STATEMENT, by_definition=True), {"holds": True})


@pytest.mark.parametrize(
    ("printed", "rounding"),
    [
        (0.275, 5e-4),
        (15.38, 5e-3),
        (0.9, 0.05),
        (5, 0.5),
        (265, 0.5),
        (1200, 0.5),
        (2.0, 0.5),
        (1e-5, 5e-6),
    ],
)
def test_rounding_is_half_a_unit_of_the_last_printed_digit(printed, rounding):
    assert print_rounding(printed) == pytest.approx(rounding, rel=1e-12)


@pytest.mark.parametrize(
    ("printed", "tolerance", "expected", "fault"),
    [
        (0.275, 5e-4, "confirmed", ""),
        (0.275, 9.9e-4, "confirmed", ""),
        (0.275, 1.0e-3, "confirmed", "twice as far off"),
        (0.12, 0.01, "confirmed", "twice as far off"),
        (0.006, 0.003, "confirmed", "more than a tenth"),
        (0.02, 0.02, "confirmed", "more than a tenth"),
        (0.9, 0.05, "confirmed", ""),
        (5, 0.5, "confirmed", ""),
        (5, 0.6, "confirmed", "more than a tenth"),
        (0.1, 0.05, "confirmed", ""),  # the rounding of the print, half the value
        (0.434, 0.02, "misprint", "twice as far off"),
        (0.434, 0.05, "misprint", "more than a tenth"),
    ],
)
def test_tolerance_under_which_nothing_could_fail_is_told(printed, tolerance, expected, fault):
    claim = replace(NUMBER, printed=printed, tolerance=tolerance, expected=expected)
    assert fault in tolerance_fault(claim)
    assert bool(fault) == bool(tolerance_fault(claim))
    assert tolerance_fault(STATEMENT) == ""


def test_tally_names_every_verdict():
    verdicts = ["confirmed"] * 3 + ["misprint"] * 2 + ["qualified", "by definition", "not tested"]
    rows = [replace(UNTESTED, verdict=verdict) for verdict in verdicts]
    rows += [replace(UNTESTED, study="pendulums", verdict=verdict) for verdict in VERDICTS]
    assert tallies(rows) == [
        "paper: 3 confirmed, 1 qualified, 0 slips, 2 misprints, 0 refuted, 1 by definition, "
        "1 not tested",
        "pendulums: 1 confirmed, 1 qualified, 1 slip, 1 misprint, 1 refuted, 1 by definition, "
        "1 not tested",
    ]


CLAIM = Claim(id="n", where="p. 1", statement="It is so.", expected="confirmed")
ROW = replace(with_verdict(CLAIM, {}), computed=3.449489742783178, error=4e-16)


def found(**fields):
    return numbers(replace(ROW, **fields))


@pytest.mark.parametrize(
    ("value", "printed", "tolerance", "shown"),
    [
        (3.449489742783178, 3.4495, 5e-5, "3.44949"),  # four figures would be 3.449
        (1.180340599016096, 1.18, 5e-3, "1.180"),
        (0.27549, 0.275, 5e-4, "0.27549"),  # 0.2755 might be rounded to 0.276
        (0.27551, 0.275, 5e-4, "0.27551"),  # and to 0.275
        (0.2755, 0.275, 5e-4, "0.2755"),
        (265.02, 265, 0.5, "265.0"),
        (-0.2, -0.2, 0.05, "-0.20"),
        (1.2345678e-7, 1.2e-7, 5e-9, "0.000000123"),
    ],
)
def test_number_beside_a_printed_one_is_shown_to_a_tenth_of_the_tolerance(
    value, printed, tolerance, shown
):
    assert beside_print(value, printed, tolerance).rstrip("0") == shown.rstrip("0")


def test_a_whole_number_beside_a_whole_print_has_no_point():
    assert [beside_print(n, 20001, 0.5) for n in (20001.0, 20003.0)] == ["20001", "20003"]
    assert beside_print(20001.0, 20001.0, 0.5) == "20001.0"


@pytest.mark.parametrize(
    ("value", "error", "shown"),
    [
        (12.3456789, 0.3, "12.3"),
        (12.3456789, 0.0, "12.3457"),
        (12.3456789, 1e-12, "12.3457"),
        (1234.5, 30.0, "1234"),
        (0.5, 1e-16, "0.5"),
        (0.0, 0.0, "0"),
        (0.0, 1e-3, "0.000"),
        (2000000.0, 0.0, "2000000"),
        (0.0123, 2e-4, "0.0123"),
    ],
)
def test_any_other_number_has_the_digits_that_its_error_justifies(value, error, shown):
    assert by_error(value, error) == shown


def test_print_keeps_its_own_digits_and_stands_beside_what_is_meant():
    fields = {"printed": 3.4945, "tolerance": 5e-5, "meant": 3.4495}
    assert found(**fields) == {"printed": "3.4945", "computed": "3.44949", "meant": "3.44950"}
    assert found(printed=1e-05)["printed"] == "0.00001"
    assert found(printed="6/1") == {"computed": "3.44949"}
    assert found(computed=True) == {}


@pytest.mark.parametrize(
    ("printed", "meant", "decimals"),
    [
        (0.275, 0.225, 3),  # a wrong digit
        (3.54, 3.4495, 2),  # two neighbours exchanged
        (12.5, 1.5, 1),  # an added digit
        (1.5, 12.5, 1),  # a lost one
        (-0.4, 0.4, 1),  # the sign
        (0.434, 4.34, 3),  # the decimal point
        (345, 3.45, 0),
        (3.57, 3.5699457, 4),  # rounded to the wrong side
    ],
)
def test_slip_is_told(printed, meant, decimals):
    assert one_slip_apart(printed, meant, decimals)


@pytest.mark.parametrize(
    ("printed", "meant", "decimals"),
    [
        (0.275, 0.2751, 3),  # no slip: the rounding
        (0.275, 0.300, 3),
        (3.57, 3.5698, 4),  # two units of the last digit, which carry
        (0.275, 0.572, 3),  # two digits that are no neighbours
        (0.275, 0.296, 3),
        (0.275, 0.382, 3),
        (125, 512, 0),
        (12.5, 0.1, 1),
    ],
)
def test_two_slips_or_none_are_no_misprint(printed, meant, decimals):
    assert not one_slip_apart(printed, meant, decimals)
