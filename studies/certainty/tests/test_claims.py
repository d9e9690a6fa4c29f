"""The numbers in the claims of the study are those of its config."""

from pathlib import Path

import pytest

from replication.inputs.strict_yaml import read_yaml

STUDY = Path(__file__).parents[1]
CONFIG = read_yaml(STUDY / "config.yaml")
ENSEMBLE = read_yaml(STUDY.parent / "reversals" / "config.yaml")["motions_ensemble"]
CLAIMS = {row["id"]: row for row in read_yaml(STUDY / "claims.yaml")}


def of_a_family(section):
    """Return how many motions of each family a section of the config takes."""
    return CONFIG[section]["motions"] * len(ENSEMBLE["scenarios"])


def lowered():
    """Return by how many per cent √r is lowered: "5 or 10 %"."""
    parts = sorted(round(100 * (1 - one)) for one in CONFIG["benefit"]["factors"] if one < 1)
    return " or ".join(map(str, parts)) + " %"


EVEN = CONFIG["break_even"]
ENDS = "certainty_deficit_ends_the_benefit"


@pytest.mark.parametrize(
    ("claim", "words"),
    [
        (ENDS, f"alone is {100 * EVEN['deficits']['highest']:g} % lower"),
        (ENDS, f"γ = {', '.join(f'{g:g}' for g in EVEN['mass_ratios'][:-1])} or"),
        (ENDS, f"or {EVEN['mass_ratios'][-1]:g} over columns of"),
        (ENDS, f"of {' or '.join(f'{6 * size:g}' for size in EVEN['sizes'])} m"),
        (ENDS, f"at {len(EVEN['pgv'] + EVEN['scaled'])} intensities"),
        (ENDS, f"{of_a_family('break_even')} synthetic"),
        ("certainty_frame_is_safer", f"a PGV of {CONFIG['benefit']['pgv']} m/s"),
        ("certainty_frame_is_safer", f"γ = {CONFIG['benefit']['mass_ratio']:g} than"),
        ("certainty_frame_is_safer", f"{of_a_family('benefit')} synthetic motions"),
        ("certainty_frame_is_safer", f"both is {lowered()} lower"),
        ("certainty_benefit_remains", f"alone is {lowered()} lower"),
        ("certainty_benefit_reverses", f"alone is {lowered().split(' or ')[-1]} lower"),
    ],
)
def test_claim_states_the_numbers_of_the_config(claim, words):
    assert words in " ".join(CLAIMS[claim]["statement"].split())


@pytest.mark.parametrize("section", ["benefit", "intensities", "rates", "break_even"])
def test_stated_probabilities_take_all_motions_of_the_ensemble(section):
    assert CONFIG[section]["motions"] == ENSEMBLE["runs"][ENSEMBLE["run"]]["motions"]


def test_benefit_is_asked_at_a_velocity_whose_probabilities_are_stated():
    assert CONFIG["benefit"]["pgv"] in CONFIG["intensities"]["pgv"]
    stated = [(one["structure"], one["scaled"]) for one in CONFIG["intensities"]["columns"]]
    assert (CONFIG["benefit"]["structure"], 1.0) in stated
