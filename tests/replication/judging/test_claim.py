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
NUMBER = replace(STATEMENT, printed=0.2683, tolerance=5e-5, unit="rad")
FOUND = "printed 0.2683, computed 0.26839 ± 1e-16 rad"


@pytest.mark.parametrize(
    ("claim", "finding", "verdict", "grounds"),
    [
        (NUMBER, value(0.26839, 1e-16, "rad"), "confirmed", FOUND),
        (
            NUMBER,
            value(0.26839, 1e-16, "rad", meant_value=0.26831),
            "misprint",
            f"{FOUND}; what is meant gives 0.26831 rad",
        ),
        (STATEMENT, truth(True), "confirmed", "holds"),
        (STATEMENT, truth(False), "refuted", "does not hold"),
        (STATEMENT, truth(False), "qualified", "holds under a condition: Only if slender."),
        (
            STATEMENT,
            truth(False, kind="sign"),
            "misprint",
            "does not hold as printed (sign); what is meant does",
        ),
        (
            STATEMENT,
            truth(False, kind="letter"),
            "slip",
            "does not hold as printed (letter); what is meant does",
        ),
        (STATEMENT, None, "not tested", "Only if slender."),
        (STATEMENT, None, "by definition", "Only if slender."),
    ],
)
def test_line_has_the_verdict_with_its_grounds(claim, finding, verdict, grounds):
    line = verdict_line(replace(claim, expected=verdict), finding, verdict)
    assert line == f"s: {verdict} ({grounds})"


def test_other_verdict_than_expected_is_said():
    assert verdict_line(STATEMENT, truth(False), "refuted") == (
        "s: refuted (does not hold); expected confirmed"
    )
    lacking = Finding.of({"not_tested": "needs an engine"})
    assert verdict_line(STATEMENT, lacking, "not tested") == (
        "s: not tested (needs an engine); a full run tests it and expects confirmed"
    )
