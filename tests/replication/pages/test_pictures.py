"""Each figure that the workflow draws is shown once, in the report or in its supplement."""

import re
from collections import Counter
from pathlib import Path

import pytest

from replication.inputs.parts import PAPER, captions_of
from replication.pages.captions import read_captions

ROOT = Path(__file__).parents[3]
PARTS = [PAPER, *sorted(path.parent.name for path in ROOT.glob("studies/*/captions.yaml"))]
PICTURE = re.compile(r"#picture\((\([^)]*\)|\"[^\"]*\")")


@pytest.mark.parametrize("part", PARTS, ids=lambda part: part or "paper")
def test_each_figure_is_shown_once(part):
    folder = ROOT / "studies" / part if part else ROOT / "paper"
    figures = f"studies/{part}/figures" if part else "figures"
    texts = [path.read_text(encoding="utf-8") for path in folder.glob("*.typ")]
    pictures = [picture for text in texts for picture in PICTURE.findall(text)]
    names = [name for picture in pictures for name in re.findall(r'"([^"]*)"', picture)]
    drawn = [path for path in read_captions([ROOT / captions_of(part)]) if path.endswith(".svg")]
    assert Counter(f"{figures}/{name}.svg" for name in names) == Counter(drawn)
