"""Proven reversals: what makes each finding fail."""

import pandas as pd
import pytest

from studies.reversals.steps import proven
from topheavy import Pulse, RockingBlock

REVERSED, BOTH, UNDECIDED = ("survives", "overturns"), ("overturns",) * 2, ("survives", "undecided")


def table(pair=REVERSED, inside=REVERSED, outside=BOTH):
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
    found = proven.findings(table(**change))
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
