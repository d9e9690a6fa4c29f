"""The tables of this run beside the reference tables that are committed in tests/reference/.

The config of this run is kept beside them, for the report and for `make publish`.
"""

from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import yaml

from replication.inputs.strict_yaml import read_yaml
from replication.workbench import run, write_table


def largest_difference(table: pd.DataFrame, reference: pd.DataFrame, absolute: float) -> float:
    """Return the largest |difference| over |reference| + absolute; inf where they do not match."""
    if list(table.columns) != list(reference.columns) or len(table) != len(reference):
        return float("inf")
    worst = 0.0
    for name in reference.columns:
        ours, theirs = table[name], reference[name]
        if pd.api.types.is_numeric_dtype(theirs) and pd.api.types.is_numeric_dtype(ours):
            ours, theirs = ours.astype(float), theirs.astype(float)
            same = (ours == theirs) | (ours.isna() & theirs.isna())
            ratio = (ours - theirs).abs() / (theirs.abs() + absolute)
            worst = max(worst, float(np.where(same, 0.0, ratio.fillna(np.inf)).max(initial=0.0)))
        elif not ours.equals(theirs):
            return float("inf")
    return worst


def main(tables: list[str], references: list[str], changed: list[str], bounds: dict) -> list[dict]:
    ours = {Path(path).name: path for path in tables}
    rows = []
    for path in references:
        name = Path(path).name
        difference = float("nan")
        if not changed:
            difference = largest_difference(
                pd.read_csv(ours[name]), pd.read_csv(path), bounds["absolute"]
            )
        if changed:
            verdict = "not compared: config.yaml differs in " + ", ".join(changed)
        else:
            verdict = "agrees" if difference <= bounds["relative"] else "differs"
        rows.append({"table": name, "largest_difference": difference, "verdict": verdict})
        print(f"{name}: {verdict} ({difference:.2g})")
    return rows


def work(job: Any) -> None:
    published = read_yaml(job.input.config)
    used = job.params.config
    sections = {*published, *used} - {"studies"}  # those have tables of their own
    changed = sorted(key for key in sections if published.get(key) != used.get(key))
    rows = main(job.input.tables, job.input.references, changed, used["reproducibility"])
    columns = ["table", "largest_difference", "verdict"]
    write_table(job.output.table, pd.DataFrame(rows, columns=columns))
    text = yaml.safe_dump(dict(used), allow_unicode=True, sort_keys=False)
    Path(job.output.config).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    run(snakemake, work)
