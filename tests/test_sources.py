"""What a rule depends on is read from the imports of its script."""

import json

import numpy as np
import pytest

from replication.sources import imported, versions
from tests.cases import ROOT

PULSES = "src/topheavy/ground/pulses.py"


@pytest.mark.parametrize(
    "text",
    [
        "import topheavy.ground.pulses",
        "from topheavy.ground import pulses",
        "from topheavy import Pulse",
        "import topheavy as th\nth.Pulse",
        "def compute():\n    from topheavy import Pulse",
    ],
)
def test_modules_are_those_that_a_script_imports_at_once_or_lazily(tmp_path, monkeypatch, text):
    monkeypatch.chdir(ROOT)
    notebook = {"cells": [{"cell_type": "code", "source": text.splitlines(keepends=True)}]}
    for name, content in (("script.py", text), ("book.ipynb", json.dumps(notebook))):
        (tmp_path / name).write_text(content, "utf-8")
        modules = imported(str(tmp_path / name))
        assert {PULSES, "src/topheavy/ground/shapes.py"} <= modules
        assert "src/topheavy/risk/curve.py" not in modules


def test_versions_are_those_of_the_packages_that_modules_import(monkeypatch):
    monkeypatch.chdir(ROOT)
    packages = versions(imported("src/steps/beyond/engine.py"))
    assert {"python", "numba", "scipy", "mujoco"} <= set(packages)
    assert packages["numpy"] == np.__version__
    assert "typst" in versions(["src/documents/typeset.py"])
    assert "not installed" not in packages.values()
