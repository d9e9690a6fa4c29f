"""How many tests fail on a fault, in a small tree with a fault of its own."""

import pytest

from replication.commands import kill_table as command
from replication.kill import counts
from replication.kill.faults import Change, Fault

TESTS = """from one import x


def test_first():
    assert x == 1


def test_last():
    assert x < 2
"""


def fault(new: str, tests: tuple[str, ...] = ("tests/test_named.py",)) -> Fault:
    return Fault(
        "one", "One is not one.", "all", tests, (Change("one.py", "x = 1", new),), "f.yaml"
    )


@pytest.fixture
def tree(plant, tmp_path):
    plant(
        tmp_path,
        {
            "one.py": "x = 1\n",
            "tests/test_named.py": "from pathlib import Path\n\n\n"
            "def test_text():\n    assert 'x = 1' in Path('one.py').read_text()\n",
            "tests/test_importing.py": TESTS,
            "tests/test_other.py": "def test_other():\n    assert False\n",
            "studies/a/tests/test_made.py": "from importlib import import_module\n\n\n"
            "def test_any():\n    import_module(f'{\"one\"}')\n",
        },
    )
    return tmp_path


def test_tests_that_a_fault_names_and_those_that_may_import_the_file_are_run(tree):
    asked = [*counts.test_files(tree, fault("x = 2"))]
    assert asked == ["tests/test_named.py", "tests/test_importing.py"]
    elsewhere = Fault("a", "", "all", (), (Change("src/one.py", "x", "y"),), "f.yaml")
    (tree / "src").mkdir()
    (tree / "src" / "one.py").write_text("x = 1\n")
    assert "studies/a/tests/test_made.py" in counts.test_files(tree, elsewhere)


def test_no_failure_stops_the_others_and_a_test_that_passes_is_not_counted(tree):
    assert counts.failing(tree, fault("x = 2")) == [
        "tests/test_named.py::test_text",
        "tests/test_importing.py::test_first",
        "tests/test_importing.py::test_last",
    ]
    assert counts.failing(tree, fault("x = 1.0", ("tests/test_importing.py",))) == []


def test_run_that_names_no_test_is_an_error(tree):
    with pytest.raises(RuntimeError, match="one: pytest ended with 4 and named no test"):
        counts.failing(tree, fault("x = 2", ("tests/test_gone.py",)))


def test_row_holds_while_the_fault_and_its_files_are_as_they_were(tree):
    one, few = fault("x = 2"), ["a", "b", "c"]
    old, new = counts.row(one, tree, few), counts.row(one, tree, [*few, "d"])
    assert (old["caught_by_n"], old["tests"], new["caught_by_n"], new["tests"]) == (
        "3",
        "a b c",
        "4",
        "",
    )
    assert counts.merged([one], tree, [old], [new]) == [new]
    (tree / "one.py").write_text("x = 1  # as ever\n")
    assert counts.merged([one], tree, [old]) == []


def test_what_is_counted_is_kept_and_not_run_again(tree, monkeypatch, capsys):
    monkeypatch.setattr(command, "ROOT", tree)
    monkeypatch.setattr(command, "COUNTS", tree / "counts.csv")
    monkeypatch.setattr(command, "copy_tree", lambda to: to.symlink_to(tree))
    for said in ("0 of 1", "1 of 1"):
        command.count([fault("x = 2")], [fault("x = 2")], 1)
        assert capsys.readouterr().out.startswith(f"{said} faults are in counts.csv")
    assert [row["caught_by_n"] for row in counts.read(tree / "counts.csv")] == ["3"]
