"""Read YAML and configs, and say what is wrong with a mistake."""

import re
from difflib import get_close_matches
from pathlib import Path
from typing import Any

import yaml
from pydantic import BaseModel, ValidationError

VERTICAL = re.compile(
    r"([-_. ](UP|DN|DOWN|DWN|UD|V|VRT|VER|VERT|Z)|[BEHS][HLN]Z)\.(AT2|CSV)$", re.IGNORECASE
)
"""How the name of a vertical component ends, by the habits of PEER, ESM, K-NET and others."""


def components(folder: str) -> tuple[list[str], list[str]]:
    """Return the records in a folder that count as horizontal, and those that are vertical."""
    names = sorted(map(str, Path(folder).iterdir()))
    records = [name for name in names if name.lower().endswith((".at2", ".csv"))]
    vertical = [name for name in records if VERTICAL.search(name)]
    return [name for name in records if name not in vertical], vertical


class _Once(yaml.SafeLoader):
    """A loader that refuses a doubled key."""

    def construct_mapping(self, node: Any, deep: bool = False) -> Any:
        keys = [key.value for key, _ in node.value]
        for key in keys:
            if keys.count(key) > 1:
                line = max(k.start_mark.line for k, _ in node.value if k.value == key) + 1
                raise SystemExit(f"{node.start_mark.name}:{line}: the key '{key}' is there twice")
        return super().construct_mapping(node, deep)


def read_yaml(path: str | Path) -> Any:
    """Return the content of a YAML file; a doubled key or another mistake ends the program."""
    try:
        with Path(path).open(encoding="utf-8") as file:
            return yaml.load(file, _Once)
    except FileNotFoundError:
        raise SystemExit(f"there is no file {path}") from None
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        mark, problem = getattr(error, "problem_mark", None), getattr(error, "problem", error)
        raise SystemExit(
            f"{path}{f':{mark.line + 1}' if mark else ''}: {problem}; expected lines `key: value`, "
            "indented by blanks, with each bracket and quote closed: mend this line or one above"
        ) from None


def read_config(path: str, model: type[BaseModel], content: Any = None) -> dict[str, Any]:
    """Return a checked config; a mistake ends the program with file, key, value and expectation."""
    content = read_yaml(path) if content is None else content
    names = content.get("structures") if isinstance(content, dict) else ()
    names = names if isinstance(names, dict) else ()
    try:
        return model.model_validate(content, context=names).model_dump()
    except ValidationError as errors:
        raise SystemExit(
            "\n".join(f"{path}: {_message(e, model)}" for e in errors.errors())
        ) from None


def _message(error: Any, model: type[BaseModel]) -> str:
    key = ".".join(str(part) for part in error["loc"])
    if error["type"] == "extra_forbidden":
        near = get_close_matches(str(error["loc"][-1]), names_of(model), n=1)
        return f"unknown key '{key}'" + (f"; did you mean '{near[0]}'?" if near else "; remove it")
    if error["type"] == "invalid_key":
        where, _, name = key.rpartition(".")
        return f"{where} has the key {name}; expected a name. A number has a point: 3.00, not 3,00"
    if error["type"] == "missing":
        return f"the key '{key}' is missing"
    entry, expected = error["input"], error["msg"].removeprefix("Value error, ")
    if not key:  # the sections contradict each other
        return expected
    comma = ""
    if (
        isinstance(entry, str)
        and entry.replace(",", "", 1).replace(".", "", 1).strip("+-").isdigit()
    ):
        comma = ": a decimal point, and no quotes" if "," in entry else ": without quotes"
    return f"{key} is {entry!r}; {expected[0].lower()}{expected[1:]}{comma}"


def names_of(model: type[BaseModel]) -> list[str]:
    """Return the keys of a model and of the models inside it."""
    schema = model.model_json_schema()
    parts = [schema, *schema.get("$defs", {}).values()]
    return [name for part in parts for name in part.get("properties", ())]
