"""The restitution against impulse and momentum of the three bodies, solved in numbers."""

import numpy as np
import pytest

from topheavy.derivation import (
    SIDES,
    column_restitution,
    energy_slenderness,
    largest_slenderness,
    restitution,
)
from topheavy.derivation.notation import alpha, gamma


def clockwise(arm, impulse):
    return arm[1] * impulse[0] - arm[0] * impulse[1]


def velocity_after(sign, slenderness, mass_ratio, *, spacing=3.0, depth=0.25):
    """θ̇ after an impact that changes over to the side `sign`, for θ̇ = 1 before."""
    column, beam = 1.0, 2 * mass_ratio
    b, h = np.sin(slenderness), np.cos(slenderness)
    new = np.array([-sign * b, h])  # from the new pivot to the centre; the old pivot is across
    old = np.array([sign * b, h])

    def velocity(arm, rate):
        return rate * np.array([arm[1], -arm[0]])

    def residual(unknowns):
        after, impulses = unknowns[0], unknowns[1:].reshape(4, 2)
        equations = []
        for ground, cap in zip(impulses[:2], impulses[2:], strict=True):
            jump = velocity(new, after) - velocity(old, 1.0)
            equations += [*(ground - cap - column * jump)]
            moment = clockwise(-new, ground) - clockwise(new, cap)
            equations.append(moment - column / 3 * (after - 1.0))
        jump = velocity(2 * new, after) - velocity(2 * old, 1.0)
        equations += [*(impulses[2] + impulses[3] - beam * jump)]
        arms = [(end * spacing / 2 - sign * b, -depth) for end in (-1, 1)]
        equations.append(sum(clockwise(*pair) for pair in zip(arms, impulses[2:], strict=True)))
        return np.array(equations)

    constant = residual(np.zeros(9))
    matrix = np.stack([residual(row) - constant for row in np.eye(9)], axis=1)
    return np.linalg.solve(matrix, -constant)[0]


@pytest.mark.parametrize("side", SIDES, ids=lambda side: side.label)
@pytest.mark.parametrize("slenderness", [0.05, 0.27, 0.8, 1.2])
@pytest.mark.parametrize("mass_ratio", [1e-9, 0.4, 7.0])
def test_impulses_on_three_bodies_give_the_restitution(side, slenderness, mass_ratio):
    derived = restitution(side).subs({alpha: slenderness, gamma: mass_ratio})
    solved = velocity_after(side.sign, slenderness, mass_ratio)
    assert solved == pytest.approx(float(derived), rel=1e-7)


@pytest.mark.parametrize("mass_ratio", [0.1, 0.434, 5.0, 300.0])
class TestSlendernessLimits:
    def test_restitution_changes_sign_at_the_largest_slenderness(self, mass_ratio):
        limit = float(largest_slenderness().subs(gamma, mass_ratio))
        assert velocity_after(1, limit - 1e-6, mass_ratio) > 0
        assert velocity_after(1, limit + 1e-6, mass_ratio) < 0

    def test_frame_and_column_lose_alike_at_the_energy_slenderness(self, mass_ratio):
        limit = float(energy_slenderness().subs(gamma, mass_ratio))
        for slenderness, frame_loses_more in ((limit - 1e-6, True), (limit + 1e-6, False)):
            frame = velocity_after(1, slenderness, mass_ratio) ** 2
            column = float(column_restitution().subs(alpha, slenderness)) ** 2
            assert (frame < column) == frame_loses_more
