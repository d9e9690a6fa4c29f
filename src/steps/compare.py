"""Compare each table with the published one, where its rule has the parameters of that run."""

import json
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import pandas as pd

from replication.step import log_to, publish

REFERENCE = Path("tests/reference")


def departures(ours: pd.DataFrame, theirs: pd.DataFrame, bounds: Mapping) -> Iterator[str]:
    """Yield each column that departs from the published one, with the first such value."""
    for name in dict.fromkeys([*theirs, *ours]):
        if name not in ours or name not in theirs:
            yield f"{name} (only {'here' if name in ours else 'published'})"
            continue
        whole = all(pd.api.types.is_integer_dtype(one[name]) for one in (ours, theirs))
        try:
            pd.testing.assert_series_equal(
                ours[name],
                theirs[name],
                check_dtype=False,
                rtol=bounds["relative"],
                atol=bounds["counts"] if whole else bounds["absolute"],
            )
        except AssertionError as fault:
            yield f"{name} ({str(fault).splitlines()[-1]})"


def compare(
    rules: Mapping[str, Any], published: Mapping[str, Any], bounds: Mapping
) -> pd.DataFrame:
    """Return a row for each published table that a rule of the run makes.

    `rules` are those of this run with their parameters and tables, `published` those of the
    published run.
    """
    rows = []
    for name, rule in rules.items():
        known = published.get(name, {})
        for path in rule["tables"]:
            theirs = REFERENCE / Path(path).name
            if not theirs.is_file():
                continue
            same = _inputs(known) == _inputs(rule)
            columns: list[str] = []
            if same:
                columns = list(departures(pd.read_csv(path), pd.read_csv(theirs), bounds))
            verdict = (
                ("differs" if columns else "agrees") if same else f"other parameters of {name}"
            )
            rows.append(
                {
                    "table": path,
                    "published": str(theirs),
                    "verdict": verdict,
                    "departs": "; ".join(columns),
                }
            )
    return pd.DataFrame(rows, columns=["table", "published", "verdict", "departs"])


def _inputs(rule: Mapping) -> str:
    """Return the parameters of a rule and the checksums of its sources as text."""
    return json.dumps([rule.get("params"), rule.get("sources")], sort_keys=True)


if __name__ == "__main__":
    with log_to(snakemake.log[0]):
        known = REFERENCE / "rules.json"
        published = json.loads(known.read_text("utf-8")) if known.is_file() else {}
        rules = snakemake.params.rules
        table = compare(rules, published, snakemake.params.bounds)
        texts = {
            snakemake.output.table: table.to_csv(index=False),
        }
        for name in ("rules", "settings"):
            text = json.dumps(snakemake.params[name], indent=1, sort_keys=True, ensure_ascii=False)
            texts[snakemake.output[name]] = text + "\n"
        publish(snakemake, texts)
