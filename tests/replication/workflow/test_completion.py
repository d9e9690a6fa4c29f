"""A rule says only what is special about it: the rest follows from its script."""

import pytest
from snakemake.exceptions import WorkflowError

from replication.workflow.provenance import makers, workflow_jobs

SNAKEFILE = """\
from replication.workflow.completion import complete, findings_made

rule all:
    input:
        "results/plain.csv",
        expand("results/{n}_each.json", n=["a", "b"]),

rule plain:
    output:
        "results/plain.csv",
    script:
        "steps/plain.py"

rule each:
    input:
        data="data.txt",
    output:
        findings="results/{n}_each.json",
    wildcard_constraints:
        n="a|b",
    script:
        "steps/{wildcards.n}.py"

rule logged:
    input:
        "steps/plain.py",
    output:
        "results/logged.csv",
    log:
        "own/place.log",
    script:
        "steps/plain.py"
"""


@pytest.fixture
def made(tmp_path, plant, monkeypatch):
    """The job that makes each output, of a small workflow with an ending."""
    monkeypatch.chdir(tmp_path)
    plain = '"""Draw {a} line.\n\nTwice."""\nimport steps.used'
    steps = {"steps/plain.py": plain, **{f"steps/{name}.py": "" for name in ("used", "a", "b")}}
    plant(tmp_path, steps | {"data.txt": "1"})

    def read(ending="\ncomplete(workflow)\n"):
        (tmp_path / "Snakefile").write_text(SNAKEFILE + ending)
        return makers(workflow_jobs(tmp_path, targets=["all", "logged"]))

    return read


def test_script_and_its_modules_are_inputs_and_log_and_benchmark_have_the_name_of_the_rule(made):
    job = made()["results/plain.csv"]
    assert sorted(job.inputs) == ["steps/plain.py", "steps/used.py"]
    assert job.logs == ("results/logs/plain.log", "results/benchmarks/plain.tsv")


def test_script_with_a_wildcard_is_an_input_of_its_own_job(made):
    jobs = made()
    for name in "ab":
        job = jobs[f"results/{name}_each.json"]
        assert job.inputs == ("data.txt", f"steps/{name}.py")
        logs = f"results/logs/each_{name}.log", f"results/benchmarks/each_{name}.tsv"
        assert job.logs == logs


def test_rule_without_a_script_is_refused(made):
    shell = '\nrule shell:\n    output:\n        "out.txt"\n    shell:\n        "touch {output}"\n'
    with pytest.raises((ValueError, WorkflowError), match=r"rule shell makes out\.txt without a s"):
        made(f"{shell}\ncomplete(workflow)\n")
