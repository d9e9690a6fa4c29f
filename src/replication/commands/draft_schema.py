"""Draft the sections that the schema of a config lacks, from its values: `make schema`.

Meanings and units are the author's to fill in, marked BLANK, and so are bounds.
"""

from collections.abc import Mapping
from pathlib import Path
from textwrap import indent
from typing import Any

import yaml

from replication.inputs.parts import PAPER, config_of
from replication.inputs.strict_yaml import read_yaml

MEANING = {"description": "BLANK: what it is"}
UNIT = {"unit": 'BLANK: the unit, "1" without one'}


def draft(value: Any) -> dict[str, Any]:
    """Return the schema of a value, which allows every value of its kind."""
    match value:
        case Mapping():
            return {key: draft(each) for key, each in value.items()}
        case [first, *_]:
            return MEANING | {"type": "array", "items": draft(first)}
        case float():
            return MEANING | UNIT | {"type": "number"}
        case bool() | int():
            return MEANING | {"type": "boolean" if isinstance(value, bool) else "integer"}
    return MEANING | {"type": "string"}


def add_missing(path: Path) -> list[str]:
    """Add the sections of a config that its schema lacks, and return their names.

    Raises
    ------
    ValueError
        When the schema does not end with `properties`.
    """
    schema, config = path.with_name("config.schema.yaml"), read_yaml(path)
    text, known = schema.read_text(encoding="utf-8"), read_yaml(schema)
    if not (missing := [key for key in config if key not in known["properties"]]):
        return []
    if [*known][-1] != "properties":
        raise ValueError(f"{schema}: expected `properties` last")
    drafts = {key: draft(config[key]) for key in missing}
    body = yaml.safe_dump(drafts, allow_unicode=True, sort_keys=False, width=100)
    schema.write_text(f"{text.rstrip()}\n\n{indent(body, '  ')}", encoding="utf-8")
    return missing


if __name__ == "__main__":
    for part in [PAPER, *read_yaml(config_of(PAPER))["studies"]]:
        path = Path(config_of(part))
        print(f"{path}: drafted {', '.join(add_missing(path)) or 'nothing, none is missing'}")
