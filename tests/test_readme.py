"""Every number in the README's findings is one that the workflow published."""

import json
import math
import re
from pathlib import Path

import pandas as pd
import pytest

ROOT = Path(__file__).parents[1]
REFERENCE = ROOT / "tests" / "reference"


def found() -> str:
    """The README's section "What we found"."""
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    return text.split("## What we found")[1].split("\n## ")[0]


def shares_of_area() -> pd.DataFrame:
    """How much of the exact spectra only one frame of a pair survives, mean over pulses."""
    areas = pd.read_csv(REFERENCE / "spectra_areas.csv").query("not linearised")
    return areas.groupby("lighter")[["only_lighter_overturns", "only_heavier_overturns"]].mean()


@pytest.fixture(scope="module")
def claims() -> dict[str, dict]:
    rows = json.loads((REFERENCE / "claims.json").read_text(encoding="utf-8"))
    return {row["id"]: row for row in rows}


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
        f"{claims['trilith_base_acceleration_in_g']['computed']:.3f}",
        f"{claims['trilith_uplift_acceleration']['computed']:.3f}",
        f"{starts.late_peak_over_alpha[1.0]:.3f}",
        *(f"{100 * share:.1f}" for share in shares_of_area().to_numpy().ravel()),
    }
    assert set(re.findall(r"\d+\.\d+", found())) == published


def test_two_thirds_of_the_gain_are_had_at_mass_ratio_one():
    share = pd.read_csv(REFERENCE / "mass_ratio.csv").set_index("mass_ratio").share_of_size_gain
    assert "Two thirds of the gain" in found()
    assert share[1.0] == pytest.approx(2 / 3, abs=1e-9)


def test_equations_said_to_be_wrong_are_the_misprints_of_sign(claims):
    said = {int(n) for n in re.findall(r"\((\d+)\)", found().split("Eqs.")[1].split("have")[0])}
    signs = pd.read_csv(REFERENCE / "equations.csv").query("fault == 'sign'").equation
    assert said == {int(n) for n in signs}


def test_shares_of_area_are_said_of_the_pair_and_the_side_they_belong_to():
    share = (100 * shares_of_area()).map("{:.1f} %".format)
    saves, topples = share.only_lighter_overturns, share.only_heavier_overturns
    said = " ".join(found().split())
    assert f"{saves[0]} of the plane of frequency and amplitude from γ = 0 to 1" in said
    assert f"and on {saves[1]} from γ = 1 to ∞" in said
    assert f"it topples it on {topples[0]} and {topples[1]}" in said


def test_lowest_amplitude_is_said_to_rise_where_the_ledger_confirms_it(claims):
    assert "lowest amplitude that overturns rises with γ" in found()
    assert claims["lowest_amplitude_rises_with_mass"]["verdict"] == "confirmed"


def test_links_lead_somewhere():
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    for target in re.findall(r"\]\(([^)#]+)\)", text):
        if not target.startswith("http"):
            assert (ROOT / target).exists(), f"README.md links to {target}, which does not exist"
