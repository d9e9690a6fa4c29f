"""Where results come from, and what they cost."""

import json
import subprocess
import sys
from dataclasses import replace

import pytest

from replication.rules.costs import main
from replication.workflow import provenance
from replication.workflow.costs import paths
from replication.workflow.internals import planned, timed_by
from replication.workflow.provenance import note_jobs, noted_jobs, source_version, workflow_jobs
from tests.replication.begun import Run

SNAKEFILE = """\
configfile: "config.yaml"

rule all:
    input:
        "out/sum.txt",

rule copy:
    input:
        "in/{name}.txt",
    output:
        "out/{name}.copy",
    log:
        "logs/{name}.log",
    script:
        "scripts/{wildcards.name}.py"

rule sum:
    input:
        "out/a.copy",
    output:
        findings="out/sum.txt",
    params:
        factor=config["factor"],
    shell:
        "cat {input} > {output}"
"""


@pytest.fixture(scope="module")
def tree(tmp_path_factory, plant):
    """The small workflow, run once."""
    copy = "import shutil\nshutil.copyfile(snakemake.input[0], snakemake.output[0])\n"
    files = {"Snakefile": SNAKEFILE, "config.yaml": "factor: 2\n", "in/a.txt": "1\n"}
    root = plant(tmp_path_factory.mktemp("workflow"), files | {"scripts/a.py": copy})
    before = workflow_jobs(root)
    command = [sys.executable, "-m", "snakemake", "--cores=1", "--scheduler=greedy", "--quiet=all"]
    subprocess.run(command, cwd=root, check=True, capture_output=True)
    return root, before


def test_jobs_are_known_before_they_ran(tree, monkeypatch, tmp_path):
    root, before = tree
    assert {job.rule for job in before} == {"all", "copy", "sum"}
    assert all(job.pending for job in before)
    monkeypatch.chdir(tmp_path)
    workflow_jobs(root)
    assert list(tmp_path.iterdir()) == []
    assert tmp_path.cwd() == tmp_path


def test_run_notes_its_jobs(tree, monkeypatch):
    root, before = tree
    monkeypatch.chdir(root)
    monkeypatch.setenv(provenance.NOTED, "")
    assert noted_jobs() == []
    with planned(root, {}, None, ["input"]) as workflow:
        note_jobs(workflow)
    expected = {job.outputs: replace(job, params={}, pending=False) for job in before}
    assert {job.outputs: replace(job, pending=False) for job in noted_jobs()} == expected


def test_version_is_the_commit_and_whether_the_tree_differs(tmp_path):
    def git(*words):
        who = ["-c", "user.name=x", "-c", "user.email=x@x.org", "-c", "commit.gpgsign=false"]
        command = ["git", "-C", tmp_path, *who, *words]
        return subprocess.run(command, check=True, capture_output=True, text=True).stdout.strip()

    assert source_version(tmp_path) == ""
    git("init", "-q")
    (tmp_path / "archive").mkdir()
    assert source_version(tmp_path / "archive") == ""  # another repository is above it
    (tmp_path / "file").write_text("1")
    git("add", "file")
    git("commit", "-q", "-m", "first")
    commit = git("rev-parse", "HEAD")
    assert source_version(tmp_path) == commit
    (tmp_path / "file").write_text("2")
    assert source_version(tmp_path) == f"{commit}-dirty"


PUBLISHING = """
import json
from replication.workflow.origins import Origins
numbers = json.loads(open("numbers.json").read())
scattergather:
    parts=2
rule part:
    output: "results/parts/{scatteritem}.csv"
    params: numbers["part"]
rule whole:
    input: gather.parts("results/parts/{scatteritem}.csv"), "step.py"
    output: table="results/tables/whole.csv"
rule kind:
    input: lambda wildcards: [f"data/{wildcards.kind}.csv"], "results/tables/whole.csv"
    output: "results/tables/{kind}.csv"
    wildcard_constraints: kind="one|two"
    params: number=lambda wildcards: numbers[wildcards.kind]
origins = Origins(workflow.rules)
names = ("whole", "one", "two", "none")
print("FOUND", json.dumps([origins.of(f"results/tables/{name}.csv") for name in names]))
"""


NUMBERS = {"part": 1, "one": 2, "two": 3}


@pytest.fixture
def found(plant, tmp_path):
    files = {"Snakefile": PUBLISHING, "data/one.csv": "1", "data/two.csv": "2", "step.py": "pass"}
    plant(tmp_path, files)

    def ask(numbers=NUMBERS, **others):
        plant(tmp_path, {"numbers.json": json.dumps(numbers), **others})
        said = Run(tmp_path, "--list-rules", "--quiet").communicate()[1]
        (line,) = [line for line in said.splitlines() if line.startswith("FOUND")]
        return json.loads(line.removeprefix("FOUND"))

    return ask


def test_result_depends_on_parameters_and_inputs_of_its_job_and_of_those_upstream(found):
    whole, one, two, none = before = found()
    assert [list(each) for each in (whole, one, two)] == [
        ["part", "whole"],
        ["part", "whole", "kind_one"],
        ["part", "whole", "kind_two"],
    ]
    assert none == {}

    def changed(**change):
        after = found(NUMBERS | change.get("numbers", {}), **change.get("files", {}))
        return [
            [job for job in each if each[job] != old[job]]
            for old, each in zip(before, after, strict=True)
        ]

    assert changed() == [[], [], [], []]
    assert changed(numbers={"part": 9}) == [["part"]] * 3 + [[]]
    assert changed(numbers={"one": 9}) == [[], ["kind_one"], [], []]
    assert changed(files={"data/two.csv": "3"}) == [[], [], ["kind_two"], []]
    assert changed(files={"data/two.csv": "2", "step.py": "1"}) == [[], [], [], []]


TIMED = """
from replication.workflow.completion import complete
rule all:
    input: "results/sum_1-of-2.csv", "results/last.csv"
rule sum:
    output: "results/sum_{part}.csv"
    script: "sum.py"
rule map:
    output: "results/map_{kind}.csv"
    benchmark: "results/benchmarks/map_{kind}.tsv"
    wildcard_constraints: kind="wide|fine"
    script: "map.py"
rule last:
    input: "results/map_wide.csv", "results/sum_1-of-2.csv"
    output: "results/last.csv"
    script: "last.py"
complete(workflow)
"""


def test_job_of_a_rule_with_wildcards_is_known_by_its_benchmark(tmp_path, plant, monkeypatch):
    files = {"Snakefile": TIMED, "sum.py": "", "map.py": "", "last.py": ""}
    monkeypatch.chdir(plant(tmp_path, files))
    names = ["sum_1-of-2", "sum_2-of-2", "map_wide", "map_wild", "mapping"]
    with planned(tmp_path, {}, ["all"], ["input"]) as workflow:
        found = {rule.name: timed_by(rule, names) for rule in workflow.rules}
        took = {"sum_1-of-2": (4.0, 1.0), "sum_2-of-2": (3.0, 1.0), "map_wide": (2.0, 1.0)}
        took |= {"last": (5.0, 1.0)}
        left = {rule.name: seconds for rule, seconds in paths(workflow.rules, took)}
    jobs = {"sum": ["sum_1-of-2", "sum_2-of-2"], "map": ["map_wide"]}
    assert found == jobs | {"all": [], "last": []}
    assert left == {"all": 0.0, "last": 5.0, "sum": 9.0, "map": 7.0}


def test_cost_of_a_job_is_of_its_benchmark_and_its_log(tmp_path):
    benchmarks = [tmp_path / "map.tsv", tmp_path / "sum.tsv"]
    for path, seconds in zip(benchmarks, (1.5, 7.0), strict=True):
        path.write_text(f"s\tmax_rss\n{seconds}\t9.9\n")
        path.with_suffix(".log").write_text(f"its words\npeak memory: {2 * seconds} MB\n")
    left = tmp_path / "old.tsv"
    left.write_text("s\n3.0\n")
    left.with_suffix(".log").write_text("of an earlier version\n")
    begun = tmp_path / "begun.tsv"  # beside this one: its log is not there yet
    begun.write_text("s\n4.0\n")
    costs = main([*benchmarks, left, begun], tmp_path)
    assert costs.to_dict("list") == {
        "rule": ["sum", "map"],
        "seconds": [7.0, 1.5],
        "memory_mb": [14.0, 3.0],
    }
