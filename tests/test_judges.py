"""One change of what is published, whose checksum is renewed, is named in one line."""

import hashlib
import json
import shutil
from pathlib import Path
from types import SimpleNamespace

import pytest

from documents import check, draw, publish, remade
from documents.stated import headlines, miscounted, misstated
from replication.sources import checksums
from replication.verdicts import unexpected
from tests.cases import ROOT, published


@pytest.fixture
def tree(tmp_path, monkeypatch):
    """A copy of what is published, with the parameters of the config as it is."""
    for name in ("src", "figures", "paper", "pyproject.toml"):
        (tmp_path / name).symlink_to(ROOT / name)
    for name in ("README.md", "LICENSE", "CITATION.cff"):
        shutil.copy(ROOT / name, tmp_path)
    for name in ("docs", "tests/reference", "config", "data"):
        shutil.copytree(ROOT / name, tmp_path / name)
    monkeypatch.chdir(tmp_path)
    checksums.__globals__["_checksum"].cache_clear()  # of the same paths elsewhere
    yield tmp_path
    checksums.__globals__["_checksum"].cache_clear()


def sealed(tree):
    """Renew the checksums, as sha256sum does."""
    lines = check.SUMS.read_text("utf-8").splitlines()
    paths = [line.split("  ", 1)[1] for line in lines]
    sums = [f"{hashlib.sha256((tree / p).read_bytes()).hexdigest()}  {p}\n" for p in paths]
    check.SUMS.write_text("".join(sums), "utf-8")


def named(part, path):
    if part is check.rewritten:
        rows = check.published(published())
        return {*part(rows, published(), path.removeprefix("docs/"))}
    return {*part()}


@pytest.mark.parametrize(
    ("path", "old", "new", "part"),
    [
        ("tests/reference/vase.csv", "0.272822711", "0.282822711", check.of_another_run),
        ("tests/reference/friction_pulses.csv", "0.168595309", "0.5", check.of_another_run),
        ("tests/reference/trilith_map.csv", "no uplift", "rests", check.of_another_run),
        ("tests/reference/settings.json", '"mass_ratio": 0.434', '"mass_ratio": 0.443',
         check.of_another_run),
        ("tests/reference/rules.json", '"mass_ratio": 0.434', '"mass_ratio": 0.443',
         check.of_another_run),
        ("docs/verdicts.md", "refuted", "confirmed", check.rewritten),
        ("docs/explorer.html", "9.81", "8.91", check.rewritten),
    ],
)  # fmt: skip
def test_change_is_named_although_its_checksum_is_renewed(tree, path, old, new, part):
    before, file = named(part, path), tree / path
    text = file.read_bytes()
    assert old.encode() in text
    file.write_bytes(text.replace(old.encode(), new.encode(), 1))
    assert any(path in line for line in check.unsealed())
    sealed(tree)
    checksums.__globals__["_checksum"].cache_clear()
    assert not any(path in line for line in check.unsealed())
    assert any(file.name in line for line in named(part, path) - before)


def test_changes_of_what_is_drawn_and_typeset_again_are_named(tree, monkeypatch):
    def pictures(scripts, *rest):
        """Draw two published pictures, and those of the article that are not published."""
        for script in scripts:
            shown = check.DOCS / f"{Path(script).stem}.svg"
            if shown.stem in ("vase", "motions", "spectra", "break_even"):
                yield from draw.pictures([script], *rest)
            else:
                yield (shown if shown.exists() else check.DOCS / "where.svg").read_text("utf-8")

    monkeypatch.setattr(remade, "pictures", pictures)
    changes = {
        "numbers.md": (b"3.79364", b"3.97364"),
        "vase.svg": (b"<title>", b"<title>no "),
        "report.pdf": (b"%PDF", b"%FDP"),
    }
    for name, (old, new) in changes.items():
        text = (tree / "docs" / name).read_bytes()
        assert old in text
        (tree / "docs" / name).write_bytes(text.replace(old, new, 1))
    lines = [*check.rewritten(check.published(published()), published(), *changes, "motions.svg")]
    assert {name for name in changes if any(name in line for line in lines)} == {*changes}
    assert not any("motions.svg" in line for line in lines)


@pytest.mark.parametrize(
    ("path", "old", "new"),
    [
        ("README.md", "numbers.md#trilith.frame_frequency_parameter", "numbers.md#trilith.frame"),
        ("README.md", "numbers.md#motions.gain_temple", "numbers.md#motions.gain_trilith"),
        ("README.md", "ST.1943-541X.0000933", "ST.1943-541X.0000393"),
        ("CITATION.cff", "\nversion: 0.1.0", "\nversion: 1.0.0"),
        ("CITATION.cff", "license: MIT", "license: GPL-3.0-only"),
        ("LICENSE", "WITHOUT WARRANTY", "WITH WARRANTY"),
        ("docs/LICENSE-CC-BY", "Attribution 4.0", "Attribution-NonCommercial 4.0"),
        ("data/records/README.md", "| 0.319 |", "| 0.391 |"),
    ],
)
@pytest.mark.usefixtures("tree")
def test_what_other_files_state_is_what_results_records_and_files_say(path, old, new):
    results = published()
    claims = check.published(results)
    assert not [*misstated(results, claims)]
    text = Path(path).read_text("utf-8")
    assert old in text
    Path(path).write_text(text.replace(old, new, 1), "utf-8")
    assert any(path in line for line in misstated(results, claims))


@pytest.mark.parametrize(
    ("old", "new", "named"),
    [
        ("77 are confirmed", "78 are confirmed", "other counts of verdicts"),
        ("Until the first impact", "Until the last impact", "'Until the first impact"),
        ("contacts stay pressed", "contacts open", "'contacts stay pressed"),
    ],
)
def test_readme_says_of_claims_what_their_verdicts_are(old, new, named):
    claims, text = check.published(published()), (ROOT / "README.md").read_text("utf-8")
    assert not [*miscounted(claims, text), *headlines(claims, "README.md", text)]
    assert old in text
    changed = text.replace(old, new)
    lines = [*miscounted(claims, changed), *headlines(claims, "README.md", changed)]
    assert [named in line for line in lines] == [True]


def test_file_without_checksum_and_checksum_without_file_are_named(tree):
    (tree / "docs/new.svg").touch()
    (tree / "docs/vase.svg").unlink()
    lines = "\n".join(check.unsealed())
    assert "docs/new.svg is not in docs/SHA256SUMS" in lines
    assert "names docs/vase.svg, which is not there" in lines


@pytest.mark.parametrize(
    ("verdict", "differs", "is_named"),
    [("confirmed", "sign", False), ("confirmed", "", True), ("refuted", "sign", True)],
)
def test_claim_is_named_where_its_verdict_or_its_flag_is_another(verdict, differs, is_named):
    row = {"id": "a", "file": "claims.yaml", "shown": "", "computed": True, "verdict": verdict}
    row |= {"differs": differs, "expected": "confirmed", "expected_differs": "sign"}
    assert len(unexpected([row])) == is_named


@pytest.fixture
def run(tree, monkeypatch):
    """The results of a run that gave what is published, up to date as Snakemake says."""
    for folder in ("results/tables", "results/notebooks"):
        Path(folder).mkdir(parents=True)
    for name in ("figures", "paper"):  # of links
        Path(name).unlink()
        shutil.copytree(ROOT / name, name, ignore=shutil.ignore_patterns("*.svg", "*.pdf"))
    publish.CLAIMS.write_text(json.dumps(check.published(published())), "utf-8")
    for path in check.REFERENCE.iterdir():
        shutil.copy(path, "results/tables" if path.suffix == ".csv" else "results")
    for page in check.DOCS.glob("notebook_*.html"):
        shutil.copy(page, f"results/notebooks/{page.name.removeprefix('notebook_')}")
    for source, target in publish.copies().items():
        if not source.exists():
            shutil.copy(target, source)
    said = SimpleNamespace(stdout="Nothing to be done", stderr="")
    monkeypatch.setattr(publish.subprocess, "run", lambda *_, **__: said)
    return said


@pytest.mark.usefixtures("run")
def test_what_is_published_is_the_run_with_its_checksums():
    Path("tests/reference/old.csv").touch()
    Path("results/explorer.html").write_text("another page", "utf-8")
    before = check.SUMS.read_text("utf-8").splitlines()
    publish.main()
    changed = {line[66:] for line in {*check.SUMS.read_text("utf-8").splitlines()} - {*before}}
    assert {path for path in changed if not path.endswith(".gz")} == {"docs/explorer.html"}
    assert list(check.unsealed()) == []
    assert not Path("tests/reference/old.csv").exists()
    assert Path("docs/explorer.html").read_text("utf-8") == "another page"


@pytest.mark.parametrize(
    ("path", "old", "new", "message"),
    [
        ("results/claims.json", '"verdict": "confirmed"', '"verdict": "refuted"', "verdict of"),
        ("results/settings.json", '"mass_ratio": 0.434', '"mass_ratio": 0.443', "config.yaml as"),
        (None, "", "", "not up to date with this tree"),
    ],
)
def test_a_run_that_did_not_judge_what_it_would_publish_is_refused(run, path, old, new, message):
    if path:
        text = Path(path).read_text("utf-8")
        assert old in text
        Path(path).write_text(text.replace(old, new, 1), "utf-8")
    else:
        run.stdout = "1 of 1 steps"
    before = check.SUMS.read_bytes()
    with pytest.raises(SystemExit, match=message):
        publish.main()
    assert check.SUMS.read_bytes() == before
