"""What the jobs of a run cost, which of them are a rule's, and the longest way to the end."""

from replication.rules.costs import main
from replication.workflow.costs import paths
from replication.workflow.internals import planned, timed_by

SNAKEFILE = """
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
    files = {"Snakefile": SNAKEFILE, "sum.py": "", "map.py": "", "last.py": ""}
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
