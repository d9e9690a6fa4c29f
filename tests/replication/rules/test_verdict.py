"""The end of a run: its last line, and what makes it fail."""

from dataclasses import replace

import pandas as pd

from replication.judging.claim import Claim, JudgedClaim
from replication.judging.ledger import with_verdict
from replication.rules.verdict import main
from replication.workbench import truth

UNTESTED = with_verdict(Claim(id="", where="p. 1", statement="", expected="not tested"), {})


def claim(name: str, verdict: str, expected: str, not_tested: str = "") -> JudgedClaim:
    return replace(UNTESTED, id=name, verdict=verdict, expected=expected, not_tested=not_tested)


def compared(**verdicts: str) -> pd.DataFrame:
    return pd.DataFrame(
        {
            "result": [f"results/tables/{name}.csv" for name in verdicts],
            "published": [f"tests/reference/{name}.csv" for name in verdicts],
            "verdict": list(verdicts.values()),
            "departs": ["peak" if verdict == "differs" else "" for verdict in verdicts.values()],
        }
    )


AS_EXPECTED = [
    claim("eq_1", "confirmed", "confirmed"),
    claim("eq_9", "misprint", "misprint"),
    replace(claim("ours", "refuted", "refuted"), study="pendulums"),
    claim("photograph", "not tested", "not tested"),
]


def test_every_claim_that_came_out_otherwise_is_a_fault_either_way():
    worse, better = claim("a", "refuted", "confirmed"), claim("b", "qualified", "refuted")
    number = replace(worse, id="c", printed=1.25, computed=1.5, unit="s")
    untested = claim("d", "not tested", "confirmed")  # for no reason
    line, faults = main([*AS_EXPECTED, worse, better, number, untested], compared(), {})
    assert faults == [
        "claim a is refuted; expected confirmed",
        "claim b is qualified; expected refuted",
        "claim c is refuted; expected confirmed (printed 1.25, computed 1.5 s)",
        "claim d is not tested; expected confirmed",
    ]
    assert line.startswith("paper: 1 confirmed, 1 qualified, 0 slips, 1 misprint, 2 refuted, ")


def test_claim_of_a_study_that_came_out_otherwise_is_a_fault():
    other = replace(claim("a", "refuted", "confirmed"), study="own")
    assert main([other], compared(), {})[1] == ["claim a is refuted; expected confirmed"]


def test_claim_that_lacks_an_optional_package_is_told_and_is_no_fault():
    lacking = [claim(name, "not tested", "confirmed", "no engine") for name in ("a", "b")]
    line, faults = main([*AS_EXPECTED, *lacking], compared(peaks="agrees"), {})
    assert faults == []
    told, paper, _ = line.splitlines()
    assert told == "2 claims not tested here: no engine"
    assert paper.endswith("3 not tested")


def test_only_a_table_that_differs_is_a_fault():
    tables = compared(first="agrees", second="differs", third="not compared: other config")
    lines, (fault,) = main(AS_EXPECTED, tables, {})
    assert "results/tables/second.csv differs from tests/reference/second.csv in peak" in fault
    assert lines.startswith("1 of 3 published results not compared: other config: tables/third.csv")


def test_check_of_ours_that_fails_is_a_fault_with_its_evidence():
    checks = {"routes.agree": truth(True), "routes.same": truth(False, worst=0.25)}
    _, faults = main(AS_EXPECTED, compared(), checks)
    assert faults == ["our own check routes.same does not hold: worst = 0.25"]
