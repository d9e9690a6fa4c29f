"""The line of a claim."""

from dataclasses import replace

import pytest

from replication.judging.claim import Claim
from replication.judging.findings import Finding
from replication.rules.one_claim import verdict_line
from replication.workbench import truth, value

STATEMENT = Claim(
    id="s", where="p. 1", statement="So.", expected="confirmed", remark="Only if slender."
)
NUMBER = replace(STATEMENT, id="n", printed=0.2683, tolerance=5e-5, unit="rad")
FOUND = value(0.26839, 1e-16, "rad")


def test_number_stands_beside_what_is_printed_with_error_and_unit():
    assert verdict_line(NUMBER, FOUND, "confirmed") == (
        "n: confirmed (printed 0.2683, computed 0.26839 ± 1e-16 rad)"
    )


def test_misprint_of_a_number_says_what_is_meant():
    found = value(0.26839, 1e-16, "rad", meant_value=0.26831)
    line = verdict_line(replace(NUMBER, expected="misprint"), found, "misprint")
    assert line.endswith("computed 0.26839 ± 1e-16 rad; what is meant gives 0.26831 rad)")


def test_what_is_not_tested_says_why():
    claim = replace(STATEMENT, expected="not tested", remark="Needs a table.")
    assert verdict_line(claim, None, "not tested") == "s: not tested (Needs a table.)"


@pytest.mark.parametrize(
    ("verdict", "grounds"),
    [
        ("confirmed", "holds"),
        ("refuted", "does not hold"),
        ("qualified", "holds under a condition: Only if slender."),
    ],
)
def test_statement_says_whether_it_holds(verdict, grounds):
    claim = replace(STATEMENT, expected=verdict)
    assert verdict_line(claim, truth(verdict == "confirmed"), verdict) == (
        f"s: {verdict} ({grounds})"
    )


def test_what_this_installation_cannot_test_says_what_a_full_run_expects():
    finding = Finding.of({"not_tested": "needs an engine"})
    assert verdict_line(STATEMENT, finding, "not tested") == (
        "s: not tested (needs an engine); a full run tests it and expects confirmed"
    )


@pytest.mark.parametrize(("verdict", "kind"), [("misprint", "sign"), ("slip", "letter")])
def test_discrepancy_of_the_print_is_named(verdict, kind):
    claim, finding = replace(STATEMENT, expected=verdict), truth(False, kind=kind)
    assert verdict_line(claim, finding, verdict) == (
        f"s: {verdict} (does not hold as printed ({kind}); what is meant does)"
    )


def test_what_cannot_be_false_says_why():
    claim = replace(STATEMENT, expected="by definition", remark="γ is so defined.")
    assert verdict_line(claim, None, "by definition") == "s: by definition (γ is so defined.)"


def test_other_verdict_than_expected_is_said():
    assert verdict_line(STATEMENT, truth(False), "refuted") == (
        "s: refuted (does not hold); expected confirmed"
    )
