"""Follow-up studies: a folder in studies/ each, with a config of its own."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from configuration import check_config
from strict_yaml import read_yaml

FOLDER = "studies"


def read_study_config(
    name: str, structures: Mapping[str, Any], folder: str = FOLDER
) -> dict[str, Any]:
    """Read and check the config of a study.

    Parameters
    ----------
    structures : mapping
        Those of config/config.yaml, which a study may name as its own.

    Raises
    ------
    ValueError
        With one line for each fault: no such study, or what `read_yaml` and `check_config` find.
    """
    path = Path(folder) / name / "config.yaml"
    if not path.is_file():
        there = sorted(found.parent.name for found in Path(folder).glob("*/config.yaml"))
        raise ValueError(
            f"config/config.yaml: studies has {name!r}, for which there is no {path}; "
            f"expected some of {', '.join(there) or 'none: there are no studies'}"
        )
    config: dict[str, Any] = read_yaml(path)
    check_config(
        config, str(path), str(path.with_name("config.schema.yaml")), structures=structures
    )
    return config
