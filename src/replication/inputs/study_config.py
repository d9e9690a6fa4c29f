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

    Parameters
    ----------
    check
        Raises a ValueError for what is wrong with a config, given its path and that of its schema.
    over
        The names of files beside config.yaml that go over it, where there are such: with
        `--configfile config/quick.yaml` those of the paper go over the paper's, and those of
        quick.yaml in a study's folder over the study's.

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
    """Refuse a study that builds on another one which is not listed before it.

    Parameters
    ----------
    studies
        The config of each study of the run, in the order of the list. Its key `needs`, if any,
        names the studies on whose settings or results it builds.

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
