"""Test whether each printed equation of the paper follows from its premises."""

from dataclasses import asdict

import pandas as pd
import sympy as sp

from replication.workbench import Finding, run, truth
from topheavy.derivation import check_printed, theorems
from topheavy.derivation.motion_proofs import follows_if_a_column_weighs

BOTH, EACH = "m_c_as_both_columns", "m_c_as_each_column"  # what Eq. (23) would mean by m_c


def main() -> tuple[pd.DataFrame, pd.DataFrame, dict]:
    checks = pd.DataFrame([asdict(check) for check in check_printed()])
    proved = {theorem.id: theorem.holds for theorem in theorems()}
    proved[BOTH] = follows_if_a_column_weighs(sp.Rational(1, 2))
    proved[EACH] = follows_if_a_column_weighs(sp.Integer(1))
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
    of_theorems = {name: truth(holds) for name, holds in proved.drop([BOTH, EACH]).items()}
    both = truth(
        proved[BOTH],
        holds_when=bool(proved[EACH]),
        condition="m_c is the mass of each of the two columns",
    )
    return of_equations | of_theorems | {BOTH: both}


if __name__ == "__main__":
    run(snakemake, lambda job: main())
