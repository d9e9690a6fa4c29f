"""What a JSON schema says of a key: its entry, resolved, and its unit."""

import re
from collections.abc import Mapping
from typing import Any


def entry_of(schema: Mapping[str, Any], name: str) -> Mapping[str, Any]:
    """Return the schema of an entry of a mapping."""
    if name in schema.get("properties", {}):
        return schema["properties"][name]
    for pattern, found in schema.get("patternProperties", {}).items():
        if re.search(pattern, name):
            return found
    other = schema.get("additionalProperties")
    return other if isinstance(other, Mapping) else {}


def resolved(schema: Mapping[str, Any], root: Mapping[str, Any]) -> dict[str, Any]:
    """Return a schema with what it refers to, over which its own entries go."""
    parts = [dict(schema)]
    for other in schema.get("allOf", []):
        parts.insert(0, resolved(other, root))
    if "$ref" in schema:
        parts.insert(0, resolved(root["$defs"][schema["$ref"].removeprefix("#/$defs/")], root))
    merged: dict[str, Any] = {}
    for part in parts:
        properties = dict(merged.get("properties", {}))
        for name, own in part.get("properties", {}).items():
            properties[name] = {"allOf": [properties[name], own]} if name in properties else own
        merged |= part | ({"properties": properties} if properties else {})
    return merged


def unit_of(schema: Mapping[str, Any], root: Mapping[str, Any]) -> str:
    """Return the unit that a schema states for itself, or for the items of its list."""
    schema = resolved(schema, root)
    return schema.get("unit") or (unit_of(schema["items"], root) if "items" in schema else "")


def has_numbers(schema: Mapping[str, Any], root: Mapping[str, Any]) -> bool:
    """Return whether a schema is that of numbers, which have a unit; whole numbers count."""
    schema = resolved(schema, root)
    inner = [*schema.get("oneOf", []), *([schema["items"]] if "items" in schema else [])]
    return schema.get("type") == "number" or any(has_numbers(each, root) for each in inner)
