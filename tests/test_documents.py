"""Documents: README, index, article, guides and the examples in docstrings."""

import doctest
import gzip
import inspect
import json
import re
import shutil

import numpy as np
import pandas as pd
import pytest
import typst
import yaml

import topheavy as th
from replication.inputs.parts import PAPER, captions_of
from replication.inputs.strict_yaml import read_yaml
from replication.judging.ledger import read_judged
from replication.pages.blanks import blanks
from replication.pages.captions import read_captions
from replication.pages.edition import with_counts
from steps import headlines
from steps.shared.published import Published, need, span, with_interval
from tests.cases import ROOT, run_alone
from topheavy import read_record

REFERENCE = ROOT / "tests" / "reference"
README = (ROOT / "README.md").read_text(encoding="utf-8")
PROSE = re.sub(r"```.*?```|\]\((?:[^()]|\([^()]*\))*\)|doi:\S+", " ", README, flags=re.DOTALL)
OPPOSITE = {"raises": "lowers", "rises": "falls", "prevents": "causes", "weakest": "strongest"}
OPPOSITE |= {"less": "more", "Yes": "No", "only the frame": "only the column"}
HELD = {"2014", "25", "3.11", "3.13", "4.0"}  # by tests below: the year, Eq. (25), Pythons, licence


def test_passages_are_those_of_the_published_results():
    assert list(headlines.headlines(ROOT)) == []


@pytest.fixture
def copy(tmp_path):
    """A tree with README, findings and the published results."""
    shutil.copytree(REFERENCE, tmp_path / "tests" / "reference")
    (tmp_path / "docs").mkdir()
    for name in ("README.md", headlines.FINDINGS, "docs/costs.csv", "docs/verify_grid.csv"):
        shutil.copyfile(ROOT / name, tmp_path / name)
    return tmp_path


def numbers() -> list[str]:
    found = dict.fromkeys(re.findall(r"(?<![\w.])\d+(?:,\d{3})*(?:\.\d+)?", PROSE))
    return [number for number in found if number not in HELD]


@pytest.mark.parametrize("number", numbers())
def test_wrong_number_of_the_readme_is_noticed(copy, number):
    digit = str((int(number[-1]) + 1) % 10)
    wrong = re.sub(rf"(?<![\w.]){re.escape(number)}(?![\w.]\d)", number[:-1] + digit, README)
    assert wrong != README
    (copy / "README.md").write_text(wrong, encoding="utf-8")
    rows = read_judged(copy / "tests" / "reference" / "claims.json")
    assert list(headlines.headlines(copy)) or with_counts(wrong, rows) != wrong


@pytest.mark.parametrize("word", [word for word in OPPOSITE if word in PROSE])
def test_opposite_word_of_the_readme_is_noticed(copy, word):
    wrong = README.replace(word, OPPOSITE[word], 1)
    assert wrong != README
    (copy / "README.md").write_text(wrong, encoding="utf-8")
    assert list(headlines.headlines(copy))


def test_wrong_number_of_the_findings_is_noticed(copy):
    page = copy / headlines.FINDINGS
    text = page.read_text(encoding="utf-8")
    page.write_text(text.replace("93.4 %", "94.3 %"), encoding="utf-8")
    (error,) = headlines.headlines(copy)
    assert error.startswith("docs/findings.md: ")


@pytest.mark.parametrize(
    ("claim", "passage"),
    [
        ("lowest_amplitude_rises_with_mass", "lowest_amplitude"),
        ("eq24", "eq24"),
        ("portal_overturns_last", "portal_overturns_last"),
    ],
)
def test_passage_whose_claim_has_another_verdict_is_refused(copy, claim, passage):
    path = copy / "tests" / "reference" / "claims.json"
    rows = json.loads(path.read_text(encoding="utf-8"))
    for row in rows:
        if row["id"] == claim:
            row["verdict"] = "qualified"
    path.write_text(json.dumps(rows), encoding="utf-8")
    assert any(passage in error for error in headlines.headlines(copy))


def test_heading_without_a_passage_is_named(copy):
    (copy / "README.md").write_text(README.replace("**Size.**", "**Sizes.**"), encoding="utf-8")
    (error,) = headlines.headlines(copy)
    assert "'Sizes' is no title of a finding; expected one of Size, " in error


@pytest.mark.parametrize(
    ("shares", "digits", "words"),
    [([0.05, 0.09], 0, "5 to 9"), ([0.26, 0.163], 1, "16.3 to 26.0"), ([0.1], 0, "10")],
)
def test_range_has_both_its_ends(shares, digits, words):
    assert span(pd.Series(shares), digits) == words


def test_interval_stands_behind_its_number():
    assert span([0.165, 0.2255]) == "17 to 23"
    row = {"end": 0.085, "end_low": 0.082, "end_high": 0.092}
    assert with_interval(row, "end") == "8.5 (8.2 to 9.2)"


def test_words_that_results_do_not_bear_are_refused():
    with pytest.raises(ValueError, match=r"^it falls: rewrite the headline"):
        need(False, "it falls")
    with pytest.raises(ValueError, match="eq23 is confirmed and not refuted"):
        Published(REFERENCE).need(eq23="refuted")


def test_readme_is_short():
    assert len(README.splitlines()) <= 80
    assert len(README.split()) <= 1000


@pytest.mark.parametrize("name", ["README.md", headlines.FINDINGS, "docs/index.html"])
def test_links_lead_somewhere(name):
    text, folder = (ROOT / name).read_text(encoding="utf-8"), (ROOT / name).parent
    targets = re.findall(r"\]\(([^)#]+)\)", text) + re.findall(r'(?:href|src)="([^"#]+)"', text)
    assert targets
    for target in targets:
        if not target.startswith("http"):
            assert (folder / target).exists(), f"{name}: {target} does not exist"


def test_index_has_the_answer_of_the_readme():
    page = " ".join((ROOT / "docs/index.html").read_text(encoding="utf-8").split())
    answer = re.search(r"\*\*(Yes, .*?)\*\*", " ".join(README.split())).group(1)
    assert f"<strong>{answer.rstrip(':')}.</strong>" in page


def test_licence_and_equation_are_those_that_are_meant():
    assert "Attribution 4.0 International" in (ROOT / "docs/LICENSE-CC-BY").read_text("utf-8")
    claims = Published(REFERENCE).claims
    assert "`make trace ITEM=eq25` leads from Eq. (25)" in " ".join(README.split())
    assert claims["eq25"]["equation"] == 25


def test_pythons_are_those_of_the_package():
    low, high = re.findall(r"3\.(\d+)", (ROOT / "pyproject.toml").read_text("utf-8"))[:2]
    assert f"Python 3.{low} to 3.{int(high) - 1}; we ran" in " ".join(README.split())


def test_doi_and_year_are_those_of_the_citation():
    cited = read_yaml(ROOT / "CITATION.cff")["references"][0]
    assert set(re.findall(r"10\.1061/[^\s\]]*\)ST[\d.A-Z-]*\d", README)) == {cited["doi"]}
    assert f"({cited['year']}, [doi:{cited['doi']}]" in README


def test_lines_of_the_library_run(tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("MPLBACKEND", "agg")
    (lines,) = re.findall(r"```python\n(.*?)```", README, re.S)
    (tmp_path / "data").symlink_to(ROOT / "data")
    monkeypatch.chdir(tmp_path)
    exec(compile(lines, "README.md", "exec"), {})
    assert "The lowest factor found that overturns is " in capsys.readouterr().out
    assert [path.name for path in tmp_path.iterdir()] == ["data"]  # nothing blocks an archive


def test_citation_counts_the_claims():
    paper = [row for row in read_judged(REFERENCE / "claims.json") if row.study == ""]
    judged = [row for row in paper if row.verdict != "not tested"]
    abstract = " ".join(read_yaml(ROOT / "CITATION.cff")["abstract"].split())
    assert f"as {len(paper)} claims, of which {len(judged)} are judged" in abstract


def test_only_the_citation_has_what_its_owner_fills_in():
    found = blanks(ROOT)
    assert [line.split(":", 2)[2][:28] for line in found] in (
        [],  # in a release
        [
            'BLANK: names of the authors"',
            "BLANK: address, and e-mail o",
            "BLANK: neither exists yet. O",
        ],
    )
    assert all(line.startswith("CITATION.cff:") for line in found)
    assert "BLANK" not in (ROOT / "codecheck.yml").read_text(encoding="utf-8")


def test_command_of_the_readme_proves_published_certificates(tmp_path):
    """Of every tenth: CI proves all of them, as the workflow does."""
    (name,) = re.findall(r"python3 -I -S src/topheavy/proven/checking (\S+)`", README)
    some = gzip.decompress((ROOT / name).read_bytes()).splitlines(keepends=True)[::10]
    (tmp_path / "some.jsonl.gz").write_bytes(gzip.compress(b"".join(some)))
    done = run_alone(tmp_path / "some.jsonl.gz")
    assert done.returncode == 0, done.stderr
    assert done.stdout.count(": proven: ") == done.stdout.count("\n") == len(some) > 150


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


GUIDE = (ROOT / "studies/FOLLOW-UP.md").read_text(encoding="utf-8")


def test_step_of_the_guide_computes_what_its_claim_states():
    (step,) = re.findall(r"```python\n(.*?)```", GUIDE, re.DOTALL)
    rows = [yaml.safe_load(block) for block in re.findall(r"```yaml\n(- id.*?)```", GUIDE, re.S)]
    ((claim,),) = rows
    names = {"__name__": "step"}
    exec(compile(step, "studies/FOLLOW-UP.md", "exec"), names)
    found = names["main"](read_record(ROOT / "data/records/el_centro_1940_NS.AT2"))
    assert found[claim["finding"]].holds  # "survives the record as it was measured"
    assert "as it was measured" in claim["statement"]
    assert ".scaled(" not in step


PUBLIC = {name: getattr(th, name) for name in dir(th) if not name.startswith("_")}
EXPLAINED = [name for name, x in PUBLIC.items() if inspect.isroutine(x) or inspect.isclass(x)]


@pytest.mark.parametrize("name", EXPLAINED)
def test_example_gives_what_it_says(name, tmp_path, monkeypatch):
    (tmp_path / "data").symlink_to(ROOT / "data")
    monkeypatch.chdir(tmp_path)
    finder = doctest.DocTestFinder(recurse=False)
    (example,) = finder.find(PUBLIC[name], name, globs={"th": th, "np": np})
    found = doctest.DocTestRunner().run(example)
    assert found.attempted > 0
    assert found.failed == 0


def test_front_door_is_what_help_shows():
    assert th.__all__[0] == "Column"
    assert {*th.__all__} < {*PUBLIC}
    assert len(th.__all__) == 13
    for name in th.__all__:
        assert f"`{name}`" in th.__doc__
