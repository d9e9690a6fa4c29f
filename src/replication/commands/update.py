"""Take the machine of another git repository: `make update FROM=../folder`, or FROM=git URL.

git has the machine as it was taken: `TREE` names its tree, and any other was changed by hand. What
only begins a new paper stays at home. Python alone runs this file, that of the newer machine.
"""

import hashlib
import os
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

MACHINE = "src/replication"
AT_HOME = (f"{MACHINE}/template", f"{MACHINE}/commands/new_paper.py")
"""What a paper does not take along: it begins another one."""
TREE = Path(".machine")
"""In a paper alone: git's name of the tree of the machine as it was taken."""
SUMS = Path(MACHINE, "SHA256SUMS")
"""What papers before 1.5.0 have in its place: the checksum of each file."""


def git(*words: str, root: Path = Path()) -> str:
    """Return what git says; its own error ends the command."""
    done = subprocess.run(["git", *words], cwd=root, stdout=subprocess.PIPE, text=True)
    return done.stdout.strip() if done.returncode == 0 else sys.exit("make update: git failed")


def record(root: Path = Path()) -> None:
    """Write down the machine as it is: all of it is added to git's index."""
    git("add", "--all", "--", MACHINE, root=root)
    tree = git("write-tree", f"--prefix={MACHINE}/", root=root)
    (root / TREE).write_text(f"{tree}\n", encoding="utf-8")
    git("add", "--", str(TREE), root=root)


def changed() -> Iterator[str]:
    """Yield the files of the machine that differ from those that were taken."""
    yield from git("status", "--porcelain", "--", MACHINE).splitlines()
    if SUMS.exists():
        for line in SUMS.read_text(encoding="utf-8").splitlines():
            value, name = line.split("  ", 1)
            file = SUMS.parent / name
            known = file.read_bytes().replace(b"\r\n", b"\n") if file.is_file() else b""
            if hashlib.sha256(known).hexdigest() != value:
                yield str(file)
    elif (now := git("rev-parse", f"HEAD:{MACHINE}")) != TREE.read_text("utf-8").strip():
        yield f"{MACHINE}, which is the tree {now[:12]} and not that of {TREE}"


def refusals(theirs: str) -> Iterator[str]:
    """Yield why a machine cannot take the place of ours, and what to do; nothing if it can."""
    if not (TREE.exists() or SUMS.exists()):
        yield f"there is no {TREE}; expected a paper that `make paper` made, and git on its machine"
    elif files := [*changed()]:
        yield from (f"{file} was changed by hand" for file in files)
        yield "expected the machine as it was taken: restore it (git restore), and bring what you "
        yield "need into the machine where it is developed"
    elif _numbers(theirs) < _numbers(ours := Path(MACHINE, "VERSION").read_text("utf-8").strip()):
        yield f"FROM has version {theirs}; expected at least {ours}, as here"


def news(changes: str, since: str) -> str:
    """Return the sections of CHANGES.md about versions after one."""
    sections = re.findall(r"^## (\d+(?:\.\d+)*)\b(.*?)(?=^## |\Z)", changes, re.M | re.S)
    later = [(number, text) for number, text in sections if _numbers(number) > _numbers(since)]
    return "\n".join(f"{number}{text.rstrip()}\n" for number, text in later)


def _numbers(of_version: str) -> tuple[int, ...]:
    return tuple(map(int, of_version.strip().split(".")))


def take() -> None:
    """Put the machine that was fetched in the place of ours, and all else of it out of the way."""
    git("restore", "--source=FETCH_HEAD", "--staged", "--worktree", "--", MACHINE)
    git("rm", "-r", "--quiet", "--force", "--ignore-unmatch", "--", *AT_HOME)


def main(source: str) -> None:
    """Fetch the newer machine, let it replace ours, lock the packages, and judge the claims again.

    Raises
    ------
    SystemExit
        When it is refused, when uv cannot lock (ours is back then), or when `make check` fails.
    """
    sys.stdout.reconfigure(line_buffering=True)  # git, uv and make write to it, too
    folder = Path(source)
    is_bare = folder.is_dir() and not (folder / ".git").exists()
    if not source or folder.resolve() == Path.cwd() or is_bare:
        sys.exit(
            f"make update: FROM is {source!r}; expected another git repository with {MACHINE}, of "
            "which the last commit is taken: a folder (no unpacked archive) or a URL"
        )
    if not Path(".git").exists():
        sys.exit("make update: this paper is in no git repository; commit it: git init, git add")
    if subprocess.run(["git", "fetch", "--quiet", "--depth=1", source, "HEAD"]).returncode:
        sys.exit(f"make update: git cannot fetch FROM, {source!r}")
    theirs = git("show", f"FETCH_HEAD:{MACHINE}/VERSION")
    if reasons := list(refusals(theirs)):
        sys.exit("\n".join(["make update: nothing is changed", *reasons]))
    before = Path(MACHINE, "VERSION").read_text(encoding="utf-8").strip()
    take()
    if not git("diff", "--cached", "--name-only", "--", MACHINE):
        print(f"The machine is {theirs}, as that of FROM: nothing to do")
        return
    print(f"The machine: {before} → {theirs}\n")
    print(news(Path(MACHINE, "CHANGES.md").read_text(encoding="utf-8"), before))
    uv = os.environ.get("UV", "uv")
    if subprocess.run([uv, "lock", "--quiet"]).returncode:
        git("restore", "--source=HEAD", "--staged", "--worktree", "--", MACHINE)
        sys.exit("make update: uv cannot lock the packages; nothing is changed")
    record()
    readme, link = Path("README.md"), f"[{{}}]({MACHINE}/CHANGES.md)"
    text = readme.read_text(encoding="utf-8")
    readme.write_text(text.replace(link.format(before), link.format(theirs)), encoding="utf-8")
    subprocess.run([uv, "run", "--locked", "--no-dev", "python", "-m", "replication.pages.edition"])
    if subprocess.run(["make", "--no-print-directory", "check"]).returncode:
        sys.exit(f"make update: the machine is {theirs} now; make check fails as said above")
    print(f"The machine is {theirs} now. Left for you: what its changes ask of a paper (above);")
    print("make reproduce lint test; read the diff, and commit it.")


if __name__ == "__main__":
    main(sys.argv[1])
