"""The page beside a config: every key with its unit, bounds, value and source."""

import re
from itertools import groupby
from pathlib import Path

from replication.inputs.config_keys import Key, comments, keys, one_line

HEAD = "| key | meaning | unit | allowed | value | source or remark |"


def config_page(path: Path) -> str:
    """Return the page of a config, a table for each section; config.schema.yaml lies beside it."""
    text = path.read_text(encoding="utf-8")
    said = comments(text)
    study = f" of the study {path.parent.name}" if path.parent.parent.name == "studies" else ""
    lines = [
        f"# The input numbers{study}",
        "",
        f"`make pages` writes this page from `{path.name}` and `config.schema.yaml`: change those.",
        'The unit "1" marks a number without dimension. A run refuses a value that is not allowed.',
        *(["", head] if (head := _head(text)) else []),
    ]
    for section, found in groupby(keys(path), lambda key: re.split(r"[.\[]", key.place)[0]):
        lines += ["", f"## {section}", ""]
        lines += [said[section], ""] if section in said else []
        lines += [HEAD, "|---" * 6 + "|", *map(_row, found)]
    return "\n".join(lines) + "\n"


def _head(text: str) -> str:
    """Return the comment at the head of a file, which an empty line separates from the rest."""
    lines = text.partition("\n\n")[0].splitlines()
    if not all(line.startswith("#") for line in lines):
        return ""
    return one_line(" ".join(line.removeprefix("#") for line in lines))


def _row(key: Key) -> str:
    value = f"`{key.value}`" if key.value else ""
    cells = (f"`{key.place}`", key.meaning, key.unit, key.allowed, value, key.source)
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"
