"""The page of the figures: what draws and computes each, and what it costs."""

from dataclasses import replace

import pytest

from replication.pages.exhibits import exhibits_page, measured
from replication.workflow.costs import read_costs
from replication.workflow.provenance import Job, makers

JOB = Job("peaks", "Snakefile:1", (), (), (), (), (), {}, None, {}, False)
JOBS = [
    replace(JOB, outputs=("shards/1.csv",), logs=("l.log", "b/shard_1-of-2.tsv")),
    replace(JOB, outputs=("shards/2.csv",), logs=("l.log", "b/shard_2-of-2.tsv")),
    replace(
        JOB,
        scripts=("src/peaks.py",),
        inputs=("shards/1.csv", "shards/2.csv", "data/a.txt"),
        outputs=("results/tables/peaks.csv",),
        logs=("b/peaks.tsv",),
    ),
    replace(
        JOB,
        scripts=("figures/peaks.py",),
        inputs=("results/tables/peaks.csv", "figures/style"),
        outputs=("figures/peaks.svg",),
    ),
    replace(JOB, outputs=("results/other.csv",), logs=("b/other.tsv",)),
]
COSTS = (
    "rule,seconds,memory_mb\nshard_1-of-2,10,200\nshard_2-of-2,20,300\npeaks,1.4,100\nother,9,9\n"
)


@pytest.fixture
def costs(tmp_path):
    (tmp_path / "costs.csv").write_text(COSTS, encoding="utf-8")
    return read_costs(tmp_path / "costs.csv")


def test_cost_is_that_of_all_jobs_that_the_figure_needs(costs):
    captions, numbers = {"figures/peaks.svg": {"title": "Peaks |θ|"}}, {"figures/peaks.svg": "S2"}
    page = exhibits_page(JOBS, captions, costs, numbers)
    assert page.splitlines()[-1] == (
        r"| S2 | Peaks \|θ\| | `figures/peaks.py` | `peaks.csv` | `src/peaks.py` | 31 | 300 |"
    )


def test_job_is_counted_once_and_no_other_job_is():
    names = measured("figures/peaks.svg", makers(JOBS))
    assert sorted(names) == ["peaks", "shard_1-of-2", "shard_2-of-2"]


def test_cost_that_was_not_measured_is_left_open():
    page = exhibits_page(JOBS, {"figures/peaks.svg": {"title": "Peaks"}}, {}, {})
    assert page.endswith("| `src/peaks.py` |  |  |\n")
