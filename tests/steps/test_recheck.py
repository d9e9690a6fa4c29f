"""The published edition checked without a run."""

import copy
import json
import shutil
from pathlib import Path

import pandas as pd
import pytest
from recheck import claims, main, tables

ROOT = Path(__file__).resolve().parents[2]
ROWS = json.loads((ROOT / "tests" / "reference" / "claims.json").read_text(encoding="utf-8"))
CLAIM = {"id": "size", "printed": 0.415, "tolerance": 5e-4, "expected": "confirmed"}
ROW = {"id": "size", "computed": 0.4148, "meant": None, "error": 1e-16, "verdict": "confirmed"}


def test_published_edition_agrees_with_itself():
    line, faults = main(ROOT)
    assert faults == []
    assert line.startswith("claims: ")


@pytest.mark.parametrize("change", [{"computed": 0.42}, {"verdict": "refuted"}, {"id": "other"}])
def test_verdict_that_its_numbers_do_not_bear_is_found(change):
    assert list(claims([CLAIM], [ROW])) == []
    assert list(claims([CLAIM], [ROW | change]))


@pytest.mark.parametrize(
    ("table", "column"),
    [
        ("mass_ratio", "frequency_ratio"),
        ("mass_ratio", "size_ratio"),
        ("restitution_over_slenderness", "restitution"),
        ("restitution_over_mass_ratio", "restitution"),
        ("moment_rotation", "moment"),
        ("heavier", "lowest_overturning_low"),
    ],
)
def test_number_that_is_not_the_equations_is_found(tmp_path, table, column):
    reference = shutil.copytree(ROOT / "tests" / "reference", tmp_path / "reference")
    assert list(tables(reference, ROWS)) == []
    found = pd.read_csv(reference / f"{table}.csv")
    found.loc[1, column] *= 0.9
    found.to_csv(reference / f"{table}.csv", index=False)
    (fault,) = tables(reference, ROWS)
    assert fault.startswith(f"{table}.csv")


def test_equation_that_follows_after_all_is_found():
    rows = copy.deepcopy(ROWS)
    next(row for row in rows if row["equation"] == 21)["verdict"] = "confirmed"
    assert any("equations.csv" in fault for fault in tables(ROOT / "tests" / "reference", rows))
