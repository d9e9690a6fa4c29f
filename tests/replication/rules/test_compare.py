"""The comparison of a run's tables and findings with those that are published."""

import json
import math

import pandas as pd
import pytest

from replication.rules.compare import departures, main

TABLE = pd.DataFrame(
    {
        "mass_ratio": [0.0, 1.0, math.inf],
        "peak": [0.1, 0.2, math.nan],
        "impacts": [0, 2, 1],
        "holds": [False, False, True],
        "name": ["a", "b", "c"],
    }
)
BOUNDS = {"relative": 1e-6, "absolute": 1e-9}
LOOSE = {"relative": 0.02, "absolute": 0.01, "counts": 1}


def changed(column: str, row: int, value) -> pd.DataFrame:
    table = TABLE.astype({column: object}) if isinstance(value, str) else TABLE.copy()
    table.loc[row, column] = value
    return table


@pytest.mark.parametrize("sign", [1, -1])
def test_difference_is_relative_with_an_absolute_floor(sign):
    def departs(value, **bounds):
        return [*departures(changed("peak", 1, value), TABLE, bounds)]

    assert departs(0.2 + sign * 1e-3, relative=4.9e-3, absolute=0.0) == ["peak"]
    assert departs(0.2 + sign * 1e-3, relative=5.1e-3, absolute=0.0) == []
    assert departs(0.2 + sign * 1e-3, relative=0.0, absolute=1.1e-3) == []
    assert departs(0.2 + sign * 1e-3, relative=0.0, absolute=0.9e-3) == ["peak"]


@pytest.mark.parametrize(("value", "departs"), [(3, []), (4, ["impacts"])])
def test_counts_of_samples_may_differ_by_a_few(value, departs):
    assert list(departures(changed("impacts", 1, value), TABLE, LOOSE)) == departs
    assert list(departures(changed("impacts", 1, value), TABLE, BOUNDS)) == ["impacts"]


@pytest.mark.parametrize(
    ("column", "row", "value"),
    [
        ("peak", 2, 0.3),  # a number where there was none
        ("peak", 0, math.nan),
        ("peak", 0, math.inf),
        ("mass_ratio", 2, 5.0),
        ("mass_ratio", 2, -math.inf),
        ("holds", 0, True),
        ("name", 1, "x"),
        ("peak", 1, "much"),
    ],
)
def test_what_has_no_distance_departs(column, row, value):
    assert list(departures(changed(column, row, value), TABLE, LOOSE)) == [column]


@pytest.mark.parametrize(
    ("other", "departs"),
    [
        (TABLE.iloc[:2], list(TABLE)),
        (TABLE.drop(columns="name"), ["name (only published)"]),
        (TABLE.assign(top=1), ["top (only here)"]),
    ],
)
def test_tables_of_another_form_depart(other, departs):
    assert list(departures(other, TABLE, LOOSE)) == departs


@pytest.fixture
def run(plant, tmp_path, monkeypatch):
    """A run of two jobs of which the second reads the first, and what is published of both."""
    monkeypatch.chdir(tmp_path)
    found = json.dumps({"lowest": {"value": 0.3, "error": 0.0, "of": [1, 2]}, "called": []})
    files = {"tables/one": TABLE.to_csv(index=False), "tables/two": TABLE.to_csv(index=False)}
    files = {f"{name}.csv": text for name, text in files.items()} | {"findings/two.json": found}
    plant(tmp_path, {f"results/{name}": text for name, text in files.items()})
    there = {
        "results/tables/one.csv": "tests/reference/one.csv",
        "results/tables/two.csv": "tests/reference/studies/two.csv",
        "results/findings/two.json": "tests/reference/findings/two.json",
    }
    plant(tmp_path, {there[f"results/{name}"]: text for name, text in files.items()})
    jobs = {"one": "a", "two": "b"}
    origins = {path: jobs if "two" in path else {"one": "a"} for path in there}
    return lambda published, bounds=BOUNDS | {"sampled": LOOSE}: [
        (row["verdict"], row["departs"]) for row in main(there, origins, published, bounds)
    ]


AGREES = ("agrees", "")


def test_only_what_depends_on_a_change_is_not_compared(run):
    assert run({"one": "a", "two": "b"}) == run(None) == [AGREES] * 3
    two = ("not compared: parameters or inputs differ of two", "")
    assert run({"one": "a", "two": "c"}) == run({"one": "a"}) == [AGREES, two, two]
    assert [verdict[-6:] for verdict, _ in run({"one": "c", "two": "b"})] == ["of one"] * 3


def test_a_main_table_has_the_strict_bounds_and_the_rest_those_of_samples(run):
    for name in ("one", "two"):
        changed("peak", 1, 0.201).to_csv(f"results/tables/{name}.csv", index=False)
    assert run(None) == [("differs", "peak"), AGREES, AGREES]
    changed("peak", 1, 0.301).to_csv("results/tables/two.csv", index=False)
    assert run(None)[1:] == [("differs", "peak"), AGREES]
    assert run(None, BOUNDS)[1:] == [("differs", "peak"), AGREES]


@pytest.mark.parametrize(("error", "departs"), [("0.0149", ""), ("0.03", "lowest.error")])
def test_error_is_compared_by_its_two_published_digits(run, tmp_path, error, departs):
    here, there = (tmp_path / f"{top}/findings/two.json" for top in ("results", "tests/reference"))
    there.write_text(there.read_text().replace("0.0", "0.015"))
    here.write_text(here.read_text().replace("0.0", error))
    assert run(None)[2][1] == run(None, BOUNDS)[2][1] == departs


def test_job_that_tested_nothing_is_not_compared(run, tmp_path):
    (tmp_path / "results/findings/two.json").write_text('{"not_tested": "no engine"}')
    assert run(None) == [AGREES, *[("not compared: no engine", "")] * 2]
