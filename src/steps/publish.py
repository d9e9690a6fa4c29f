"""Copy the results of a finished run to docs/ and tests/reference/, with checksums: make publish"""

import gzip
import hashlib
import json
import shutil
from pathlib import Path

from replication.claims import unexpected
from replication.config import read_config
from replication.sections import Paper

REFERENCE, DOCS = Path("tests/reference"), Path("docs")

PAGES = {
    "paper/report.pdf": "report.pdf",
    "paper/supplement.pdf": "supplement.pdf",
    "results/verdicts.md": "verdicts.md",
    "results/explorer.html": "explorer.html",
    "results/animation.gif": "animation.gif",
    "results/certificates/proven.jsonl": "certificates.jsonl.gz",
}
PICTURES = ["structures", "parameters", "trilith", "allen", "vase", "where", "motions"]  # of README


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


def refuse() -> None:
    """Stop unless a run of config/config.yaml has judged every claim as expected.

    Its tables may differ from the published ones, since these are replaced.
    """
    made = [
        "results/claims.json",
        "results/settings.json",
        "paper/report.pdf",
        "paper/supplement.pdf",
    ]
    if missing := [path for path in made if not Path(path).is_file()]:
        raise SystemExit(f"there is no {missing[0]}; expected a finished run: make reproduce")
    if wrong := unexpected(json.loads(Path("results/claims.json").read_text("utf-8"))):
        raise SystemExit("\n".join(wrong))
    used = json.loads(Path("results/settings.json").read_text("utf-8"))["paper/claims.yaml"]
    if used != json.loads(json.dumps(read_config("config/config.yaml", Paper))):
        raise SystemExit("results/ is not of config/config.yaml as it is now: make reproduce")


def main() -> None:
    refuse()
    made = copies()
    for path in REFERENCE.rglob("*"):
        if path.is_file() and path not in made.values():
            path.unlink()
    for source, target in made.items():
        target.parent.mkdir(parents=True, exist_ok=True)
        if target.suffix == ".gz":
            target.write_bytes(gzip.compress(source.read_bytes(), mtime=0))
        else:
            shutil.copyfile(source, target)
    sums = [
        path for folder in (DOCS, REFERENCE) for path in sorted(folder.rglob("*")) if path.is_file()
    ]
    lines = [
        f"{hashlib.sha256(p.read_bytes()).hexdigest()}  {p}\n"
        for p in sums
        if p.name != "SHA256SUMS"
    ]
    (DOCS / "SHA256SUMS").write_text("".join(lines), "utf-8")
    print(f"{len(made)} files are published; read the diff, mend README's numbers, then commit")


if __name__ == "__main__":
    main()
