"""studies/FOLLOW-UP.md: every code block, literally and in order, in a copy of the repository."""

import re
import sys

import numpy as np
import pandas as pd
import pytest

from studies.example import capacity
from tests.copies import Edits, copied, run, snakemake

BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
PLACE = re.compile(r'^(?:#|//) (studies/\S+?)(, at its end|, (above|down to) the line "(.+)")?\n')
SECTION = """#import "/paper/format.typ": *
#include "/studies/bridge/section.typ"
"""
COMPILE = """import json, typst, yaml
from replication.claims import judged, read_claims, read_findings
from replication.numbers import Numbers
settings = yaml.safe_load(open("studies/bridge/config.yaml"))
claims = read_claims("studies/bridge/claims.yaml", settings)
found = read_findings(["results/findings/bridge_capacity.json"])
rows = [judged(claim, found) for claim in claims]
json.dump(rows, open("results/claims.json", "w"))
texts = {"config": "{}", "captions": "{}"}
typst.compile("section.typ", root=".", sys_inputs=texts)
html = typst.compile("section.typ", root=".", sys_inputs=texts | {"check": ""}, format="html")
print("without a source:", Numbers(html.decode()).without)
print({row["id"]: row["verdict"] for row in rows})
"""


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


@pytest.fixture(scope="module")
def copy(tmp_path_factory):
    return copied(tmp_path_factory.mktemp("study"))


def contents(folder):
    """The content of each file that the run did not write."""
    files = [path for path in folder.rglob("*") if path.is_file()]
    inside = [path.relative_to(folder) for path in files]
    return {
        path: (folder / path).read_bytes()
        for path in inside
        if path.parts[0] not in ("results", ".snakemake") and "__pycache__" not in path.parts
    }


def test_the_page_is_followed_literally(copy):
    before = contents(copy)
    blocks = BLOCK.findall((copy / "studies/FOLLOW-UP.md").read_text("utf-8"))
    kinds = ["sh", "yaml", "python", "yaml", "python", "typst", "sh", "sh"]
    assert [kind for kind, _ in blocks] == kinds
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
    assert "without a source: []" in told
    (copy / "section.typ").unlink()
    assert run(copy, "sh", "-e", "-c", remove[1])[0] == 0
    assert contents(copy) == before
    assert not list((copy / "results").glob("*/bridge_*"))


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ("el_centro", "el_cento", "there is no file data/records/el_cento"),
        (", column_mass: 60", "", "3 columns under a cap beam need column_mass"),
    ],
)
def test_a_mistake_is_named_before_any_job(copy, old, new, told):
    edits = Edits(copy)
    edits("studies/example/config.yaml", old, new)
    code, message = snakemake(copy, "--dry-run", "results/findings/example_capacity.json")
    edits.undo()
    assert code == 1
    assert told in message
    assert "studies/example/config.yaml" in message


def test_a_range_without_a_capacity_stops_the_step():
    factors = pd.Series(1.01 ** np.arange(100))
    with pytest.raises(SystemExit, match=r"no capacity up to a factor of 2.*: raise highest"):
        capacity.capacities(factors, factors > 3.0, [0.05], 0.9)
    found = capacity.capacities(factors, factors > 2.0, [0.05, 0.1], 0.9)
    assert found == pytest.approx(2.0, rel=0.02)
