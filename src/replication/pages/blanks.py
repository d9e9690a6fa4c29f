"""List what is still to be filled in, marked BLANK: `make lint`, `make archive`, `make publish`.

With RELEASE=1 these refuse it.
"""

import os
import sys
from collections.abc import Iterator
from pathlib import Path

MARK = "BLANK:"
FOLDERS = ("config", "docs", "figures", "notebooks", "paper", "studies")
TOP = ("CITATION.cff", "CONTRIBUTING.md", "LICENSE", "README.md", "pyproject.toml")
KINDS = {".bib", ".cff", ".ipynb", ".md", ".toml", ".typ", ".yaml", ""}


def blanks(root: Path = Path()) -> Iterator[str]:
    """Yield file, line and text of each mark."""
    found = (path for name in FOLDERS for path in sorted((root / name).rglob("*")))
    for path in [*(root / name for name in TOP), *found]:
        if path.is_file() and path.suffix in KINDS:
            for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
                if MARK in line:
                    text = line[line.index(MARK) :].strip()
                    yield f"{path.relative_to(root).as_posix()}:{number}: {text}"


def is_release() -> bool:
    """Return whether RELEASE requires the demands of a release."""
    return os.environ.get("RELEASE", "0") not in ("", "0")


def main(root: Path = Path()) -> None:
    """Print each mark; with RELEASE=1 end with an error if there is one."""
    found = list(blanks(root))
    if found:
        print(*found, sep="\n", file=sys.stderr)
        print(f"{len(found)} lines are to be filled in before a release", file=sys.stderr)
    if found and is_release():
        sys.exit("RELEASE=1: expected none of them")


if __name__ == "__main__":
    main()
