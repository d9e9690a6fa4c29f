"""Copy the results of a finished run to docs/ and tests/reference/, with checksums: make publish"""

import hashlib
import json
import shutil
import subprocess
import sys
from collections.abc import Iterable
from pathlib import Path

from documents import shown
from documents.check import DOCS, REFERENCE, SUMS
from replication.config import read_config
from replication.sections import Paper
from replication.verdicts import unexpected

CLAIMS = Path("results/claims.json")

PAGES = {
    "paper/report.pdf": "report.pdf",
    "paper/supplement.pdf": "supplement.pdf",
    "results/verdicts.md": "verdicts.md",
    "results/numbers.md": "numbers.md",
    "results/explorer.html": "explorer.html",
    "results/functions.html": "functions.html",
    "results/animation.gif": "animation.gif",
}
PICTURES = ["structures", "parameters", "trilith", "allen", "vase", "where", "motions"]
"""Figures of README."""


def copies() -> dict[Path, Path]:
    """Return what is published, and where: pages, notebooks, and the tables that findings need."""
    rules = json.loads(Path("results/rules.json").read_text("utf-8"))
    tables = {
        path
        for rule in rules.values()
        if rule["findings"]
        for path in [*rule["tables"], *rule["reads"]]
    }
    targets = {Path(source): DOCS / name for source, name in PAGES.items()}
    targets |= {
        page: DOCS / f"notebook_{page.name}" for page in Path("results/notebooks").glob("*.html")
    }
    targets |= {Path(f"figures/{name}.svg"): DOCS / f"{name}.svg" for name in PICTURES}
    targets |= {Path(path): REFERENCE / Path(path).name for path in sorted(tables)}
    return targets | {
        Path("results") / name: REFERENCE / name for name in ("rules.json", "settings.json")
    }


def refuse(paths: Iterable[Path]) -> None:
    """Stop unless a run of config/config.yaml is up to date and has judged its own tables.

    Its tables may differ from the published ones, since these are replaced. The Snakefile refuses
    a table or finding that was edited.
    """
    if wrong := unexpected(json.loads(CLAIMS.read_text("utf-8"))):
        raise SystemExit("\n".join(wrong))
    used = json.loads(Path("results/settings.json").read_text("utf-8"))["paper/claims.yaml"]
    if used != json.loads(json.dumps(read_config("config/config.yaml", Paper))):
        raise SystemExit("results/ is not of config/config.yaml as it is now: make reproduce")
    command = [sys.executable, "-m", "snakemake", "--dry-run", *map(str, [CLAIMS, *paths])]
    answer = subprocess.run(command, capture_output=True, text=True)
    if "Nothing to be done" not in answer.stdout + answer.stderr:
        raise SystemExit(
            "results/ is not up to date with this tree: make reproduce (snakemake -n says why)"
        )


def main() -> None:
    finished = [Path("results/rules.json"), Path("results/settings.json"), CLAIMS]
    if missing := [path for path in finished if not path.is_file()]:
        raise SystemExit(f"there is no {missing[0]}; expected a finished run: make reproduce")
    targets = copies()
    refuse(targets)
    for path in REFERENCE.rglob("*"):
        if path.is_file() and path not in targets.values():
            path.unlink()
    for source, target in targets.items():
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(source, target)
    shown.write()
    sums = [
        path for folder in (DOCS, REFERENCE) for path in sorted(folder.rglob("*")) if path.is_file()
    ]
    lines = [f"{hashlib.sha256(p.read_bytes()).hexdigest()}  {p}\n" for p in sums if p != SUMS]
    SUMS.write_text("".join(lines), "utf-8")
    print(f"{len(targets)} files are published; read the diff, mend README's numbers, then commit")


if __name__ == "__main__":
    main()
