"""Test whether each printed equation of the paper follows from its premises."""

from dataclasses import asdict

import pandas as pd

from replication.workbench import Finding, run, truth
from topheavy.derivation import check_printed, theorems


def main() -> tuple[pd.DataFrame, pd.DataFrame, dict]:
    checks = pd.DataFrame([asdict(check) for check in check_printed()])
    proved = {theorem.id: theorem.holds for theorem in theorems()}
    table = pd.DataFrame(proved.items(), columns=["theorem", "holds"])
    return checks, table, findings(checks, table)


def findings(equations: pd.DataFrame, theorems: pd.DataFrame) -> dict[str, Finding]:
    """Return what holds as printed or as meant, from the tables of equations and theorems."""
    proved = theorems.set_index("theorem").holds
    printed = equations.astype(object).where(equations.notna(), None)
    of_equations = {
        check.id: truth(
            check.follows,
            meant_holds=None if check.follows else bool(check.meant_follows and check.fault),
            kind=check.fault or None,
            mended=check.mended or None,
        )
        for check in printed.itertuples()
    }
    return of_equations | {name: truth(holds) for name, holds in proved.items()}


if __name__ == "__main__":
    run(snakemake, lambda job: main())
