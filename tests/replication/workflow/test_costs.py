"""What the jobs of a published run cost, and what follows from it."""

from replication.workflow.costs import longest_jobs, read_costs


def test_rule_takes_as_long_as_its_longest_shard(tmp_path):
    table = tmp_path / "costs.csv"
    table.write_text("rule,seconds,memory_mb\nmap_1-of-2,3.5,9\nmap_2-of-2,4.5,9\nsum,0.2,9\n")
    assert longest_jobs(table) == {"map": 4.5, "sum": 0.2}


def test_no_edition_is_published_yet(tmp_path):
    assert read_costs(tmp_path / "costs.csv") == {}
    assert longest_jobs(tmp_path / "costs.csv") == {}
