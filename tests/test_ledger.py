"""The claims ledger: complete, well formed, and tied to what computes it."""

import re
from collections import Counter
from pathlib import Path

import pytest
from jsonschema import Draft202012Validator

from replication.inputs.strict_yaml import read_yaml
from replication.judging.findings import findings_by_rule
from replication.judging.ledger import read_rows

ROOT = Path(__file__).resolve().parents[1]
LEDGER = read_yaml(ROOT / "paper" / "claims.yaml")
SCHEMA = ROOT / "src/replication/judging/claims.schema.yaml"
SCHEMA = read_yaml(SCHEMA)
CONFIG = read_yaml(ROOT / "config" / "config.yaml")
STUDIES = [ROOT / "studies" / name / "claims.yaml" for name in CONFIG["studies"]]
FINDINGS = findings_by_rule((ROOT / "tests" / "reference" / "findings").glob("*.json"))

# Every number of the paper's passage on the trilith, in its order.
TRILITH_NUMBERS = [0.22, 0.8, 0.275, 15.38, 0.4, 0.11, 0.415, 4.21, 265, 0.434, 0.9, 3.79]
TRILITH_NUMBERS += [11, 5, 0.005, 3.3, 2.15, 0.219]


def test_every_row_is_well_formed():
    rows = [row for _, _, row in read_rows([ROOT / "paper" / "claims.yaml", *STUDIES])]
    faults = [
        f"{rows[error.absolute_path[0]]['id']}: {error.message}"
        for error in Draft202012Validator(SCHEMA).iter_errors(rows)
    ]
    assert faults == []


def test_the_schema_is_one():
    Draft202012Validator.check_schema(SCHEMA)


@pytest.mark.parametrize(
    "change",
    [
        {"id": "Upper"},
        {"expected": "true"},
        {"remarks": "Misspelt."},
        {"tolerance": 0.1},
        {"expected": "not tested", "remark": "Has a finding."},
        {"expected": "qualified"},
        {"equation": 0},
        {"function": "steps.spectra.main"},
        {"by_definition": True},
        {"expected": "by definition", "remark": "Has a finding."},
        {"ours": False},
    ],
)
def test_the_schema_refuses(change):
    row = {
        "id": "row",
        "where": "p. 1",
        "statement": "It is so.",
        "function": "topheavy.simulate",
        "rule": "statements",
        "finding": "so",
        "expected": "confirmed",
    }
    validator = Draft202012Validator(SCHEMA)
    assert validator.is_valid([row])
    assert not validator.is_valid([row | change])


def test_no_id_is_given_twice():
    assert [key for key, count in Counter(row["id"] for row in LEDGER).items() if count > 1] == []


def test_no_statement_is_made_twice():
    # The same formula may be printed well in one place and badly in another.
    twice = Counter(
        (row["statement"], row.get("equation"), row.get("printed"), row["where"]) for row in LEDGER
    )
    assert max(twice.values()) == 1


def test_no_row_has_an_equation_that_the_paper_has_not():
    assert {row["equation"] for row in LEDGER if "equation" in row} <= set(range(1, 26))


@pytest.mark.parametrize("number", range(1, 26))
def test_every_equation_of_the_paper_has_a_row(number):
    rows = [row for row in LEDGER if row.get("equation") == number]
    assert rows
    for row in rows:
        assert f"Eq. ({number})" in row["where"]
        assert re.fullmatch(rf"eq{number}(_negative|_positive)?", row["finding"])


def test_both_figures_have_rows():
    for figure in ("Fig. 1", "Fig. 2"):
        assert any(figure in row["where"] for row in LEDGER)


@pytest.mark.parametrize(
    ("rule", "finding"), sorted({(row["rule"], row["finding"]) for row in LEDGER if "rule" in row})
)
def test_rule_made_the_finding_that_the_row_names(rule, finding):
    """In the published run; the next `make publish` takes up new ones."""
    assert finding in FINDINGS[rule].by_name


@pytest.mark.parametrize("number", TRILITH_NUMBERS)
def test_every_number_of_the_trilith_passage_has_a_row(number):
    printed = [str(row.get("printed", "")) for row in LEDGER if "trilith" in row["where"]]
    numbers = {float(found) for text in printed for found in re.findall(r"\d+(?:\.\d+)?", text)}
    assert number in numbers


def test_all_but_the_confirmed_say_why():
    assert [
        row["id"] for row in LEDGER if row["expected"] != "confirmed" and not row.get("remark")
    ] == []


def test_what_is_not_tested_or_cannot_be_false_has_no_finding():
    for row in LEDGER:
        without = row["expected"] in ("not tested", "by definition")
        assert ("finding" in row) != without, row["id"]


def test_limits_are_of_claims_of_the_ledgers():
    rows = [row for _, _, row in read_rows([ROOT / "paper" / "claims.yaml", *STUDIES])]
    known = {row["id"]: row for row in rows}
    limits = read_yaml(ROOT / "paper" / "limits.yaml")
    named = [name for row in limits for name in row["claims"]]
    assert set(named) <= set(known)
    assert all("finding" in known[name] for name in named)


TEXTS = ["README.md", "docs/findings.md", "paper/*.typ", "studies/*/*.typ", "paper/claims.yaml"]
TEXTS += ["studies/*/claims.yaml"]
BY = re.compile(
    r"(both|two|one) programs?\b|checker that shares no code|not proven|not to be proven|SymPy"
)
CODE = re.compile(
    r'#?let proven =.*|"[^"\n]*proven[^"\n]*"|`[^`\n]*`|\bproven\.[\w.-]+|(rule|id|function): .*'
)


def said_of(text):
    """Yield what stands around each `proven` of a prose, without the names in its code."""
    plain = " ".join(CODE.sub("", text).split())
    for found in re.finditer(r"\bproven\b", plain):
        yield plain[max(0, found.start() - 400) : found.end() + 700]


@pytest.mark.parametrize("path", sorted(p for each in TEXTS for p in ROOT.glob(each)), ids=str)
def test_what_is_proven_names_the_programs(path):
    for around in said_of(path.read_text(encoding="utf-8")):
        assert BY.search(around), around


def test_word_without_its_programs_is_found():
    (around,) = said_of('#let proven = found("proven_below")\nThe minimum is proven.')
    assert not BY.search(around)
    assert BY.search(f"{around} Both prove it, by both programs.")
