"""Findings: one way in from JSON or a step, one way out, and no misspelt field."""

import json

import pytest

from replication.judging.findings import (
    Findings,
    findings_by_rule,
    read_findings,
    write_findings,
)

ENTRIES = {"holds": False, "widest": 0.5, "meant_holds": None, "kind": None, "error": 1e-3}


@pytest.mark.parametrize(
    "content",
    [
        {"b": ENTRIES, "a": {"value": 1.0, "error": 0.1, "unit": "m"}, "called": ["lib.f"]},
        {"not_tested": "no engine", "called": []},
    ],
)
def test_file_is_written_as_it_was_read(tmp_path, content):
    path = tmp_path / "rule.json"
    text = json.dumps(content, indent=2) + "\n"
    path.write_text(text, encoding="utf-8")
    write_findings(path, read_findings(path))
    assert path.read_text(encoding="utf-8") == text
    assert findings_by_rule([path]) == {"rule": Findings.of(content)}


@pytest.mark.parametrize(
    ("entries", "told"),
    [
        ({"holds": False, "meant_hold": True}, "'meant_hold'; did you mean 'meant_holds'"),
        ({"value": 1.0, "err_or": 0.1}, "'err_or'; did you mean 'error'"),
        ({"holds": False, "hold_when": True}, "'hold_when'; did you mean 'holds_when'"),
        ({"value": 1.0}, "has value; expected either 'value' and 'error'"),
        ({"value": 1.0, "error": 0.1, "holds": True}, "expected either"),
        ({}, "has no entry; expected either"),
    ],
)
def test_finding_that_could_judge_no_claim_is_refused_with_its_file(tmp_path, entries, told):
    path = tmp_path / "rule.json"
    path.write_text(json.dumps({"so": entries}), encoding="utf-8")
    with pytest.raises(ValueError, match=rf"rule\.json: the finding 'so': .*{told}"):
        read_findings(path)


def test_entry_that_is_no_finding_is_refused():
    with pytest.raises(ValueError, match=r"the finding 'so' is True; expected value\(\) or truth"):
        Findings.of({"so": True})
