"""The equation of motion by Lagrange, Eq. (1), and the period of small swings, Eq. (2)."""

import sympy as sp

t, m, l, g = sp.symbols("t m l g", positive=True)  # time; mass, length, gravity  # noqa: E741
theta0 = sp.Symbol("theta_0", positive=True)
theta = sp.Function("theta")(t)


def equation_of_motion() -> sp.Expr:
    """Return the angular acceleration of a pendulum, by Lagrange's equation."""
    kinetic = m * (l * theta.diff(t)) ** 2 / 2
    potential = -m * g * l * sp.cos(theta)
    lagrangian = kinetic - potential
    equation = lagrangian.diff(theta.diff(t)).diff(t) - lagrangian.diff(theta)
    (acceleration,) = sp.solve(equation, theta.diff(t, 2))
    return sp.simplify(acceleration)  # Eq. (1)


def period_of_small_swings() -> sp.Expr:
    """Return the period over that of infinitely small swings, to the second order of amplitude.

    It expands the complete elliptic integral, 2 K(sin²(θ₀/2)) / π, which integrates Eq. (1).
    """
    exact = 2 * sp.elliptic_k(sp.sin(theta0 / 2) ** 2) / sp.pi
    return sp.series(exact, theta0, 0, 3).removeO()  # Eq. (2), with the sign that is meant


PRINTED = {
    1: -g / l * sp.sin(theta),
    2: 1 - theta0**2 / 16,
}
"""The equations as the paper prints them, by number."""
