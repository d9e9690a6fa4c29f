"""Compare the printed equations with the derived ones."""

import sympy as sp

from replication.workbench import run, truth
from theory.motion import PRINTED, equation_of_motion, period_of_small_swings, theta0


def main() -> dict:
    derived = {1: equation_of_motion(), 2: period_of_small_swings()}
    follows = {number: sp.simplify(derived[number] - PRINTED[number]) == 0 for number in derived}
    with_plus = PRINTED[2].subs(theta0, sp.I * theta0)  # the other sign before θ₀²
    return {
        "eq1": truth(follows[1]),
        "eq2": truth(
            follows[2],
            meant_holds=sp.simplify(derived[2] - with_plus) == 0,
            kind="sign",  # of the discrepancy, if there is one: verdicts.KINDS
        ),
    }


if __name__ == "__main__":
    run(snakemake, lambda job: main())
