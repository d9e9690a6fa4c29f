"""The page of the figures: what draws and computes each, and what it costs."""

from functools import reduce
from itertools import permutations
from operator import add

from replication.pages import exhibits
from replication.pages.exhibits import exhibits_page
from replication.workflow.provenance import Job

JOBS = [
    Job("peaks", outputs=("shards/1.csv",), logs=("l.log", "b/shard_1-of-2.tsv")),
    Job("peaks", outputs=("shards/2.csv",), logs=("l.log", "b/shard_2-of-2.tsv")),
    Job(
        "peaks",
        scripts=("src/peaks.py",),
        inputs=("shards/1.csv", "shards/2.csv", "data/a.txt"),
        outputs=("results/tables/peaks.csv",),
        logs=("b/peaks.tsv",),
    ),
    Job(
        "peaks",
        scripts=("figures/peaks.py",),
        inputs=("results/tables/peaks.csv", "figures/style"),
        outputs=("figures/peaks.svg",),
    ),
    Job("peaks", outputs=("results/other.csv",), logs=("b/other.tsv",)),
]


def test_cost_that_was_not_measured_is_left_open():
    page = exhibits_page(JOBS, {"figures/peaks.svg": {"title": "Peaks"}}, {}, {})
    assert page.endswith("(../src/peaks.py) |  |  |\n")


def test_figures_stand_in_their_order():
    captions = {path: {"title": path} for path in "ecadb"}
    jobs = [Job("draw", outputs=(path,)) for path in captions]
    numbers = {"d": "2", "a": "10", "c": "S2", "gone": "S3", "b": "S10"}  # of the last edition
    page = exhibits_page(jobs, captions, {}, numbers)
    assert [row.split(" | ")[1] for row in page.splitlines()[-5:]] == ["d", "a", "c", "b", "e"]


def test_cost_does_not_depend_on_the_order_of_the_jobs(monkeypatch):
    costs = {"a": (0.1, 1), "b": (0.2, 1), "c": (0.5, 1), "d": (0.7, 1)}
    sums = {reduce(add, (costs[name][0] for name in order)) for order in permutations(costs)}
    assert {f"{each:.0f}" for each in sums} == {"1", "2"}  # sum() is exact from Python 3.12 on
    pages = set()
    for order in permutations(costs):
        monkeypatch.setattr(exhibits, "_measured", lambda *given, order=order: order)
        pages.add(exhibits_page(JOBS, {"figures/peaks.svg": {"title": "Peaks"}}, costs, {}))
    (page,) = pages
    assert page.endswith("(../src/peaks.py) | 2 | 1 |\n")
