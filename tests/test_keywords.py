"""A wrong keyword is answered by the right one."""

import pytest

import topheavy as th

COLUMN = th.Column(0.5, 3.0)
PULSE = th.Pulse("one-sine", 0.3, 6.0)


@pytest.mark.parametrize(
    ("wrong", "told"),
    [
        (lambda: th.Column(width=1.0, height=6.0), "Column has no argument 'width'; Column.of_dim"),
        (lambda: th.Column(half_widht=1.0, half_height=3.0), "did you mean 'half_width'"),
        (
            lambda: th.RockingFrame(COLUMN, cap_mass=4e5),
            r"RockingFrame.of_masses\(column, cap_mass",
        ),
        (lambda: th.RockingFrame(COLUMN, gamma=1.0), "it is called mass_ratio"),
        (lambda: th.simulate(COLUMN, PULSE, restitution=0.9), r"structure.block\(restitution=…\)"),
        (lambda: th.simulate(COLUMN, record=PULSE), "it is called excitation"),
        (lambda: th.Record(dt=0.01, acceleration=[0, 1]), "it is called time_step"),
        (lambda: th.Pulse("one-sine", 0.3, omega=6.0), "it is called angular_frequency"),
        (lambda: th.judge(COLUMN, PULSE, zzz=1), "expected structure, excitation"),
        (lambda: th.Pulse("one-sine", 0.3, period=1.0), "angular_frequency is 2π over it"),
        (lambda: th.simulate(COLUMN, PULSE, scale=2.0), r"excitation.scaled\(factor\)"),
        (lambda: th.lowest_overturning(COLUMN, PULSE, (0, 5), resolution=1), "it is called floor"),
        (lambda: th.fragility([COLUMN], [PULSE], [1.0], lowerd=[0.1]), "did you mean 'lowered'"),
        (lambda: th.plot.structure(COLUMN, ax=None), "it is called axes"),
        (lambda: th.Record(0.1, [0, 1]).scaled_to(PGV=1.0), "did you mean 'pgv'"),
    ],
)
def test_wrong_keyword_names_the_right_one(wrong, told):
    with pytest.raises(TypeError, match=told):
        wrong()


def test_right_keywords_pass_through():
    assert th.Column(half_width=0.5, half_height=3.0) == th.Column.of_dimensions(
        width=1.0, height=6.0
    )
    assert th.simulate(structure=COLUMN, excitation=PULSE, samples=5).time.size == 5
