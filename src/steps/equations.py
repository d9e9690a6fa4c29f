"""Test whether each printed equation of the paper follows from its premises, and prove theorems."""

import re

import pandas as pd

from derivation import check_printed, theorems
from replication.step import check, run, truth

VARIANT = re.compile(r"_(negative|positive|\d+)$")  # the sign of θ, or the equation of a step


def compute():
    proofs = pd.DataFrame(theorems())
    fails = proofs.theorem[~proofs.holds]
    check(fails.empty, f"these theorems do not hold: {', '.join(fails)}")
    return {"equations": pd.DataFrame(check_printed()), "theorems": proofs}


def findings(equations, theorems):
    """Return whether each equation holds as printed or as meant, and each theorem.

    The forms of one equation for both signs of θ, and the steps between equations, are one finding.
    """
    results = {t.theorem: truth(t.holds) for t in theorems.itertuples()}
    for name, forms in equations.groupby(
        equations.id.str.replace(VARIANT, "", regex=True), sort=False
    ):
        results[name] = as_printed_or_meant(forms)
    return results


def as_printed_or_meant(forms):
    wrong = forms[~forms.follows]
    if wrong.empty:
        return truth(True)
    meant = (wrong.meant_follows == True) & wrong.kind.notna()  # noqa: E712
    return truth(False, meant_holds=meant.all(), kind=wrong.kind.iloc[0])


if __name__ == "__main__":
    run(snakemake, compute, findings)
