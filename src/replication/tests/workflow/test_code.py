"""The files that a script imports are found, and a job that loads another one fails."""

import subprocess
import sys
from pathlib import Path

import pytest

from replication.workflow.code import code, results_read, undeclared

ROOT = Path(__file__).parents[4]


@pytest.fixture
def tree(tmp_path):
    """A small repository: a lazy package, steps beside each other, a study."""
    files = {
        "src/lib/__init__.py": "import lazy_loader\n"
        "__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)\n",
        "src/lib/__init__.pyi": "from .shapes import Shape\nfrom .forces import force\n"
        "from .files import read\n",
        "src/lib/files/__init__.py": "from lib.files.text import read\n",
        "src/lib/files/text.py": "read = open\n",
        "src/lib/shapes.py": "import math\nShape = math.pi\n",
        "src/lib/forces.py": "from lib.shapes import Shape\nforce = Shape\n",
        "src/lib/inner/__init__.py": "def load():\n    from lib.inner import core\n\n\nload()\n",
        "src/lib/inner/core.py": "CORE = 1\n",
        "src/steps/shared.py": "import lib\nSHARED = lib.Shape\n",
        "studies/one/deep.py": "DEEP = 1\n",
    }
    for name, text in files.items():
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return tmp_path


def imported_by(tree, text, name="src/steps/step.py"):
    (tree / name).write_text(text)
    return [path for path in code(name, root=tree) if path != name]


LAZY = ["src/lib/__init__.py", "src/lib/__init__.pyi"]


def test_lazy_name_is_found_in_the_module_that_defines_it_and_no_other(tree):
    assert imported_by(tree, "from lib import Shape") == [*LAZY, "src/lib/shapes.py"]


def test_lazy_name_of_an_inner_package_is_found(tree):
    assert imported_by(tree, "from lib import read")[2:] == [
        "src/lib/files/__init__.py",
        "src/lib/files/text.py",
    ]


def test_script_itself_is_there_too(tree):
    assert code("src/lib/shapes.py", root=tree) == ["src/lib/shapes.py"]


def test_what_a_module_imports_is_found_too(tree):
    both = ["src/lib/forces.py", "src/lib/shapes.py"]
    assert imported_by(tree, "from lib.forces import force") == [*LAZY, *both]


def test_attribute_of_an_imported_package_counts_as_import(tree):
    assert imported_by(tree, "import lib as l\nprint(l.force)")[2:] == [
        "src/lib/forces.py",
        "src/lib/shapes.py",
    ]


def test_import_inside_a_function_is_found(tree):
    assert "src/lib/inner/core.py" in imported_by(tree, "def f():\n    import lib.inner")


def test_modules_of_folders_without_init_are_found(tree):
    text = "from steps.shared import SHARED\nfrom studies.one.deep import DEEP\n"
    found = imported_by(tree, text)
    assert {"src/steps/shared.py", "src/lib/shapes.py", "studies/one/deep.py"} <= set(found)


def test_import_for_types_alone_is_left_out(tree):
    text = "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    from lib import force\n"
    assert imported_by(tree, text) == []


def test_packages_from_elsewhere_are_left_out(tree):
    assert imported_by(tree, "import numpy as np\nfrom scipy.integrate import quad\n") == []


def test_code_of_a_notebook_is_read(tree):
    cell = '{"cells": [{"cell_type": "code", "source": ["%matplotlib inline\\n", "import lib\\n", '
    cell += '"lib.Shape"]}]}'
    assert imported_by(tree, cell, "src/steps/play.ipynb") == [*LAZY, "src/lib/shapes.py"]


def test_imports_of_a_snakefile_are_found(tree):
    text = "from lib import (\n    Shape,\n)\n\nrule all:\n    input: 'from lib import force'\n"
    assert imported_by(tree, text, "Snakefile")[2:] == ["src/lib/shapes.py"]
    assert imported_by(tree, "include: 'x'\nimport lib.forces\n", "more.smk")[2:] == [
        "src/lib/forces.py",
        "src/lib/shapes.py",
    ]


def test_import_of_a_name_that_is_only_known_later_is_refused(tree):
    with pytest.raises(ValueError, match=r"step\.py:2: .*only known when this runs"):
        imported_by(tree, "import importlib\nimportlib.import_module(name)\n")


def test_script_that_is_not_there_is_named(tree):
    with pytest.raises(FileNotFoundError, match=r"nosuch\.py"):
        code("src/steps/nosuch.py", root=tree)


SCRIPT = """
import sys
from replication.workflow.code import code, undeclared
sys.path[:0] = ["src", "src/steps", "."]
import shared
print(undeclared(code("src/steps/shared.py")))
print(undeclared(set(code("src/steps/shared.py")) - {"src/steps/shared.py"}))
import studies.one.deep
print(undeclared(code("src/steps/shared.py")))
"""


def test_module_that_was_loaded_and_not_declared_is_found(tree):
    pytest.importorskip("lazy_loader")
    done = subprocess.run(
        [sys.executable, "-c", SCRIPT], cwd=tree, capture_output=True, text=True, check=True
    )
    assert done.stdout.splitlines() == ["[]", "['src/steps/shared.py']", "['studies/one/deep.py']"]


def test_nothing_of_this_repository_is_undeclared_where_all_is_declared():
    assert "src/replication/workflow/code.py" in undeclared([], root=ROOT)
    everything = [str(path) for path in ROOT.glob("**/*.py")]
    assert undeclared(everything, root=ROOT) == []


def test_results_that_a_notebook_reads_are_found(tmp_path):
    notebook = tmp_path / "read.ipynb"
    notebook.write_text(
        '"pd.read_csv(\\"../results/tables/spectra.csv\\")", "results/tables/spectra.csv", '
        '"pd.read_json(\\"../results/findings/vase.json\\")", "results/report.html"'
    )
    assert results_read(notebook) == ["results/findings/vase.json", "results/tables/spectra.csv"]
