"""Replace the machine of a paper by a newer one: `make update FROM=../folder`, or FROM=git URL.

Python alone runs this file, that of the newer machine, in the folder of the paper.
"""

import hashlib
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

MACHINE = "src/replication"
SUMS = "SHA256SUMS"
"""In a paper alone: the checksum of each file of the machine, as it was copied."""


def copy_machine(source: Path, to: Path) -> str:
    """Copy a machine, list the checksums of its files, and return its version."""
    for name, path in _files(source).items():
        (to / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(path, to / name)
    lines = (f"{value}  {path}\n" for path, value in _checksums(to).items())
    (to / SUMS).write_text("".join(lines), encoding="utf-8")
    return version(to)


def version(machine: Path) -> str:
    """Return the version of a machine."""
    return (machine / "VERSION").read_text(encoding="utf-8").strip()


def changed(machine: Path, sums: Path | None = None) -> list[str]:
    """Return the files of a machine that changed, came or went since it was copied."""
    lines = (sums or machine / SUMS).read_text(encoding="utf-8").splitlines()
    listed = {path: value for value, path in (line.split("  ", 1) for line in lines)}
    there = _checksums(machine)
    return sorted(path for path in {*listed, *there} if listed.get(path) != there.get(path))


def refusals(ours: Path, newer: Path) -> Iterator[str]:
    """Yield why a machine cannot take the place of ours, and what to do; nothing if it can."""
    changes = (newer / "CHANGES.md").read_text(encoding="utf-8")
    if not (ours / "VERSION").exists():
        yield f"{ours} was made before the machine had a version; expected 1.0.0 or later."
        yield changes.split("\n## Before 1.0.0\n")[1].strip()
    elif not (ours / SUMS).exists():
        yield f"{ours} has no {SUMS}; expected a paper that `make paper` made"
    elif files := changed(ours):
        yield from (f"{ours}/{path} was changed by hand" for path in files)
        yield "expected the files as they were copied: restore these (git restore), and bring what "
        yield "you need into the machine where it is developed"
    elif (newer / SUMS).exists() and changed(newer):
        yield f"FROM has a machine that was changed by hand: {', '.join(changed(newer))}"
    elif _numbers(version(newer)) < _numbers(version(ours)):
        yield f"FROM has version {version(newer)}; expected at least {version(ours)}, as here"


def news(changes: str, since: str) -> str:
    """Return the sections of CHANGES.md about versions after one."""
    sections = re.findall(r"^## (\d+(?:\.\d+)*)\b(.*?)(?=^## |\Z)", changes, re.M | re.S)
    later = [(number, text) for number, text in sections if _numbers(number) > _numbers(since)]
    return "\n".join(f"{number}{text.rstrip()}\n" for number, text in later)


def replace(newer: Path, root: Path = Path()) -> None:
    """Put another machine in the place of ours, lock the packages, and judge the claims again.

    Raises
    ------
    SystemExit
        When it is refused, when uv cannot lock (ours is back then), or when `make pages` or
        `make check` fails.
    """
    ours = root / MACHINE
    if reasons := list(refusals(ours, newer)):
        sys.exit("\n".join(["make update: nothing is changed", *reasons]))
    before, now = version(ours), version(newer)
    if _checksums(ours) == _checksums(newer):
        print(f"The machine is {now}, as that of FROM: nothing to do")
        return
    print(f"The machine: {before} → {now}\n")
    print(news((newer / "CHANGES.md").read_text(encoding="utf-8"), before))
    aside = ours.with_name("replication.before")
    ours.rename(aside)
    copy_machine(newer, ours)
    if subprocess.run([os.environ.get("UV", "uv"), "lock", "--quiet"], cwd=root).returncode:
        shutil.rmtree(ours)
        aside.rename(ours)
        sys.exit("make update: uv cannot lock the packages; nothing is changed")
    shutil.rmtree(aside)
    readme = root / "README.md"
    text = readme.read_text(encoding="utf-8")
    link = f"[{{}}]({MACHINE}/CHANGES.md)"
    readme.write_text(text.replace(link.format(before), link.format(now)), encoding="utf-8")
    for target in ("pages", "check"):
        if subprocess.run(["make", "--no-print-directory", target], cwd=root).returncode:
            sys.exit(f"make update: the machine is {now} now; make {target} fails as it says above")
    print(f"The machine is {now} now. Left for you: what its changes ask of a paper (above);")
    print("make reproduce lint test; read the diff, and commit it.")


def main(source: str) -> None:
    """Find the newer machine, and let it replace ours."""
    sys.stdout.reconfigure(line_buffering=True)  # uv and make write to it, too
    with tempfile.TemporaryDirectory() as clone:
        folder = Path(source)
        if source and not folder.is_dir():
            subprocess.run(["git", "clone", "--quiet", "--depth=1", "--", source, clone])
            folder = Path(clone)
        newer = (folder / MACHINE).resolve()
        script = newer / "commands" / "update.py"
        if not source or not script.is_file() or newer == Path(MACHINE).resolve():
            sys.exit(
                f"make update: FROM is {source!r}; expected another folder, or a repository that "
                f"git can clone, with {MACHINE}/commands/update.py in it"
            )
        if script == Path(__file__).resolve():
            replace(newer)
        else:
            done = subprocess.run([sys.executable, "-I", "-S", script, folder.resolve()])
            sys.exit(done.returncode)


def _files(machine: Path) -> dict[str, Path]:
    """Return the files of a machine by name, without its list and the caches of tools."""
    found = {path.relative_to(machine): path for path in sorted(machine.rglob("*"))}
    return {
        name.as_posix(): path
        for name, path in found.items()
        if path.is_file()
        and path.name != SUMS
        and not any(part == "__pycache__" or part.startswith(".") for part in name.parts)
    }


def _checksums(machine: Path) -> dict[str, str]:
    return {name: _checksum(path) for name, path in _files(machine).items()}


def _checksum(path: Path) -> str:
    """Return the SHA-256 of a file, whatever line ends git gave it."""
    return hashlib.sha256(path.read_bytes().replace(b"\r\n", b"\n")).hexdigest()


def _numbers(of_version: str) -> tuple[int, ...]:
    return tuple(map(int, of_version.split(".")))


if __name__ == "__main__":
    main(sys.argv[1])
