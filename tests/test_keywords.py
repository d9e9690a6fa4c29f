"""A wrong keyword is answered by the right one."""

import pytest

from topheavy import (
    Column,
    Pulse,
    Record,
    RockingFrame,
    fragility,
    judge,
    lowest_overturning,
    plot,
    simulate,
)

COLUMN = Column(0.5, 3.0)
PULSE = Pulse("one-sine", 0.3, 6.0)


@pytest.mark.parametrize(
    ("wrong", "told"),
    [
        (lambda: Column(width=1.0, height=6.0), "Column has no argument 'width'; Column.of_dim"),
        (lambda: Column(half_widht=1.0, half_height=3.0), "did you mean 'half_width'"),
        (lambda: RockingFrame(COLUMN, cap_mass=4e5), r"RockingFrame.of_masses\(column, cap_mass"),
        (lambda: RockingFrame(COLUMN, gamma=1.0), "it is called mass_ratio"),
        (lambda: simulate(COLUMN, PULSE, restitution=0.9), r"structure.block\(restitution=…\)"),
        (lambda: simulate(COLUMN, record=PULSE), "it is called excitation"),
        (lambda: Record(dt=0.01, acceleration=[0, 1]), "it is called time_step"),
        (lambda: Pulse("one-sine", 0.3, omega=6.0), "it is called angular_frequency"),
        (lambda: judge(COLUMN, PULSE, zzz=1), "expected structure, excitation"),
        (lambda: Pulse("one-sine", 0.3, period=1.0), "angular_frequency is 2π over it"),
        (lambda: simulate(COLUMN, PULSE, scale=2.0), r"excitation.scaled\(factor\)"),
        (lambda: lowest_overturning(COLUMN, PULSE, (0, 5), resolution=1), "it is called floor"),
        (lambda: fragility([COLUMN], [PULSE], [1.0], lowerd=[0.1]), "did you mean 'lowered'"),
        (lambda: plot.structure(COLUMN, ax=None), "it is called axes"),
        (lambda: Record(0.1, [0, 1]).scaled_to(PGV=1.0), "did you mean 'pgv'"),
    ],
)
def test_wrong_keyword_names_the_right_one(wrong, told):
    with pytest.raises(TypeError, match=told):
        wrong()


def test_right_keywords_pass_through():
    assert Column(half_width=0.5, half_height=3.0) == Column.of_dimensions(width=1.0, height=6.0)
    assert simulate(structure=COLUMN, excitation=PULSE, samples=5).time.size == 5
