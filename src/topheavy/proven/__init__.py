"""Outcomes of rocking blocks under a pulse, verified with interval arithmetic.

    certified(structure, pulse, factor)        ─►  certificate, or None
    survives_below(structure, pulse, high)     ─►  certificates of boxes of factors from 0 to `high`
    checking.check(certificate)                ─►  survives | overturns, or NotProven

Floats propose the steps of a proof; `checking`, which needs the standard library alone, proves or
refuses each. Dimensions and pulse are exact decimals. Assumed are the model, Python's integers and
the code in `checking`.
"""

from topheavy.proven import checking
from topheavy.proven.prover import certified, survives_below

__all__ = ["certified", "checking", "survives_below"]
