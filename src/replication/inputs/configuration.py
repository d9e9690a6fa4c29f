"""Check config.yaml against its schema; the messages say how to correct it."""

import math
import pkgutil
import re
import sys
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from itertools import pairwise
from pathlib import Path
from typing import Any

from jsonschema import Draft202012Validator, ValidationError

from replication.inputs.strict_yaml import read_yaml
from replication.inputs.suggestions import hint

NAMES = {
    "^[a-z][a-z0-9_]*$": "a lower-case letter, then lower-case letters, digits or _",
    "^[A-Za-z0-9_]+$": "letters, digits or _",
    r"\.$": "a sentence, which ends with a full stop",
    r"^(?!steps|replication)[a-z]\w*(\.[A-Za-z_]\w*)+$": (
        "a function with its module, such as lib.shapes.area, neither of steps nor of replication"
    ),
}
"""The patterns of the schemas, in words."""

BOUNDS = {
    "minimum": "at least",
    "maximum": "at most",
    "exclusiveMinimum": "more than",
    "exclusiveMaximum": "less than",
}

DRAFT = "; of a new section, `make schema` drafts what the schema says"


class Sections(dict[str, Any]):
    """A config that names its file when it lacks a section that a rule takes."""

    path = "config/config.yaml"

    def __missing__(self, name: str) -> Any:
        raise ValueError(
            f"{self.path} has no section {name!r}, which a rule takes; {hint(name, self)}"
        )

    def __reduce__(self) -> tuple[type, tuple[Any]]:
        return dict, (dict(self),)  # a job loads no module for it


def check_config(
    config: Mapping[str, Any],
    path: str,
    schema_path: str,
    checks: Iterable[Callable[[Mapping[str, Any]], Iterable[str]]] = (),
    unordered: Collection[str] = (),
) -> None:
    """Refuse a config that breaks its schema, or whose entries do not fit together.

    Each of the `checks`, which are of a paper, yields what is wrong with the entries. Lists of
    numbers ascend, but for those with the names `unordered`.

    Raises
    ------
    ValueError
        With one line for each fault: the file, the place, the value, and what was expected.
    """
    schema = read_schema(schema_path)
    errors = Draft202012Validator(schema).iter_errors(config)
    messages = {
        message + DRAFT * message.startswith("the top level has an unknown key")
        for error in errors
        for message in messages_of(error)
    }
    if isinstance(config, Mapping):
        messages |= {message for check in checks for message in check(config)}
    for place, value in _walk(config):
        if place.rpartition(".")[2] not in unordered:
            messages |= {*_numbers(place, value)}
    if messages:
        raise ValueError("\n".join(f"{path}: {message}" for message in sorted(messages)))


OF_SCHEMAS = {"properties", "patternProperties", "$defs"}
"""Keywords whose values have a schema for each name."""

COMBINED = {"type", "$ref", "allOf", "oneOf"}
"""With one of these, `properties` is a part of a schema, and is taken as written."""

APPLIED = OF_SCHEMAS | {"items", "additionalProperties"}


def read_schema(path: str | Path) -> Any:
    """Return the JSON schema of a file in which what is usual is left out.

    A mapping from names to schemas alone stands for `properties`. What has
    properties, and nothing of `COMBINED`, is an object without other keys, and each of them is
    `required` unless it names some. Where it has `values: package.module.NAME`, that list becomes
    its `enum`: a list that a library has is not said again.

    Raises
    ------
    ValueError
        For a name that is none of a list or tuple.
    """

    def filled(node: Any) -> Any:
        if isinstance(node, list):
            return [filled(item) for item in node]
        if not isinstance(node, dict):
            return node
        if node and not APPLIED & set(node) and all(isinstance(one, dict) for one in node.values()):
            node = {"properties": node}
        found = {
            key: {name: filled(one) for name, one in value.items()}
            if key in OF_SCHEMAS
            else filled(value)
            for key, value in node.items()
        }
        if "properties" in found and not COMBINED & set(found):
            closed = {"type": "object", "additionalProperties": False}
            found = closed | {"required": [*found["properties"]]} | found
        if isinstance(name := node.get("values"), str):
            found["enum"] = listed(name)
        return found

    def listed(name: str) -> list[Any]:
        try:
            values = pkgutil.resolve_name(name)
        except (ImportError, AttributeError, ValueError) as error:
            raise ValueError(f"{path}: values is {name!r}: {error}; expected a list") from None
        if not isinstance(values, list | tuple):
            raise ValueError(f"{path}: values is {name!r}, which is {values!r}; expected a list")
        return list(values)

    return filled(read_yaml(path))


# What the schema says ----------------------------------------------------------------------------


def messages_of(error: ValidationError) -> Iterator[str]:
    """Yield a line for each fault that a schema finds: the place, the value, what was expected."""
    place = _dotted(error.absolute_path) or "the top level"
    allowed = list(error.schema.get("properties", {})) if isinstance(error.schema, dict) else []
    match error.validator:
        case "additionalProperties":
            patterns = error.schema.get("patternProperties", {})
            for key in sorted(set(error.instance) - set(allowed), key=str):
                if not patterns:
                    yield f"{place} has an unknown key {key!r}; {hint(key, allowed)}"
                elif not any(re.search(pattern, str(key)) for pattern in patterns):
                    yield f"{place} has the name {key!r}; expected {_named(*patterns)}"
        case "oneOf":
            branches = _fitting(error)
            if len(branches) == 1:
                yield from (message for fault in branches[0] for message in messages_of(fault))
            else:
                kinds = " or ".join(
                    schema.get("title", str(schema)) for schema in error.validator_value
                )
                yield f"{place} is {error.instance!r}; expected {kinds}"
        case "required":
            missing = [key for key in error.validator_value if key not in error.instance]
            yield f"{place} lacks {', '.join(missing)}"
        case "dependentRequired":
            for key, needed in error.validator_value.items():
                missing = [other for other in needed if other not in error.instance]
                if key in error.instance and missing:
                    yield f"{place} has {key} and lacks {', '.join(missing)}"
        case bound if bound in BOUNDS:
            yield f"{place} is {error.instance}; expected {BOUNDS[bound]} {error.validator_value}"
        case "enum":
            yield f"{place} is {error.instance!r}; {hint(error.instance, error.validator_value)}"
        case "pattern":
            yield f"{place} is {error.instance!r}; expected {_named(error.validator_value)}"
        case "type":
            yield f"{place} is {error.instance!r}; expected a value of type {error.validator_value}"
        case _:
            yield f"{place} is {error.instance!r}; {error.message}"


def _fitting(error: ValidationError) -> list[list[ValidationError]]:
    """Return the faults of each branch that at least allows a value of the given type."""
    branches: dict[int | str, list[ValidationError]] = {}
    for fault in error.context or ():
        branches.setdefault(fault.relative_schema_path[0], []).append(fault)
    return [
        faults
        for faults in branches.values()
        if not any(fault.validator == "type" and not fault.relative_path for fault in faults)
    ]


def _named(*patterns: str) -> str:
    """Return what is expected of a name."""
    return " or ".join(NAMES.get(pattern, f"a text that matches {pattern}") for pattern in patterns)


# What no schema can say --------------------------------------------------------------------------


def _numbers(place: str, value: Any) -> Iterator[str]:
    """Numbers that are none, grids that do not grow, lists that do not ascend."""
    if isinstance(value, float) and math.isnan(value):
        yield f"{place} is not a number (.nan); expected a number"
    elif isinstance(value, Mapping) and {"lowest", "highest"} <= set(value):
        low, high = value["lowest"], value["highest"]
        if is_number(low) and is_number(high) and low >= high:
            yield f"{place}.highest is {high}; expected more than {place}.lowest, {low}"
    elif isinstance(value, list):
        numbers = [item for item in value if is_number(item)]
        if any(first >= second for first, second in pairwise(numbers)):
            yield (
                f"{place} is {value}; expected numbers in ascending order; write a vector as a "
                "mapping, { x: 1, y: 0 }"
            )


def _walk(value: Any, *path: str | int) -> Iterator[tuple[str, Any]]:
    yield _dotted(path), value
    items = enumerate(value) if isinstance(value, list) else ()
    for key, item in value.items() if isinstance(value, Mapping) else items:
        yield from _walk(item, *path, key)


def _dotted(path: Iterable[str | int]) -> str:
    return ".".join(str(part) for part in path)


def is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def mapping_in(parent: Any, key: Any) -> Mapping[str, Any]:
    """Return an entry if it is a mapping, or else an empty one: the schema has told of it."""
    entry = parent.get(key) if isinstance(parent, Mapping) else None
    return entry if isinstance(entry, Mapping) else {}


def main(paths: Iterable[str]) -> str | None:
    """Return what is wrong with schemas, or with the files beside them that they are of."""
    for path in paths:
        schema, of = read_schema(path), path.replace(".schema.yaml", ".yaml")
        Draft202012Validator.check_schema(schema)
        for error in Draft202012Validator(schema).iter_errors(read_yaml(of)):
            return f"{of}: {', '.join(messages_of(error))}"
    return None


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
