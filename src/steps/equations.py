"""Test whether each printed equation of the paper follows from its premises."""

from dataclasses import asdict

import pandas as pd

from replication.workbench import Finding, run, truth
from topheavy.derivation import check_printed, theorems


def main() -> tuple[pd.DataFrame, dict]:
    table = pd.DataFrame([asdict(check) for check in check_printed()])
    proved = {theorem.id: truth(theorem.holds) for theorem in theorems()}
    return table, findings(table) | proved


def findings(equations: pd.DataFrame) -> dict[str, Finding]:
    """Return whether each equation holds as printed or as meant, from the table of checks."""
    told = equations.astype(object).where(equations.notna(), None)
    return {
        check.id: truth(
            check.follows,
            meant_holds=None if check.follows else bool(check.meant_follows and check.fault),
            kind=check.fault or None,
            mended=check.mended or None,
        )
        for check in told.itertuples()
    }


if __name__ == "__main__":
    run(snakemake, lambda job: main())
