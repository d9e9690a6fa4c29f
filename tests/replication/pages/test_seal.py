"""The seal of the edition tells of each published file, input and text that changed."""

import random
import shutil
import subprocess
from pathlib import Path

import pytest

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

ROOT = Path(__file__).parents[3]


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
