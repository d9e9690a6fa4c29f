"""Check that the workflow can run in its folder."""

import os
import re
import sys
from pathlib import Path

UNQUOTED = re.compile(r"[\s'\"\\$`&;|<>()*?\[\]{}:]")
"""What a shell does not take as a part of a word, and the colon, which separates search paths."""


def check_place(
    python: str = sys.executable, folder: str = ".", package: str | Path = Path(__file__).parents[1]
) -> None:
    """Refuse a place where no job could run.

    Raises
    ------
    ValueError
        When the path of Python has a character that is more than a letter to the shell: Snakemake
        does not quote that path. When the folder cannot be written to. When the machine itself
        (`package`) was imported from another folder, and so would everything else be.
    """
    if found := UNQUOTED.search(python):
        raise ValueError(
            f"the path of Python, {python}, has the character {found[0]!r}; expected letters, "
            "digits and . _ - / alone, since Snakemake starts its jobs without quoting that path: "
            "move the folder, delete its .venv, and run again"
        )
    if not os.access(folder, os.W_OK):
        raise ValueError(
            f"{os.path.abspath(folder)} cannot be written to; expected a folder that can, for the "
            "results: copy it to where you may write"
        )
    own = Path(folder, "src", "replication")
    if own.is_dir() and not own.samefile(package):
        raise ValueError(
            f"replication is imported from {package}; expected {own.resolve()}: this folder is a "
            "copy, and its .venv still points at the original. Delete .venv, and run again by make"
        )
