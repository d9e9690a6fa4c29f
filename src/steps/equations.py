"""Test whether each printed equation of the paper follows from its premises, and prove theorems."""

import math
import re

import numpy as np
import pandas as pd
from sympy import lambdify

from derivation import check_printed, mechanics, theorems
from derivation.notation import alpha, gamma
from replication.step import check, run, truth
from topheavy import Column, RockingFrame

VARIANT = re.compile(r"_(negative|positive|\d+)$")  # the sign of θ, or the equation of a step


def compute():
    check_formulas()
    proofs = pd.DataFrame(theorems())
    fails = proofs.theorem[~proofs.holds]
    check(fails.empty, f"these theorems do not hold: {', '.join(fails)}")
    return {"equations": pd.DataFrame(check_printed()), "theorems": proofs}


def check_formulas():
    """Check the library's p̂/p, R̂/R, √r of column and frame and g tan α against the derivation."""
    frame = [lambdify(gamma, f()) for f in (mechanics.frequency_ratio, mechanics.size_ratio)]
    frame_root = lambdify((alpha, gamma), mechanics.restitution())
    column_root = lambdify(alpha, mechanics.column_restitution())
    for angle in np.radians(np.linspace(1.0, 60.0, 60)):
        column = Column(math.sin(angle), math.cos(angle))
        for ratio in (0.0, 0.1, 0.434, 1.0, 7.0, 100.0):
            ours = RockingFrame(column, ratio)
            pairs = [
                (ours.frequency_parameter / column.frequency_parameter, frame[0](ratio)),
                (ours.equivalent_size / column.size, frame[1](ratio)),
                (ours.restitution, frame_root(angle, ratio)),
                (column.restitution, column_root(angle)),
                (ours.uplift_acceleration, math.tan(angle)),
            ]
            apart = max(abs(formula - derived) for formula, derived in pairs)
            check(apart < 1e-13, f"α = {angle:.3g}, γ = {ratio:g}: {apart:.1g} from the derivation")


def findings(equations, theorems):
    """Return whether each equation holds as printed or as meant, and each theorem.

    The forms of one equation for both signs of θ, and the steps between equations, are one finding.
    """
    results = {t.theorem: truth(t.holds) for t in theorems.itertuples()}
    for name, forms in equations.groupby(
        equations.id.str.replace(VARIANT, "", regex=True), sort=False
    ):
        results[name] = as_printed_or_meant(forms)
    loses_less = results["impulses_inside_the_corners_lose_less"]["holds"]
    results["maximum_restitution"] = truth(
        not loses_less,
        holds_when=loses_less,
        condition="the impulses of an impact act at the corners",
    )
    return results


def as_printed_or_meant(forms):
    wrong = forms[~forms.follows]
    if wrong.empty:
        return truth(True)
    meant = (wrong.meant_follows == True) & wrong.kind.notna()  # noqa: E712
    return truth(False, meant_holds=meant.all(), kind=wrong.kind.iloc[0])


if __name__ == "__main__":
    run(snakemake, compute, findings)
