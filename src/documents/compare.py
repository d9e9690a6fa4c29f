"""Compare each table with the published one, where its rule has the parameters of that run."""

import json
from collections.abc import Collection, Iterator, Mapping
from pathlib import Path
from typing import Any

import pandas as pd

from replication.job import log_to, write
from replication.sources import checksums

REFERENCE = Path("tests/reference")


def departures(
    ours: pd.DataFrame, theirs: pd.DataFrame, bounds: Mapping, counts: Collection[str] = ()
) -> Iterator[str]:
    """Yield each column that departs from the published one, with the first such value.

    Whole numbers are exact, but for `counts` of outcomes. Such a count may differ by
    `bounds["counts"]`; of a column of outcomes, each 0 or 1, so many may differ.
    """
    for name in dict.fromkeys([*theirs, *ours]):
        if name not in ours or name not in theirs:
            yield f"{name} (only {'here' if name in ours else 'published'})"
            continue
        pair = ours[name], theirs[name]
        is_whole = all(map(pd.api.types.is_integer_dtype, pair))
        relative, absolute = bounds["relative"], bounds["absolute"]
        if is_whole:
            relative, absolute = 0.0, bounds["counts"] if name in counts else 0.0
        if name in counts and all(column.isin([0, 1]).all() for column in pair):
            is_few = len(ours) == len(theirs) and (pair[0] != pair[1]).sum() <= bounds["counts"]
            absolute = 1.0 if is_few else 0.0
        try:
            pd.testing.assert_series_equal(*pair, check_dtype=False, rtol=relative, atol=absolute)
        except AssertionError as fault:
            yield f"{name} ({str(fault).splitlines()[-1]})"


def compare(
    rules: Mapping[str, Any], published: Mapping[str, Any], bounds: Mapping
) -> pd.DataFrame:
    """Return a row for each table of a run: whether it agrees with the published one.

    `rules` are those of this run with their parameters and tables, `published` those of the
    published run.
    """
    rows = []
    for name, rule in rules.items():
        is_same = _inputs(published, name) == _inputs(rules, name)
        for path in rule["tables"]:
            theirs = REFERENCE / Path(path).name
            columns: list[str] = []
            if not theirs.is_file():
                verdict = "not published"
            elif not is_same:
                verdict = "other parameters"
            else:
                tables = pd.read_csv(path), pd.read_csv(theirs)
                columns = list(departures(*tables, bounds, rule["params"].get("counts", ())))
                verdict = "differs" if columns else "agrees"
            rows.append(
                {
                    "rule": name,
                    "table": path,
                    "published": str(theirs),
                    "verdict": verdict,
                    "departs": "; ".join(columns),
                }
            )
    return pd.DataFrame(rows, columns=["rule", "table", "published", "verdict", "departs"])


def _inputs(rules: Mapping[str, Any], name: str) -> str:
    """Return as text the parameters of a rule, the checksums of its sources, and what it reads."""
    rule = rules.get(name, {})
    reads = {*rule.get("reads", ())}
    before = sorted(other for other, entry in rules.items() if reads & {*entry["tables"]})
    parts = [rule.get("params"), rule.get("sources"), [_inputs(rules, other) for other in before]]
    return json.dumps(parts, sort_keys=True)


if __name__ == "__main__":
    with log_to(snakemake.log[0]):
        published, settings = (
            json.loads(path.read_text("utf-8")) if path.is_file() else {}
            for path in (REFERENCE / "rules.json", REFERENCE / "settings.json")
        )
        table = compare(snakemake.params.rules, published, snakemake.params.bounds)
        # Under the published config every table has to be compared.
        table["required"] = settings == json.loads(json.dumps(snakemake.params.settings))
        texts = {snakemake.output.table: table.to_csv(index=False)}
        rules = {
            name: rule | {"sums": checksums(rule["tables"])}
            for name, rule in snakemake.params.rules.items()
        }
        for name, content in {"rules": rules, "settings": snakemake.params.settings}.items():
            text = json.dumps(content, indent=1, sort_keys=True, ensure_ascii=False)
            texts[snakemake.output[name]] = text + "\n"
        write(snakemake, texts)
