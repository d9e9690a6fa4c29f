"""studies/FOLLOW-UP.md: every code block, literally and in order, in a copy of the repository."""

import re
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).parents[1]
IGNORED = ("results", ".snakemake", ".git", ".venv", ".uv", "__pycache__", "*.svg", "*.pdf", "docs")
BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
PLACE = re.compile(r'^(?:#|//) (studies/\S+?)(, at its end|, (above|down to) the line "(.+)")?\n')
SECTION = """#import "/paper/format.typ": *
#include "/studies/bridge/section.typ"
"""
COMPILE = """import json, typst, yaml
from replication.claims import judged, read_claims, read_findings
settings = yaml.safe_load(open("studies/bridge/config.yaml"))
claims = read_claims("studies/bridge/claims.yaml", settings)
found = read_findings(["results/findings/bridge_capacity.json"])
rows = [judged(claim, found) for claim in claims]
json.dump(rows, open("results/claims.json", "w"))
typst.compile("section.typ", root=".", sys_inputs={"config": "{}", "captions": "{}"})
print({row["id"]: row["verdict"] for row in rows})
"""


def run(folder, *command):
    """Run a command in the copy, whose library comes before an installed one."""
    paths = {"PYTHONPATH": "src:.", "PATH": f"{Path(sys.executable).parent}:/usr/bin:/bin"}
    done = subprocess.run(command, cwd=folder, env=paths, capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr


def snakemake(folder, *arguments):
    return run(folder, sys.executable, "-m", "snakemake", "--cores", "1", *arguments)


def edit(folder, text):
    """Write a block into the file that its first line names, at the place that it names."""
    path, rest, where, line = PLACE.match(text).groups()
    target, text = folder / path, text.split("\n", 1)[1]
    if not rest:
        target.write_text(text, "utf-8")
        return
    before = target.read_text("utf-8")
    if line is None:
        target.write_text(before + text, "utf-8")
        return
    at = before.rindex("\n", 0, before.index(line)) + 1
    target.write_text((before[:at] if where == "above" else "") + text + before[at:], "utf-8")


@pytest.fixture
def copy(tmp_path):
    folder = tmp_path / "a copy"
    shutil.copytree(ROOT, folder, ignore=shutil.ignore_patterns(*IGNORED))
    author = ["-c", "user.name=a", "-c", "user.email=a@b"]
    for command in (["init", "-q"], ["add", "-A"], [*author, "commit", "-qm", "copy"]):
        assert run(folder, "git", *command) == (0, "")
    return folder


def test_the_page_is_followed_literally(copy):
    blocks = BLOCK.findall((copy / "studies/FOLLOW-UP.md").read_text("utf-8"))
    assert [kind for kind, _ in blocks] == [
        "sh",
        "yaml",
        "python",
        "yaml",
        "python",
        "typst",
        "sh",
        "sh",
    ]
    begin, *edits, reproduce, remove = blocks
    assert run(copy, "sh", "-e", "-c", begin[1])[0] == 0
    time = 0.01 * np.arange(2000)
    shaking = 4.0 * np.sin(2 * np.pi * time / 2.5) * np.exp(-0.5 * ((time - 6) / 2) ** 2)
    record = copy / "studies/bridge/record.txt"
    np.savetxt(record, np.transpose([time, shaking]), header="time (s), acceleration (m/s2)")
    for _, text in edits:
        edit(copy, text)
    assert reproduce[1] == "make reproduce\n"  # here: the jobs of the study, from nothing
    targets = ["results/findings/bridge_capacity.json", "studies/bridge/share.svg"]
    code, told = snakemake(copy, *targets)
    assert code == 0, told
    (copy / "section.typ").write_text(SECTION, "utf-8")
    code, told = run(copy, sys.executable, "-c", COMPILE)
    assert code == 0, told
    assert "'bridge_gain_is_large': 'refuted'" in told
    (copy / "section.typ").unlink()
    assert run(copy, "sh", "-e", "-c", remove[1])[0] == 0
    assert run(copy, "git", "status", "--porcelain") == (0, "")
    assert not list((copy / "results").glob("*/bridge_*"))


@pytest.mark.parametrize(
    ("file", "old", "new", "told"),
    [
        ("config.yaml", "scale: 1.3", "scal: 1.3", "unknown key 'scal'; did you mean 'scale'?"),
        ("config.yaml", "scale: 1.3", "scale: 1,3", "scale is '1,3'"),
        ("config.yaml", "el_centro", "el_cento", "there is no file data/records/el_cento"),
        ("config.yaml", ", column_mass: 60", "", "3 columns under a cap beam need column_mass"),
        ("claims.yaml", "{scale:g}", "{scal:g}", "claim example_survives has {scal}"),
        (
            "study.smk",
            '"results/tables/example_capacity.csv",\n        scripts',
            '"results/tables/capacity.csv",\n        scripts',
            "reads results/tables/capacity.csv, which no rule makes",
        ),
    ],
)
def test_a_mistake_is_named_before_any_job(copy, file, old, new, told):
    path = copy / "studies/example" / file
    assert old in path.read_text("utf-8")
    path.write_text(path.read_text("utf-8").replace(old, new, 1), "utf-8")
    code, message = snakemake(copy, "--dry-run", "results/findings/example_capacity.json")
    assert code == 1
    assert told in message
    assert file in message or "study.smk" in message


@pytest.mark.parametrize(
    ("file", "old", "new", "told"),
    [
        (
            "capacity.py",
            'return {"factor": factors} |',
            'return {"survives": truth(True)} or {"factor": factors} |',
            "where rule example_capacity declares the table",
        ),
        (
            "capacity.py",
            "def findings(example_capacity,",
            "def findings(example_capacty,",
            "findings takes 'example_capacty'; rule example_capacity has",
        ),
        (
            "capacity_figure.py",
            "draw(example_capacity)",
            "draw(capacity)",
            "draw takes 'capacity'; rule example_figures has",
        ),
        ("config.yaml", "highest: 8.0", "highest: 2.0", "no capacity up to a factor of 1.99"),
    ],
)
def test_a_mistake_in_a_step_names_the_file_and_the_remedy(copy, file, old, new, told):
    path = copy / "studies/example" / file
    assert old in path.read_text("utf-8")
    path.write_text(path.read_text("utf-8").replace(old, new), "utf-8")
    code, message = snakemake(copy, "studies/example/capacity.svg")
    assert code == 1
    assert told in message
