"""A new study from studies/skeleton/: `make study NAME=my_study`."""

import keyword
import re
import shutil
import sys
from pathlib import Path

from replication.inputs.strict_yaml import read_word
from replication.judging.ledger import OURS, REPRODUCED
from replication.judging.verdicts import by_origin

SKELETON = "skeleton"
LONGEST = 20
"""Letters of a name: so few that the lines of the skeleton that contain it need no other breaks."""
NAMES = re.compile(r"\brule (\w+):|\bresults/\w+/([a-z]\w*)")
"""What a Snakefile calls its rules and their results."""
REGISTER = re.compile(r"^studies: \[(.*)\]$", re.MULTILINE)


def create(name: str, root: Path = Path()) -> Path:
    """Copy the skeleton under another name, and put that name into config/config.yaml.

    Raises
    ------
    ValueError
        For a name that is taken, means something else or cannot be one; for a config without the
        line `studies: [...]`.
    """
    folder, config = root / "studies" / name, root / "config" / "config.yaml"
    check_name(name, root, LONGEST)
    if folder.exists():
        raise ValueError(f"NAME is {name!r}, and {folder} exists; expected a new name")
    if taken := _taken(name, root):
        raise ValueError(
            f"NAME is {name!r}, which is too like {taken[0]!r}: the names of a study's rules and "
            "results begin with its own; expected a name with which none of the others begins"
        )
    text = config.read_text(encoding="utf-8")
    line = REGISTER.search(text)
    if line is None:
        raise ValueError(f"{config} has no line 'studies: [...]'; expected one to add {name} to")
    names = [*filter(None, line[1].split(", "))]
    if name in names:
        raise ValueError(
            f"NAME is {name!r}, which the list studies in {config} has already, without a folder: "
            "take it out there, or choose another name"
        )
    left_out = shutil.ignore_patterns("__pycache__", "*.svg")
    shutil.copytree(folder.with_name(SKELETON), folder, ignore=left_out)
    for path in filter(Path.is_file, sorted(folder.rglob("*"))):
        path.write_text(path.read_text(encoding="utf-8").replace(SKELETON, name), encoding="utf-8")
    listed = ", ".join([*names, name])
    config.write_text(REGISTER.sub(f"studies: [{listed}]", text), encoding="utf-8")
    return folder


def check_name(name: str, root: Path, longest: int) -> None:
    """Raise ValueError for a name of a study or claim that cannot be one, or means something."""
    if not re.fullmatch(r"[a-z][a-z0-9_]*", name) or len(name) > longest:
        raise ValueError(
            f"NAME is {name!r}; expected a lower-case letter, then lower-case letters, digits "
            f"or _, at most {longest} in all"
        )
    if meaning := _meaning(name, root):
        raise ValueError(
            f"NAME is {name!r}, {meaning}; expected another name, for example 'my_{name[:14]}'"
        )


def _meaning(name: str, root: Path) -> str | None:
    """Return what else a name means to a program that reads it, or None."""
    if (value := read_word(name)) != name:
        return f"which YAML reads as {value!r}, and the config names its studies in YAML"
    if keyword.iskeyword(name):
        return "a keyword of Python, and the tests of a study import its steps by its name"
    if name in {*by_origin([]), OURS, REPRODUCED}:
        return "under which the verdicts count claims that belong to no study"
    if f"{name}/" in (root / ".gitignore").read_text(encoding="utf-8").splitlines():
        return "the name of folders that .gitignore keeps out of git"
    return None


def names_of(root: Path) -> set[str]:
    """Return the names of rules, results, figures, notebooks and documents."""
    kinds = ("Snakefile", "src/*/*.smk", "studies/*/*.smk")
    snakefiles = [path for kind in kinds for path in sorted(root.glob(kind))]
    texts = [path.read_text(encoding="utf-8") for path in snakefiles]
    names = {found for text in texts for both in NAMES.findall(text) for found in both if found}
    made = ("figures/*.py", "notebooks/*.ipynb", "paper/*.typ")
    return names | {path.stem for pattern in made for path in root.glob(pattern)}


def _taken(name: str, root: Path) -> list[str]:
    """Return the names, of the paper and of studies, that would be mixed up with the new one's."""
    studies = [path.parent.name for path in root.glob("studies/*/study.smk")]
    return [
        *sorted(other for other in names_of(root) if other.startswith(name)),
        *sorted(study for study in studies if name.startswith(f"{study}_")),
    ]


if __name__ == "__main__":
    try:
        folder = create(sys.argv[1])
    except (OSError, ValueError) as error:
        sys.exit(f"make study: {error}")
    print(f"{folder} is made, and named in config/config.yaml. Run it: make reproduce")
    print(f"studies/FOLLOW-UP.md explains how to change each file. Begin in {folder}/steps.")
