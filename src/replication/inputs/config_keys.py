"""The keys of a config, each with its meaning, unit and value.

The schema gives meaning and unit. `unit` is an annotation of ours, "1" for a number without
dimension. A key without a description or a unit takes those of what contains it.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml

from replication.inputs.configuration import read_schema
from replication.inputs.schema_words import entry_of, has_numbers, resolved, unit_of
from replication.inputs.strict_yaml import read_yaml


@dataclass(frozen=True)
class Key:
    """A key of the config that holds a value: a number, a text, or a list of such.

    Meaning and unit are "" where the schema has none.
    """

    place: str  # its path, dotted; `[]` stands for each item of a list of mappings
    meaning: str
    unit: str
    values: tuple[Any, ...]  # one; inside a list of mappings, that of each item

    @property
    def value(self) -> str:
        """Its values as YAML."""
        return "; ".join(_yaml(value) for value in self.values)


def keys(path: Path, used: Mapping[str, Any] | None = None) -> list[Key]:
    """Return every key of a config that holds a value, in the order of the file.

    `used` has the values of a run, where another file went over this one.
    """
    schema = read_schema(path.with_name("config.schema.yaml"))
    config = read_yaml(path) if used is None else used
    return [
        key
        for name, value in config.items()
        for key in _keys(name, [value], entry_of(schema, name), schema, {})
    ]


def _keys(
    place: str,
    values: list[Any],
    schema: Mapping[str, Any],
    root: Mapping[str, Any],
    outer: Mapping[str, str],
) -> Iterator[Key]:
    """Yield the keys at a place; `values` has more than one entry inside a list of mappings."""
    schema = resolved(schema, root)
    inherited = {name: schema.get(name, outer.get(name, "")) for name in ("description", "unit")}
    if all(isinstance(value, Mapping) for value in values):
        for name in dict.fromkeys(name for value in values for name in value):
            inner = [value[name] for value in values if name in value]
            below = f"{place}.{name}" if place else str(name)
            yield from _keys(below, inner, entry_of(schema, name), root, inherited)
        return
    items = [item for value in values if isinstance(value, list) for item in value]
    if items and all(isinstance(item, Mapping) for item in items):
        of_items = schema.get("items", {})
        yield from _keys(f"{place}[]", items, of_items, root, inherited)
        return
    meaning = one_line(inherited["description"])
    unit = unit_of(schema, root) or (inherited["unit"] if has_numbers(schema, root) else "")
    yield Key(place, meaning, unit, tuple(values))


def _yaml(value: Any) -> str:
    text = yaml.safe_dump(value, default_flow_style=True, allow_unicode=True, width=10**6)
    return text.removesuffix("\n...\n").strip()


def one_line(text: str) -> str:
    return " ".join(text.split())
