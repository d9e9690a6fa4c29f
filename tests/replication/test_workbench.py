"""What every step does at its edges."""

import json
import math

import numpy as np
import pytest

from replication.judging.findings import Findings, read_findings, write_findings
from replication.workbench import truth, value

# ---------------------------------------------------------------------------- log


# ---------------------------------------------------------------------------- findings


def test_findings_are_plain_and_survive_being_written(tmp_path):
    findings = {
        "number": value(np.float64(1.5), np.float32(0.25), "m", meant_value=np.float64(2.0)),
        "fact": truth(np.bool_(True), peaks=np.array([1.0, 2.0]), name="α"),
    }
    number = {"value": 1.5, "error": 0.25, "unit": "m", "meant_value": 2.0}
    assert findings["number"].entries == number
    assert findings["fact"].entries == {"holds": True, "peaks": [1.0, 2.0], "name": "α"}
    assert type(findings["fact"].holds) is bool
    path = tmp_path / "findings.json"
    write_findings(path, Findings(findings, ("a.b",)))
    text = path.read_text(encoding="utf-8")
    entries = {name: finding.entries for name, finding in findings.items()}
    assert json.loads(text) == entries | {"called": ["a.b"]}
    assert read_findings(path) == Findings(findings, ("a.b",))
    assert "α" in text
    assert text.endswith("}\n")


@pytest.mark.parametrize("number", [math.nan, math.inf])
def test_finding_that_is_no_number_is_not_written(tmp_path, number):
    with pytest.raises(ValueError, match="JSON"):
        write_findings(tmp_path / "findings.json", Findings({"lost": value(number, 0.0)}))


# ---------------------------------------------------------------------------- tables
