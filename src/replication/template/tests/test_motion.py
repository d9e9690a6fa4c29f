"""The equations that are derived."""

import sympy as sp

from theory.motion import equation_of_motion, g, l, period_of_small_swings, theta, theta0


def test_small_swings_are_harmonic():
    angle = sp.Symbol("angle")
    stiffness = -equation_of_motion().subs(theta, angle).diff(angle).subs(angle, 0)
    assert sp.simplify(stiffness - g / l) == 0


def test_period_grows_with_the_amplitude():
    assert period_of_small_swings().coeff(theta0, 2) > 0
