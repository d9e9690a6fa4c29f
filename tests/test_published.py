"""What README quotes is published, and a run's tables are compared with what is published."""

import re

import pandas as pd
import pytest

from documents.check import REFERENCE
from documents.compare import compare, departures
from documents.judge import faults
from tests.cases import ROOT

README = (ROOT / "README.md").read_text(encoding="utf-8")

TABLE = {"key": [0, 1, 4, 9], "outcome": [0, 1, 1, 0], "count": [7, 8, 9, 9], "x": [1.0, 2, 3, 4]}
BOUNDS = {"relative": 1e-6, "absolute": 1e-9, "counts": 2}


@pytest.mark.parametrize(
    ("column", "content", "departs"),
    [
        ("key", [0, 1, 4, 8], "key (At positional index 3, first diff: 8 != 9)"),
        ("outcome", [1, 0, 1, 0], ""),
        ("outcome", [1, 0, 0, 0], "outcome (At positional index 0, first diff: 1 != 0)"),
        ("count", [9, 6, 9, 9], ""),
        ("count", [7, 8, 9, 12], "count (At positional index 3, first diff: 12 != 9)"),
        ("x", [1.0, 2, 3, 4.000001], ""),
        ("x", [1.0, 2, 3, 4.00001], "x (At positional index 3, first diff: 4.00001 != 4.0)"),
    ],
)
def test_column_is_compared_as_a_key_an_outcome_a_count_or_a_number(column, content, departs):
    ours, theirs = pd.DataFrame(TABLE | {column: content}), pd.DataFrame(TABLE)
    assert "; ".join(departures(ours, theirs, BOUNDS, ["outcome", "count"])) == departs


@pytest.mark.parametrize(
    ("verdict", "required", "words"),
    [
        ("agrees", True, []),
        ("differs", False, ["t.csv differs from"]),
        ("other parameters", False, []),
        ("other parameters", True, ["t.csv was not compared (other parameters)"]),
        ("not published", True, ["t.csv was not compared (not published)"]),
    ],
)
def test_run_fails_where_a_table_is_not_as_published(verdict, required, words):
    table = {"table": "t.csv", "published": "p.csv", "verdict": verdict, "departs": "x"}
    lines = faults([], [table | {"required": str(required)}])
    assert len(lines) == len(words)
    assert all(line.startswith(start) for line, start in zip(lines, words, strict=True))


def test_table_of_other_parameters_or_sources_is_not_compared(tmp_path):
    path = str(tmp_path / "vase.csv")
    pd.read_csv(ROOT / REFERENCE / "vase.csv").to_csv(path, index=False)
    (path_of_other := tmp_path / "other" / "vase.csv").parent.mkdir()
    path_of_other.write_text("structure\nbare\n", "utf-8")
    rule = {"params": {"a": 1}, "sources": {"s": "0"}, "tables": [path]}
    for change, verdict in (
        ({}, "agrees"),
        ({"params": {"a": 2}}, "other parameters"),
        ({"sources": {"s": "1"}}, "other parameters"),
        ({"tables": [str(tmp_path / "new.csv")]}, "not published"),
        ({"tables": [str(path_of_other)]}, "differs"),
    ):
        compared = compare({"vase": rule | change}, {"vase": rule}, BOUNDS)
        assert list(compared.verdict) == [verdict]
    run = {"vase": rule | {"reads": ["a.csv", "b.csv"]}} | {
        name: {"params": {name: 1}, "tables": [f"{name}.csv"]} for name in ("b", "a")
    }
    of_others = run | {"b": run["b"] | {"params": {"b": 2}}}
    for rules, verdict in ((run, "agrees"), (of_others, "other parameters")):
        compared = compare(rules, dict(sorted(run.items())), BOUNDS)  # published in another order
        assert compared.verdict[0] == verdict


def test_example_of_readme_prints_what_its_comment_says(capsys):
    (code,) = re.findall(r"```python\n(.*?)```", README, re.DOTALL)
    exec(code, {})
    assert re.search(r":  # (.*)", code)[1].split(", ") == capsys.readouterr().out.split()
