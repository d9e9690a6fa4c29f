"""The captions of the HTML report: complete, tied to the ledger, and sound reStructuredText."""

import re
from dataclasses import replace
from pathlib import Path

import pytest
import yaml
from docutils.core import publish_parts
from jinja2 import Environment

from replication.inputs.parts import drawn_from
from replication.judging.claim import Claim
from replication.judging.ledger import with_verdict
from replication.pages.captions import captioned, read_captions, verdict

ROOT = Path(__file__).resolve().parents[3]
STUDIES = sorted(path.parent for path in ROOT.glob("studies/*/study.smk"))


def read(path):
    return yaml.safe_load(path.read_text(encoding="utf-8"))


def figures(folder):
    """The figures that the scripts of a folder draw."""
    scripts = [path for path in folder.glob("*.py") if drawn_from(path)]
    return {path.relative_to(ROOT).with_suffix(".svg").as_posix() for path in scripts}


OURS = [ROOT / "figures", *STUDIES]
LEDGER = {row["id"] for row in read(ROOT / "paper" / "claims.yaml")}


def test_every_figure_of_the_paper_has_a_caption_and_no_caption_is_left_over():
    found = set(read(ROOT / "figures" / "captions.yaml"))
    assert found == figures(ROOT / "figures") | {"results/animation.png"}


@pytest.mark.parametrize("study", STUDIES, ids=lambda path: path.name)
def test_every_figure_of_a_study_has_a_caption(study, jobs):
    folder = f"studies/{study.name}/figures/"
    drawn = {path for job in jobs for path in job.outputs if path.startswith(folder)}
    drawn = drawn or figures(study / "figures")  # of the skeleton, which is no study of ours
    assert drawn
    assert set(read(study / "captions.yaml")) == drawn


@pytest.mark.parametrize("folder", OURS, ids=lambda path: path.name)
def test_captions_name_claims_of_the_ledger_once(folder):
    ledger = set(LEDGER)
    if (folder / "claims.yaml").exists():
        ledger |= {row["id"] for row in read(folder / "claims.yaml")}
    for path, entry in read(folder / "captions.yaml").items():
        assert set(entry) == {"title", "category", "caption", "alt", "claims"}, path
        assert entry["alt"] not in (entry["title"], entry["caption"]), path
        assert set(entry["claims"]) <= ledger, path
        assert len(set(entry["claims"])) == len(entry["claims"]), path


@pytest.mark.parametrize("folder", OURS, ids=lambda path: path.name)
def test_no_two_results_of_a_category_have_one_title(folder):
    entries = read(folder / "captions.yaml").values()
    assert len({(entry["category"], entry["title"]) for entry in entries}) == len(entries)


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


def test_verdict_counts_in_the_order_of_the_verdicts():
    told = ["not tested", "qualified", "confirmed", "confirmed", "misprint"]
    assert verdict(told) == "2 confirmed, 1 qualified, 1 misprint, 1 not tested"
    assert verdict([]) == "no claim"


def test_result_captioned_twice_is_refused(tmp_path):
    paths = [tmp_path / "a.yaml", tmp_path / "b.yaml"]
    for path in paths:
        path.write_text(yaml.safe_dump({"a.svg": ENTRY}), encoding="utf-8")
    with pytest.raises(ValueError, match=r"b\.yaml: a\.svg has a caption already"):
        read_captions(paths)
