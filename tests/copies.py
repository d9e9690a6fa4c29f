"""A copy of the repository, in which tests run Snakemake and change files."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

from tests.cases import ROOT

SKIPPED = (".*", "docs", "results", "reference", "__pycache__", "*.svg", "*.pdf", "dist")


def copied(folder: Path) -> Path:
    """Copy what a run needs into a folder whose name has a space."""
    tree = folder / "a copy"
    shutil.copytree(ROOT, tree, ignore=shutil.ignore_patterns(*SKIPPED))
    return tree


def run(tree: Path, *command: str) -> tuple[int, str]:
    """Run a command in the copy, whose library comes before an installed one."""
    env = os.environ | {"PYTHONPATH": f"{tree / 'src'}{os.pathsep}{tree}"}
    done = subprocess.run(command, cwd=tree, env=env, capture_output=True, text=True, timeout=300)
    return done.returncode, done.stdout + done.stderr


def snakemake(tree: Path, *words: str) -> tuple[int, str]:
    return run(tree, sys.executable, "-m", "snakemake", "--cores", "1", *words)


class Edits:
    """Changes of files in a copy that are undone at the end."""

    def __init__(self, tree: Path) -> None:
        self.tree, self.kept = tree, {}

    def __call__(self, path: str, old: str, new: str) -> None:
        text = (self.tree / path).read_text(encoding="utf-8")
        assert old in text
        self.kept.setdefault(path, text)
        (self.tree / path).write_text(text.replace(old, new, 1), encoding="utf-8")

    def undo(self) -> None:
        for path, text in self.kept.items():
            (self.tree / path).write_text(text, encoding="utf-8")
