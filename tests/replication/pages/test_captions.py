"""The captions of the HTML report: complete, tied to the ledger, and sound reStructuredText."""

import re
from dataclasses import replace
from pathlib import Path

import pytest
import yaml
from docutils.core import publish_parts
from jinja2 import Environment

from replication.inputs.strict_yaml import read_yaml
from replication.judging.claim import Claim
from replication.judging.ledger import with_verdict
from replication.pages.captions import captioned, read_captions

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
