"""Blocks in balls: they hold the exact α, p and √r, narrowly, and floats nearby lie outside."""

import math

import pytest

from topheavy import Column, FixedMassColumn, MonolithicPortal, RockingFrame
from topheavy.proven import BlockBox
from topheavy.proven.balls import arb, exact, precision
from topheavy.proven.blocks import enclosed

COLUMN = Column(0.5, 3.0)
STRUCTURES = [
    COLUMN,
    *(RockingFrame(COLUMN, gamma) for gamma in (0.0, 0.25, 1.0, math.inf)),
    *(FixedMassColumn(COLUMN, gamma, 0.4, 0.7) for gamma in (0.0, 1.0, math.inf)),
    MonolithicPortal(COLUMN, 1.0, 4.0, 0.7, 0.2),
]


@pytest.mark.parametrize("structure", STRUCTURES, ids=repr)
def test_balls_are_those_of_the_floats_to_rounding(structure):
    with precision(136):
        balls, block = enclosed(structure, linearised=False), structure.block()
        for name in ("slenderness", "frequency_parameter", "restitution"):
            ball, number = getattr(balls, name), getattr(block, name)
            assert ball.rad() < 1e-35
            assert abs(float(ball) - number) < 4e-16 * abs(number)


def test_slenderness_is_that_of_the_dimensions_and_not_a_float():
    with precision(136):
        for structure in (COLUMN, RockingFrame(COLUMN, 1.0), FixedMassColumn(COLUMN, 0.0)):
            balls = enclosed(structure, linearised=False)
            assert (balls.slenderness.tan() - arb(1) / 6).contains(0)
            assert not balls.slenderness.contains(exact(COLUMN.slenderness))
            assert not balls.frequency_parameter.contains(exact(COLUMN.frequency_parameter))


def test_box_contains_its_blocks():
    balls = enclosed(BlockBox((1.0, 1.1), 0.2, (0.8, 0.9)), linearised=False)
    assert all(balls.frequency_parameter.contains(exact(x)) for x in (1.0, 1.05, 1.1))
    assert all(balls.restitution.contains(exact(x)) for x in (0.8, 0.9))


def test_box_of_no_blocks_is_refused():
    with pytest.raises(ValueError, match=r"restitution is \(0.9, 0.8\); expected the lower"):
        BlockBox(1.0, 0.2, (0.9, 0.8))
    with pytest.raises(ValueError, match=r"restitution is 1\.2"):
        BlockBox(1.0, 0.2, (0.9, 1.2))
