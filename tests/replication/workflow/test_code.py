"""The files that a script imports are found, and a job that loads another one fails."""

import subprocess
import sys
from pathlib import Path

import pytest

from replication.workflow.code import code, undeclared

ROOT = Path(__file__).parents[3]


@pytest.fixture
def tree(tmp_path, plant):
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
    return plant(tmp_path, files)


def imported_by(tree, text, name="src/steps/step.py"):
    (tree / name).write_text(text)
    return [path for path in code(name, root=tree) if path != name]


LAZY = ["src/lib/__init__.py", "src/lib/__init__.pyi"]


SHAPES = [*LAZY, "src/lib/shapes.py"]
FORCES = [*LAZY, "src/lib/forces.py", "src/lib/shapes.py"]
FILES = [*LAZY, "src/lib/files/__init__.py", "src/lib/files/text.py"]
INNER = [*LAZY, "src/lib/inner/__init__.py", "src/lib/inner/core.py"]
NO_PACKAGES = "from steps.shared import SHARED\nfrom studies.one.deep import DEEP\n"
FOR_TYPES = "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    from lib import force\n"
CELL = """{"cells": [{"cell_type": "code",
"source": ["%matplotlib inline\\n", "import lib\\n", "lib.Shape"]}]}"""
ALL = "from lib import (\n    Shape,\n)\n\nrule all:\n    input: 'from lib import force'\n"


@pytest.mark.parametrize(
    ("name", "text", "found"),
    [
        ("step.py", "from lib import Shape", SHAPES),
        ("step.py", "from lib import read", FILES),
        ("step.py", "from lib.forces import force", FORCES),
        ("step.py", "import lib as l\nprint(l.force)", FORCES),
        ("step.py", "def f():\n    import lib.inner", INNER),
        ("step.py", NO_PACKAGES, [*SHAPES, "src/steps/shared.py", "studies/one/deep.py"]),
        ("step.py", FOR_TYPES, []),
        ("step.py", "import numpy as np\nfrom scipy.integrate import quad\n", []),
        ("play.ipynb", CELL, SHAPES),
        ("Snakefile", ALL, SHAPES),
        ("more.smk", "include: 'x'\nimport lib.forces\n", FORCES),
    ],
)
def test_modules_of_the_repository_that_a_file_imports_are_found(tree, name, text, found):
    assert imported_by(tree, text, f"src/steps/{name}") == found


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
