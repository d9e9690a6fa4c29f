"""The simplifications of Allen et al. (1986), one at a time."""

import math
from dataclasses import astuple

import pytest

from topheavy import Column, RockingBlock, RockingFrame
from topheavy.bodies.massless_columns import simplified

COLUMN = Column(0.5, 2.0)
FRAME = RockingFrame(COLUMN, 1.0)


@pytest.mark.parametrize(
    ("simplification", "changed"),
    [
        ("linearised", {"linearised"}),
        ("massless frequency", {"frequency_parameter"}),
        ("massless restitution", {"restitution"}),
        ("all", {"linearised", "frequency_parameter", "restitution"}),
    ],
)
def test_each_simplification_changes_what_it_names_and_nothing_else(simplification, changed):
    exact, simple = FRAME.block(), simplified(FRAME, simplification)
    names = RockingBlock.__dataclass_fields__
    assert {name for name in names if getattr(exact, name) != getattr(simple, name)} == changed


def test_massless_columns_have_the_limits_of_the_paper():
    simple = simplified(FRAME, "all")
    p, alpha = COLUMN.frequency_parameter, COLUMN.slenderness
    assert simple.frequency_parameter == pytest.approx(p * math.sqrt(2 / 3), rel=1e-15)
    assert simple.restitution == pytest.approx(math.cos(2 * alpha), rel=1e-15)
    # the pendulum of two columns without mass: p̂² = g/2R
    assert simple.frequency_parameter**2 == pytest.approx(9.81 / (2 * COLUMN.size), rel=1e-15)


def test_frames_under_ever_heavier_caps_approach_the_massless_columns():
    limit = simplified(FRAME, "all")

    def distance(mass_ratio: float) -> float:
        block = RockingFrame(COLUMN, mass_ratio).block().linear()
        return max(abs(a - b) for a, b in zip(astuple(block), astuple(limit), strict=True))

    for mass_ratio in (10.0, 1e3, 1e5):
        # Eqs. (23), (25): what is left falls as 1/γ
        assert distance(10 * mass_ratio) == pytest.approx(distance(mass_ratio) / 10, rel=0.05)


def test_unknown_simplification_is_refused_with_the_known():
    with pytest.raises(ValueError, match=r"'massless'; expected one of linearised, .*, all$"):
        simplified(FRAME, "massless")


def test_columns_too_stocky_to_rock_without_mass_are_refused():
    stocky = RockingFrame(Column(1.1, 1.0), 0.1)  # α = 47.7°: rocks only with mass
    assert stocky.block().restitution > 0.0
    with pytest.raises(ValueError, match="45°"):
        simplified(stocky, "all")
