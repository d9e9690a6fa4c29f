"""What all tests share: the order in which several processes take them."""

import gc
import os
from types import SimpleNamespace

import pytest

from tests.replication.conftest import claims, jobs, plant  # noqa: F401

os.environ.pop("RELEASE", None)  # of `RELEASE=1 make test`: each test sets what it is about

LONGEST_FIRST = (
    "test_graph.py",
    "test_verdicts.py",
    "test_compiled.py",
    "test_forks.py",
    "test_reruns.py",
    "test_page.py",
    "test_forged.py",
    "test_run.py",
    "test_recheck.py",
    "test_documents.py",
    "test_shown.py",
    "test_odd_input.py",
    "test_forces.py",
    "test_solver.py",
    "test_state.py",
    "test_extensions.py",
    "test_histories.py",
    "test_types.py",
    "test_resampling.py",
    "test_shaking.py",
)
"""Files that take longest: begun first, no process is left with one of them at the end."""


@pytest.hookimpl(wrapper=True)
def pytest_collection():
    """Look for no garbage while tests are collected, and not among them later."""
    gc.disable()
    try:
        return (yield)
    finally:
        gc.freeze()
        gc.set_threshold(50_000, 20, 50)  # seldom: SymPy and SciPy make many objects that stay
        gc.enable()


def pytest_collection_modifyitems(items):
    """Put the files that take longest before the others."""
    place = {name: number for number, name in enumerate(LONGEST_FIRST)}
    items.sort(key=lambda item: place.get(item.path.name, len(place)))


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_setupnodes():
    """Compile the kernel before several processes need it at the same time."""
    from steps.kernel import main

    main()


@pytest.fixture
def given(monkeypatch):
    """Let names of a module stand for what is given: a function, or what a function returns."""

    def let(module, **found):
        for name, one in found.items():
            is_stub = callable(one) or isinstance(one, SimpleNamespace)
            monkeypatch.setattr(module, name, one if is_stub else lambda *_, one=one, **__: one)

    return let
