"""The wrong outcomes of Allen's model: cells in a row, and their shares."""

import pandas as pd
import pytest

from steps import allen_overturning


def test_neighbours_of_one_verdict_are_a_run():
    cells = [(1.0, "a"), (2.0, "a"), (3.0, "b"), (4.0, "a")]
    found = pd.DataFrame(allen_overturning.runs(cells))
    assert found.lowest.tolist() == [1.0, 3.0, 4.0]
    assert found.highest.tolist() == [2.0, 3.0, 4.0]
    assert found.cells.tolist() == [2, 1, 1]
    assert found.verdict.tolist() == ["a", "b", "a"]


def test_share_is_that_of_the_cells():
    rows = [
        ("all", 3, "falsely safe"),
        ("all", 1, "both survive"),
        ("linearised", 2, "falsely safe"),
    ]
    table = pd.DataFrame(rows, columns=["model", "cells", "verdict"])
    found = allen_overturning.findings(table)
    assert found["all"]["falsely_safe"] == pytest.approx(0.75)
    assert found["linearised"]["falsely_safe"] == pytest.approx(1.0)
