"""A clean replication of another paper: `make paper TO=../other`.

The machine is copied, as are the files that are the same for every paper; `template/` has the rest,
an example that runs at once. Nothing of this paper goes along, nor what only begins a paper.
"""

import os
import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

from replication.commands.update import AT_HOME, MACHINE, record
from replication.inputs.parts import PAPER, config_of, ledger_of
from replication.judging.ledger import read_ledger
from replication.pages.edition import publish_verdicts
from replication.pages.seal import seal
from replication.workflow.place import UNQUOTED

ROOT = Path(__file__).resolve().parents[3]
TEMPLATE = Path(__file__).parents[1] / "template"
COPIED = (
    ".ci/run",
    ".github/workflows/ci.yaml",
    ".gitignore",
    "figures/style.mplstyle",
    "profiles/default/config.yaml",
    "uv.lock",
)
"""Files that are the same for every paper, but for the name of the project in them.

uv then takes out of its lock what is not needed."""


def create(to: Path, root: Path = ROOT) -> Path:
    """Make the folder of a new replication, and return it.

    Raises
    ------
    ValueError
        For a folder that is not empty, lies in this one, or has a path or name that cannot be used;
        or when uv cannot lock the packages.
    """
    to = to.resolve()
    name = _checked_name(to, root)
    left_out = shutil.ignore_patterns("__pycache__", "*.svg")
    shutil.copytree(TEMPLATE, to, ignore=left_out, dirs_exist_ok=True)
    home = shutil.ignore_patterns("__pycache__", ".*", *(Path(path).name for path in AT_HOME))
    shutil.copytree(root / MACHINE, to / MACHINE, ignore=home)
    version = _read(to / MACHINE / "VERSION").strip()
    project = tomllib.loads(_read(root / "pyproject.toml"))["project"]["name"]
    for path in COPIED:
        (to / path).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(root / path, to / path)
        (to / path).write_text(_read(to / path).replace(project, name), encoding="utf-8")
    (to / "docs").mkdir()
    for path in ("LICENSE", "docs/LICENSE-CC-BY"):
        (to / path).write_text(_licence(_read(root / path)), encoding="utf-8")
    for path in ("pyproject.toml", "README.md"):
        text = _read(to / path).replace("@NAME@", name).replace("@VERSION@", version)
        (to / path).write_text(text, encoding="utf-8")
    uv = os.environ.get("UV") or shutil.which("uv") or root / ".uv/bin/uv"
    locked = subprocess.run([uv, "lock", "--quiet"], cwd=to, capture_output=True, text=True)
    if locked.returncode:
        raise ValueError(f"uv cannot lock the packages of {to}:\n{locked.stderr}")
    _publish(to)
    return to


def _publish(to: Path) -> None:
    """Publish the example, which has findings and a table of an earlier run."""
    shutil.copyfile(to / config_of(PAPER), to / "tests/reference/config.yaml")
    publish_verdicts(read_ledger([to / ledger_of(PAPER)]), to)
    seal(to)


def _checked_name(to: Path, root: Path) -> str:
    """Return the name of the project in a folder, which is that of the folder."""
    if to.exists() and (not to.is_dir() or any(to.iterdir())):
        raise ValueError(f"TO is {to}, which exists and is not empty; expected a new folder")
    if to.is_relative_to(root):
        raise ValueError(f"TO is {to}, which lies in {root}; expected a folder beside it")
    if found := UNQUOTED.search(str(to)):
        raise ValueError(
            f"TO is {to}, which has the character {found[0]!r}; expected letters, digits and "
            ". _ - / alone, since Snakemake starts its jobs without quoting that path"
        )
    name = re.sub(r"[^a-z0-9]+", "-", to.name.lower()).strip("-")
    lock = tomllib.loads(_read(root / "uv.lock"))
    if not name or name in {package["name"] for package in lock["package"]}:
        raise ValueError(
            f"TO is {to}, and its last part is the name of the project; expected one with letters "
            "or digits that is not the name of a package that the project uses"
        )
    return name


def _licence(text: str) -> str:
    """Return a licence of the authors of the machine and of the new ones."""
    text, *_ = text.partition("\n---")  # below it follows what it covers here
    text = re.sub(r" ?The ground motions in [^.]*\.", "", text)
    ours = r"\1Copyright (c) BLANK: year, your names\n"
    return re.sub(r"^(Copyright .*\n)", ours, text, count=1, flags=re.MULTILINE)


def _read(path: Path) -> str:
    return path.read_text(encoding="utf-8")


def first_commit(folder: Path) -> str:
    """Begin the history of a folder, on the branch on which its workflow runs; say what is left."""
    git = ("git", "-C", str(folder))
    subprocess.run([*git, "init", "--quiet", "--initial-branch=main"], check=True)
    record(folder)
    subprocess.run([*git, "add", "--all"], check=True)
    author = [*git, "-c", "user.useConfigOnly=true", "var", "GIT_AUTHOR_IDENT"]
    if subprocess.run(author, capture_output=True).returncode:
        return (
            "git knows no author, so type: git config --global user.name 'Your Name'; "
            f"git config --global user.email you@…; git -C {folder} commit -m 'A new paper'"
        )
    subprocess.run([*git, "commit", "--quiet", "--message=A new paper"], check=True)
    return "It is committed on the branch main."


if __name__ == "__main__":
    try:
        folder = create(Path(sys.argv[1] or "."))
    except ValueError as error:
        sys.exit(f"make paper: {error}")
    if shutil.which("git"):
        print(first_commit(folder))
    print(f"{folder} is made. Run it: make -C {folder} reproduce")
    print(f"Then make it yours: {folder}/README.md says in which order.")
