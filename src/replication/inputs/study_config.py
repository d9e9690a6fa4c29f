"""Follow-up studies: a folder in studies/ each, with a config of its own."""

from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any

from snakemake.utils import update_config

from replication.inputs.strict_yaml import read_yaml

FOLDER = "studies"


def read_study_config(
    name: str,
    check: Callable[[dict[str, Any], str, str], None],
    folder: str = FOLDER,
    over: Iterable[str] = (),
) -> dict[str, Any]:
    """Read and check the config of a study.

    The files beside config.yaml with the names `over` go over it, where there are such: with
    `--configfile config/quick.yaml` that of the paper goes over the paper's config, and quick.yaml
    in the folder of a study over the study's. `check` raises a ValueError, given the config, its
    path and that of its schema.

    Raises
    ------
    ValueError
        With one line for each fault: no such study, or what `read_yaml` and the check find.
    """
    path = Path(folder) / name / "config.yaml"
    if not path.is_file():
        there = sorted(found.parent.name for found in Path(folder).glob("*/config.yaml"))
        raise ValueError(
            f"config/config.yaml: studies has {name!r}, for which there is no {path}; "
            f"expected some of {', '.join(there) or 'none: there are no studies'}"
        )
    config: dict[str, Any] = read_yaml(path)
    paths = [str(path)]
    for other in filter(Path.is_file, map(path.with_name, over)):
        update_config(config, read_yaml(other))
        paths.insert(0, str(other))
    check(config, " over ".join(paths), str(path.with_name("config.schema.yaml")))
    return config


def check_needs(studies: Mapping[str, Mapping[str, Any]]) -> None:
    """Refuse a study that builds on another one, named in its `needs`, which is not listed before.

    Raises
    ------
    ValueError
        Naming the study, and those that it lacks.
    """
    before: list[str] = []
    for name, config in studies.items():
        needed = config.get("needs", [])
        if missing := [other for other in needed if other not in before]:
            raise ValueError(
                f"{FOLDER}/{name}/config.yaml: needs has {', '.join(missing)}, and studies of "
                f"config/config.yaml is [{', '.join(studies)}]; expected {', '.join(needed)} in "
                f"studies before {name}, or studies without {name}"
            )
        before.append(name)
