"""A clean replication of another paper: `make paper TO=../other`.

The files that are the same for every paper are copied from the repository itself; `template/` has
the rest, an example that runs at once. Nothing of this paper goes along.
"""

import re
import shutil
import subprocess
import sys
import tomllib
from collections.abc import Iterable, Iterator
from pathlib import Path

from replication.pages.seal import seal
from replication.workflow.place import UNQUOTED

ROOT = Path(__file__).resolve().parents[3]
TEMPLATE = Path(__file__).parents[1] / "template"
COPIED = (
    ".ci/run",
    ".github/workflows/ci.yaml",
    ".gitignore",
    "environment.yml",
    "figures/style.mplstyle",
    "profiles/default/config.yaml",
    "src/replication/tests/test_environment.py",
    "src/replication/tests/test_house.py",
)
"""Files that are the same for every paper, but for the name of the project in them."""

LEFT_OUT = ("__pycache__", "template", "kill", "new_paper.py", "kill_table.py", "*.svg")
"""What of the machine and of the template does not go along."""

ONLY_HERE = (
    *("basedpyright", "heyoka", "hypothesis", "lazy-loader", "llvmlite", "mujoco-core", "numba"),
    *("pdoc", "python-flint", "snakemake-executor-plugin-slurm", "xarray"),
)
"""Packages that neither the machine nor the example needs."""

OWN_REASONS = ("scipy", "sympy")
"""Packages for which the template gives reasons of its own."""


def create(to: Path, root: Path = ROOT) -> Path:
    """Make the folder of a new replication, and return it.

    Raises
    ------
    ValueError
        For a folder that is not empty, lies in this one, or has a path or name that cannot be used.
    """
    to, project = to.resolve(), _project(root)
    name = _checked_name(to, root)
    ignored = shutil.ignore_patterns(*LEFT_OUT)
    shutil.copytree(TEMPLATE, to, ignore=ignored, dirs_exist_ok=True)
    shutil.copytree(root / "src/replication", to / "src/replication", ignore=ignored)
    shutil.rmtree(to / "src/replication/tests")
    for path in COPIED:
        (to / path).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(root / path, to / path)
        text = _read(to / path).replace(project, name)
        (to / path).write_text(text, encoding="utf-8")
    environment = without(ONLY_HERE, _read(to / "environment.yml"))
    (to / "environment.yml").write_text(environment, encoding="utf-8")
    (to / "uv.lock").write_text(reduced_lock(_read(root / "uv.lock"), name), encoding="utf-8")
    for path in ("LICENSE", "LICENSE-CC-BY"):
        (to / path).write_text(_licence(_read(root / path)), encoding="utf-8")
    reasons = re.findall(r"^- `[\w.-]+`: .*\n", _read(root / "CONTRIBUTING.md"), re.MULTILINE)
    blanks = {
        "@NAME@": name,
        "@SHARED@\n": _shared(_read(root / "pyproject.toml"), project),
        "@REASONS@\n": without((*ONLY_HERE, *OWN_REASONS), "".join(reasons)),
    }
    for path in ("pyproject.toml", "CONTRIBUTING.md"):
        text = _read(to / path)
        for blank, filled in blanks.items():
            text = text.replace(blank, filled)
        (to / path).write_text(text, encoding="utf-8")
    seal(to)
    return to


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
    if not name or name in {package["name"] for package in _packages(_read(root / "uv.lock"))}:
        raise ValueError(
            f"TO is {to}, and its last part is the name of the project; expected one with letters "
            "or digits that is not the name of a package that the project uses"
        )
    return name


def without(packages: Iterable[str], text: str) -> str:
    """Return a text without the lines that declare packages, nor the comments right above these."""
    declares = re.compile(rf'(?<![\w-])(?:{"|".join(packages)})(?=["`=<>])')
    kept: list[str] = []
    for line in text.splitlines(keepends=True):
        if declares.search(line):
            while kept and kept[-1].lstrip().startswith("# "):
                kept.pop()
        else:
            kept.append(line)
    return "".join(kept)


def reduced_lock(text: str, name: str) -> str:
    """Return uv's lock for a project of another name that does without the packages of ONLY_HERE.

    It keeps the versions, and needs no index: a package stays if the project still reaches it.
    """
    head, *blocks = text.split("[[package]]\n")
    own = next(block for block in blocks if 'source = { editable = "." }' in block)
    root = re.sub('^name = ".*"', f'name = "{name}"', without(ONLY_HERE, own))
    root = re.sub(r"^[\w-]+ = \[\n\]\n", "", root, flags=re.MULTILINE)  # groups that are empty now
    gone = (  # the extras of the library, which stays here
        r"^\[package.optional-dependencies\]\n(?:[^[\n].*\n)*\n|^provides-extras = .*\n"
        r"|^    .*, marker = \"extra == .*\n"
    )
    root = re.sub(gone, "", root, flags=re.MULTILINE)
    groups = re.findall(r"^([\w-]+) = \[", root.split("requires-dev]")[1], flags=re.MULTILINE)
    root = re.sub(
        r"^default-groups = \[(.*)\]$",
        lambda line: f"default-groups = [{', '.join(_named(line[1], {*groups}))}]",
        root,
        flags=re.MULTILINE,
    )
    blocks[blocks.index(own)] = root
    edges: dict[str, set[str]] = {}
    for package in _packages(head + "".join(f"[[package]]\n{block}" for block in blocks)):
        groups = (package.get("optional-dependencies", {}), package.get("dev-dependencies", {}))
        needed = [
            *package.get("dependencies", []),
            *(d for g in groups for v in g.values() for d in v),
        ]
        edges.setdefault(package["name"], set()).update(each["name"] for each in needed)
    reached, waiting = set(), {name}
    while waiting:
        reached.add(package := waiting.pop())
        waiting |= edges[package] - reached
    kept = {block: re.match('name = "(.*)"', block)[1] for block in blocks}
    parts = [block for block in sorted(blocks, key=kept.get) if kept[block] in reached]
    return head + "\n".join(f"[[package]]\n{block.rstrip()}\n" for block in parts)


def _named(listed: str, groups: set[str]) -> Iterator[str]:
    """Yield those of a list of quoted groups that are there."""
    return (each for each in listed.split(", ") if each.strip('"') in groups)


def _packages(lock: str) -> list[dict]:
    return tomllib.loads(lock)["package"]


def _project(root: Path) -> str:
    return tomllib.loads(_read(root / "pyproject.toml"))["project"]["name"]


def _shared(pyproject: str, project: str) -> str:
    """Return what every project has in its pyproject.toml: dependencies, groups, tools."""
    begin, end = pyproject.index("# Why each of these"), pyproject.index("[tool.mypy]")
    text = without(ONLY_HERE, pyproject[begin:end])
    text = re.sub(r"(?m)^(?:# .*\n)*(?:optional-dependencies\..*\n)+", "", text)
    text = re.sub(r'(extend-exclude = \["\*\.ipynb").*', r"\1]", text)
    return text.replace(f"src/{project}", "src/theory")


def _licence(text: str) -> str:
    """Return a licence of the authors of the machine and of the new ones."""
    text, *_ = text.partition("\n---")  # below it follows what it covers here
    text = re.sub(r" ?The ground motions in [^.]*\.", "", text)
    return re.sub(
        r"^(Copyright .*\n)", r"\1Copyright (c) BLANK: year, your names\n", text, flags=re.M
    )


def _read(path: Path) -> str:
    return path.read_text(encoding="utf-8")


if __name__ == "__main__":
    try:
        folder = create(Path(sys.argv[1] or "."))
    except ValueError as error:
        sys.exit(f"make paper: {error}")
    if shutil.which("git"):
        subprocess.run(["git", "init", "--quiet", str(folder)], check=True)
        # Its workflow runs on this branch; git init takes the name from the user's settings.
        on_main = ["git", "-C", str(folder), "symbolic-ref", "HEAD", "refs/heads/main"]
        subprocess.run(on_main, check=True)
    print(f"{folder} is made. Run it: make -C {folder} reproduce")
    print(f"Then make it yours: {folder}/README.md says in which order.")
