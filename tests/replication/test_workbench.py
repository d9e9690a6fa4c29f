"""What every step does at its edges."""

import json
import math
import sys

import numpy as np
import pandas as pd
import pytest

from replication.judging.findings import Findings, read_findings, write_findings
from replication.workbench import grid, log_to, truth, value, write_table

# ---------------------------------------------------------------------------- log


def test_what_a_step_prints_is_in_its_log(tmp_path):
    before = sys.stdout, sys.stderr
    with log_to(str(tmp_path / "log")):
        print("to the log")
        print("so is this", file=sys.stderr)
    assert (tmp_path / "log").read_text(encoding="utf-8") == "to the log\nso is this\n"
    assert (sys.stdout, sys.stderr) == before


@pytest.mark.parametrize("error", [ValueError, SystemExit, KeyboardInterrupt])
def test_error_is_in_the_log_and_goes_on(tmp_path, error):
    before = sys.stdout, sys.stderr
    with pytest.raises(error, match="too stocky"), log_to(str(tmp_path / "log")):
        raise error("too stocky")
    text = (tmp_path / "log").read_text(encoding="utf-8")
    assert "Traceback" in text
    assert f"{error.__name__}: too stocky" in text
    assert (sys.stdout, sys.stderr) == before


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


def test_table_is_read_back_to_its_nine_digits(tmp_path):
    path = tmp_path / "table.csv"
    rows = [{"x": 1 / 3, "n": 2, "name": "a"}, {"x": math.nan, "n": 3, "name": "b, c"}]
    write_table(str(path), rows)
    assert path.read_bytes() == b'x,n,name\n0.333333333,2,a\n,3,"b, c"\n'
    assert math.isnan(pd.read_csv(path).x[1])


def test_table_is_the_same_bytes_from_rows_columns_and_frames(tmp_path):
    columns = {"x": [0.1, 0.123456789 * (1 + 1e-13)], "y": ["a", "b"]}
    for form in (columns, frame := pd.DataFrame(columns), frame.to_dict("records")):
        write_table(str(tmp_path / "table.csv"), form)
        assert (tmp_path / "table.csv").read_bytes() == b"x,y\n0.1,a\n0.123456789,b\n"


def test_grid_runs_evenly_from_lowest_to_highest():
    np.testing.assert_array_equal(
        grid({"lowest": 1.0, "highest": 2.0, "points": 5}), [1.0, 1.25, 1.5, 1.75, 2.0]
    )
