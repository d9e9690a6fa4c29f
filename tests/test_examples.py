"""Each public name has an example, and each example of the library is true."""

import doctest
import importlib
import inspect
import pkgutil

import matplotlib.pyplot as plt
import numpy as np
import pytest

import topheavy as th
from tests.cases import ROOT

MODULES = [module.name for module in pkgutil.walk_packages(th.__path__, "topheavy.")]
PUBLIC = [
    name
    for name in th.__all__
    if inspect.isfunction(getattr(th, name)) or inspect.isclass(getattr(th, name))
]


@pytest.mark.parametrize("name", MODULES)
def test_examples_are_true(name, tmp_path, monkeypatch):
    (tmp_path / "data").symlink_to(ROOT / "data")  # they read data/records, and write files
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MPLBACKEND", "agg")
    results = doctest.testmod(importlib.import_module(name), extraglobs={"th": th, "np": np})
    plt.close("all")
    assert results.failed == 0


@pytest.mark.parametrize("name", PUBLIC)
def test_public_name_has_an_example(name):
    assert ">>> " in inspect.getdoc(getattr(th, name))


@pytest.mark.parametrize("package", [th, th.plot])
def test_names_are_one_list(package):
    assert dir(package) == sorted(package.__all__)
    assert all(hasattr(package, name) for name in package.__all__)
