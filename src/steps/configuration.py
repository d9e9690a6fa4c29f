"""The check of config.yaml against its schema, with messages that a person can act on."""

import difflib
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import yaml
from jsonschema import Draft202012Validator, ValidationError


def check_config(config: Mapping[str, Any], path: str, schema_path: str) -> None:
    """Refuse a config that breaks its schema.

    Raises
    ------
    ValueError
        With one line for each fault: the file, the place, the value, and what was expected.
    """
    schema = yaml.safe_load(Path(schema_path).read_text(encoding="utf-8"))
    faults = sorted(
        f"{path}: {message}"
        for error in Draft202012Validator(schema).iter_errors(config)
        for message in _messages(error)
    )
    if faults:
        raise ValueError("\n".join(faults))


def _messages(error: ValidationError) -> Iterator[str]:
    place = ".".join(str(part) for part in error.absolute_path) or "the top level"
    allowed = list(error.schema.get("properties", {})) if isinstance(error.schema, dict) else []
    match error.validator:
        case "additionalProperties":
            for key in sorted(set(error.instance) - set(allowed)):
                close = difflib.get_close_matches(str(key), allowed, n=1)
                hint = f"did you mean {close[0]!r}?" if close else f"expected {', '.join(allowed)}"
                yield f"{place} has an unknown key {key!r}; {hint}"
        case "required":
            missing = [key for key in error.validator_value if key not in error.instance]
            yield f"{place} lacks {', '.join(missing)}"
        case "minimum":
            yield f"{place} is {error.instance}; expected at least {error.validator_value}"
        case "maximum":
            yield f"{place} is {error.instance}; expected at most {error.validator_value}"
        case "exclusiveMinimum":
            yield f"{place} is {error.instance}; expected more than {error.validator_value}"
        case "exclusiveMaximum":
            yield f"{place} is {error.instance}; expected less than {error.validator_value}"
        case "enum":
            expected = ", ".join(map(str, error.validator_value))
            yield f"{place} is {error.instance!r}; expected one of {expected}"
        case "type":
            yield f"{place} is {error.instance!r}; expected a value of type {error.validator_value}"
        case _:
            yield f"{place} is {error.instance!r}; {error.message}"
