"""The derived base shear against the library, and its proofs against wrong results."""

import math
from functools import cache

import pytest
import sympy as sp

from topheavy import Column, RockingFrame, base_shear_slope
from topheavy.derivation import base_shear as proofs
from topheavy.derivation.notation import SIDES, alpha, g, gamma, ground_acceleration


@cache
def derived_slope(side):
    return sp.diff(proofs.after_uplift(side), ground_acceleration)


@pytest.mark.parametrize("slenderness", [0.05, math.atan(1 / 6), 0.6])
@pytest.mark.parametrize("ratio", [0.1, 1.0, 7.0])
def test_library_follows_the_derivation(slenderness, ratio):
    frame = RockingFrame(Column(math.sin(slenderness), math.cos(slenderness)), ratio)
    given = {alpha: slenderness, gamma: ratio, g: 1.0}
    for side in SIDES:
        derived = float(derived_slope(side).subs(given))
        assert base_shear_slope(frame) == pytest.approx(derived, rel=1e-12)
