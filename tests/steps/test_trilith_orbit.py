"""The proven starts of the trilith: what makes the finding fail."""

import pandas as pd
import pytest

from steps import trilith_orbit

ENDS = (("rocking", "steady"), ("rests", "rests"), ("overturned", "overturns"))


@pytest.mark.parametrize(
    ("pairs", "holds"),
    [
        (ENDS, True),
        ((*ENDS, ("rests", "undecided")), True),  # is counted
        ((*ENDS, ("rests", "steady")), False),
        ((*ENDS, ("rocking", "overturns")), False),
        (ENDS[:2], False),  # none overturns
        ((*ENDS[1:], ("rocking", "undecided")), False),
    ],
)
def test_each_end_is_proven_and_none_differs(pairs, holds):
    table = pd.DataFrame(pairs, columns=["outcome", "proven"])
    found = trilith_orbit.findings(table)["starts"]
    assert found.holds is holds
    assert found.entries["undecided"] == (table.proven == "undecided").sum()


def test_sample_has_so_many_starts_of_each_outcome(monkeypatch):
    monkeypatch.setattr(trilith_orbit, "settles", lambda found, *start: start)
    rows = [(0, 0.1 * k, 0.0, name) for k in range(30) for name in trilith_orbit.NAMES]
    table = pd.DataFrame(rows, columns=["quarters", "rotation", "velocity", "outcome"])
    found = trilith_orbit.starts(None, table)
    assert set(found.outcome.value_counts()) == {trilith_orbit.EACH}
    assert found.proven.iloc[0] == tuple(found.iloc[0, :3])
