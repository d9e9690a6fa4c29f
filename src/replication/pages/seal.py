"""The seal of the published edition: the checksums of its files, and of what it was made from."""

from collections.abc import Iterable, Iterator
from contextlib import suppress
from pathlib import Path

from replication.inputs.checksums import sha256

SEAL = "docs/checksums.txt"
EDITION = ("docs", "tests/reference")
"""The folders of the published files."""
SOURCES = ("config", "data", "figures", "notebooks", "paper", "src/explorer", "studies")
"""The folders of the inputs and texts."""
TOP = ("CITATION.cff", "README.md", "codecheck.yml", "docs/exhibits.md")
"""Texts beside these; the last two are those of `make publish`."""
OLDER = "the edition is older than"
"""With this begins the line of an input or text that changed since."""
VERDICTS = "docs/verdicts.md"
"""Not sealed: it follows from the published rows line by line, by `make publish`."""
KINDS = {
    *(".bib", ".cff", ".css", ".html", ".ipynb", ".js", ".md", ".mplstyle", ".typ"),
    *(".AT2", ".csv", ".txt", ".yaml"),
}
"""The endings of inputs and texts; code and what a run writes beside them is neither."""
MADE_FROM = "# What it was made from"
HEAD = f"""\
# The published edition, by `make publish`: SHA-256 of each file, of a text with Python's line ends
{{edition}}{MADE_FROM}
{{sources}}"""


def seal(root: Path = Path()) -> None:
    """Write the checksums of the edition that is there, and of what is there to make it from."""
    edition, sources = map(_lines, (_edition(root), _sources(root)))
    (root / SEAL).write_text(HEAD.format(edition=edition, sources=sources), encoding="utf-8")


def broken(root: Path = Path()) -> Iterator[str]:
    """Yield the published files that changed since they were sealed."""
    listed = {name: value for name, value in _sealed(root)[0].items() if name != VERDICTS}
    for name, kind in _changes(listed, _edition(root)):
        yield f"{name} {kind} since `make publish`: held against {SEAL}"


def outdated(root: Path = Path()) -> Iterator[str]:
    """Yield the inputs and texts that changed since the edition was made."""
    for name, kind in _changes(_sealed(root)[1], _sources(root)):
        yield f"{OLDER} {name}, which {kind} since `make publish`"


def checksum(path: Path) -> str:
    """Return the SHA-256 of a file; of a text with Python's line ends, whatever the checkout's."""
    content = path.read_bytes()
    with suppress(UnicodeDecodeError):  # a picture or a PDF
        content = content.decode("utf-8").replace("\r\n", "\n").encode()
    return sha256(content)


def digest(folder: Path) -> str:
    """Return one SHA-256 of all files of a folder, of a list as `sha256sum` writes it."""
    return sha256(_lines(_checksums(folder, folder.rglob("*"))).encode())


def _edition(root: Path) -> dict[str, str]:
    found = _checksums(root, (path for name in EDITION for path in (root / name).rglob("*")))
    return {name: value for name, value in found.items() if name not in (*TOP, VERDICTS)}


def _sources(root: Path) -> dict[str, str]:
    found = (path for name in SOURCES for path in (root / name).rglob("*"))
    texts = (path for path in found if path.suffix in KINDS)
    return _checksums(root, [*texts, *(root / name for name in TOP)])


def _checksums(root: Path, paths: Iterable[Path]) -> dict[str, str]:
    named = {path.relative_to(root).as_posix(): path for path in paths if path.is_file()}
    return {name: checksum(named[name]) for name in sorted(named) if name != SEAL}


def _lines(found: dict[str, str]) -> str:
    return "".join(f"{value}  {name}\n" for name, value in found.items())


def _sealed(root: Path) -> list[dict[str, str]]:
    """Return what is listed of the edition, and of what it was made from."""
    path = root / SEAL
    parts = path.read_text(encoding="utf-8").split(MADE_FROM)
    if len(parts) != 2:
        raise ValueError(
            f"{path} has {len(parts) - 1} lines {MADE_FROM!r}; expected one: restore it"
        )
    rows = [
        [line.split("  ", 1) for line in part.splitlines() if line[:1] != "#"] for part in parts
    ]
    return [{row[1]: row[0] for row in of_part if len(row) == 2} for of_part in rows]


def _changes(listed: dict[str, str], there: dict[str, str]) -> Iterator[tuple[str, str]]:
    for name in sorted({*listed, *there}):
        if name not in there:
            yield name, "is gone"
        elif name not in listed:
            yield name, "is new"
        elif listed[name] != there[name]:
            yield name, "changed"
