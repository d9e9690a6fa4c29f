"""Refuse a workflow that reads a result which no rule makes.

Snakemake takes a file that no rule makes as an input of the user. A result that an earlier workflow
left behind would then go into the report, and it would never be computed again.
"""

from collections.abc import Callable, Collection, Iterable
from pathlib import Path
from typing import Any

from replication.inputs.suggestions import hint

RESULTS = "results/"


def made_by(rules: Iterable[Any]) -> Callable[[str], bool]:
    """Return the function that tells whether one of Snakemake's rules makes a file, by its path."""
    outputs = [output for rule in rules for output in rule.output]
    return lambda path: any(output.match(path) for output in outputs)


def refuse_unmade(rules: Iterable[Any], tables: Collection[str], reference: Path) -> None:
    """Refuse rules of Snakemake, or figures, that read a file in results/ which no rule makes.

    The figures read `tables`. The workflow compares a table with each published one (`reference`).

    Raises
    ------
    ValueError
        With one line for each such file: who reads it, and how to put it right.
    """
    rules = list(rules)
    is_made = made_by(rules)
    unmade = {
        (path, _reader(rule, path))
        for rule in rules
        for path in _paths(rule.input)
        if not is_made(path)
    }
    drawn = {f"{RESULTS}tables/{name}.csv" for name in tables}
    unmade |= {(path, "a figure") for path in drawn if not is_made(path)}
    others = [path for rule in rules for path in _paths(rule.output)]
    faults: dict[str, str] = {}
    for path, reader in sorted(unmade):
        advice = _advice(path, others, reference)
        faults.setdefault(path, f"{reader} reads {path}, which no rule makes; {advice}")
    if faults:
        raise ValueError("\n".join(faults.values()))


def _reader(rule: Any, path: str) -> str:
    """Return which rule reads a file, and the text or notebook among its inputs that names it."""
    texts = [Path(each) for each in map(str, rule.input) if each.endswith((".typ", ".ipynb"))]
    name = f'"{Path(path).stem}"'
    named = [p.as_posix() for p in texts if p.is_file() and name in p.read_text(encoding="utf-8")]
    return f"rule {rule.name}" + (f" ({', '.join(named)})" if named else "")


def _paths(files: Iterable[Any]) -> list[str]:
    """Return those of the inputs or outputs of a rule that are plain paths in results/."""
    return [path for path in map(str, files) if path.startswith(RESULTS) and "{" not in path]


def _advice(path: str, others: Iterable[str], reference: Path) -> str:
    published = reference / Path(path).name
    if published.is_file():
        return f"delete {published.as_posix()} if the workflow no longer makes this table"
    beside = sorted(Path(each).stem for each in others if Path(each).parent == Path(path).parent)
    return hint(Path(path).stem, beside) if beside else "expected the output of a rule"
