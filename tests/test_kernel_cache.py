"""Compiled code is kept for the very state of the source that it was compiled from.

numba looks at the file of a function alone: without a cache of each state, a change in another
file that the function calls would go unnoticed.
"""

import importlib
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import numba
import pytest
from numba.extending import is_jitted

import topheavy.kernel

PACKAGE = Path(topheavy.kernel.__file__).parents[1]
KERNEL = PACKAGE / "kernel"
MODULES = {
    ".".join(path.relative_to(PACKAGE).with_suffix("").parts): path
    for path in KERNEL.rglob("[a-z]*.py")
}

#: Whether bounces of 1e-6 rest 0.1 before the ground passes the uplift level; `rest` asks
#: `forcing` for the ground.
ASK = """
import json, math, topheavy.kernel
from numba import config
from topheavy import RockingBlock
from topheavy.kernel.forcing import NO_RECORD, ONE_SINE, Forcing
from topheavy.kernel.rest import comes_to_rest
from topheavy.kernel.taylor import oscillator
block = oscillator(RockingBlock(2.0, 0.2, 0.9))
pulse = Forcing(ONE_SINE, 2 * block.level, 1.0, 6.0, 1.0)
time = math.asin(0.5) - 0.1
push = -2 * block.level * math.sin(time) - block.level
rests = comes_to_rest(block, pulse, NO_RECORD, time, 1e-6, push, 1.0, 1.0)
print(json.dumps([
    topheavy.kernel.__file__, bool(rests), config.CACHE_DIR,
    sum(comes_to_rest.stats.cache_hits.values()),
]))
"""


def ask(home: Path, cache: str = "") -> tuple[bool, int]:
    """Import the package of `home` in a process of its own: its answer, and what it had cached."""
    environment = {key: value for key, value in os.environ.items() if "NUMBA" not in key}
    given = {"NUMBA_CACHE_DIR": cache} if cache else {}
    done = subprocess.run(
        [sys.executable, "-c", ASK],
        env=environment | given | {"PYTHONPATH": str(home)},
        cwd=home,
        capture_output=True,
        text=True,
        check=True,
    )
    where, rests, cache_dir, hits = json.loads(done.stdout)
    assert Path(where).is_relative_to(home)
    assert cache_dir == cache  # other code that numba compiles keeps its own cache
    return rests, hits


@pytest.fixture
def copy(tmp_path):
    shutil.copytree(
        PACKAGE, tmp_path / "topheavy", ignore=shutil.ignore_patterns("__pycache__", "derivation")
    )
    return tmp_path


@pytest.mark.parametrize("folder", ["", "of_this_node"])
def test_change_of_what_a_compiled_function_calls_is_noticed(copy, folder):
    cache = str(copy / folder) if folder else ""
    assert ask(copy, cache) == (True, 0)
    assert ask(copy, cache) == (True, 1)  # compiled once
    beside = copy / "topheavy" / "kernel" / "__pycache__"
    assert any(beside.rglob("*.nbi")) == (not folder)
    assert any((copy / "of_this_node").rglob("*.nbi")) == bool(folder)

    forcing = copy / "topheavy" / "kernel" / "forcing.py"
    source = forcing.read_text(encoding="utf-8")
    there = "return forcing.amplitude * value, forcing.amplitude * forcing.frequency * rate"
    assert source.count(there) == 1
    changed = source.replace(there, there.replace("amplitude * value", "amplitude * 2 * value"))
    forcing.write_text(changed, encoding="utf-8")
    assert ask(copy, cache) == (False, 0)


def test_change_of_the_list_of_shapes_is_noticed(copy):
    """Its lengths are constants in the machine code."""
    assert ask(copy) == (True, 0)
    shapes = copy / "topheavy" / "shapes.py"
    shapes.write_text(shapes.read_text(encoding="utf-8") + "\n", encoding="utf-8")
    assert ask(copy) == (True, 0)


def test_every_kernel_module_is_loaded_with_the_cache():
    program = "import sys, topheavy.kernel; print(*sys.modules)"
    found = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True
    )
    loaded = {name.removeprefix("topheavy.") for name in found.stdout.split()}
    assert {"kernel.grid", "kernel.lanes.steps"} <= MODULES.keys() <= loaded
    assert os.environ.get("NUMBA_CACHE_DIR", "") == numba.config.CACHE_DIR


def test_what_a_function_is_compiled_with_is_its_own():
    """numba hands down what a function leaves open, from whichever function calls it first."""
    modules = [importlib.import_module(f"topheavy.{name}") for name in sorted(MODULES)]
    functions = {f for module in modules for f in vars(module).values() if is_jitted(f)}
    assert len(functions) > 60
    handed_down = {"fastmath", "error_model", "forceinline"}  # numba.core.cpu: inherit_if_not_set
    lacking = {f.__name__ for f in functions if not handed_down <= set(f.targetoptions)}
    assert lacking == set()
