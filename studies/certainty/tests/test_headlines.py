"""What the README says of this study is what is published."""

from pathlib import Path

import pandas as pd

from steps.headlines import found as findings_of
from steps.shared.published import from_to
from studies.certainty import headlines

ROOT = Path(__file__).resolve().parents[3]
REFERENCE = ROOT / "tests" / "reference"


def said() -> str:
    return " ".join(findings_of((ROOT / "README.md").read_text(encoding="utf-8")).split())


def test_motions_that_overturn_at_a_stated_velocity_are_published():
    rows = {name: headlines.stated_motions(REFERENCE, name) for name in ("bare", "fixed", "free")}
    (motions,) = set().union(*(of.motions for of in rows.values()))
    assert f"Under two families of {motions} motions each" in said()
    assert [len(of) for of in rows.values()] == [2] * 3
    alone, fixed, free = (from_to(of.probability) for of in rows.values())
    assert f"{alone} % overturn a 6 m column alone, {fixed} % the column with its own" in said()
    assert f"and {free} % the frame that carries the same mass freely" in said()


def test_measured_records_that_reverse_the_ranking_unscaled_are_published():
    (name, alone), (other, both) = headlines.unscaled(REFERENCE).items()
    assert name.rpartition("_")[0] == other.rpartition("_")[0]  # of one station
    (frame,) = alone[True]
    assert frame > 0.0 in alone[False]
    assert f"one overturns only the 6 m frame with γ = {frame:g}." in said()
    column, *frames = both[True]
    assert column == 0.0
    falls, stands = (" and ".join(f"{gamma:g}" for gamma in of) for of in (frames, both[False]))
    assert f"overturns the 6 m column and its frames with γ = {falls}, but not" in said()
    assert f"but not with γ = {stands}." in said()


def test_benefit_is_said_to_do_what_its_intervals_say():
    rows = pd.read_csv(REFERENCE / "studies" / "certainty_benefit.csv")
    both, alone = (
        rows[rows.way == way].set_index(["factor", "family"]).interval
        for way in ("both", "column alone")
    )
    assert "remains if the coefficients of restitution of column and frame change by" in said()
    assert set(both) == {"is positive"}
    assert "If only that of the column is 10 % lower, the ranking at" in said()
    assert set(alone[0.9]) == {"is negative"}
    assert f"5 % lower, the 95 % interval of the benefit {alone[0.95, 'broadband']} for" in said()
    assert alone[0.95, "near-fault"] == "is positive"
