"""The ledger as the workflow reads it."""

from dataclasses import replace

import pytest
import yaml

from replication.judging.claim import Claim
from replication.judging.findings import Findings
from replication.judging.ledger import (
    as_text,
    finding_of,
    read_judged,
    read_ledger,
    with_verdict,
    with_verdicts,
)

CLAIM = Claim(
    id="c",
    where="p. 1",
    statement="It is so.",
    function="topheavy.simulate",
    rule="r",
    finding="so",
    expected="confirmed",
)


def write(path, *rows):
    """Write a ledger of rows that have the other keys which every row has."""
    whole = {"where": "p. 1", "statement": "It is so.", "expected": "confirmed"}
    path.write_text(yaml.safe_dump([whole | row for row in rows]), encoding="utf-8")


@pytest.fixture
def paths(tmp_path, plant):
    """The ledgers of a paper and of its study `own`."""
    names = ["paper/claims.yaml", "studies/own/claims.yaml"]
    plant(tmp_path, dict.fromkeys(names, ""))
    return [tmp_path / name for name in names]


def test_row_says_whose_claim_it_is(paths):
    write(paths[0], {"id": "b"}, {"id": "a", "ours": True})
    write(paths[1], {"id": "c", "printed": 2})
    claims = read_ledger(paths)
    assert [(each.id, each.study) for each in claims] == [("b", ""), ("a", "ours"), ("c", "own")]
    assert claims[2].printed == 2


@pytest.mark.parametrize(
    ("change", "others"),
    [({"statement": "It is not."}, "statement"), ({"printed": 2, "tolerance": 0.5}, "printed, to")],
)
def test_study_changes_what_judges_a_claim_and_not_the_claim(paths, change, others):
    write(paths[0], {"id": "a", "rule": "r", "finding": "old", "remark": "Why."})
    row = {"id": "a", "expected": "refuted", "rule": "s", "finding": "new"}
    paths[1].write_text(yaml.safe_dump([row]), encoding="utf-8")
    (claim,) = read_ledger(paths)
    assert claim == Claim.of({"where": "p. 1", "statement": "It is so.", **row}, paths[1])
    paths[1].write_text(yaml.safe_dump([row | change]), encoding="utf-8")
    with pytest.raises(ValueError, match=f"a is a claim of the paper; .* not {others}"):
        read_ledger(paths)


def test_finding_that_the_rule_does_not_make_is_named():
    told = "the claim c names the finding 'rihgt', which rule r does not make; did you mean 'right'"
    with pytest.raises(ValueError, match=told):
        finding_of(replace(CLAIM, finding="rihgt"), Findings.of({"right": {"holds": False}}))
    with pytest.raises(ValueError, match="names the finding 'called', which rule r does not make"):
        finding_of(replace(CLAIM, finding="called"), Findings.of({"called": []}))


def found(called, **finding):
    return {"r": Findings.of({"so": finding, "called": called})}


def test_claim_is_judged_by_what_ran():
    row = with_verdict(CLAIM, found(["topheavy.outcomes.simulate.simulate"], holds=True))
    assert (row.verdict, row.computed, row.kind) == ("confirmed", True, "")
    row = with_verdict(
        CLAIM, found(["topheavy.outcomes.simulate.simulate"], holds=False, holds_when=True)
    )
    assert (row.verdict, row.computed) == ("qualified", False)


@pytest.mark.parametrize(
    "called", [[], ["topheavy.second.reference.simulate", "topheavy.simulate"]]
)
def test_function_that_its_rule_never_called_judges_nothing(called):
    with pytest.raises(ValueError, match="claim c: its rule r never called"):
        with_verdict(CLAIM, found(called, holds=True))


def test_all_claims_that_cannot_be_judged_are_named_together():
    others = [replace(CLAIM, id=name, finding="other") for name in ("d", "e")]
    with pytest.raises(ValueError, match=r"the claim d names[^\n]*\nthe claim e names[^\n]*$"):
        with_verdicts([CLAIM, *others], found(["topheavy.outcomes.simulate.simulate"], holds=True))


def test_what_was_not_run_for_lack_of_a_package_needs_no_function():
    claim = replace(CLAIM, remark="It is so for all.")
    row = with_verdict(claim, {"r": Findings.of({"not_tested": "no engine", "called": []})})
    assert (row.verdict, row.not_tested, row.remark) == ("not tested", "no engine", "no engine")


def test_number_that_is_zero_is_a_number():
    claim = replace(CLAIM, printed=0.0, tolerance=0.5)
    row = with_verdict(claim, found(["topheavy.outcomes.simulate.simulate"], value=0.0, error=0.0))
    assert (row.computed, row.verdict) == (0.0, "confirmed")
    assert isinstance(row.computed, float)


def test_judged_rows_are_read_as_they_were_written(tmp_path):
    rows = [with_verdict(CLAIM, found(["topheavy.outcomes.simulate.simulate"], holds=True))]
    path = tmp_path / "claims.json"
    path.write_text(as_text(rows), encoding="utf-8")
    assert read_judged(path) == rows
    sparse = as_text(rows, published=True)
    assert "null" not in sparse
    path.write_text(sparse, encoding="utf-8")
    assert read_judged(path) == rows
    path.write_text(as_text(rows).replace('"error"', '"eror"'), encoding="utf-8")
    with pytest.raises(ValueError, match=r"claims.json: c: .*'eror'"):
        read_judged(path)


@pytest.mark.parametrize(
    ("row", "told"),
    [
        ({"tolernce": 0.1}, "has an unknown key 'tolernce'; did you mean 'tolerance'"),
        ({"study": "mine"}, "has an unknown key 'study'; expected one of id, where"),
    ],
)
def test_misspelt_key_is_refused_with_a_suggestion(paths, row, told):
    write(paths[0], {"id": "c"} | row)
    with pytest.raises(ValueError, match=rf"claims\.yaml: c: the row {told}"):
        read_ledger(paths[:1])
    paths[0].write_text("- id: c\n  where: p. 1\n", encoding="utf-8")
    with pytest.raises(ValueError, match=r"c: the row lacks statement, expected"):
        read_ledger(paths[:1])
