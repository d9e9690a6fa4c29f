"""The deliberate faults: each still fits the tree, and the table has what caught it."""

import os
import shutil
from dataclasses import replace
from pathlib import Path

import pytest
import yaml

from replication.commands import kill_table as command
from replication.judging.calls import definition
from replication.judging.findings import Findings
from replication.judging.ledger import read_ledger
from replication.kill import table as table
from replication.kill.faults import JUDGING, Change, Fault, faulty, load
from replication.kill.table import Row
from replication.workbench import truth

ROOT = Path(__file__).resolve().parents[3]
FAULTS = load()
LEDGER = read_ledger(command.ledger_files())
NAMES = [fault.name for fault in FAULTS]
ONE = Fault(
    name="one",
    fault="One is two.",
    routes="all",
    tests=("test_one.py",),
    changes=(Change("one.py", "x = 1", "x = 2"),),
    home="faults/one.yaml",
)
ROW = Row("one", "One is two.", "all", "one.py", "verdict", "eq1 eq2", "", "", "2026-01-01")


@pytest.fixture(scope="module")
def published():
    return table.read(ROOT / "docs" / "kill_table.csv")


@pytest.fixture
def tree(tmp_path):
    """A tree of one file, and a test of it that passes.

    The file is old, as in a copy, so that Python does not take the faulty one's bytecode for its.
    """
    (tmp_path / "one.py").write_text("x = 1\n", encoding="utf-8")
    os.utime(tmp_path / "one.py", (0.0, 1e9))
    test = "from one import x\n\n\ndef test_one():\n    assert x == 1\n"
    (tmp_path / "test_one.py").write_text(test, encoding="utf-8")
    return tmp_path


# The faults --------------------------------------------------------------------------------------


def test_faults_still_fit_the_tree():
    assert FAULTS
    for fault in FAULTS:
        for file, text in fault.texts(ROOT).items():
            assert file.startswith(("src/", "studies/", "config/")), fault.name
            assert text != (ROOT / file).read_text(encoding="utf-8"), fault.name
            if file.endswith(".yaml"):
                assert yaml.load(text, getattr(yaml, "CSafeLoader", yaml.SafeLoader)), fault.name
            elif not file.endswith((".css", ".js")):
                compile(text, fault.name, "exec")  # a fault of the sense, not of the syntax
        assert fault.tests, fault.name
        for test in fault.tests:
            file, _, function = test.partition("::")
            assert (ROOT / file).exists(), fault.name
            if function:
                assert f"def {function}" in (ROOT / file).read_text(encoding="utf-8"), fault.name


def test_fault_that_names_no_tests_is_asked_of_those_of_its_modules(tmp_path, plant):
    tests = {
        "studies/a/steps/one.py": "studies/a/tests/test_one.py",
        "src/steps/one.py": "tests/steps/test_one.py",
        "src/library/bodies/one.py": "tests/bodies/test_all.py",
    }
    changes = [{"file": file, "old": "", "new": ""} for file in [*tests, "src/steps/one.py"]]
    entry = {"name": "one", "fault": "Wrong.", "changes": changes}
    heads = dict.fromkeys(tests.values(), "from library.bodies import one\n")
    later = {"tests/bodies/test_two.py": "def test_two():\n    assert one\n"}
    plant(tmp_path, {"faults/one.yaml": yaml.safe_dump([entry])} | heads | later)
    assert [fault.tests for fault in load(tmp_path)] == [tuple(tests.values())]


def test_fault_needs_no_study_but_its_own_and_has_its_name_alone():
    """It would be lost, or fit no tree, without the other study."""
    for fault in FAULTS:
        own = Path(fault.home).parent.as_posix() if fault.home.startswith("studies/") else None
        files = [Path(file) for file in (*fault.files, *fault.tests)]
        homes = {"/".join(file.parts[:2]) for file in files if file.parts[0] == "studies"}
        assert homes <= {own}, fault.name
    assert len({*NAMES}) == len(NAMES)


@pytest.mark.parametrize(("text", "times"), [("y = 1\n", 0), ("x = 1\nx = 1\n", 2)])
def test_fault_that_no_longer_fits_is_named_with_its_file(tmp_path, text, times):
    (tmp_path / "one.py").write_text(text, encoding="utf-8")
    with pytest.raises(ValueError, match=rf"one.yaml: one: one.py has {times} times 'x = 1'"):
        ONE.texts(tmp_path)


def test_fault_leaves_no_trace(tree):
    file = tree / "one.py"
    before = file.stat().st_mtime_ns
    with faulty(tree, ONE):
        assert file.read_text(encoding="utf-8") == "x = 2\n"
    assert file.read_text(encoding="utf-8") == "x = 1\n"
    assert file.stat().st_mtime_ns == before


# What catches a fault ----------------------------------------------------------------------------


def judge(monkeypatch, tree, fault, turned, *, fails=True, **options):
    """Put a fault to the test, where the rules of claims turn these; the rules that were asked."""
    asked = []

    def workflow(tree, claims, studies):
        assert (tree / "one.py").read_text(encoding="utf-8") == "x = 2\n"
        rules = list(dict.fromkeys(claim.rule for claim in claims))
        asked.extend(rules)
        return [name for name in turned if name in {c.id for c in claims}], rules[2:], ""

    def first_failing(tree, tests):
        asked.extend(tests)
        return "test_one.py::test_one" if fails else ""

    monkeypatch.setattr(table, "workflow", workflow)
    monkeypatch.setattr(table, "first_failing", first_failing)
    row = table.put_to_the_test(tree, fault, LEDGERS, [], lambda claims: None, **options)
    return row, asked


def of(rule, name):
    return replace(LEDGER[0], id=name, rule=rule, finding="x")


LEDGERS = {
    "paper": [of("a", "eq1"), of("b", "eq2"), of("b", "eq3"), of("c", "eq4")],
    "studies": [of("d", "ours")],
}
PAPERS = ["a", "b", "c"]


def test_first_failing_test_is_named(tree):
    assert table.first_failing(tree, ["test_one.py"]) == ""
    with faulty(tree, ONE):
        assert table.first_failing(tree, ["test_one.py"]) == "test_one.py::test_one"
        of_a_file = """import pytest
@pytest.mark.parametrize("path", ["a.py"])
def test_path(path): assert False
"""
        (tree / "test_paths.py").write_text(of_a_file, encoding="utf-8")
        assert table.first_failing(tree, ["test_paths.py"]) == "test_paths.py::test_path"


def test_fault_in_the_judging_that_no_test_catches_survives_at_once(monkeypatch, tree):
    judging = replace(ONE, routes=JUDGING)
    row, asked = judge(monkeypatch, tree, judging, ["eq1"], fails=False)
    assert (row.caught_by, asked) == ("SURVIVED", ["test_one.py"])


def test_new_fault_is_put_to_tests_then_to_the_paper_then_to_studies(monkeypatch, tree):
    row, asked = judge(monkeypatch, tree, ONE, ["eq1"])
    assert (row.caught_by, row.test) == ("test", "test_one.py::test_one")
    assert asked == ["test_one.py"]
    row, asked = judge(monkeypatch, tree, ONE, ["eq1", "ours"], fails=False)
    assert (row.caught_by, row.verdicts, row.rules) == ("verdict", "eq1", "c")
    assert asked == ["test_one.py", *PAPERS]
    row, asked = judge(monkeypatch, tree, ONE, ["ours"], fails=False)
    assert (row.caught_by, row.verdicts) == ("verdict", "ours")
    assert asked == ["test_one.py", *PAPERS, "d"]
    row, _ = judge(monkeypatch, tree, ONE, [], fails=False)
    assert (row.caught_by, row.rules) == ("rule", "c")


def test_rule_of_a_study_is_asked_first_only_where_none_of_the_paper_turned(monkeypatch, tree):
    for turned, rule in (("ours", "d"), ("ours eq4", "c")):
        last = replace(ROW, verdicts=turned)
        _, asked = judge(monkeypatch, tree, ONE, turned.split(), last=last, seconds={"c": 9.0})
        assert asked == [rule]


def test_test_that_caught_a_fault_last_is_asked_first(monkeypatch, tree):
    last = replace(ROW, verdicts="", test="test_one.py::test_one")
    row, asked = judge(monkeypatch, tree, ONE, ["eq1"], last=last)
    assert (row.test, asked) == (last.test, [last.test])


# A run -------------------------------------------------------------------------------------------


@pytest.fixture
def trees(monkeypatch, tree):
    """Copies of the tree of one file in which rules a, b and c are run; what ran in which copy."""
    ran = []

    def workflow(tree, claims, studies, cores=1):
        rules = sorted({claim.rule for claim in claims})
        assert all((tree / "results" / rule).exists() for rule in rules) or "2" not in one(tree)
        (tree / "results").mkdir(exist_ok=True)
        (tree / ".snakemake").mkdir(exist_ok=True)
        for rule in rules:
            (tree / "results" / rule).touch()
        ran.append((one(tree), rules))
        return ["eq1"] if "2" in one(tree) and "a" in rules else [], [], ""

    def one(tree):
        return (tree / "one.py").read_text(encoding="utf-8")

    for name, value in {
        "TABLE": tree / "table",
        "ROOT": tree,
        "ledgers": lambda: LEDGERS,
        "studies": list,
        "ledger_files": list,
        "current": lambda rows, *given: rows,
        "copy_tree": lambda to: shutil.copytree(tree, to),
    }.items():
        monkeypatch.setattr(command, name, value)

    def first_failing(tree, tests, cores=0):
        assert not (tree / "results").exists()
        return "test_one.py::test_one" if "2" in one(tree) else ""

    for module in (command, table):
        monkeypatch.setattr(module, "workflow", workflow)
        monkeypatch.setattr(module, "first_failing", first_failing)
    return ran


def test_rules_that_are_asked_run_once_without_a_fault_and_no_test_sees_results(trees, tree):
    table.write([ROW, replace(ROW, name="two")], [], tree / "table.csv")
    faults = [replace(ONE, name=name) for name in ("one", "two", "three")]
    rows = {row.name: row.caught_by for row in command.kill_table(faults)}
    assert rows == {"one": "verdict", "two": "verdict", "three": "test"}
    assert trees == [("x = 1\n", ["a"]), ("x = 2\n", ["a"]), ("x = 2\n", ["a"])]
    assert set(rows) == {row.name for row in command.kill_table(faults, cores=2)}


@pytest.mark.parametrize(
    ("test", "turned", "told"),
    [
        ("test_one.py::test_one", [], "without a fault: it fails"),  # it is asked first
        ("", ["eq1"], r"without a fault: \['eq1'\] turn"),
        ("", [], "without a fault: it fails"),  # as no verdict turns any more
    ],
)
def test_what_fails_without_a_fault_stops_the_run(trees, tree, monkeypatch, test, turned, told):
    table.write([replace(ROW, verdicts="eq1", test=test)], [], tree / "table.csv")
    for name in ("results", ".snakemake"):
        (tree / name).mkdir()
    for module in (command, table):
        monkeypatch.setattr(module, "workflow", lambda *given: (turned, [], "said"))
        monkeypatch.setattr(module, "first_failing", lambda *given: "it")
    with pytest.raises(RuntimeError, match=told):
        list(command.kill_table([ONE]))


def test_verdict_is_that_of_the_findings_and_of_what_ran():
    (claim,) = (row for row in LEDGER if row.id == "eq1")
    called = definition(claim.function, ROOT)
    for holds, verdict in ((True, "confirmed"), (False, "refuted")):
        findings = Findings({claim.finding: truth(holds)}, (called,))
        assert table.verdict(claim, {claim.rule: findings}, ROOT) == verdict
    uncalled = Findings({claim.finding: truth(True)})
    assert "never called" in table.verdict(claim, {claim.rule: uncalled}, ROOT)
    assert table.verdict(claim, {}, ROOT).startswith("none: ")


def test_rows_of_all_ledgers_are_judged_once():
    paper, studies = command.ledgers().values()
    assert sorted(row.id for row in paper + studies) == sorted(row.id for row in LEDGER)
    assert {row.study for row in studies} >= set(command.studies())


# What is kept ------------------------------------------------------------------------------------


@pytest.fixture
def found(monkeypatch, tree):
    """A file in which the row of ONE is kept."""
    monkeypatch.setattr(command, "ROOT", tree)
    command.keep(tree / "kept", ONE.digest(tree), ROW)
    return tree / "kept"


def test_row_is_kept_for_the_fault_that_was_run(found, tree, monkeypatch):
    """The tree may change while a fault is run in its copy."""

    def ran(faults, **options):
        (tree / "one.py").write_text("x = 1\ny = 1\n", encoding="utf-8")
        yield ROW

    monkeypatch.setattr(command, "KEPT", tree / "none")
    monkeypatch.setattr(command, "kill_table", ran)
    monkeypatch.setattr(command, "load", lambda: [ONE, replace(ONE, name="two")])
    monkeypatch.setattr("sys.argv", ["kill_table", "--faults=one"])
    command.main()
    assert command.left([ONE], command.kept(command.KEPT)) == [ONE]


# The published table -----------------------------------------------------------------------------


def waiting(rows):
    """The faults that were not run since they were written or changed."""
    return [name for name in NAMES if name not in {row.name for row in rows}]


def test_published_table_is_current_and_its_page_is_that_of_the_table(published):
    assert table.current(published, FAULTS, LEDGER, ROOT) == published
    page = (ROOT / "docs" / "kill_table.md").read_text(encoding="utf-8")
    assert page == table.page(published, LEDGER, waiting(published))


def test_row_of_which_the_fault_or_what_caught_it_is_gone_is_dropped(tree):
    (tree / "Snakefile").write_text("rule one:\n", encoding="utf-8")
    claims = [replace(LEDGER[0], id="eq1")]

    def left(row, faults=(ONE,)):
        return table.current([row], faults, claims, tree)

    assert left(ROW) == [replace(ROW, verdicts="eq1")]
    assert left(replace(ROW, verdicts="eq2")) == []
    assert left(ROW, [replace(ONE, fault="Two is three.")]) == []
    assert left(ROW, []) == []
    tested = replace(ROW, caught_by="test", verdicts="", test="test_one.py::test_one")
    assert left(tested) == [tested]
    assert left(replace(tested, test="test_two.py::test_two")) == []
    assert left(replace(tested, test="test_one.py::test_renamed")) == []
    assert left(replace(tested, test="test_one.py::TestOfOld::test_one")) == []
    stopped = replace(ROW, caught_by="rule", verdicts="", rules="one two")
    assert left(stopped) == [replace(stopped, rules="one")]
    assert left(replace(stopped, rules="two")) == []


def test_publishing_takes_what_was_found_since(monkeypatch, tmp_path, published):
    monkeypatch.setattr(command, "TABLE", tmp_path / "kill_table")
    monkeypatch.setattr(command, "KEPT", tmp_path / "kept")
    by_name = {fault.name: fault for fault in FAULTS}
    again, stale, survived = (replace(row, date="2027-01-01") for row in published[:3])
    for row in (again, stale, replace(survived, caught_by="SURVIVED")):
        digest = "other" if row == stale else by_name[row.name].digest(ROOT)
        command.keep(command.KEPT, digest, row)
    table.write(published[1:], LEDGER, command.TABLE)
    assert command.refresh()
    later = replace(again, date="2027-01-02")
    command.keep(command.KEPT, by_name[again.name].digest(ROOT), later)
    assert not command.refresh()
    assert table.read(tmp_path / "kill_table.csv") == [later, *published[1:]]


def test_publishing_names_the_faults_to_run(monkeypatch, tmp_path, published):
    monkeypatch.setattr(command, "TABLE", tmp_path / "kill_table")
    monkeypatch.setattr(command, "KEPT", tmp_path / "none")
    table.write([replace(published[0], fault="Other."), *published[1:]], LEDGER, command.TABLE)
    command.refresh()
    assert table.read(tmp_path / "kill_table.csv") == published[1:]
    page = (tmp_path / "kill_table.md").read_text(encoding="utf-8")
    names = waiting(published[1:])
    assert published[0].name in names
    assert f"written or changed ({len(names)}): {', '.join(names)}." in page


# The choice --------------------------------------------------------------------------------------


def test_commit_picks_different_faults_and_every_fault_has_its_turn():
    picked = [command.rotation(FAULTS, 3, f"{commit:x}") for commit in range(len(FAULTS))]
    assert all(len({fault.name for fault in three}) == 3 for three in picked)
    assert {fault.name for three in picked for fault in three} == set(NAMES)
    assert command.rotation(FAULTS, 3, "a0573f3\n") == command.rotation(FAULTS, 3, "a0573f3")


def test_faults_are_chosen_by_name_or_route_and_an_unknown_one_is_refused():
    judging = command.chosen(FAULTS, JUDGING, None)
    assert judging
    assert judging == [fault for fault in FAULTS if fault.routes == JUDGING]
    with pytest.raises(SystemExit, match="no fault is named 'gremlin'; there are cap_without"):
        command.chosen(FAULTS, "p_for_p_hat,gremlin", None)


def test_rotation_without_a_repository_says_what_to_do(tmp_path, monkeypatch):
    monkeypatch.setattr(command, "ROOT", tmp_path)
    monkeypatch.setenv("GIT_CEILING_DIRECTORIES", str(tmp_path.parent))
    with pytest.raises(SystemExit, match="no git repository here; expected one, or names"):
        command.chosen(FAULTS, None, 3)
