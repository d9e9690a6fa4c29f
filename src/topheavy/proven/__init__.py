"""Proven outcomes of rocking blocks: enclosures in place of tolerances, by ball arithmetic.

    outcome(structure, excitation)           ─►  survives | overturns | undecided

Every number is a ball of Arb that contains the true one: the structure's dimensions and the ground
motion are exact decimals, and each step, impact and comparison is rounded outward. What is assumed
is the model, Arb, and this code; `checking` proves the same again without both.

Needs python-flint: `pip install "topheavy[proven]"`.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
