"""List what is still to be filled in, marked BLANK: `make lint`, `make archive`, `make publish`.

With RELEASE=1 these refuse it.
"""

import os
import subprocess
import sys
from pathlib import Path

MARK = "BLANK:"
FOLDERS = ("config", "docs", "figures", "notebooks", "paper", "studies", ":(glob)*")
"""Where a mark is one, in text files."""


def blanks(root: Path = Path()) -> list[str]:
    """Return file, line and text of each mark."""
    command = ["git", "grep", "--no-index", "--exclude-standard", "-I", "--line-number"]
    command += ["--only-matching", "-e", f"{MARK}.*", "--", *FOLDERS]
    found = subprocess.run(command, cwd=root, stdout=subprocess.PIPE, encoding="utf-8")
    if found.returncode > 1:  # 1 is for none
        sys.exit("git cannot look for what is to be filled in")
    return found.stdout.splitlines()


def is_release() -> bool:
    """Return whether RELEASE requires the demands of a release."""
    return os.environ.get("RELEASE", "0") not in ("", "0")


def main(root: Path = Path()) -> None:
    """Print each mark; with RELEASE=1 end with an error if there is one."""
    found = blanks(root)
    if found:
        print(*found, sep="\n", file=sys.stderr)
        print(f"{len(found)} lines are to be filled in before a release", file=sys.stderr)
    if found and is_release():
        sys.exit("RELEASE=1: expected none of them")


if __name__ == "__main__":
    main()
