"""A run prints one line for each job, and the whole log of one that failed."""

import re

import pytest

SNAKEFILE = """
from replication.workflow.progress import one_line_a_job
one_line_a_job()
rule all:
    input: "a.txt", "b.txt"
rule write:
    output: "{name}.txt"
    log: "{name}.log"
    message: "Writing {wildcards.name}"
    shell: "echo told >{log}; test {wildcards.name} != WRONG && touch {output}"
"""


@pytest.fixture
def told(tmp_path, ran):
    def run(wrong):
        (tmp_path / "Snakefile").write_text(SNAKEFILE.replace("WRONG", wrong))
        return ran("--scheduler=greedy", "--show-failed-logs")

    return run


def test_each_job_has_one_line_with_its_share_and_time(told):
    _, said = told("nobody")
    lines = re.findall(r"^ +(\d) of 3 +\d+\.\d s  (.*)$", said, flags=re.MULTILINE)
    assert [number for number, _ in lines] == ["1", "2", "3"]
    assert {name for _, name in lines} == {"Writing a", "Writing b", "all"}
    assert not re.search("Select jobs|Execute 1|Finished jobid", said)
