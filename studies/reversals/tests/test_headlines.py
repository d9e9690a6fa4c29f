"""What the README says of this study is what is published."""

from pathlib import Path

from replication.inputs.strict_yaml import read_yaml
from replication.judging.ledger import read_judged
from steps.headlines import found as findings_of
from studies.reversals import headlines

ROOT = Path(__file__).resolve().parents[3]
REFERENCE = ROOT / "tests" / "reference"


def said() -> str:
    return " ".join(findings_of((ROOT / "README.md").read_text(encoding="utf-8")).split())


def test_window_of_the_map_is_that_of_the_study():
    study = read_yaml(REFERENCE / "studies" / "reversals.yaml")["pulses"]
    ends = study["grids"][study["grid"]]
    frequencies, amplitudes = (
        f"{axis['lowest']:g} to {axis['highest']:g} times"
        for axis in (ends["frequency_ratios"], ends["amplitudes"])
    )
    assert f"pulses of {frequencies} the frequency parameter" in said()
    assert f"and of {amplitudes} the uplift acceleration" in said()


def test_motions_of_the_study_are_as_many_as_said():
    rows = headlines.motions(REFERENCE, "reversals_medians", mass_ratio=1.0, as_large_as=0)
    (motions,) = set(rows.motions)
    assert f"Under two families of {motions} motions each" in said()


def test_lowest_amplitude_is_said_to_rise_where_the_ledger_confirms_it():
    assert "minimum overturning acceleration rises with γ" in said()
    verdicts = {row.id: row.verdict for row in read_judged(REFERENCE / "claims.json")}
    assert verdicts["reversals_lowest_rises"] == "confirmed"
