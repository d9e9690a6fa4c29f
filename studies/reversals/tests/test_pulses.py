"""Reversals under pulses: maps, where they lie, and those that are proven."""

import math

import numpy as np
import pandas as pd
import pytest

from steps.shared.spectra_compared import Spectra
from steps.shared.spectrum import solve
from studies.reversals.figures.where import WINDOW, outlines
from studies.reversals.steps import proven, pulses
from studies.reversals.steps.pulses_shard import CHANGES, changed, changed_line, lines
from topheavy import Column, Pulse, RockingBlock, RockingFrame

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


def area(corners):
    (x, y), (right, up) = corners[:-1].T, corners[1:].T
    return abs(np.sum(x * up - right * y)) / 2


def test_areas_are_those_of_the_intervals_joined_over_frequency():
    rows = [(omega, 1.0 + omega, np.nan, "without impact") for omega in (1.0, 2.0, 3.0)]
    rows += [(omega, 1.0, 1.0 + omega / 2, "with impact") for omega in (1.0, 2.0, 3.0)]
    rows += [(2.0, 2.5, 2.6, "with impact")]  # narrower, drawn as a bar
    cells = pd.DataFrame(rows, columns=["frequency_ratio", "lower", "upper", "mode"])
    at_once = 2.0 * (WINDOW[3] - 3.0)
    assert [area(one) for one in outlines(cells)] == pytest.approx([at_once, 2.0, 0.1])


REVERSED, BOTH, UNDECIDED = ("survives", "overturns"), ("overturns",) * 2, ("survives", "undecided")


def table_of(pair=REVERSED, inside=REVERSED, outside=BOTH):
    rows = [("pair", pair), ("outside", outside), ("inside", inside), ("outside", BOTH)]
    rows.append(("inside", REVERSED))
    made = [(of, *outcomes, 5.0, 1e-8) for of, outcomes in rows]
    names = ["of", "lighter", "heavier", "amplitude", "relative_width"]
    return pd.DataFrame(made, columns=names)


@pytest.mark.parametrize(
    ("change", "pair_holds", "widest_holds"),
    [
        ({}, True, True),
        ({"pair": BOTH}, False, True),
        ({"pair": UNDECIDED}, False, True),
        ({"inside": BOTH}, True, False),
        ({"outside": REVERSED}, True, False),
        ({"outside": UNDECIDED}, True, False),
    ],
)
def test_reversal_is_proven_inside_and_its_absence_outside(change, pair_holds, widest_holds):
    found = proven.findings(table_of(**change))
    assert found["at_every_pair"].holds is pair_holds
    assert found["widest"].holds is widest_holds


def test_both_ends_are_tried_until_they_are_proven(monkeypatch):
    """A band from 4 to 6 whose ends are known to 1e-7: the first width is too small."""

    class Place(proven.Place):
        def line(self, gamma):
            return 1.0, RockingBlock(2.0, 0.25, 0.9), Pulse("one-sine", 1.0, gamma + 1.0)

    class Found:
        def counterexample(self, pairs):
            return 0.4, Place(5.0, "one-sine", False, 1.0), 0.0, 2.0, 5.0

    def judged(block, pulse):
        if min(abs(pulse.amplitude - end) for end in (4.0, 6.0)) < 1e-7:
            return "undecided", None
        falls = pulse.angular_frequency == 3.0 and 4.0 < pulse.amplitude < 6.0
        return ("overturns" if falls else "survives"), {"amplitude": pulse.amplitude}

    monkeypatch.setattr(proven, "proven", judged)
    found = proven.of_widest(Found(), [0.0, 2.0])
    rows = pd.DataFrame(row for row, _ in found)
    assert set(rows.relative_width) == {1e-7}
    assert rows.of.tolist() == ["outside", "inside"] * 2
    assert rows.amplitude.tolist() == pytest.approx([4.0, 4.0, 6.0, 6.0], rel=2e-7)
    assert proven.holds(rows)
    assert len(found[0][1]) == 2
