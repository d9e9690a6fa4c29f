"""The deliberate faults: each still fits the library, and the table says what caught it."""

import csv
from pathlib import Path

import pytest
import yaml

from faults import kill_table

ROOT = Path(__file__).resolve().parents[1]
FAULTS = kill_table.load()
LEDGER = yaml.safe_load((ROOT / "paper" / "claims.yaml").read_text(encoding="utf-8"))
NAMES = [fault.name for fault in FAULTS]
ONE = kill_table.Fault(
    name="one",
    fault="One is two.",
    routes="all",
    tests=(),
    changes=(kill_table.Change("one.py", "x = 1", "x = 2"),),
)


@pytest.fixture(scope="module")
def published():
    with (ROOT / "docs" / "kill_table.csv").open(encoding="utf-8", newline="") as file:
        return [kill_table.Row(**row) for row in csv.DictReader(file)]


@pytest.mark.parametrize("fault", FAULTS, ids=NAMES)
def test_fault_still_fits_the_library(fault):
    for file, text in fault.texts(ROOT).items():
        assert file.startswith("src/topheavy/")
        assert text != (ROOT / file).read_text(encoding="utf-8")
        compile(text, file, "exec")  # a fault of the physics, not of the syntax
    assert all((ROOT / test).exists() for test in fault.tests)
    assert fault.tests


def test_names_are_unique():
    assert len(set(NAMES)) == len(NAMES)


def test_published_table_has_every_fault_as_it_is(published):
    kept = [(row.name, row.fault, row.routes, row.files) for row in published]
    assert kept == [(f.name, f.fault, f.routes, " ".join(f.files)) for f in FAULTS]


def test_published_table_has_no_survivor(published):
    assert {row.caught_by for row in published} <= {"verdict", "rule", "test"}
    assert all(row.verdicts or row.rules or row.test for row in published)


def test_what_caught_a_fault_is_still_there(published):
    rules = (ROOT / "Snakefile").read_text(encoding="utf-8")
    for row in published:
        assert set(row.verdicts.split()) <= {claim["id"] for claim in LEDGER}
        assert all(f"rule {rule}:" in rules for rule in row.rules.split())  # all: given up
        file, *_, test = row.test.split("::") if row.test else ("", "")
        assert not file or f"def {test}(" in (ROOT / file).read_text(encoding="utf-8")


def test_published_page_is_that_of_the_table(published):
    page = (ROOT / "docs" / "kill_table.md").read_text(encoding="utf-8")
    assert page == kill_table.page(published)


@pytest.mark.parametrize(("text", "times"), [("y = 1\n", 0), ("x = 1\nx = 1\n", 2)])
def test_fault_that_no_longer_fits_is_named_with_its_file(tmp_path, text, times):
    (tmp_path / "one.py").write_text(text, encoding="utf-8")
    with pytest.raises(ValueError, match=rf"faults.yaml: one: one.py has {times} times 'x = 1'"):
        ONE.texts(tmp_path)


def test_fault_leaves_no_trace(tmp_path):
    file = tmp_path / "one.py"
    file.write_text("x = 1\n", encoding="utf-8")
    before = file.stat().st_mtime_ns
    with kill_table.faulty(tmp_path, ONE):
        assert file.read_text(encoding="utf-8") == "x = 2\n"
    assert file.read_text(encoding="utf-8") == "x = 1\n"
    assert file.stat().st_mtime_ns == before


def test_verdict_without_a_finding_is_none_that_is_expected():
    claim = next(row for row in LEDGER if row.get("finding"))
    assert kill_table.verdict(claim, {}).startswith("none: ")


def test_commit_picks_different_faults_and_every_fault_has_its_turn():
    picked = [kill_table.rotation(FAULTS, 3, f"{commit:x}") for commit in range(len(FAULTS))]
    assert all(len({fault.name for fault in three}) == 3 for three in picked)
    assert {fault.name for three in picked for fault in three} == set(NAMES)
    assert kill_table.rotation(FAULTS, 3, "a0573f3\n") == kill_table.rotation(FAULTS, 3, "a0573f3")


def test_unknown_fault_is_refused_with_those_that_there_are():
    with pytest.raises(SystemExit, match="no fault is named 'gremlin'; there are cap_without"):
        kill_table.chosen(FAULTS, "p_for_p_hat,gremlin", None)


def test_rotation_without_a_repository_says_what_to_do(tmp_path, monkeypatch):
    monkeypatch.setattr(kill_table, "ROOT", tmp_path)
    monkeypatch.setenv("GIT_CEILING_DIRECTORIES", str(tmp_path.parent))
    with pytest.raises(SystemExit, match="no git repository here; expected one, or names"):
        kill_table.chosen(FAULTS, None, 3)
