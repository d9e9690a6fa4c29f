"""The figures of the article, and the alternative text of each."""

import json
import re
import shutil
from pathlib import Path

import pytest
import typst

from replication.inputs.parts import PAPER, captions_of
from replication.pages.captions import read_captions

ROOT = Path(__file__).parents[1]
SOURCES = {PAPER: ROOT / "paper" / "report.typ"} | {
    path.parent.name: path for path in ROOT.glob("studies/*/article.typ")
}
PICTURE = re.compile(r"#picture\((\([^)]*\)|\"[^\"]*\")")


def drawings(part: str) -> list[list[str]]:
    """The figures that a part of the article shows, each with the paths of its drawings."""
    folder = f"studies/{part}/figures" if part else "figures"
    found = PICTURE.findall(SOURCES[part].read_text(encoding="utf-8"))
    return [[f"{folder}/{name}.svg" for name in re.findall(r'"([^"]*)"', one)] for one in found]


def test_article_has_ten_figures():
    assert sum(len(drawings(part)) for part in SOURCES) == 10


@pytest.mark.parametrize("part", SOURCES, ids=lambda part: part or "paper")
def test_each_drawing_has_an_alternative_text_that_is_not_its_caption(part):
    captions = read_captions([ROOT / captions_of(part)])
    for path in (path for figure in drawings(part) for path in figure):
        assert captions[path].get("alt"), f"{path} has no alt in {captions_of(part)}"
        assert captions[path]["alt"] not in captions[path]["caption"]


@pytest.mark.parametrize(
    ("value", "digits", "printed"),
    [(0.053259579, 2, "0.06"), (0.053259579, 3, "0.054"), (0.05, 2, "0.05"), (2.0, 0, "2")],
)
def test_printed_bound_is_not_below_the_value_that_it_bounds(tmp_path, value, digits, printed):
    source = tmp_path / "bound.typ"
    source.write_text(f"""#import "/src/replication/typst/format.typ": at-most
#metadata(at-most({value}, {digits})) <bound>""")
    for part in ("src/replication/typst/format.typ", "paper/symbols.typ"):
        (tmp_path / part).parent.mkdir(parents=True)
        shutil.copy(ROOT / part, tmp_path / part)
    (tmp_path / "results").mkdir()
    (tmp_path / "results" / "claims.json").write_text("[]", "utf-8")
    found = typst.query(source, "<bound>", root=tmp_path, field="value")
    assert json.loads(found) == [printed]
