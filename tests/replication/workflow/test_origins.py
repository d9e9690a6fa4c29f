"""What a result depends on: it fails when Snakemake drops what `origins` calls of its rules."""

import json

import pytest

from tests.replication.begun import Run

SNAKEFILE = """
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
    files = {"Snakefile": SNAKEFILE, "data/one.csv": "1", "data/two.csv": "2", "step.py": "pass"}
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
