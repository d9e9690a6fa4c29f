"""The lanes have one door: outside their folder, `kernel.grid` alone imports them."""

import re
from pathlib import Path

import topheavy.kernel

ROOT = Path(__file__).parents[3]
KERNEL = Path(topheavy.kernel.__file__).parent
INSIDE = re.compile(r"topheavy\.kernel\.lanes|topheavy\.kernel import .*\blanes\b")


def test_only_the_grid_imports_the_lanes():
    folders = ("src", "studies", "benchmarks", "figures", "notebooks", "tests")
    files = [path for folder in folders for path in (ROOT / folder).rglob("*.py")]
    files += ROOT.rglob("notebooks/*.ipynb")
    users = {path for path in files if INSIDE.search(path.read_text(encoding="utf-8"))}
    rooms = (KERNEL / "lanes", Path(__file__).parent)
    outside = {path for path in users if not any(path.is_relative_to(room) for room in rooms)}
    assert outside == {KERNEL / "grid.py"}
