"""The ledger is refused before anything is computed: file, row, what was expected."""

import json
from pathlib import Path

import pytest
import yaml

from replication.judging.ledger import read_ledger
from replication.judging.ledger_check import PUBLISHED, SCHEMA, check_ledger
from replication.judging.verdicts import print_rounding, verdict_on
from replication.workbench import value

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


def test_rows_that_are_right_pass(tree):
    check(
        tree,
        ROW,
        ROW | NUMBER | {"id": "number"},
        {"id": "lost", "where": "p. 1", "statement": "It was.", "expected": "not tested"}
        | {"remark": "A matter of history."},
        {"id": "name", "where": "p. 1", "statement": "It is called so.", "by_definition": True}
        | {"expected": "by definition", "remark": "It defines γ."},
        own=[
            {"id": "row", "rule": "statements", "finding": "more", "expected": "refuted"}
            | {"function": "topheavy.judge", "remark": "It fails."}
        ],
    )


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
