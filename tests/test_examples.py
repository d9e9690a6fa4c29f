"""The example in the docstring of each public name."""

import doctest
import inspect

import numpy as np
import pytest

import topheavy as th
from tests.cases import ROOT

PUBLIC = {name: getattr(th, name) for name in dir(th) if not name.startswith("_")}
EXPLAINED = [name for name, x in PUBLIC.items() if inspect.isroutine(x) or inspect.isclass(x)]


@pytest.mark.parametrize("name", EXPLAINED)
def test_example_gives_what_it_says(name, tmp_path, monkeypatch):
    (tmp_path / "data").symlink_to(ROOT / "data")
    monkeypatch.chdir(tmp_path)
    finder = doctest.DocTestFinder(recurse=False)
    (example,) = finder.find(PUBLIC[name], name, globs={"th": th, "np": np})
    found = doctest.DocTestRunner().run(example)
    assert found.attempted > 0
    assert found.failed == 0


def test_front_door_is_what_help_shows():
    assert th.__all__[0] == "Column"
    assert {*th.__all__} < {*PUBLIC}
    assert len(th.__all__) == 13
    for name in th.__all__:
        assert f"`{name}`" in th.__doc__
