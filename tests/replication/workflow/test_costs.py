"""What the jobs of a published run cost, and which of them are a rule's."""

from replication.workflow.costs import read_costs
from replication.workflow.internals import planned, timed_by

SNAKEFILE = """
from replication.workflow.completion import complete
rule all:
    input: "out/sum_1-of-2.csv", "out/map_wide.csv"
rule sum:
    output: "out/sum_{part}.csv"
    script: "sum.py"
rule map:
    output: "out/map_{kind}.csv"
    benchmark: "results/benchmarks/map_{kind}.tsv"
    wildcard_constraints: kind="wide|fine"
    script: "map.py"
complete(workflow)
"""


def test_costs_are_by_job_and_there_are_none_before_the_first_edition(tmp_path):
    table = tmp_path / "costs.csv"
    assert read_costs(table) == {}
    table.write_text("rule,seconds,memory_mb\nmap,1.5,100\nsum,0.2,50.5\n")
    assert read_costs(table) == {"map": (1.5, 100.0), "sum": (0.2, 50.5)}


def test_job_of_a_rule_with_wildcards_is_known_by_its_benchmark(tmp_path, plant, monkeypatch):
    files = {"Snakefile": SNAKEFILE, "sum.py": "", "map.py": ""}
    monkeypatch.chdir(plant(tmp_path, files))
    names = ["sum_1-of-2", "sum_2-of-2", "map_wide", "map_wild", "mapping"]
    with planned(tmp_path, {}, ["all"], ["input"]) as workflow:
        found = {rule.name: timed_by(rule, names) for rule in workflow.rules}
    assert found == {"all": [], "sum": ["sum_1-of-2", "sum_2-of-2"], "map": ["map_wide"]}
