"""The frame's energies against those of turned rectangles, by finite differences."""

import numpy as np
import pytest
import sympy as sp

from topheavy.derivation import SIDES, kinetic_energy, potential_energy
from topheavy.derivation.notation import (
    I_o,
    R,
    alpha,
    g,
    gamma,
    ground_velocity,
    m_b,
    m_c,
    velocity,
)

SIZE, SLENDERNESS, COLUMN, BEAM, GRAVITY = 1.7, 0.3, 0.9, 2.2, 9.81
PARAMETERS = {
    R: SIZE,
    alpha: SLENDERNESS,
    m_c: COLUMN,
    m_b: BEAM,
    I_o: 4 / 3 * COLUMN * SIZE**2,
    gamma: BEAM / (2 * COLUMN),
    g: GRAVITY,
}


def centre_and_cap(rotation):
    """The column's centre and its carrying corner, from the pivot's place when upright."""
    sign = np.sign(rotation)
    angle = rotation - sign * SLENDERNESS
    arm = SIZE * np.array([np.sin(angle), np.cos(angle)])
    pivot = np.array([sign * SIZE * np.sin(SLENDERNESS), 0])
    return pivot + arm, pivot + 2 * arm


def energies(rotation, rate, ground):
    step = 1e-6
    ahead, behind = (centre_and_cap(rotation + way * rate * step) for way in (1, -1))
    moved = [(a - b) / (2 * step) + [ground, 0] for a, b in zip(ahead, behind, strict=True)]
    centre, cap = (velocity @ velocity for velocity in moved)
    kinetic = COLUMN * centre + COLUMN * SIZE**2 / 3 * rate**2 + BEAM * cap / 2
    here, upright = centre_and_cap(rotation), centre_and_cap(np.sign(rotation) * 1e-12)
    rises = [now[1] - then[1] for now, then in zip(here, upright, strict=True)]
    return kinetic, GRAVITY * (2 * COLUMN * rises[0] + BEAM * rises[1])


@pytest.mark.parametrize("side", SIDES, ids=lambda side: side.label)
@pytest.mark.parametrize(("lean", "rate", "ground"), [(0.05, 0.3, 0.0), (0.25, -0.8, 0.6)])
def test_energies_are_those_of_turned_rectangles(side, lean, rate, ground):
    values = PARAMETERS | {side.rotation: side.sign * lean, velocity: rate, ground_velocity: ground}
    derived = [float(sp.N(e(side).subs(values))) for e in (kinetic_energy, potential_energy)]
    np.testing.assert_allclose(derived, energies(side.sign * lean, rate, ground), rtol=1e-7)
