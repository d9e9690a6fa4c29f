"""The comparison of a run's tables with those that are committed."""

import math

import pandas as pd
import pytest

from replication.rules.compare import largest_difference, main

TABLE = pd.DataFrame(
    {
        "mass_ratio": [0.0, 1.0, math.inf],
        "peak": [0.1, 0.2, math.nan],
        "impacts": [0, 2, 1],
        "name": ["a", "b", "c"],
    }
)
BOUNDS = {"relative": 1e-6, "absolute": 1e-9}


def changed(column: str, row: int, value) -> pd.DataFrame:
    table = TABLE.astype({column: object}) if isinstance(value, str) else TABLE.copy()
    table.loc[row, column] = value
    return table


def test_table_does_not_differ_from_itself():
    assert largest_difference(TABLE, TABLE.copy(), 1e-9) == 0.0


@pytest.mark.parametrize("sign", [1, -1])
def test_difference_is_relative_with_an_absolute_floor(sign):
    other = changed("peak", 1, 0.2 + sign * 1e-3)
    assert largest_difference(other, TABLE, 0.0) == pytest.approx(5e-3)
    assert largest_difference(other, TABLE, 0.8) == pytest.approx(1e-3)
    at_zero = changed("mass_ratio", 0, sign * 1e-12)
    assert largest_difference(at_zero, TABLE, 1e-9) == pytest.approx(1e-3)


def test_largest_of_all_columns_counts():
    other = changed("peak", 1, 0.2002).assign(impacts=[0, 3, 1])
    assert largest_difference(other, TABLE, 0.0) == pytest.approx(0.5)


@pytest.mark.parametrize(
    ("column", "row", "value"),
    [
        ("peak", 2, 0.3),  # a number where there was none
        ("peak", 0, math.nan),
        ("peak", 0, math.inf),
        ("mass_ratio", 2, 5.0),
        ("mass_ratio", 2, -math.inf),
        ("name", 1, "x"),
        ("peak", 1, "much"),
    ],
)
def test_what_has_no_distance_is_infinitely_far(column, row, value):
    assert largest_difference(changed(column, row, value), TABLE, 1e-9) > 1e9


@pytest.mark.parametrize(
    "other",
    [TABLE.iloc[:2], TABLE.drop(columns="name"), TABLE.rename(columns={"peak": "top"})],
    ids=["a row less", "a column less", "another name"],
)
def test_tables_of_another_form_are_infinitely_far(other):
    assert largest_difference(other, TABLE, 1e-9) == math.inf
    assert largest_difference(TABLE, other, 1e-9) == math.inf


def test_other_truth_is_a_difference():
    truths = TABLE.assign(holds=[False, False, True])
    assert largest_difference(truths, truths.copy(), 1e-9) == 0.0
    assert largest_difference(truths.assign(holds=True), truths, 1e-9) >= 1.0


def test_table_agrees_differs_or_is_not_compared_when_the_config_was_changed(tmp_path):
    ours, theirs = tmp_path / "ours" / "peaks.csv", tmp_path / "reference" / "peaks.csv"
    for path in (ours, theirs):
        path.parent.mkdir()
        TABLE.to_csv(path, index=False)
    for value, keys, verdict, difference in (
        (0.2 + 1e-8, [], "agrees", 5e-8),
        (0.2 + 1e-6, [], "differs", 5e-6),
        (9.0, ["one", "other"], "not compared: config.yaml differs in one, other", math.nan),
    ):
        changed("peak", 1, value).to_csv(ours, index=False)
        (row,) = main([str(ours)], [str(theirs)], keys, BOUNDS)
        assert (row["table"], row["verdict"]) == ("peaks.csv", verdict)
        assert row["largest_difference"] == pytest.approx(difference, rel=1e-4, nan_ok=True)
    with pytest.raises(KeyError, match="peaks"):  # the run did not make it
        main([], [str(theirs)], [], BOUNDS)
