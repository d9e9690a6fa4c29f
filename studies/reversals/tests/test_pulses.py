"""The half about pulses, in the limits where the answer is known."""

import math

import numpy as np
import pytest

from steps.shared.spectra_compared import Spectra
from steps.shared.spectrum import solve
from studies.reversals.steps import pulses
from studies.reversals.steps.pulses_shard import CHANGES, changed, changed_line, lines
from topheavy import Column, RockingFrame

CASE = {
    "slendernesses": [14.0],
    "shapes": ["one-cosine"],
    "mass_ratios": [0.0, 1.0, 1e9, math.inf],
    "separated": [math.inf],
    "frequency_ratios": {"lowest": 1.5, "highest": 3.5, "points": 5},
    "amplitudes": {"lowest": 1.0, "highest": 8.0, "resolution": 0.05},
    "finer": {"below": 1.3, "resolution": 0.01},
    "sample": {"points": 4, "seed": 1},
    "drawn": [14.0],
}


@pytest.fixture(scope="module")
def table():
    return solve(lines(CASE), CASE)


@pytest.fixture(scope="module")
def whole(table):
    return table[table.change == "both"]


def shares(table, light, heavy):
    (row,) = pulses.areas(Spectra(CASE, table), [(light, heavy)]).itertuples()
    return row


def test_frame_neither_helps_nor_harms_beside_itself(whole):
    row = shares(whole, 1.0, 1.0)
    assert (row.helps, row.harms) == (0.0, 0.0)
    assert row.lighter_overturns == row.heavier_overturns > 0.0


@pytest.mark.parametrize("change", CHANGES)
def test_cap_without_mass_changes_nothing(change):
    column = Column(1.0, 4.0)
    assert changed(column.block(), RockingFrame(column, 0.0).block(), change) == column.block()


def test_both_changes_are_the_frame():
    column = Column(1.0, 4.0)
    frame = RockingFrame(column, 2.0).block()
    size = changed(column.block(), frame, "size")
    assert changed(column.block(), frame, "both") == frame
    assert changed(size, frame, "restitution") == size.with_restitution(frame.restitution) == frame


def test_size_alone_moves_the_columns_spectrum_to_other_frequencies():
    ratio = RockingFrame(Column(1.0, 4.0), math.inf).equivalent_size / Column(1.0, 4.0).size
    size = changed_line(14.0, "one-cosine", "size", math.inf, 2.0)
    column = changed_line(14.0, "one-cosine", "both", 0.0, 2.0 * math.sqrt(ratio))
    found = solve([size, column], CASE)
    (_, moved), (_, there) = found.groupby("change")
    assert len(moved) == len(there) > 0
    np.testing.assert_allclose(
        moved[["lower", "upper"]].fillna(8.0), there[["lower", "upper"]].fillna(8.0), rtol=1e-8
    )


def test_restitution_alone_leaves_overturning_without_impact_where_it_is(table):
    apart = table[table["mode"] == "without impact"].set_index(["change", "frequency_ratio"])
    column = apart[apart.mass_ratio == 0.0].lower.loc["both"].groupby("frequency_ratio").max()
    alone = apart.lower.loc["restitution"].groupby("frequency_ratio").max()
    np.testing.assert_allclose(alone, column, rtol=1e-8)
