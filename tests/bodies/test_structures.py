"""Column, frame and block: printed values, energy and momentum, limits, what is refused."""

import math
import sys

import numpy as np
import pytest

from topheavy import STANDARD_GRAVITY as G
from topheavy import Column, RockingBlock, RockingFrame

COLUMN = Column(0.5, 2.0)  # tan α = 1/4
STOCKY = Column(2.0, 1.0)  # α = 63.4°: Housner's √r is 1 − 1.5 · 0.8 = −0.2
BLOCK = RockingBlock(2.0, 0.25, 0.9)
TRILITH = RockingFrame(Column(0.11, 0.40), 0.434)
RATIOS = [0.0, 1e-6, 0.1, 0.434, 1.0, 4.0, 13.23, 1e3, math.inf]
SLENDERNESSES = [math.radians(degrees) for degrees in (2.0, 5.0, 8.0, 14.0, 25.0, 40.0)]
EVERY_COLUMN = pytest.mark.parametrize("alpha", SLENDERNESSES)


def column_of(slenderness, size=2.0):
    return Column(size * math.sin(slenderness), size * math.cos(slenderness))


UNIT = RockingFrame(column_of(0.25), 1.0)
PRINTED = {  # value, as printed, relative tolerance
    "Eq. (25), α = 0.25, γ = 1: √r": (UNIT.restitution, 0.885234, 1e-6),
    "Eq. (23), γ = 1: p̂/p": (
        *(UNIT.frequency_parameter / UNIT.column.frequency_parameter, 0.866025, 1e-6),
    ),
    "Eq. (24), γ = 1: R̂/R": (UNIT.equivalent_size / UNIT.column.size, 4 / 3, 1e-6),
    "trilith: R (m)": (TRILITH.column.size, 0.41485, 1e-3),
    "trilith: p (rad/s)": (TRILITH.column.frequency_parameter, 4.211, 1e-3),
    "trilith: p̂ (rad/s)": (TRILITH.frequency_parameter, 3.794, 1e-3),
    "trilith: uplift (g)": (TRILITH.uplift_acceleration, 0.275, 1e-3),
    "trilith: α (degrees)": (math.degrees(TRILITH.slenderness), 15.38, 1e-3),
    "trilith: base acceleration (g)": (0.005 * (2 * math.pi * 3.3) ** 2 / G, 0.2191, 1e-3),
    "gravity (m/s²)": (G, 9.81, 0.0),
}


@pytest.mark.parametrize(("value", "printed", "tolerance"), PRINTED.values(), ids=PRINTED)
def test_printed_value_is_met(value, printed, tolerance):
    assert value == pytest.approx(printed, rel=tolerance)


# ---------------------------------------------------------------------------- the frame


@pytest.mark.parametrize("gamma", RATIOS[:-1])
@EVERY_COLUMN
def test_frame_follows_from_energy_and_momentum(alpha, gamma):
    """Of one column, which turns about a corner, and its half of the cap, on the corner across.

    The impulses of an impact act at the new contacts: about the new corner, only that of the cap
    changes the angular momentum of the column, by the change of the cap's momentum.
    """
    frame = RockingFrame(column_of(alpha), gamma)
    b, h = frame.column.half_width, frame.column.half_height
    inertia = 4 / 3 * 4.0 + gamma * 4.0**2
    p = math.sqrt(G * (2.0 + 2 * gamma * 2.0) / inertia)
    assert frame.frequency_parameter == pytest.approx(p, rel=1e-14)
    twin = column_of(alpha, frame.equivalent_size)
    assert twin.frequency_parameter == pytest.approx(p, rel=1e-14)

    def momentum(point, pivot):  # about the new corner, of a unit mass that turns about a pivot
        arm, lever = np.subtract(point, pivot), np.subtract(point, (b, 0.0))
        return lever @ arm

    before = 4.0 / 3 + momentum((0, h), (-b, 0)) + gamma * (-2 * b * 0 + 0)
    cap_before = gamma * (np.subtract((-b, 2 * h), (b, 0.0)) @ np.subtract((b, 2 * h), (-b, 0.0)))
    after = 4.0 / 3 + momentum((0, h), (b, 0)) + gamma * momentum((-b, 2 * h), (b, 0))
    assert frame.restitution == pytest.approx((before + cap_before) / after, rel=1e-11)
    assert (frame.restitution < frame.column.restitution) == (gamma > 0.0)


@pytest.mark.parametrize("gamma", [1e12, 1e160, sys.float_info.max, math.inf])
@EVERY_COLUMN
def test_frame_under_a_boundless_cap_reaches_the_massless_column_limit(alpha, gamma):
    column, frame = column_of(alpha), RockingFrame(column_of(alpha), gamma)
    found = (frame.frequency_parameter, frame.equivalent_size, frame.restitution)
    expected = (math.sqrt(2 / 3) * column.frequency_parameter, 3.0, math.cos(2 * alpha))
    assert found == pytest.approx(expected, rel=1e-10)


def test_masses_give_the_mass_ratio_of_any_number_of_columns():
    assert RockingFrame.of_masses(COLUMN, 265.0, 305.3) == RockingFrame(COLUMN, 265.0 / 610.6)
    assert RockingFrame.of_masses(COLUMN, 6.0, 2.0, columns=6) == RockingFrame(COLUMN, 0.5)
    assert RockingFrame.of_masses(COLUMN, 0.0, 2.0).mass_ratio == 0.0


# ---------------------------------------------------------------------------- the block


@pytest.mark.parametrize("structure", [COLUMN, *(RockingFrame(COLUMN, g) for g in RATIOS), STOCKY])
def test_block_has_the_three_numbers_of_its_structure(structure):
    p, alpha = structure.frequency_parameter, structure.slenderness
    if structure is not STOCKY:
        assert structure.block() == RockingBlock(p, alpha, structure.restitution, linearised=False)
    for restitution in (0.0, 0.5, 1.0):
        block = RockingBlock(p, alpha, restitution)
        assert structure.block(restitution=restitution) == block
        assert block.linear() == RockingBlock(p, alpha, restitution, linearised=True)
        assert block.linear().linear() == block.linear()
        assert block.linear().with_restitution(0.3) == RockingBlock(p, alpha, 0.3, linearised=True)
        lifts = block.uplift_acceleration, block.linear().uplift_acceleration
        assert lifts == pytest.approx((math.tan(alpha), alpha), rel=1e-15)
    for name in ("half_width", "mass_ratio", "restitution"):
        with pytest.raises(AttributeError):
            setattr(structure, name, 0.1)
        with pytest.raises(AttributeError):
            setattr(block, name, 0.1)


# ---------------------------------------------------------------------------- what is refused


POSITIVE, NAN = (0.0, -0.2, math.nan, math.inf), (math.nan, -math.inf)
NO_NUMBERS = ("0.5", True, np.array([0.5, 0.6]), np.ma.masked, None)
MAKERS = {  # what takes a number, the number's name in the message, and what it may not be
    "half_width": (lambda x: Column(x, 3.0), POSITIVE),
    "half_height": (lambda x: Column(0.5, x), POSITIVE),
    "mass_ratio": (lambda x: RockingFrame(COLUMN, x), (-0.2, -1e-300, *NAN)),
    "frequency_parameter": (lambda x: RockingBlock(x, 0.25, 0.9), POSITIVE),
    "slenderness": (lambda x: RockingBlock(2.0, x, 0.9), (math.pi / 2, 1.6, *POSITIVE)),
    "restitution": (lambda x: RockingBlock(2.0, 0.25, x), (-0.01, 1.01, *NAN)),
    "restitution of another": (BLOCK.with_restitution, (-0.01, 1.01, *NAN)),
    "restitution of a column": (lambda x: COLUMN.block(restitution=x), (-0.01, 1.01, *NAN)),
    "restitution of a frame": (lambda x: UNIT.block(restitution=x), (-0.01, 1.01, *NAN)),
}


@pytest.mark.parametrize("name", MAKERS)
def test_impossible_number_is_refused_by_name_and_value(name):
    make, values = MAKERS[name]
    for value in values:
        with pytest.raises(ValueError, match=f"{value:.3g}") as error:
            make(value)
        assert error.match(name.split()[0])
    for value in () if " of a " in name else NO_NUMBERS:
        with pytest.raises(ValueError, match=rf"^{name.split()[0]} is .*; expected a number$"):
            make(value)


def of_masses(*masses, columns=2):
    return RockingFrame.of_masses(COLUMN, *masses, columns=columns)


@pytest.mark.parametrize(
    ("make", "says"),
    [
        (lambda: of_masses(1.0, 1.0, columns=1), "columns is 1; expected a whole number from 2 on"),
        (lambda: of_masses(1.0, 1.0, columns=2.0), "columns is 2.0"),
        (lambda: of_masses(1.0, 0.0), "column_mass is 0; expected more than zero"),
        (lambda: of_masses(-1.0, 1.0), "cap_mass is -1; expected zero or more"),
        (lambda: RockingFrame(COLUMN, np.ones(2)), r"^mass_ratio is an array of shape \(2,\); exp"),
    ],
)
def test_impossible_masses_are_refused(make, says):
    with pytest.raises(ValueError, match=says):
        make()
