"""Check what is published, without a run: make check

Files have the checksums of docs/SHA256SUMS. Parameters are those of config/config.yaml. Findings
are drawn again from the tables by the steps that drew them, every claim is judged again, and
pictures, documents, lists, both pages and the animation are made again. README's links lead to the
numbers that they show.
"""

import hashlib
import json
import runpy
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from documents.stated import misstated, unsaid
from replication.claims import read_claims
from replication.config import components, read_config, read_yaml
from replication.sections import Paper
from replication.sources import checksums
from replication.step import call
from replication.verdicts import counts, judged, unexpected

REFERENCE, DOCS = Path("tests/reference"), Path("docs")
SUMS = DOCS / "SHA256SUMS"
MEND = "make reproduce && make publish"


def read(name: str) -> dict[str, Any]:
    """Return what is published of the run: `rules` or `settings`."""
    return json.loads((REFERENCE / f"{name}.json").read_text("utf-8"))


def findings(rules: dict[str, Any], folder: Path = REFERENCE) -> dict[str, dict[str, Any]]:
    """Return the findings of each rule, by its script, from the tables in a folder."""
    by_rule = {}
    for name, rule in rules.items():
        if rule["findings"]:
            paths = [folder / Path(path).name for path in [*rule["reads"], *rule["tables"]]]
            tables = {path.stem: str(path) for path in paths}
            by_rule[name] = call(
                runpy.run_path(rule["script"])["findings"], name, tables, rule["params"]
            )
    return by_rule


def published(by_rule: dict[str, dict[str, Any]] | None = None) -> list[dict[str, Any]]:
    """Return every claim with its verdict, from the findings of the published tables."""
    by_rule = by_rule or findings(read("rules"))
    return [
        judged(c, by_rule)
        for path, known in read("settings").items()
        for c in read_claims(path, known)
    ]


def unsealed() -> Iterator[str]:
    """Yield each published file without its checksum, and each checksum without its file."""
    lines = [line.split("  ", 1) for line in SUMS.read_text("utf-8").splitlines()]
    sums = {path: digest for digest, path in lines}
    files = {str(p) for folder in (DOCS, REFERENCE) for p in folder.rglob("*") if p.is_file()}
    for path in sorted(files - {str(SUMS)} | set(sums)):
        if path not in files:
            yield f"{SUMS} names {path}, which is not there: {MEND}"
        elif path not in sums:
            yield f"{path} is not in {SUMS}: {MEND}"
        elif hashlib.sha256(Path(path).read_bytes()).hexdigest() != sums[path]:
            yield f"{path} has not the checksum of {SUMS}: git checkout {path}, or {MEND}"


def of_another_run() -> Iterator[str]:
    """Yield each published parameter that the config lacks, and each table of another run."""
    config = json.loads(json.dumps(read_config("config/config.yaml", Paper)))
    for settings in read("settings").values():
        if others := [name for name in config if settings.get(name) != config[name]]:
            yield f"{REFERENCE}/settings.json: other {', '.join(others)} than the config: {MEND}"
    texts = {json.dumps(part, sort_keys=True) for part in _parts(config)}
    for rule, entry in read("rules").items():
        for name, content in entry["params"].items():
            if name != "counts" and json.dumps(content, sort_keys=True) not in texts:
                yield f"{REFERENCE}/rules.json: {name} of {rule} is not in the config: {MEND}"
        for path in entry["tables"] if entry["findings"] else []:
            table = REFERENCE / Path(path).name
            if entry.get("sums", {}).get(path) not in checksums([table]).values():
                yield f"{table} is not the table that its run wrote, by rules.json: {MEND}"
        if entry["sources"] != checksums(entry["sources"]):
            yield f"{REFERENCE}/rules.json: another {', '.join(entry['sources'])} of {rule}: {MEND}"


def _parts(content: Any) -> Iterator[Any]:
    """Yield a content of a config and all that is in it."""
    yield content
    if isinstance(content, dict | list):
        for part in content.values() if isinstance(content, dict) else content:
            yield from _parts(part)


def rewritten(
    rows: list[dict[str, Any]], results: dict[str, dict[str, Any]], *names: str
) -> Iterator[str]:
    """Yield each published file, of some names, that tables and sources give otherwise."""
    from documents import animation, explorer, functions, lists, publish, remade

    config, style = read_config("config/config.yaml", Paper), "figures/style.mplstyle"
    film = config["animation"], config["structures"]["temple"]
    record = "data/records/el_centro_1940_NS.AT2"
    records, _ = components("data/records")
    library = style, records, "paper/site/site.css"
    run = lists.Run(rows, read_yaml("figures/captions.yaml"))
    pages = {
        "verdicts.md": lambda: lists.claims(run, lists.Docs()),
        "explorer.html": lambda: explorer.compute(record)["page"],
        "functions.html": lambda: functions.compute(*library)["page"],
        "animation.gif": lambda: animation.compute(*film, style)["gif"],
    }
    others = ["numbers.md", "report.pdf", "supplement.pdf", *map("{}.svg".format, publish.PICTURES)]
    contents = {name: pages[name]() for name in names or pages if name in pages}
    if wanted := [name for name in names or others if name not in pages]:
        with tempfile.TemporaryDirectory() as folder:
            documents = remade.remade(Path(folder), config, read("rules"), results, rows, REFERENCE)
        contents |= {name: documents[name] for name in wanted}
        yield from unsaid(documents["report.html"], rows)
    for name, content in contents.items():
        lines = (content.encode() if isinstance(content, str) else content).split(b"\n")
        shown = (DOCS / name).read_bytes().split(b"\n")
        if shown != lines:
            pairs = zip([*shown, b""], [*lines, b""], strict=False)
            number = next((n for n, pair in enumerate(pairs, 1) if pair[0] != pair[1]), len(lines))
            yield f"{DOCS / name}, line {number}, is not what tables and sources give: {MEND}"


def faults(results: dict[str, dict[str, Any]]) -> Iterator[str]:
    """Yield a line for each thing that is published and is not as it should be."""
    rows = published(results)
    yield from unsealed()
    yield from of_another_run()
    yield from unexpected(rows)
    yield from misstated(results, rows)
    yield from rewritten(rows, results)


if __name__ == "__main__":
    results = findings(read("rules"))
    if wrong := [*faults(results)]:
        raise SystemExit("\n".join(wrong))
    print(*counts(published(results)), sep="\n")
    print("Each verdict, from the published tables, is the one that paper/claims.yaml expects.")
