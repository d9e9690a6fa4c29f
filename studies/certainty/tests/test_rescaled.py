"""Reversals under a rescaled record: each condition of the finding, where it alone fails."""

import numpy as np
import pandas as pd
import pytest

from studies.certainty.steps import rescaled
from topheavy import Column, Record

GAMMAS = [0.0, 1.0, 4.0]


@pytest.mark.parametrize(
    ("falls", "pair"),
    [
        ([False, False, False], None),
        ([True, True, True], None),
        ([True, False, False], None),
        ([False, True, False], (0.0, 1.0)),
        ([True, False, True], (1.0, 4.0)),
        ([False, False, True], (0.0, 4.0)),
    ],
)
def test_order_is_reversed_if_a_heavier_one_overturns_and_a_lighter_one_survives(falls, pair):
    assert rescaled.reversed_pair(GAMMAS, np.array(falls)) == pair


def test_ends_are_the_nearest_factors_at_which_the_pair_is_not_reversed(monkeypatch):
    factors = np.array([0.97, 0.98, 0.99, 1.0, 1.01, 1.02, 1.03])
    falls = np.array([[False] * 7, [False, True, True, True, True, False, True], [False] * 7])
    monkeypatch.setattr(rescaled, "overturned_together", lambda *given: falls)
    asked = []
    monkeypatch.setattr(rescaled, "by_scipy", lambda *given: asked.append(given[2:]) or True)
    record, column = Record(0.01, np.zeros(4)), Column(0.5, 3.0)
    found = pd.DataFrame(rescaled.rows(record, "c", column, GAMMAS, factors))
    assert found[found.end.notna()].end.tolist() == [0.97, 1.02]
    assert asked == [((0.0, 1.0), 0.98, 0.97), ((0.0, 1.0), 1.01, 1.02)]


def table(ends=(0.996, 1.001), own=True):
    rows = [
        {"record": "a", "structure": "c", "factor": factor, "overturned": None, "reversed": False}
        for factor in (0.95, 0.98, 0.99, 1.0, 1.01, 1.02, 1.05)
    ]
    rows[3]["reversed"] = own
    for row, end in zip((rows[2], rows[4]), ends, strict=False):
        row |= {"end": end, "survives": 0.0, "overturns": 1.0, "by_scipy": True}
    return pd.DataFrame(rows)


@pytest.mark.parametrize(
    ("found", "holds"),
    [
        (table(), True),
        (table(ends=(0.996,)), False),  # it does not end upward
        (table(ends=(0.98, 1.001)), False),
        (table(own=False), False),
    ],
)
def test_reversal_ends_within_one_percent_on_both_sides(found, holds):
    one = rescaled.findings(found)["reversals_end"]
    assert one.holds is holds
    if holds:
        assert one["within"]["0.01"] == {"changed": 1, "reversed": 1}


def test_scipy_has_to_confirm_every_end():
    found = table()
    found.loc[2, "by_scipy"] = False
    assert not rescaled.findings(found)["ends_by_scipy"].holds
