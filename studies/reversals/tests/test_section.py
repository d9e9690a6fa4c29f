"""What the section of this study prints."""

from pathlib import Path

STUDY = Path(__file__).parents[1]


def test_misfit_of_the_fragility_curves_is_printed_as_a_bound():
    text = (STUDY / "section_motions.typ").read_text("utf-8")
    assert "They pass within\n#at-most(motions.misfit.value, 3) of every computed point" in text
