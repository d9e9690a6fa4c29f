"""What all tests share."""

import random
from itertools import groupby

import pytest


def pytest_addoption(parser):
    parser.addoption("--night", action="store_true", help="all cases, in place of a sample of some")


def pytest_collection_modifyitems(config, items):
    """Leave, of the cases of a test that is `sampled`, as many as it says: always the same."""
    if config.getoption("night"):
        return
    left = set()
    for _, cases in groupby(items, lambda item: item.nodeid.partition("[")[0]):
        cases = list(cases)
        mark = cases[0].get_closest_marker("sampled")
        if mark and len(cases) > mark.args[0]:
            left |= {*cases} - {*random.Random(7).sample(cases, mark.args[0])}
    config.hook.pytest_deselected(items=[item for item in items if item in left])
    items[:] = [item for item in items if item not in left]


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_setupnodes():
    """Compile the kernel before several processes need it at the same time."""
    from steps.kernel import compute

    compute()
