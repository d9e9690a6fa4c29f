"""What all tests share: the parsed workflow, and the order in which several processes take them."""

from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]

LONGEST_FIRST = (
    "test_reruns.py",
    "test_graph.py",
    "test_closing.py",
    "test_page.py",
    "test_solver.py",
    "test_endings.py",
    "test_trace.py",
    "test_check_html.py",
    "test_simulate.py",
)
"""Files that take longest: begun first, no process is left with one of them at the end."""


def pytest_collection_modifyitems(items):
    """Put the files that take longest before the others."""
    place = {name: number for number, name in enumerate(LONGEST_FIRST)}
    items.sort(key=lambda item: place.get(item.path.name, len(place)))


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_setupnodes():
    """Compile the kernel before several processes need it at the same time."""
    from steps.kernel import main

    main()


@pytest.fixture(scope="session")
def jobs():
    """Every job of the workflow, by Snakemake's own reading of the Snakefile."""
    from replication.workflow.provenance import workflow_jobs

    return workflow_jobs(ROOT)


@pytest.fixture(scope="session")
def claims(jobs):
    """The rows of the ledger, from whatever files the Snakefile takes them."""
    return [job.params["claim"] for job in jobs if "claim" in job.params]
