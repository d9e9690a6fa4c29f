"""The solvers of a history, each with the blocks that it can follow."""

import pytest

import topheavy as th
from steps.shared import plain
from steps.shared.linear import simulate_linear_exact as closed
from tests.cases import BLOCK
from topheavy.ground.shapes import ELEMENTARY, FINITE_SHAPES

CLOSED_PULSES = [shape for shape in ELEMENTARY if shape in FINITE_SHAPES]

NAMES = {th.simulate: "Taylor", plain.simulate: "plain", closed: "closed"}
CLOSE = {th.simulate: 1e-8, plain.simulate: 1e-8, closed: 1e-13}
"""How near a solver is to a closed form, of α and of amplitudes."""


def solvers(*blocks):
    """Each solver with each block that it can follow."""
    return [
        pytest.param(solve, block, id=f"{name}-{'linear' if block.linearised else 'exact'}")
        for block in blocks
        for solve, name in NAMES.items()
        if block.linearised or solve is not closed
    ]


EVERY = pytest.mark.parametrize(("solve", "block"), solvers(BLOCK, BLOCK.linear()))
ON_LINEAR = pytest.mark.parametrize("solve", NAMES, ids=NAMES.values())
TWO = [th.simulate, plain.simulate]
BY_TWO = pytest.mark.parametrize("solve", TWO, ids=["Taylor", "plain"])
