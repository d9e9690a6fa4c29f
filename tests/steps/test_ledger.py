"""The ledger as the workflow reads it."""

import pytest
from ledger import finding_of, read_ledger


def test_rows_of_all_files_come_in_order(tmp_path):
    paths = [tmp_path / "first.yaml", tmp_path / "second.yaml"]
    paths[0].write_text("- id: b\n- id: a\n")
    paths[1].write_text("- id: c\n  printed: 2\n")
    rows = read_ledger(paths)
    assert [row["id"] for row in rows] == ["b", "a", "c"]
    assert rows[2]["printed"] == 2


def test_finding_is_the_one_that_the_claim_names():
    claim = {"id": "c", "rule": "r", "finding": "right"}
    assert finding_of(claim, {"left": {"holds": True}, "right": {"holds": False}}) == {
        "holds": False
    }
    assert finding_of({"id": "c"}, {"right": {"holds": False}}) is None


def test_finding_that_the_rule_does_not_make_is_named():
    claim = {"id": "c", "rule": "r", "finding": "gone"}
    with pytest.raises(ValueError, match="the claim c names the finding 'gone', which rule r"):
        finding_of(claim, {"right": {"holds": False}})
