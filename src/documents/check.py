"""Judge every claim again from the published tables, without a run: make check

What is published in docs/ and tests/reference/ has the checksums of docs/SHA256SUMS (make checks
that first); the findings are drawn again from the tables by the steps that drew them.
"""

import json
import runpy
from pathlib import Path
from typing import Any

from replication.claims import read_claims
from replication.step import call
from replication.verdicts import counts, judged, unexpected

REFERENCE = Path("tests/reference")


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


def published() -> list[dict[str, Any]]:
    """Return every claim with its verdict, from the published tables."""
    rules = json.loads((REFERENCE / "rules.json").read_text("utf-8"))
    settings = json.loads((REFERENCE / "settings.json").read_text("utf-8"))
    by_rule = findings(rules)
    return [
        judged(c, by_rule) for path, known in settings.items() for c in read_claims(path, known)
    ]


if __name__ == "__main__":
    rows = published()
    if wrong := unexpected(rows):
        raise SystemExit("\n".join(wrong))
    print(*counts(rows), sep="\n")
    print("Each verdict, from the published tables, is the one that paper/claims.yaml expects.")
