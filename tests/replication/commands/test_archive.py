"""Archives of a run, and `make verify`."""

import hashlib
import json
import os
import py_compile
import re
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

from replication.commands import archive
from replication.commands.verify import main
from replication.origin.recorded import CRATE, Crate
from replication.workflow.provenance import Job

ROOT = Path(__file__).resolve().parents[3]
LEFT_OUT = ["results/costs.csv", "results/logs", CRATE]
RESULTS = {"results/peaks.csv": "1\n", "figures/peaks.svg": "<svg/>\n"}


def git(root, *words):
    who = ["-c", "user.name=x", "-c", "user.email=x@x.org", "-c", "commit.gpgsign=false"]
    command = ["git", "-C", root, *who, *words]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout.strip()


@pytest.fixture
def tree(tmp_path, plant, monkeypatch):
    """A clone with the machine in it, and a finished run, none of whose rules is to run again."""
    root = tmp_path / "tree"
    root.mkdir()
    skipped = shutil.ignore_patterns("__pycache__", "template")
    shutil.copytree(ROOT / "src/replication", root / "src/replication", ignore=skipped)
    source = {
        "pyproject.toml": '[project]\nname = "peaks"\nversion = "0.1.0"\n',
        "figures/peaks.py": "draw()\n",
        "run": "#!/bin/sh\n",
        ".gitignore": "results/\n*.svg\ndist/\n__pycache__/\n",
    }
    extra = {"results/costs.csv": "rule,seconds\n", "results/logs/peaks.log": "said\n"}
    plant(root, {**source, **RESULTS, **extra})
    (root / "run").chmod(0o755)
    git(root, "init", "-q")
    git(root, "add", ".")
    git(root, "commit", "-q", "-m", "first")
    list_results(root)
    monkeypatch.setattr(archive, "pending", lambda root: [])
    return root


def list_results(root):
    """Write the crate, as the last rule of a run does: what a command reads of it."""
    files = {path: (root / path).read_bytes() for path in (*RESULTS, "figures/peaks.py")}
    entities = [
        {"@id": path, "@type": "File", "sha256": hashlib.sha256(data).hexdigest()}
        for path, data in files.items()
    ]
    entities += [
        {"@id": "Snakefile", "@type": "File", "version": git(root, "rev-parse", "HEAD")},
        {"@id": "#left_out", "@type": "PropertyValue", "value": LEFT_OUT},
        {
            "@id": "#job/results/peaks.csv",
            "@type": "CreateAction",
            "name": "peaks",
            "result": [{"@id": path} for path in RESULTS],
        },
    ]
    (root / CRATE).write_text(json.dumps({"@graph": entities}), encoding="utf-8")


@pytest.fixture
def unpacked(tree, tmp_path):
    """The archive in an empty folder elsewhere, without git."""
    archive.main(tree)
    with zipfile.ZipFile(tree / "dist/peaks-0.1.0.zip") as packed:
        packed.extractall(tmp_path / "elsewhere")
    return tmp_path / "elsewhere"


def verified(root):
    """Run what `make verify` runs, with the unpacked machine."""
    return subprocess.run(
        [sys.executable, "-I", "-S", "src/replication/commands/verify.py"],
        cwd=root,
        capture_output=True,
        text=True,
    )


def test_two_archives_have_the_same_bytes_whatever_times_and_permissions(tree):
    said = archive.main(tree)
    path = tree / "dist/peaks-0.1.0.zip"
    first = path.read_bytes()
    for each in (tree / "run", *map(tree.joinpath, RESULTS)):
        os.utime(each, (1e9, 1e9))
        each.chmod(0o700 if each.name == "run" else 0o600)
    archive.main(tree)
    assert path.read_bytes() == first
    assert f"{path}: " in said
    assert hashlib.sha256(first).hexdigest() in said


def test_unpacked_archive_verifies_and_sha256sum_agrees(unpacked):
    done = verified(unpacked)
    assert done.returncode == 0, done.stderr
    assert re.search(r"verified: \d+ files are as SHA256SUMS has them", done.stdout)
    assert "verified: 2 outputs and 1 inputs" in done.stdout
    command = ["sha256sum", "--check", "--strict", "--quiet", "SHA256SUMS"]
    subprocess.run(command, cwd=unpacked, check=True)


@pytest.mark.parametrize(
    ("path", "make", "told"),
    [
        ("src/json", lambda path: path.symlink_to("../results/logs"), "is a link"),
        ("src/gone", lambda path: path.symlink_to("nowhere"), "is a link"),
        ("src/pipe", os.mkfifo, "was added"),
        ("src/json/__init__.py", lambda path: path.write_text("print('planted')"), "was added"),
        ("figures", lambda path: path.rename("f") and path.symlink_to("f"), "is a link"),
        ("run", lambda path: path.unlink() or path.symlink_to("figures/peaks.py"), "is a link"),
    ],
)
def test_link_or_module_that_was_added_is_named_and_not_run(
    unpacked, monkeypatch, path, make, told
):
    monkeypatch.chdir(unpacked)
    (unpacked / path).parent.mkdir(exist_ok=True)
    make(unpacked / path)
    done = verified(unpacked)
    assert done.returncode == 1
    assert f"{path} {told}" in done.stderr
    assert "planted" not in done.stdout


def test_module_of_the_folder_stands_in_for_none_of_python(unpacked):
    for name in ("SHA256SUMS", "ro-crate-metadata.json"):  # so that it counts as a finished tree
        (unpacked / name).unlink()
    (unpacked / "src/json.py").write_text("print('planted')", encoding="utf-8")
    assert "planted" not in verified(unpacked).stdout


@pytest.mark.parametrize(
    "path",
    ["results/peaks.csv", "figures/peaks.svg", "figures/peaks.py", "ro-crate-metadata.json"],
)
def test_file_that_was_tampered_with_or_is_missing_is_named(unpacked, path):
    (unpacked / path).write_text("{}", encoding="utf-8")
    (unpacked / "pyproject.toml").unlink()
    done = verified(unpacked)
    assert done.returncode == 1
    changed, missing = sorted(done.stderr.splitlines(), key=lambda line: " is missing" in line)
    assert changed.startswith(f"{path} changed after it was packed: its SHA-256 is ")
    assert missing == "pyproject.toml is missing; SHA256SUMS has it"


def test_forgery_that_the_crates_agree_with_is_named_and_that_of_all_sums_has_another(
    unpacked, tree
):
    (published,) = re.findall(r"SHA256SUMS (\w{64})$", archive.main(tree))
    assert verified(unpacked).stdout.count(published) == 1
    path = unpacked / "results/peaks.csv"
    before = hashlib.sha256(path.read_bytes()).hexdigest()
    path.write_text("forged\n", encoding="utf-8")
    after = hashlib.sha256(path.read_bytes()).hexdigest()
    crate = (unpacked / CRATE).read_text(encoding="utf-8").replace(before, after)
    for name in (CRATE, Path(CRATE).name):
        (unpacked / name).write_text(crate, encoding="utf-8")
    done = verified(unpacked)
    assert done.returncode == 1
    assert done.stderr.startswith("results/peaks.csv changed after it was packed")
    assert f"{CRATE} is not the one that was packed" in done.stdout
    sums = (unpacked / "SHA256SUMS").read_text("utf-8")
    command = ["sha256sum", *(line[66:] for line in sums.splitlines())]
    sums = subprocess.run(command, cwd=unpacked, check=True, capture_output=True).stdout
    (unpacked / "SHA256SUMS").write_bytes(sums)
    done = verified(unpacked)
    assert done.returncode == 0
    assert published not in done.stdout
    assert "Compare its SHA-256 with that published" in done.stdout


def test_compiled_file_that_was_added_is_named_and_not_run(unpacked):
    module = unpacked / "src/replication/origin/recorded.py"
    source = module.read_bytes()
    for content in (b"raise SystemExit".ljust(len(source)), source):
        module.write_bytes(content)
        os.utime(module, (1e9, 1e9))
        if content != source:
            py_compile.compile(str(module))
    done = verified(unpacked)
    assert "made by commands here or added: __pycache__\n" in done.stdout
    assert "verified: 2 outputs" in done.stdout


@pytest.mark.parametrize(
    ("content", "told"),
    [
        (None, " is missing or empty; an archive has"),
        (b"", " is missing or empty; an archive has"),
        *((text, ", line 1 is ") for text in (b"\xff\xfe\x00", b"0  a\n", b"g" * 64 + b"  a\n")),
    ],
)
def test_archive_without_sound_checksums_is_refused(unpacked, content, told):
    (unpacked / "SHA256SUMS").unlink()
    if content is not None:
        (unpacked / "SHA256SUMS").write_bytes(content)
    done = verified(unpacked)
    assert done.returncode == 1
    assert done.stderr.startswith(f"SHA256SUMS{told}")


@pytest.mark.parametrize(
    ("path", "committed", "told"),
    [
        ("remove " + CRATE, False, "expected a finished run: make reproduce"),
        (CRATE, False, "is not the RO-Crate of a run"),
        ("results/peaks.csv", False, "results/peaks.csv changed after rule peaks made it"),
        ("run", False, "the tree differs from its commit"),
        ("figures/peaks.py", True, "figures/peaks.py changed after the run"),
        ("remove .git", False, "is no git repository"),
    ],
)
def test_unfinished_or_unverified_run_is_refused(tree, path, committed, told):
    if path.startswith("remove "):
        (tree / path.removeprefix("remove ")).rename(tree.with_name("removed"))
    else:
        (tree / path).write_text("{}", encoding="utf-8")
    if committed:
        git(tree, "commit", "-q", "-a", "-m", "second")
    with pytest.raises(SystemExit, match=told):
        archive.main(tree)
    assert not (tree / "dist").exists()


def test_run_that_would_go_on_is_refused_with_its_rules(tree, monkeypatch):
    monkeypatch.undo()
    jobs = [Job("peaks", outputs=("a",), pending=True), Job("all", pending=True)]
    jobs += [Job("done", outputs=("b",))]
    monkeypatch.setattr(archive, "workflow_jobs", lambda root, targets: jobs)
    with pytest.raises(SystemExit, match="out of date, in peaks: make reproduce"):
        archive.main(tree)


def test_results_of_an_earlier_commit_are_listed_again(tree, monkeypatch):
    monkeypatch.setattr(archive, "renew", list_results)
    (tree / "run").write_text("#!/bin/sh\ntrue\n", encoding="utf-8")
    git(tree, "commit", "-q", "-a", "-m", "second")
    before = (tree / CRATE).read_text("utf-8")
    archive.main(tree)
    assert (tree / CRATE).read_text("utf-8") != before
    assert (tree / "dist/peaks-0.1.0.zip").exists()


FILES = {
    "results/tables/peaks.csv": "a,b\n1,2\n",
    "results/logs/peaks.log": "said\n",
    "results/costs.csv": "rule,seconds\n",
    "figures/peaks.svg": "<svg/>\n",
    "figures/peaks.py": "draw()\n",
}
MADE = ("results/tables/peaks.csv", "figures/peaks.svg")
RECORDED = Crate(
    checksums={
        name: hashlib.sha256(FILES[name].encode()).hexdigest()
        for name in (*MADE, "figures/peaks.py")
    },
    rules=dict.fromkeys(MADE, "peaks"),
    left_out=("results/costs.csv", "results/logs"),
    version="",
)


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("results/tables/peaks.csv", "changed after rule peaks made it: its SHA-256 is "),
        ("figures/peaks.py", "changed after the run: its SHA-256 is "),
        ("results/new/other.csv", "is extra: no rule made it; move it away"),
        ("results/x.txt", "is extra: no rule made it; move it away"),
        ("figures/other.svg", "is extra: no rule made it; move it away"),
        # logs, costs and what the run did not read are not the crate's
        ("results/logs/claim.log", None),
        ("results/costs.csv", None),
        ("figures/new.py", None),
    ],
)
def test_file_that_is_not_as_the_run_left_it_is_named(plant, tmp_path, name, told):
    assert main(RECORDED, plant(tmp_path, FILES)) == []
    faults = main(RECORDED, plant(tmp_path, {name: "other than before"}))
    assert [fault.startswith(f"{name} {told}") for fault in faults] == [True] * bool(told)


def test_missing_file_names_the_rule_that_makes_it(plant, tmp_path):
    (plant(tmp_path, FILES) / "figures/peaks.svg").unlink()
    assert main(RECORDED, tmp_path) == ["figures/peaks.svg is missing; rule peaks makes it"]


def test_link_in_place_of_a_file_or_beside_one_is_named(plant, tmp_path):
    path = plant(tmp_path, FILES) / "figures/peaks.svg"
    path.rename(tmp_path / "other.svg")
    path.symlink_to(tmp_path / "other.svg")
    (tmp_path / "results/more").symlink_to(tmp_path / "figures")
    link, extra = main(RECORDED, tmp_path)
    assert link.startswith("figures/peaks.svg is a link; expected the file itself")
    assert extra == "results/more is extra: no rule made it; move it away"
