"""Pages: captions, pictures, exhibits, the report's opening and documents."""

import re
import shutil
from collections import Counter
from dataclasses import replace
from functools import reduce
from itertools import permutations
from operator import add
from pathlib import Path

import pytest
import yaml
from docutils.core import publish_parts
from jinja2 import Environment

from replication.inputs.parts import PAPER, captions_of
from replication.inputs.strict_yaml import read_yaml
from replication.judging.claim import Claim
from replication.judging.ledger import read_judged, with_verdict
from replication.pages import exhibits, opening
from replication.pages.captions import captioned, read_captions
from replication.pages.exhibits import exhibits_page
from replication.pages.typeset import compiled, figure_numbers, reads, refuse_unshown
from replication.workflow.provenance import Job

ROOT = Path(__file__).resolve().parents[3]
STUDIES = sorted(path.parent for path in ROOT.glob("studies/*/study.smk"))


def read(path):
    return read_yaml(path)


OURS = [ROOT / "figures", *STUDIES]


@pytest.mark.parametrize("folder", OURS, ids=lambda path: path.name)
def test_captions_are_whole_and_tell_results_apart(folder):
    entries = read(folder / "captions.yaml")
    assert len({(each["category"], each["title"]) for each in entries.values()}) == len(entries)
    for path, entry in entries.items():
        assert set(entry) == {"title", "category", "caption", "alt", "claims"}, path
        assert entry["alt"] not in (entry["title"], entry["caption"]), path
        assert len(set(entry["claims"])) == len(entry["claims"]), path


CLAIM = replace(
    with_verdict(Claim(id="rises", where="p. 1", statement="", expected="not tested"), {}),
    statement="Its moment falls with |θ|, and m_ is *its* `mass`.",
    verdict="qualified",
)
ENTRY = {
    "title": "T",
    "category": "C",
    "caption": "(a) Over α_ and |θ|_.",
    "alt": "A *line* that falls.",
    "claims": ["rises"],
}


def test_caption_comes_out_as_it_is_written():
    shown = captioned("a.svg", {"a.svg": ENTRY}, [CLAIM])
    template = (ROOT / "src" / "replication" / "pages" / "caption.rst").read_text(encoding="utf-8")

    class Rule:
        module_globals = {"caption_of": lambda result: shown}  # noqa: RUF012

    class Job:
        rule = Rule
        output = ["a.svg"]  # noqa: RUF012

    class File:
        job = Job

    text = Environment(trim_blocks=True, lstrip_blocks=True).from_string(template)
    page = publish_parts(text.render(snakemake=Job, files=[File]), writer="html")["body"]
    plain = re.sub(r"<[^>]*>", "", page)
    assert ENTRY["caption"] in plain
    assert f"What is seen: {ENTRY['alt']}" in plain
    assert "1 qualified" in plain
    assert f"qualified: {CLAIM.statement} (p. 1)" in plain
    assert "system-message" not in page


def test_result_captioned_twice_is_refused(tmp_path):
    paths = [tmp_path / "a.yaml", tmp_path / "b.yaml"]
    for path in paths:
        path.write_text(yaml.safe_dump({"a.svg": ENTRY}), encoding="utf-8")
    with pytest.raises(ValueError, match=r"b\.yaml: a\.svg has a caption already"):
        read_captions(paths)


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


JOBS = [
    Job("peaks", outputs=("shards/1.csv",), logs=("l.log", "b/shard_1-of-2.tsv")),
    Job("peaks", outputs=("shards/2.csv",), logs=("l.log", "b/shard_2-of-2.tsv")),
    Job(
        "peaks",
        scripts=("src/peaks.py",),
        inputs=("shards/1.csv", "shards/2.csv", "data/a.txt"),
        outputs=("results/tables/peaks.csv",),
        logs=("b/peaks.tsv",),
    ),
    Job(
        "peaks",
        scripts=("figures/peaks.py",),
        inputs=("results/tables/peaks.csv", "figures/style"),
        outputs=("figures/peaks.svg",),
    ),
    Job("peaks", outputs=("results/other.csv",), logs=("b/other.tsv",)),
]


def test_cost_that_was_not_measured_is_left_open():
    page = exhibits_page(JOBS, {"figures/peaks.svg": {"title": "Peaks"}}, {}, {})
    assert page.endswith("(../src/peaks.py) |  |  |\n")


def test_figures_stand_in_their_order():
    captions = {path: {"title": path} for path in "ecadb"}
    jobs = [Job("draw", outputs=(path,)) for path in captions]
    numbers = {"d": "2", "a": "10", "c": "S2", "gone": "S3", "b": "S10"}  # of the last edition
    page = exhibits_page(jobs, captions, {}, numbers)
    assert [row.split(" | ")[1] for row in page.splitlines()[-5:]] == ["d", "a", "c", "b", "e"]


def test_cost_does_not_depend_on_the_order_of_the_jobs(monkeypatch):
    costs = {"a": (0.1, 1), "b": (0.2, 1), "c": (0.5, 1), "d": (0.7, 1)}
    sums = {reduce(add, (costs[name][0] for name in order)) for order in permutations(costs)}
    assert {f"{each:.0f}" for each in sums} == {"1", "2"}  # sum() is exact from Python 3.12 on
    pages = set()
    for order in permutations(costs):
        monkeypatch.setattr(exhibits, "_measured", lambda *given, order=order: order)
        pages.add(exhibits_page(JOBS, {"figures/peaks.svg": {"title": "Peaks"}}, costs, {}))
    (page,) = pages
    assert page.endswith("(../src/peaks.py) | 2 | 1 |\n")


def test_report_opens_on_verdicts_and_on_the_claims_that_need_a_condition(tmp_path):
    published = ROOT / "tests" / "reference" / "claims.json"
    rows = read_judged(published)
    (tmp_path / "results").mkdir()
    shutil.copy(published, tmp_path / "results")
    (tmp_path / "CITATION.cff").write_text("title: A|B\nabstract: What it is.\n", encoding="utf-8")
    (tmp_path / "a.png").write_bytes(b"abc")
    shown = "![Build](https://a.b/c.svg)\n![A wave](a.png)\n"
    (tmp_path / "README.md").write_text(shown, encoding="utf-8")
    found = opening.opening(tmp_path)
    title, verdicts, *told = found
    assert title == r"\ A\|B"
    assert "What it is." in found[title][0]
    picture = [".. image:: data:image/png;base64,", "YWJj", f":alt: {opening.escaped('A wave')}"]
    assert found[title][1:] == ["\n     ".join(picture)]
    assert len(found[verdicts]) == len({row.study for row in rows})
    assert sum(map(len, map(found.get, told))) == sum(row.verdict in opening.TITLES for row in rows)


@pytest.fixture
def tree(tmp_path, plant, monkeypatch):
    files = {
        "paper/report.typ": '#import "format.typ": *\n#include "/studies/one/section.typ"\n'
        '#let mass = found("mass_ratio")\n#table-of("heavier").len()\n#mass.a\n'
        "#for name in sys.inputs.keys() [#name]\n",
        "paper/format.typ": '#let found(rule) = json("/results/findings/" + rule + ".json")\n'
        '#let table-of(name) = csv("/results/tables/" + name + ".csv")\n',
        "studies/one/section.typ": '#let asked = yaml("config.yaml")\nOne: #asked.n\n',
        "studies/one/config.yaml": "n: 1\n",
        "results/findings/mass_ratio.json": '{"a": 1}\n',
        "results/tables/heavier.csv": "x\n1\n",
        "results/tables/other.csv": "x\n1\n",
    }
    monkeypatch.chdir(plant(tmp_path, files))
    return tmp_path


def test_sources_data_tables_and_findings_are_found(tree):
    assert reads("paper/report.typ") == [
        "paper/format.typ",
        "paper/report.typ",
        "results/findings/mass_ratio.json",
        "results/tables/heavier.csv",
        "studies/one/config.yaml",
        "studies/one/section.typ",
    ]


@pytest.mark.parametrize("missing", ["results/tables/heavier.csv", "studies/one/config.yaml"])
def test_file_that_is_read_and_not_declared_stops_the_compiler(tree, missing):
    declared = reads("paper/report.typ")
    assert compiled("paper/report.typ", declared, {}).startswith(b"%PDF")
    declared.remove(missing)
    with pytest.raises(ValueError, match="not found"):
        compiled("paper/report.typ", declared, {})


def test_figure_that_no_document_shows_is_refused(tree):
    figures = ["figures/vase", "figures/size", "studies/one/figures/size"]
    report, section = tree / "paper/report.typ", tree / "studies/one/section.typ"
    report.write_text('#found("size")\n#picture(\n("vase", "tower"), called: "both", [Vase.])\n')
    section.write_text('#picture("size", wide: false, [Size.])\n#picture("vase", [Vase again.])\n')
    sources = ["paper/report.typ", "studies/one/section.typ"]
    refuse_unshown(figures, [*sources, "results/claims.json"])
    section.write_text("none\n")
    with pytest.raises(ValueError, match="no document shows") as error:
        refuse_unshown(figures, sources)
    said = str(error.value).splitlines()
    assert [line.split(".py")[0] for line in said] == figures[1:]


def test_fault_of_a_source_has_its_file_and_line(tree):
    (tree / "studies/one/section.typ").write_text("One.\n\n#none.a\n")
    with pytest.raises(ValueError, match=r"(?s)fields on type none.* studies/one/section\.typ:3:"):
        compiled("paper/report.typ", reads("paper/report.typ"), {})


def test_figures_of_article_and_supplement_are_numbered_by_picture(tree, plant):
    svg = '<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9"/>'
    plant(tree, dict.fromkeys(("a.svg", "b.svg", "c.svg"), svg))
    shown = '#figure(image("/{}.svg"), caption: [])\n#figure(table([1]), caption: [])\n'
    for name, pictures in (("report", "bc"), ("supplement", "a")):
        plant(tree, {f"paper/{name}.typ": "".join(map(shown.format, pictures))})
    assert figure_numbers({}) == {"b.svg": "1", "c.svg": "2", "a.svg": "S1"}
