"""The exact solution of the linearised motion, step by step: a check of every other solver.

On one side and one piece of the ground motion (Allen et al. 1986; Housner 1963), with τ = p t,

    φ(τ) = α + s κ a(τ) + C₁ cosh τ + C₂ sinh τ,    κ = 1/(1 + (ω/p)²)

for a sine or cosine of ω; κ = 1 for a straight line. Uplift, impacts and rest are those of the
plain solver, which therefore may check the Taylor solver by this, and not itself.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from audit import ALPHA, AMP, PACE, PHI, RATE, SIDE, Drive
from steps.shared import plain
from topheavy.bodies.response import Response
from topheavy.bodies.structures import Structure, as_block
from topheavy.ground.excitation import Excitation
from topheavy.ground.pulses import Pulse
from topheavy.ground.shapes import ELEMENTARY


def simulate_linear_exact(
    structure: Structure, excitation: Excitation | None = None, **options: Any
) -> Response:
    """Return the linearised response in exact form; options as of `plain.simulate`.

    Raises
    ------
    ValueError
        For a block that is not linearised, a pulse that is not `ELEMENTARY`, and as `simulate`.
    """
    if not as_block(structure).linearised:
        raise ValueError("the block is not linearised; expected block.linear()")
    if isinstance(excitation, Pulse) and excitation.shape not in ELEMENTARY:
        raise ValueError(
            f"shape is {excitation.shape!r}, which has no elementary solution; "
            f"expected one of {', '.join(ELEMENTARY)}"
        )
    return plain.simulate(structure, excitation, leap=exact_step, **options)


def exact_step(lanes: NDArray[np.float64], x: Any, dx: Any, drive: Drive) -> NDArray[np.float64]:
    """Return φ and dφ/dτ after a step of dx on one side, as `audit.leapfrog` does."""
    side, phi, rate, alpha, amplitude, pace = lanes[[SIDE, PHI, RATE, ALPHA, AMP, PACE]]
    push = drive.ground.at
    is_wave = push in (np.sin, np.cos)
    share = side * amplitude * (1.0 / (1.0 + pace**-2.0) if is_wave else 1.0)

    def forced(x: Any) -> NDArray[np.float64]:  # behind a sine or cosine by a quarter of a period
        slope = push(x + np.pi / 2.0) if is_wave else push(1.0) - push(0.0)
        return np.array([alpha + share * push(x), share * slope / pace])

    offset, speed = np.array([phi, rate]) - forced(x)
    cosh, sinh = np.cosh(dx * pace), np.sinh(dx * pace)
    return forced(x + dx) + np.array([offset * cosh + speed * sinh, offset * sinh + speed * cosh])
