"""The proven counterexample and reversals: what makes each finding fail."""

import pandas as pd
import pytest

from studies.certainty.steps import proven
from topheavy import Column, Record
from topheavy.proven import Outcome

EXTREME = [(0.0, "overturns", 2), (float("inf"), "overturns", 0)]


def table(extreme=EXTREME, under=(("survives", "survives"), ("overturns", "undecided"))):
    rows = [
        {"record": "extreme", "structure": slope, "mass_ratio": g, "proven": p, "impacts": n}
        for slope, some in (("20°", EXTREME), ("30°", extreme))
        for g, p, n in some
    ]
    rows += [{"record": "a", "by_solver": solver, "proven": found} for solver, found in under]
    return pd.DataFrame(rows)


@pytest.mark.parametrize(
    ("light", "heavy", "holds"),
    [
        (("overturns", 2), ("overturns", 0), True),
        (("survives", 0), ("overturns", 0), True),
        (("overturns", 0), ("overturns", 0), False),
        (("overturns", 2), ("overturns", 1), False),
        (("undecided", -1), ("overturns", 0), False),
        (("overturns", 2), ("undecided", 0), False),
    ],
)
def test_counterexample_overturns_the_heavier_frame_alone_without_impact(light, heavy, holds):
    extreme = [(0.0, *light), (float("inf"), *heavy)]
    assert proven.findings(table(extreme))["beyond_the_theorem"].holds is holds


@pytest.mark.parametrize(
    ("under", "holds"),
    [
        ([("survives", "survives"), ("overturns", "undecided")], True),
        ([("survives", "overturns"), ("overturns", "overturns")], False),
        ([("survives", "undecided")], False),
    ],
)
def test_no_proven_outcome_under_a_record_differs(under, holds):
    found = proven.findings(table(under=under))["reversals_under_records"]
    assert found.holds is holds
    assert found.entries["undecided"] == sum(end == "undecided" for _, end in under)


def test_reversed_pair_of_each_record_is_proven_at_its_own_scale(monkeypatch):
    asked = []

    def outcome(frame, record):
        asked.append((frame.mass_ratio, record.name))
        return Outcome("survives", 0)

    monkeypatch.setattr(proven, "outcome", outcome)
    rows = [("a", "c", gamma, gamma in (1.0, 4.0)) for gamma in (0.0, 1.0, 2.0, 4.0)]
    known = pd.DataFrame(rows, columns=["record", "structure", "mass_ratio", "overturned"])
    records = [Record(0.01, [0.0, 0.1, 0.0], "a")]
    found = list(proven.under_records(known, {"c": Column(0.5, 3.0)}, records))
    assert asked == [(0.0, "a"), (1.0, "a")]
    assert [row["by_solver"] for row in found] == ["survives", "overturns"]
