"""The ledger of claims, its checks, and findings."""

import json
from dataclasses import replace
from pathlib import Path

import pytest
import yaml

from replication.judging.claim import Claim
from replication.judging.findings import Finding, Findings, read_findings
from replication.judging.ledger import (
    as_text,
    finding_of,
    read_judged,
    read_ledger,
    with_verdict,
    with_verdicts,
)
from replication.judging.ledger_check import PUBLISHED, SCHEMA, check_ledger
from replication.judging.verdicts import print_rounding, verdict_on
from replication.rules.one_claim import verdict_line
from replication.workbench import truth, value

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


ROOT = Path(__file__).resolve().parents[3]
ROW = {
    "id": "row",
    "where": "p. 1",
    "statement": "It is so.",
    "function": "topheavy.simulate",
    "rule": "heavier",
    "finding": "heavier_survives_more",
    "expected": "confirmed",
}
NUMBER = {"printed": 0.275, "tolerance": 5e-4, "because": "half a unit"}
MISSPELT = "expctd"
RULES = ["heavier", "statements"]


@pytest.fixture
def tree(tmp_path, plant):
    copied = [SCHEMA, "src/topheavy/__init__.pyi", "src/topheavy/outcomes/simulate.py"]
    files = {name: (ROOT / name).read_bytes() for name in copied}
    findings = {"heavier_survives_more": {"holds": True}, "called": []}
    published = {f"{PUBLISHED}/heavier.json": json.dumps(findings)}
    ledgers = {"paper/claims.yaml": "", "studies/own/claims.yaml": ""}
    return plant(tmp_path, files | published | ledgers)


def check(tree, *rows, own=()):
    paths = [tree / "paper" / "claims.yaml"]
    paths[0].write_text(yaml.safe_dump(list(rows)), encoding="utf-8")
    if own:
        paths.append(tree / "studies" / "own" / "claims.yaml")
        paths[1].write_text(yaml.safe_dump(list(own)), encoding="utf-8")
    check_ledger(paths, RULES, tree)


def without(*keys):
    return {key: ROW[key] for key in ROW if key not in keys}


@pytest.mark.parametrize(
    ("row", "told"),
    [
        (without("expected") | {MISSPELT: "confirmed"}, "unknown key 'expctd'; did you mean"),
        (ROW | {"expected": "qualifed"}, "expected is 'qualifed'; did you mean 'qualified'?"),
        (ROW | {"rule": "heavyer"}, 'findings="results/findings/heavyer.json"; did you mean'),
        (ROW | {"rule": "nosuch"}, 'output findings="results/findings/nosuch.json"; expected one'),
        (ROW | {"statement": "It falls"}, "'It falls'; expected a sentence, which ends with"),
        (ROW | {"function": "steps.heavier.main"}, "expected a function with its module, such as"),
        (ROW | {"finding": "heavier_survive_more"}, "did you mean 'heavier_survives_more'?"),
        (ROW | {"function": "topheavy.simulat"}, "function: topheavy.simulat is no function or cl"),
        (ROW | NUMBER | {"tolerance": 0.1}, "tolerance 0.1 is more than a tenth"),
        (ROW | NUMBER | {"tolerance": 0.001}, "would confirm a value twice as far off"),
        (without("where"), "lacks where"),
        (ROW | {"printed": 0.275, "because": "half a unit"}, "the row has because and lacks tole"),
        (ROW | {"expected": "refuted"}, "lacks remark"),
        (ROW | {"expected": "by definition", "remark": "So."}, "cannot be false has no finding"),
        (ROW | {"by_definition": True}, "is marked so, and nothing else is"),
        (without("rule", "function", "finding") | {"expected": "by definition", "remark": "So."},
         "lacks by_definition"),
        (ROW | {"id": "Upper"}, "id is 'Upper'"),
    ],
)  # fmt: skip
def test_row_that_is_wrong_is_named_with_its_file(tree, row, told):
    with pytest.raises(ValueError, match=r"claims\.yaml") as error:
        check(tree, row)
    line = next(line for line in str(error.value).splitlines() if told in line)
    assert line.startswith(f"{tree}/paper/claims.yaml: {row['id']}: ")


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("", "is empty; expected"),
        ("id: row\n", "holds a dict; expected a list of claims"),
        ("- where: p. 1\n  statement: It is so.\n", r"row 1 has no id \(It is so.\)"),
        ("- id: a\n- more\n", r"row 2 has no id \(more\)"),
        ("- id: a\n- id: a\n", "the id 'a' is given twice"),
    ],
)
def test_file_that_is_no_ledger_is_named(tree, text, told):
    path = tree / "paper" / "claims.yaml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(ValueError, match=f"paper/claims.yaml:? {told}"):
        check_ledger([path], RULES, tree)


def test_no_row_of_ours_confirms_a_value_twice_as_far_off_as_its_digits_allow():
    paths = [ROOT / "paper" / "claims.yaml", *sorted(ROOT.glob("studies/*/claims.yaml"))]
    claims = [claim for claim in read_ledger(paths) if claim.tolerance is not None]
    assert len(claims) > 10
    for claim in claims:
        for side in (-1.0, 1.0):
            off = claim.printed + 2.0001 * side * print_rounding(claim.printed)
            assert verdict_on(claim, value(off, 0.0)) == "refuted", claim.id


STATEMENT = Claim(
    id="s", where="p. 1", statement="So.", expected="confirmed", remark="Only if slender."
)
SLENDERNESS = replace(STATEMENT, printed=0.2683, tolerance=5e-5, unit="rad")
FOUND = "printed 0.2683, computed 0.26839 ± 1e-16 rad"


@pytest.mark.parametrize(
    ("claim", "finding", "verdict", "grounds"),
    [
        (SLENDERNESS, value(0.26839, 1e-16, "rad"), "confirmed", FOUND),
        (
            SLENDERNESS,
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
