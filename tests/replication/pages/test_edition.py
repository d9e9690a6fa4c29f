"""The edition that is published: its seal, its blanks and codecheck.yml."""

import random
import shutil
import subprocess
from pathlib import Path

import pytest
import yaml

from replication.pages.blanks import main
from replication.pages.codecheck import codecheck_file, manifest
from replication.pages.seal import (
    EDITION,
    KINDS,
    SEAL,
    SOURCES,
    TOP,
    VERDICTS,
    broken,
    outdated,
    seal,
)
from replication.workflow.provenance import Job


@pytest.fixture
def sealed(tmp_path, plant):
    """A small tree with an edition and what it was made from."""
    texts = dict.fromkeys(("tests/reference/t.csv", "paper/report.typ", *TOP), "one\ntwo\n")
    plant(tmp_path, {"docs/report.pdf": b"\xff\r\n", "paper/report.pdf": "of a run", **texts})
    seal(tmp_path)
    assert [*broken(tmp_path), *outdated(tmp_path)] == []
    return tmp_path


OLDER = "the edition is older than "


@pytest.mark.parametrize(
    ("name", "content", "told"),
    [
        ("docs/report.pdf", b"\xff\n", "docs/report.pdf changed since"),
        ("tests/reference/t.csv", b"one\ntwo \n", "tests/reference/t.csv changed since"),
        ("docs/new.csv", b"1", "docs/new.csv is new"),
        ("docs/report.pdf", None, "docs/report.pdf is gone"),
        ("paper/report.typ", b"one\nthree\n", f"{OLDER}paper/report.typ, which changed"),
        ("README.md", b"one\nthree\n", f"{OLDER}README.md, which changed"),
        ("data/records/a.AT2", b"1\n", f"{OLDER}data/records/a.AT2, which is new"),
        ("src/explorer/page.js", b"1\n", f"{OLDER}src/explorer/page.js, which is new"),
        ("docs/exhibits.md", b"one\nthree\n", f"{OLDER}docs/exhibits.md, which changed"),
        ("tests/reference/t.csv", b"one\r\ntwo\r\n", None),  # line ends of a checkout
        ("paper/report.pdf", b"new", None),  # made by a run
    ],
)
def test_published_file_input_or_text_that_changed_is_named(sealed, name, content, told):
    if content is None:
        (sealed / name).unlink()
    else:
        (sealed / name).parent.mkdir(parents=True, exist_ok=True)
        (sealed / name).write_bytes(content)
    faults = [*broken(sealed), *outdated(sealed)]
    assert [fault.startswith(str(told)) for fault in faults] == [True] * bool(told)


def test_seal_that_lost_a_part_is_refused(sealed):
    (sealed / SEAL).write_text("abc  docs/report.pdf\n", encoding="utf-8")
    with pytest.raises(ValueError, match=r"checksums.txt has 0 lines"):
        list(broken(sealed))


@pytest.fixture
def tree(tmp_path, plant):
    report = {"report.typ": "= One\nauthors: BLANK: your names\n", "report.pdf": b"\0BLANK: \xff"}
    plant(tmp_path / "paper", report)
    return plant(tmp_path, {"README.md": "A blank line.\n"})


@pytest.mark.parametrize(("asked", "refused"), [("1", True), ("0", False), ("", False)])
def test_release_refuses_marks(tree, monkeypatch, asked, refused):
    monkeypatch.setenv("RELEASE", asked)
    if refused:
        with pytest.raises(SystemExit, match="RELEASE=1"):
            main(tree)
    else:
        main(tree)
    (tree / "paper" / "report.typ").write_text("= One\n")
    main(tree)


JOBS = [
    Job(
        "peaks",
        scripts=("src/peaks.py",),
        outputs=("results/tables/peaks.csv", "results/shards/peaks.csv", "results/claims.json"),
    ),
    Job("figure", inputs=("results/tables/peaks.csv",), outputs=("figures/peaks.svg",)),
    Job("report", inputs=("figures/peaks.svg",), outputs=("paper/report.pdf",)),
]
CAPTIONS = {"figures/peaks.svg": {"title": "Peaks: all"}}
CITATION = {
    "title": "On “peaks”",
    "authors": [
        {
            "given-names": "A.",
            "family-names": "Bee",
            "orcid": "https://orcid.org/0000-0002-1825-0097",
        }
    ],
}


def test_missing_orcid_is_told_and_a_doi_is_the_reference():
    citation = {"title": "T", "authors": [{"name": "The Bees"}], "doi": "10.1/x"}
    text = codecheck_file(JOBS, CAPTIONS, citation)
    assert "CITATION.cff has none of The Bees" in text
    assert "ORCID" not in codecheck_file(JOBS, CAPTIONS, CITATION).partition("version:")[0]
    assert yaml.safe_load(text)["paper"]["reference"] == "https://doi.org/10.1/x"


def test_every_figure_table_and_document_of_the_run_is_listed(jobs):
    made = {out for job in jobs for out in job.outputs}
    captions = {out: {"title": out} for out in made if out.endswith(".svg")}
    listed = [entry["file"] for entry in manifest(jobs, captions)]
    assert len(set(listed)) == len(listed)
    kinds = (".pdf", ".svg")
    assert {out for out in made if out.endswith(kinds)} <= set(listed) <= made
    assert {Path(path).suffix for path in listed} >= {*kinds, ".csv"}


ROOT = Path(__file__).parents[3]


def test_each_tracked_file_of_the_edition_and_of_its_sources_is_sealed(tmp_path):
    """One bit of a file that chance picks is reported, of each kind of file in each folder."""
    command = ["git", "ls-files", *EDITION, *SOURCES, *TOP]
    listed = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    names = [name for name in listed.stdout.splitlines() if (ROOT / name).is_file()]
    names = [name for name in names if Path(name).suffix in KINDS or name.startswith(EDITION)]
    if not names:
        pytest.skip("no git here, which lists the files")
    kinds = {(name.split("/")[0], Path(name).suffix): [] for name in names}
    for name in names:
        kinds[name.split("/")[0], Path(name).suffix].append(name)
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(ROOT / name, tmp_path / name)
    seal(tmp_path)
    for picked in (random.choice(of_kind) for of_kind in kinds.values()):
        content = bytearray((tmp_path / picked).read_bytes())
        if picked in (SEAL, VERDICTS) or not content:  # `make check` holds each line of the pages
            continue
        place = random.randrange(len(content))
        content[place] ^= 1
        (tmp_path / picked).write_bytes(content)
        told = [*broken(tmp_path), *outdated(tmp_path)]
        assert any(picked in line for line in told), f"byte {place} of {picked}"
        content[place] ^= 1
        (tmp_path / picked).write_bytes(content)
