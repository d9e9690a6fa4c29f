"""A copy of the tree, in which commands run without a trace in the tree itself."""

import os
import shutil
import signal
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
LONGEST = 900.0
"""s: a command that takes longer hangs."""


def copy_tree(to: Path) -> None:
    """Copy what git tracks or would track; of a source archive, all but what the run makes."""
    listed = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
        cwd=ROOT,
        capture_output=True,
        check=False,
    )
    if listed.returncode != 0:
        own = shutil.ignore_patterns(".*", "results", "__pycache__", "*.svg", "*.pdf")
        shutil.copytree(ROOT, to, ignore=own, dirs_exist_ok=True)
        shutil.copytree(ROOT / "docs", to / "docs", dirs_exist_ok=True)
        return
    for name in listed.stdout.decode().split("\0"):
        if (ROOT / name).is_file():
            (to / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, to / name)


def run(tree: Path, *command: str) -> tuple[int, str]:
    """Run Python in a tree with the tree's own packages; return its code and all that it said.

    Compiled code of a kernel with a fault is kept beside the tree, not in the user's cache.
    """
    path, cache = os.pathsep.join([str(tree / "src"), str(tree)]), tree.parent / "machine_code"
    with subprocess.Popen(
        [sys.executable, *command],
        cwd=tree,
        env=os.environ | {"PYTHONPATH": path, "NUMBA_CACHE_DIR": str(cache)},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        start_new_session=True,
    ) as process:
        try:
            said, _ = process.communicate(timeout=LONGEST)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            said, _ = process.communicate()
            said += f"\ngiven up after {LONGEST:g} s"
    return process.returncode, said
