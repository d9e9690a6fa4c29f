"""Find results that nobody reads: `make lint`. Each is one more place that nobody watches.

A published finding has a reader if a row, a document, a page or a check takes it; a key of the
config or a column of a published table, if a source has its name, or a text from which it is made.
paper/unread.yaml, if there is one, names keys and columns that are read in another way, with why.
"""

import ast
import csv
import fnmatch
import json
import re
import sys
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

from replication.inputs.parts import PAPER, ledger_of
from replication.inputs.strict_yaml import read_yaml
from replication.judging.ledger import read_ledger
from replication.judging.readers import Name, having_readers

EXCEPTIONS = Path("paper/unread.yaml")
MOST = 20
"""So many exceptions, and no more."""
CHECKS = re.compile(r"^CHECKS \|?= (\{.*?\})$", re.MULTILINE | re.DOTALL)
SOURCES = ("Snakefile", "src/**/*.py", "src/**/*.smk", "studies/**/*.py", "studies/**/*.smk")
TEXTS = ("paper/*.typ", "paper/claims.yaml", "studies/**/*.typ", "studies/*/claims.yaml")
SHOWN = ("figures/*.py", "notebooks/*.ipynb")
NOT_OURS = ("src/*/tests/", "src/replication/template/", "studies/*/tests/")


def texts(root: Path, patterns: Iterable[str]) -> dict[str, str]:
    """Return the texts of files by their paths, without tests."""
    found = (path for pattern in patterns for path in sorted(root.glob(pattern)))
    names = (path.relative_to(root).as_posix() for path in found)
    mine = [name for name in names if not any(fnmatch.fnmatch(name, f"{no}*") for no in NOT_OURS)]
    return {name: (root / name).read_text(encoding="utf-8") for name in mine}


def unread_findings(root: Path, sources: Mapping[str, str]) -> list[Name]:
    """Return the published findings that no row, document, page or check takes."""
    names = read_yaml(root / "config/config.yaml").get("studies") or []
    ledgers = [root / ledger_of(name) for name in (PAPER, *names)]
    claims = [*read_ledger(ledgers[:1]), *read_ledger(ledgers)]  # a study may rewrite a row
    checks: dict[str, list[str]] = {}
    for text in sources.values():
        for found in CHECKS.findall(text):
            checks |= ast.literal_eval(found)
    known = having_readers(claims, checks, sources)
    published = {
        (path.stem, name)
        for path in (root / "tests/reference/findings").glob("*.json")
        for name in json.loads(path.read_text(encoding="utf-8"))
        if name not in {"called", "not_tested"}
    }
    return sorted(published - known)


class Words:
    """The words of sources, and the shapes of names that their f-strings make."""

    def __init__(self, sources: Iterable[str]) -> None:
        self.words: set[str] = set()
        made: set[str] = set()
        for text in sources:
            self.words |= {*re.findall(r"[\w-]+", text), *re.findall(r'"([^"\n]+)"', text)}
            made |= {*re.findall(r'f"((?:\w|\{[^{}"]*\})*_(?:\w|\{[^{}"]*\})*)"', text)}
        shapes = {re.sub(r"\{[^{}]*\}", "*", shape) for shape in made if "{" in shape}
        self.shapes = [shape for shape in shapes if re.search(r"[a-z]{3}", shape)]

    def __contains__(self, name: str) -> bool:
        return name in self.words or any(fnmatch.fnmatch(name, shape) for shape in self.shapes)


def keys(section: Mapping[str, Any], above: str = "") -> Iterator[tuple[str, str]]:
    """Yield every key of a config with its path."""
    for key, value in section.items():
        yield f"{above}{key}", str(key)
        if isinstance(value, Mapping):
            yield from keys(value, f"{above}{key}.")


def faults(root: Path = Path()) -> Iterator[str]:
    """Yield what nobody reads, and exceptions that nothing needs."""
    sources = texts(root, (*SOURCES, *TEXTS))
    for rule, name in unread_findings(root, sources):
        yield (
            f"finding {rule}.{name} has no reader; expected a row, a text, or an entry in CHECKS "
            "that names it, or no such finding"
        )
    words = Words([*sources.values(), *texts(root, SHOWN).values()])
    unread: dict[str, str] = {}
    for path in sorted([*root.glob("config/config.yaml"), *root.glob("studies/*/config.yaml")]):
        lost = (key for key, name in keys(read_yaml(path)) if name not in words)
        unread |= {f"{path.relative_to(root)}: {key}": "key" for key in lost}
    for path in sorted(root.glob("tests/reference/**/*.csv")):
        with path.open(encoding="utf-8", newline="") as file:
            columns = next(csv.reader(file))
        lost = (name for name in columns if name not in words)
        unread |= {f"{path.relative_to(root)}: {name}": "column" for name in lost}
    listed = read_yaml(root / EXCEPTIONS) if (root / EXCEPTIONS).exists() else {}
    for entry, kind in unread.items():
        if not any(fnmatch.fnmatch(entry, pattern) for pattern in listed):
            yield (
                f"{entry}: no source reads this {kind}; remove it, or say in {EXCEPTIONS} what does"
            )
    for pattern in listed:
        if not fnmatch.filter(unread, pattern):
            yield f"{EXCEPTIONS}: '{pattern}' is of no use: what it names has a reader, or is gone"
    if len(listed) > MOST:
        yield f"{EXCEPTIONS} has {len(listed)} entries; expected at most {MOST}"


if __name__ == "__main__":
    sys.exit("\n".join(faults()) or None)
