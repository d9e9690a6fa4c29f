"""Read YAML files strictly: an error names the file and line of a mistake."""

from contextlib import suppress
from pathlib import Path
from typing import Any

import yaml

MERGE = "tag:yaml.org,2002:merge"
"""The tag of `<<`, which merges another mapping."""


MOST_LEVELS = 100
"""Of lists and mappings within each other. Python stops at a thousand, and PyYAML crashes later."""

MOST_PARTS = 100_000
"""Values and keys of a file, each alias counted as all of the value that it names."""


class _Strict:
    """Of a safe loader, which keeps the last of equal keys: an error for the second one."""

    def construct_mapping(self: Any, node: yaml.MappingNode, deep: bool = False) -> dict[Any, Any]:
        first_lines: dict[Any, int] = {}
        for key_node, _ in node.value:
            if key_node.tag == MERGE or not isinstance(key_node, yaml.ScalarNode):
                continue  # what is no scalar, PyYAML refuses
            key, line = self.construct_object(key_node), key_node.start_mark.line + 1
            if key in first_lines:
                raise yaml.constructor.ConstructorError(
                    problem=f"the key {key!r} is given twice, first in line {first_lines[key]}; "
                    "expected each key once",
                    problem_mark=key_node.start_mark,
                )
            first_lines[key] = line
        return super().construct_mapping(node, deep)


class _Loader(_Strict, yaml.SafeLoader):
    """Its errors say more than those of the compiled one."""


class _Compiled(_Strict, getattr(yaml, "CSafeLoader", yaml.SafeLoader)):
    """Ten times as fast, where PyYAML was built with it."""


_Parser = getattr(yaml, "CSafeLoader", yaml.SafeLoader)


def read_yaml(path: str | Path) -> Any:
    """Return the content of a YAML file.

    Raises
    ------
    ValueError
        With file and line: for a mapping that has a key twice, a fault of the syntax, a byte that
        is not UTF-8, an alias within the value that it names, more than MOST_LEVELS or MOST_PARTS.
        With the file: when it is empty.
    """
    data = Path(path).read_bytes()
    try:
        text = data.decode("utf-8-sig")
        _check_extent(path, text)
        try:
            content = yaml.load(text, _Compiled)
        except yaml.YAMLError:
            content = yaml.load(text, _Loader)
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        raise ValueError(
            f"{path}, line {line}: the byte 0x{data[error.start]:02x} is not UTF-8; "
            "expected a file that is saved in UTF-8"
        ) from None
    except yaml.reader.ReaderError as error:
        line = data.decode("utf-8-sig").count("\n", 0, error.position) + 1
        raise ValueError(
            f"{path}, line {line}: the character {chr(error.character)!r} is not allowed in YAML; "
            "expected text"
        ) from None
    except yaml.MarkedYAMLError as error:
        raise ValueError(f"{path}, {_in_words(error)}") from None
    if content is None:
        raise ValueError(f"{path} is empty; expected YAML")
    return content


def read_word(word: str) -> Any:
    """Return what YAML reads where a list or mapping contains this word, such as True of `on`."""
    return yaml.load(word, _Compiled)


def _check_extent(path: str | Path, text: str) -> None:
    """Refuse what would take too long to follow: aliases of aliases, and what has no end.

    A fault of the syntax ends the check, and is left to the loader.
    """
    within: list[tuple[str | None, int]] = []  # the anchor of what is open, the parts before it
    extents: dict[str, int] = {}  # of what an anchor names
    parts, problem = 0, ""
    with suppress(yaml.YAMLError):
        for event in yaml.parse(text, Loader=_Parser):
            match event:
                case yaml.AliasEvent(anchor=name):
                    if name in (anchor for anchor, _ in within):
                        problem = (
                            f"the alias *{name} is within the value that it names, which then has "
                            "no end; expected an alias of another value"
                        )
                    parts += extents.get(name, 0)
                case yaml.ScalarEvent(anchor=name):
                    parts += 1
                    if name:
                        extents[name] = 1
                case yaml.CollectionStartEvent(anchor=name):
                    within.append((name, parts))
                    parts += 1
                case yaml.CollectionEndEvent():
                    name, before = within.pop()
                    if name:
                        extents[name] = parts - before
            if len(within) > MOST_LEVELS:
                problem = (
                    f"more than {MOST_LEVELS} lists and mappings are within each other; expected "
                    "fewer: is a bracket missing?"
                )
            if parts > MOST_PARTS:
                problem = (
                    f"the file has more than {MOST_PARTS} values and keys up to here, each alias "
                    "(*name) counted as all of its value; expected fewer"
                )
            if problem:
                raise ValueError(f"{path}, line {event.start_mark.line + 1}: {problem}")


def _in_words(error: yaml.MarkedYAMLError) -> str:
    """Return where YAML is wrong, what is wrong, and within what."""
    line = f"line {error.problem_mark.line + 1}: {error.problem}"
    if error.context is None:
        return line
    begin = error.context_mark.line + 1 if error.context_mark else None
    within = f"{error.context}, which begins in line {begin}" if begin else error.context
    return (
        f"{line} ({within}); expected YAML, indented by spaces, each bracket and quote closed again"
    )
