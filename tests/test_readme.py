"""Every number in the README's findings is one that the workflow published."""

import math
import re
from pathlib import Path

import pandas as pd
import pytest

from replication.claim import JudgedClaim
from replication.ledger import read_judged
from replication.publishing import count_table

ROOT = Path(__file__).parents[1]
REFERENCE = ROOT / "tests" / "reference"


def found() -> str:
    """The README's section "What we found"."""
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    return text.split("## What we found")[1].split("\n## ")[0]


def under_motions(table: str, **place: float) -> pd.Series:
    """The row of a published table of the study reversals: temple columns, near-fault motions."""
    rows = pd.read_csv(REFERENCE / "studies" / f"{table}.csv")
    rows = rows.query("structure == 'temple' and family == 'near-fault'")
    for column, value in place.items():
        rows = rows[rows[column] == value]
    (row,) = (row for _, row in rows.iterrows())
    return row


@pytest.fixture(scope="module")
def claims() -> dict[str, JudgedClaim]:
    rows = read_judged(REFERENCE / "claims.json")
    return {row.id: row for row in rows}


def test_every_decimal_number_is_published(claims):
    ratios = pd.read_csv(REFERENCE / "mass_ratio.csv").set_index("mass_ratio")
    lowest = pd.read_csv(REFERENCE / "heavier.csv").set_index("mass_ratio").lowest_overturning_low
    starts = pd.read_csv(REFERENCE / "trilith_starts.csv").set_index("share_of_speed")
    published = {
        f"{ratios.frequency_ratio[math.inf]:.3f}",
        f"{ratios.size_ratio[math.inf]:.1f}",
        f"{lowest[0.0]:.3f}",
        f"{lowest[1.0]:.3f}",
        f"{lowest[math.inf]:.3f}",
        f"{claims['trilith_base_acceleration_in_g'].computed:.3f}",
        f"{claims['trilith_uplift_acceleration'].computed:.3f}",
        f"{starts.late_peak_over_alpha[1.0]:.3f}",
        f"{100 * claims['reversals_help'].computed:.1f}",
        f"{100 * claims['reversals_harm'].computed:.1f}",
        f"{100 * claims['mechanism_share_apart'].computed:.1f}",
        f"{100 * under_motions('reversals_medians', mass_ratio=1.0, as_large_as=0).gain:.1f}",
        f"{100 * under_motions('reversals_pairs', lighter=0, heavier=1.0).motions:.1f}",
    }
    assert set(re.findall(r"\d+\.\d+", found())) == published


def test_two_thirds_of_the_gain_are_had_at_mass_ratio_one():
    share = pd.read_csv(REFERENCE / "mass_ratio.csv").set_index("mass_ratio").share_of_size_gain
    assert "Two thirds of the gain" in found()
    assert share[1.0] == pytest.approx(2 / 3, abs=1e-9)


def test_equations_said_to_be_wrong_are_those_of_their_kind(claims):
    equations = pd.read_csv(REFERENCE / "equations.csv")
    parts = (found().split("Eqs.")[1].split("have")[0], found().split("Eqs.")[2].split("hold")[0])
    for said, fault in zip(parts, ("sign", "convention"), strict=True):
        numbers = {int(n) for n in re.findall(r"\((\d+)\)", said)}
        assert numbers == {int(n) for n in equations[equations.fault == fault].equation}


def test_lowest_amplitude_is_said_to_rise_where_the_ledger_confirms_it(claims):
    assert "lowest amplitude that overturns rises with γ" in " ".join(found().split())
    assert claims["reversals_lowest_rises"].verdict == "confirmed"
    assert claims["lowest_amplitude_rises_with_mass"].verdict == "confirmed"


def test_links_lead_somewhere():
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    for target in re.findall(r"\]\(([^)#]+)\)", text):
        if not target.startswith("http"):
            assert (ROOT / target).exists(), f"README.md links to {target}, which does not exist"


def test_motions_of_the_study_are_as_many_as_said():
    motions = under_motions("reversals_medians", mass_ratio=1.0, as_large_as=0).motions
    assert f"Under {motions:.0f} near-fault motions" in found()


def test_table_of_verdicts_counts_the_claims_of_paper_and_studies_apart(claims):
    assert "\n".join(count_table(list(claims.values()))) in found()
