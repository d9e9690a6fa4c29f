"""The ledger as the workflow reads it."""

import pytest
from ledger import finding_of, judged, read_ledger


def test_rows_of_all_files_come_in_order(tmp_path):
    paths = [tmp_path / "first.yaml", tmp_path / "second.yaml"]
    paths[0].write_text("- id: b\n- id: a\n")
    paths[1].write_text("- id: c\n  printed: 2\n")
    rows = read_ledger(paths)
    assert [row["id"] for row in rows] == ["b", "a", "c"]
    assert rows[2]["printed"] == 2


def test_row_says_whose_claim_it_is(tmp_path):
    paths = [tmp_path / "paper" / "claims.yaml", tmp_path / "studies" / "own" / "claims.yaml"]
    for path, text in zip(paths, ["- id: a\n- id: b\n  ours: true\n", "- id: c\n"], strict=True):
        path.parent.mkdir(parents=True)
        path.write_text(text)
    assert [row["study"] for row in read_ledger(paths)] == ["", "ours", "own"]


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


CLAIM = {
    "id": "c",
    "study": "",
    "where": "p. 1",
    "statement": "It is so.",
    "function": "topheavy.simulate",
    "rule": "r",
    "finding": "so",
    "expected": "confirmed",
}


def found(called, **finding):
    return {"r": {"so": finding, "called": called}}


def test_claim_is_judged_by_what_ran():
    row = judged(CLAIM, found(["topheavy.simulate.simulate"], holds=True))
    assert (row["verdict"], row["computed"], row["kind"]) == ("confirmed", True, "")
    row = judged(CLAIM, found(["topheavy.simulate.simulate"], holds=False, holds_when=True))
    assert (row["verdict"], row["computed"]) == ("qualified", False)


@pytest.mark.parametrize("called", [[], ["topheavy.reference.simulate", "topheavy.simulate"]])
def test_function_that_its_rule_never_called_judges_nothing(called):
    with pytest.raises(ValueError, match="claim c: its rule r never called"):
        judged(CLAIM, found(called, holds=True))


def test_what_was_not_run_for_lack_of_a_package_needs_no_function():
    row = judged(CLAIM, {"r": {"not_tested": "no engine", "called": []}})
    assert (row["verdict"], row["not_tested"]) == ("not tested", "no engine")


def test_list_of_functions_is_no_finding():
    with pytest.raises(ValueError, match="names the finding 'called', which rule r does not make"):
        finding_of(CLAIM | {"finding": "called"}, {"called": []})
