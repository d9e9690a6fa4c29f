"""The keys of a config, each with its meaning, unit and value; the comments of a config.

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


def comments(text: str) -> dict[str, str]:
    """Return the comments of a YAML file by the dotted place of the key that they are about.

    A comment at the end of a line is about the first key of this line. Lines of comment are about
    the key below them.
    """
    ends: dict[int, int] = {}  # by line, where the last token that is no comment ends
    for token in yaml.scan(text):
        if token.end_mark.line == token.start_mark.line:
            ends[token.end_mark.line] = token.end_mark.column
    lines = text.splitlines()
    found: dict[str, str] = {}
    for place, line in _lines(yaml.compose(text), ""):
        above: list[str] = []
        for other in reversed(lines[:line]):
            if not other.strip().startswith("#"):
                break
            above.insert(0, other.strip().removeprefix("#"))
        beside = lines[line][ends.get(line, 0) :].strip().removeprefix("#")
        said = one_line(" ".join([*above, beside]))
        if said and place not in found:
            found[place] = said
    return found


def _lines(node: yaml.Node, place: str) -> Iterator[tuple[str, int]]:
    """Yield each place and its line: a key, and each item of a list of mappings.

    Of the keys on one line only the first is yielded, and of a list the first item that has a line.
    """
    entries: list[tuple[str, yaml.Node, yaml.Node]] = []
    if isinstance(node, yaml.MappingNode):
        above = f"{place}." if place else ""
        entries = [(f"{above}{key.value}", key, value) for key, value in node.value]
    elif isinstance(node, yaml.SequenceNode):
        items = (item for item in node.value if isinstance(item, yaml.MappingNode))
        entries = [(f"{place}[]", item, item) for item in items]
    for below, begin, inner in entries:
        here = begin.start_mark.line
        yield below, here
        yield from ((at, line) for at, line in _lines(inner, below) if line != here)


def _yaml(value: Any) -> str:
    text = yaml.safe_dump(value, default_flow_style=True, allow_unicode=True, width=10**6)
    return text.removesuffix("\n...\n").strip()


def one_line(text: str) -> str:
    return " ".join(text.split())
