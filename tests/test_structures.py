"""Column, rocking frame and rocking block: limits, published values, the impact, bad input."""

import math
import sys

import numpy as np
import pytest

from topheavy import (
    STANDARD_GRAVITY,
    Column,
    FixedMassColumn,
    MonolithicPortal,
    Pulse,
    Record,
    RockingBlock,
    RockingFrame,
    fragility,
    judge,
    overturned_by,
    reference,
    simulate,
)

COLUMN = Column(0.5, 2.0)  # tan α = 1/4
STOCKY = Column(2.0, 1.0)  # α = 63.4°: Housner's √r is 1 − 1.5 · 0.8 = −0.2
MASS_RATIOS = [0.0, 1e-6, 0.1, 0.434, 1.0, 4.0, 13.23, 1e3, math.inf]
SLENDERNESSES = [math.radians(degrees) for degrees in (2.0, 5.0, 8.0, 14.0, 25.0, 40.0)]


def column_of(slenderness: float, size: float = 2.0) -> Column:
    return Column(size * math.sin(slenderness), size * math.cos(slenderness))


def restitution_from_impulses(column: Column, mass_ratio: float) -> float:
    """√r from impulse and momentum of one column and its half of the cap beam, not from Eq. (25).

    The column turns about its left corner and carries the cap at its upper right corner; after the
    impact it turns about its right corner with the cap at its upper left corner. The impulses act
    at the new contacts alone, so the angular momentum about the new corner changes only by the
    impulse of the cap, which is the change of the cap's momentum.
    """
    b, h, mass, half_cap = column.half_width, column.half_height, 1.0, mass_ratio

    def cross(r, s):
        return r[0] * s[1] - r[1] * s[0]

    def turn(r):  # the velocity of a point at r from the pivot, at unit angular velocity
        return np.array([-r[1], r[0]])

    left, right, centre = np.array([-b, 0.0]), np.array([b, 0.0]), np.array([0.0, h])
    old_cap, new_cap = np.array([b, 2 * h]), np.array([-b, 2 * h])
    inertia = mass * (b**2 + h**2) / 3
    before = inertia + mass * cross(centre - right, turn(centre - left))
    after = inertia + mass * cross(centre - right, turn(centre - right))
    cap_before = half_cap * cross(new_cap - right, turn(old_cap - left))
    cap_after = half_cap * cross(new_cap - right, turn(new_cap - right))
    return (before + cap_before) / (after + cap_after)


# ---------------------------------------------------------------------------- published values

PUBLISHED = [
    # source, what, how it is computed, value, relative tolerance
    ("Eq. (25), α = 0.25, γ = 1", "√r", lambda: unit_frame().restitution, 0.885234, 1e-6),
    (
        "Eq. (23), γ = 1",
        "p̂/p",
        lambda: unit_frame().frequency_parameter / unit_frame().column.frequency_parameter,
        0.866025,
        1e-6,
    ),
    (
        "Eq. (24), γ = 1",
        "R̂/R",
        lambda: unit_frame().equivalent_size / unit_frame().column.size,
        4 / 3,
        1e-6,
    ),
    ("trilith", "R (m)", lambda: trilith().column.size, 0.41485, 1e-3),
    ("trilith", "p (rad/s)", lambda: trilith().column.frequency_parameter, 4.211, 1e-3),
    ("trilith", "p̂ (rad/s)", lambda: trilith().frequency_parameter, 3.794, 1e-3),
    ("trilith", "uplift (g)", lambda: trilith().uplift_acceleration, 0.275, 1e-3),
    ("trilith", "α (degrees)", lambda: math.degrees(trilith().slenderness), 15.38, 1e-3),
    (
        "trilith, 5 mm at 3.3 Hz",
        "base acceleration (g)",
        lambda: 0.005 * (2 * math.pi * 3.3) ** 2 / STANDARD_GRAVITY,
        0.2191,
        1e-3,
    ),
]


def unit_frame() -> RockingFrame:
    return RockingFrame(column_of(0.25), 1.0)


def trilith() -> RockingFrame:
    return RockingFrame(Column(0.11, 0.40), 0.434)


@pytest.mark.parametrize(
    ("source", "what", "compute", "value", "tolerance"),
    PUBLISHED,
    ids=[f"{row[0]}: {row[1]}" for row in PUBLISHED],
)
def test_published_values_are_met(source, what, compute, value, tolerance):
    assert compute() == pytest.approx(value, rel=tolerance), f"{what} of {source}"


def test_trilith_is_shaken_below_its_uplift_threshold():
    base_acceleration = 0.005 * (2 * math.pi * 3.3) ** 2 / STANDARD_GRAVITY
    assert base_acceleration < trilith().uplift_acceleration


# ---------------------------------------------------------------------------- the column


def test_gravity_is_the_papers():
    assert STANDARD_GRAVITY == 9.81


def test_column_geometry_is_that_of_its_half_diagonal():
    column = Column(0.3, 0.4)
    assert column.half_width == 0.3
    assert column.half_height == 0.4
    assert column.size == pytest.approx(0.5, rel=1e-15)
    assert math.tan(column.slenderness) == pytest.approx(0.75, rel=1e-15)
    assert column.uplift_acceleration == pytest.approx(0.75, rel=1e-15)
    assert column.restitution == pytest.approx(1 - 1.5 * 0.36, rel=1e-14)


def test_column_frequency_is_that_of_a_rectangle_about_its_corner():
    # I_o = m (b² + h²)/3 + m R², p² = m g R / I_o
    b, h = 0.7, 3.1
    size = math.hypot(b, h)
    inertia = (b**2 + h**2) / 3 + size**2
    expected = math.sqrt(STANDARD_GRAVITY * size / inertia)
    assert Column(b, h).frequency_parameter == pytest.approx(expected, rel=1e-14)


def test_similar_columns_differ_in_frequency_alone():
    small, large = Column(0.5, 2.0), Column(2.0, 8.0)
    assert large.slenderness == pytest.approx(small.slenderness, rel=1e-15)
    assert large.restitution == pytest.approx(small.restitution, rel=1e-15)
    assert large.frequency_parameter == pytest.approx(small.frequency_parameter / 2, rel=1e-15)


@pytest.mark.parametrize("slenderness", SLENDERNESSES)
def test_column_restitution_follows_from_impulse_and_momentum(slenderness):
    column = column_of(slenderness)
    assert column.restitution == pytest.approx(restitution_from_impulses(column, 0.0), rel=1e-12)


# ---------------------------------------------------------------------------- the frame


@pytest.mark.parametrize("mass_ratio", [0.1, 0.434, 1.0, 4.0, 13.23, 1e3])
def test_frame_frequency_follows_from_its_energy(mass_ratio):
    # A column and its half of the cap, which moves with the far end of the diagonal, 2R away.
    size, half_cap = COLUMN.size, mass_ratio
    inertia = 4 / 3 * size**2 + half_cap * (2 * size) ** 2
    moment = STANDARD_GRAVITY * (size + half_cap * 2 * size)
    frame = RockingFrame(COLUMN, mass_ratio)
    assert frame.frequency_parameter == pytest.approx(math.sqrt(moment / inertia), rel=1e-14)


@pytest.mark.parametrize("mass_ratio", [0.0, 0.1, 0.434, 1.0, 13.23])
@pytest.mark.parametrize("slenderness", SLENDERNESSES)
def test_frame_restitution_follows_from_impulse_and_momentum(slenderness, mass_ratio):
    column = column_of(slenderness)
    expected = restitution_from_impulses(column, mass_ratio)
    assert RockingFrame(column, mass_ratio).restitution == pytest.approx(expected, rel=1e-11)


def test_frame_without_cap_is_its_column():
    frame = RockingFrame(COLUMN, 0.0)
    assert frame.frequency_parameter == pytest.approx(COLUMN.frequency_parameter, rel=1e-15)
    assert frame.equivalent_size == pytest.approx(COLUMN.size, rel=1e-15)
    assert frame.restitution == pytest.approx(COLUMN.restitution, rel=1e-15)


@pytest.mark.parametrize("mass_ratio", [1e12, 1e160, sys.float_info.max, math.inf])
@pytest.mark.parametrize("slenderness", SLENDERNESSES)
def test_frame_under_a_boundless_cap_reaches_the_massless_column_limit(slenderness, mass_ratio):
    column = column_of(slenderness)
    frame = RockingFrame(column, mass_ratio)
    expected = math.sqrt(2 / 3) * column.frequency_parameter
    assert frame.frequency_parameter == pytest.approx(expected, rel=1e-11)
    assert frame.equivalent_size == pytest.approx(1.5 * column.size, rel=1e-11)
    assert frame.restitution == pytest.approx(math.cos(2 * slenderness), rel=1e-10)


def test_heavier_cap_slows_and_enlarges_the_frame_and_lowers_its_restitution():
    frames = [RockingFrame(COLUMN, ratio) for ratio in MASS_RATIOS]
    assert np.all(np.diff([frame.frequency_parameter for frame in frames]) < 0)
    assert np.all(np.diff([frame.equivalent_size for frame in frames]) > 0)
    assert np.all(np.diff([frame.restitution for frame in frames]) < 0)


@pytest.mark.parametrize("slenderness", SLENDERNESSES)
@pytest.mark.parametrize("mass_ratio", MASS_RATIOS[1:])
def test_frame_restitution_is_below_that_of_its_column(slenderness, mass_ratio):
    column = column_of(slenderness)
    assert RockingFrame(column, mass_ratio).restitution < column.restitution


@pytest.mark.parametrize("mass_ratio", MASS_RATIOS)
def test_equivalent_size_is_that_of_a_column_with_the_frames_frequency(mass_ratio):
    frame = RockingFrame(COLUMN, mass_ratio)
    twin = column_of(COLUMN.slenderness, frame.equivalent_size)
    assert twin.frequency_parameter == pytest.approx(frame.frequency_parameter, rel=1e-14)


@pytest.mark.parametrize("mass_ratio", MASS_RATIOS)
def test_frame_lifts_where_its_column_lifts(mass_ratio):
    frame = RockingFrame(COLUMN, mass_ratio)
    assert frame.column == COLUMN
    assert frame.mass_ratio == mass_ratio
    assert frame.slenderness == COLUMN.slenderness
    assert frame.uplift_acceleration == COLUMN.uplift_acceleration


# ---------------------------------------------------------------------------- the block


@pytest.mark.parametrize(
    "structure", [COLUMN, RockingFrame(COLUMN, 4.0), RockingFrame(COLUMN, math.inf)]
)
def test_block_carries_the_three_numbers_of_its_structure(structure):
    block = structure.block()
    assert isinstance(block, RockingBlock)
    assert block.frequency_parameter == structure.frequency_parameter
    assert block.slenderness == structure.slenderness
    assert block.restitution == structure.restitution
    assert block.linearised is False


@pytest.mark.parametrize("structure", [COLUMN, RockingFrame(COLUMN, 4.0), STOCKY])
@pytest.mark.parametrize("restitution", [0.0, 0.5, 1.0])
def test_block_takes_a_given_restitution(structure, restitution):
    block = structure.block(restitution=restitution)
    assert block.restitution == restitution
    assert block.frequency_parameter == structure.frequency_parameter
    assert block.slenderness == structure.slenderness


def test_with_restitution_changes_nothing_else():
    block = RockingBlock(2.0, 0.25, 0.9, linearised=True)
    assert block.with_restitution(0.3) == RockingBlock(2.0, 0.25, 0.3, linearised=True)
    assert block.restitution == 0.9


def test_linear_changes_nothing_else():
    block = RockingBlock(2.0, 0.25, 0.9)
    assert block.linear() == RockingBlock(2.0, 0.25, 0.9, linearised=True)
    assert block.linear().linear() == block.linear()
    assert block.linearised is False


def test_linear_block_lifts_at_slenderness_and_exact_block_at_its_tangent():
    block = RockingBlock(2.0, 0.25, 0.9)
    assert block.uplift_acceleration == pytest.approx(math.tan(0.25), rel=1e-15)
    assert block.linear().uplift_acceleration == 0.25


@pytest.mark.parametrize(
    ("thing", "name"),
    [
        (COLUMN, "half_width"),
        (RockingFrame(COLUMN, 1.0), "mass_ratio"),
        (RockingBlock(2.0, 0.25, 0.9), "restitution"),
    ],
    ids=["column", "frame", "block"],
)
def test_structures_are_frozen(thing, name):
    with pytest.raises(AttributeError):
        setattr(thing, name, 0.1)


# ---------------------------------------------------------------------------- stocky structures


def test_restitution_of_a_stocky_column_is_the_formulas_negative_value():
    assert STOCKY.restitution == pytest.approx(-0.2, rel=1e-14)
    assert RockingFrame(STOCKY, math.inf).restitution == pytest.approx(-0.6, rel=1e-14)


@pytest.mark.parametrize(
    ("structure", "slenderness", "largest"),
    [
        # √r = 0 where sin²α = (1 + 3γ)/(3/2 + 6γ): radians or degrees may be named
        (STOCKY, r"1\.107|63\.4", r"0\.955|54\.7"),
        (RockingFrame(STOCKY, 0.0), r"1\.107|63\.4", r"0\.955|54\.7"),
        (RockingFrame(STOCKY, 1.0), r"1\.107|63\.4", r"0\.819|0\.82\b|46\.9"),
        (RockingFrame(STOCKY, math.inf), r"1\.107|63\.4", r"0\.785|45"),
        (RockingFrame(column_of(0.9), math.inf), r"0\.9\b|0\.90|51\.5|51\.6", r"0\.785|45"),
    ],
    ids=["column", "frame γ=0", "frame γ=1", "frame γ=∞", "column that rocks under no cap only"],
)
def test_stocky_block_is_refused_with_its_slenderness_and_the_largest(
    structure, slenderness, largest
):
    with pytest.raises(ValueError, match=slenderness) as error:
        structure.block()
    assert error.match(largest)


def test_column_just_below_the_largest_slenderness_rocks_and_just_above_does_not():
    largest = math.asin(math.sqrt(2 / 3))
    assert column_of(largest - 1e-9).block().restitution >= 0
    with pytest.raises(ValueError, match=r"0\.955|54\.7"):
        column_of(largest + 1e-6).block()


# ---------------------------------------------------------------------------- bad input


@pytest.mark.parametrize("value", [0.0, -0.2, math.nan, math.inf])
@pytest.mark.parametrize("side", ["half_width", "half_height"])
def test_column_refuses_impossible_sides(side, value):
    sides = {"half_width": 0.5, "half_height": 2.0} | {side: value}
    with pytest.raises(ValueError, match=f"{value:g}") as error:
        Column(**sides)
    assert error.match(side)


@pytest.mark.parametrize("value", ["0.5", True, np.array([0.5, 0.6]), np.ma.masked, None])
def test_what_is_no_number_is_refused_when_a_structure_is_made(value):
    for name, make in (
        ("half_width", lambda: Column(value, 3.0)),
        ("half_height", lambda: Column(0.5, value)),
        ("mass_ratio", lambda: RockingFrame(COLUMN, value)),
        ("frequency_parameter", lambda: RockingBlock(value, 0.25, 0.9)),
        ("slenderness", lambda: RockingBlock(2.0, value, 0.9)),
        ("restitution", lambda: RockingBlock(2.0, 0.25, value)),
        ("restitution", lambda: RockingBlock(2.0, 0.25, 0.9).with_restitution(value)),
    ):
        with pytest.raises(ValueError, match=rf"^{name} is .*; expected a number$"):
            make()


def test_array_of_mass_ratios_is_refused_with_its_shape():
    with pytest.raises(
        ValueError, match=r"^mass_ratio is an array of shape \(2,\); expected a num"
    ):
        RockingFrame(COLUMN, np.array([1.0, 2.0]))


@pytest.mark.parametrize("value", [-0.2, -1e-300, -math.inf, math.nan])
def test_frame_refuses_negative_and_undefined_mass_ratios(value):
    with pytest.raises(ValueError, match=f"{value:g}") as error:
        RockingFrame(COLUMN, value)
    assert error.match("mass_ratio|γ")


@pytest.mark.parametrize("value", [0.0, -0.1, math.pi / 2, 1.6, math.nan, math.inf])
def test_block_refuses_slenderness_outside_a_right_angle(value):
    with pytest.raises(ValueError, match=f"{value:.3g}") as error:
        RockingBlock(2.0, value, 0.9)
    assert error.match("slenderness|α")


@pytest.mark.parametrize("value", [0.0, -2.0, math.nan, math.inf])
def test_block_refuses_impossible_frequency_parameters(value):
    with pytest.raises(ValueError, match=f"{value:.3g}") as error:
        RockingBlock(value, 0.25, 0.9)
    assert error.match("frequency_parameter|p̂|p\\b")


@pytest.mark.parametrize("value", [-0.01, 1.01, math.nan, math.inf])
def test_restitution_outside_zero_to_one_is_refused_everywhere(value):
    block = RockingBlock(2.0, 0.25, 0.9)
    for make in (
        lambda: RockingBlock(2.0, 0.25, value),
        lambda: block.with_restitution(value),
        lambda: COLUMN.block(restitution=value),
        lambda: RockingFrame(COLUMN, 1.0).block(restitution=value),
    ):
        with pytest.raises(ValueError, match=f"{value:g}") as error:
            make()
        assert error.match("restitution|√r")


def test_masses_give_the_mass_ratio_of_any_number_of_columns():
    column = Column(0.5, 3.0)
    assert RockingFrame.of_masses(column, 265.0, 305.3) == RockingFrame(column, 265.0 / 610.6)
    assert RockingFrame.of_masses(column, 6.0, 2.0, columns=6) == RockingFrame(column, 0.5)
    assert RockingFrame.of_masses(column, 0.0, 2.0).mass_ratio == 0.0


@pytest.mark.parametrize(
    ("masses", "columns", "message"),
    [
        ((1.0, 1.0), 1, "columns is 1; expected a whole number from 2 on"),
        ((1.0, 1.0), 2.0, "columns is 2.0"),
        ((1.0, 0.0), 2, "column_mass is 0; expected more than zero"),
        ((-1.0, 1.0), 2, "cap_mass is -1; expected zero or more"),
    ],
)
def test_impossible_masses_are_refused(masses, columns, message):
    with pytest.raises(ValueError, match=message):
        RockingFrame.of_masses(Column(0.5, 3.0), *masses, columns=columns)


@pytest.mark.filterwarnings("always")
@pytest.mark.parametrize(
    ("make", "asked"),
    [
        (lambda: Column(800.0, 4800.0), r"9600 m long, .* in cm or mm\? Then it is 96 or 9.6 m"),
        (lambda: Column.of_dimensions(width=140.0, height=900.0), "900 m long.* is 9 or 0.9 m"),
        (lambda: Column(0.8, 4800.0), "9600 m long"),
        (lambda: RockingFrame.of_masses(COLUMN, 400.0, 60e3), r"_ratio is 0.00333; .* same unit"),
        (lambda: RockingFrame.of_masses(COLUMN, 400e3, 60.0), r"is 3333.33; .* different units"),
        (lambda: RockingFrame(COLUMN, 365), "mass_ratio is 365; few exceed 100: is it a mass"),
        (lambda: FixedMassColumn(COLUMN, 365), "mass_ratio is 365; few exceed 100"),
        (lambda: MonolithicPortal(COLUMN, 365, 5.0), "mass_ratio is 365; few exceed 100"),
        (lambda: MonolithicPortal(COLUMN, 1.0, 6000.0), "span is 6000 m.*is it in cm or mm"),
        (lambda: Record(10.0, [0.0, 0.1]), "time_step is 10 s.*is it in ms"),
        (lambda: Pulse("one-sine", 392.0, 6.28), "amplitude is 392 g.*is it in m/s² or cm/s²"),
        (lambda: simulate(COLUMN, rotation=1.0), "rotation is 1 rad.*is the rotation in degrees"),
        (lambda: Record(0.1, [0.0, 0.1]).scaled_to(pgv=60), "pgv is 60 m/s.*is it in cm/s"),
        (
            lambda: fragility([COLUMN], [Record(0.1, [0.0, 0.1])], [20.0, 60.0]),
            "levels go up to 60 m/s.*are they in cm/s",
        ),
        (lambda: Record(0.1, [0.0, 3.13]), "record: the largest acceleration is 3.13 g.*m/s²"),
    ],
)
def test_what_is_probably_a_mistake_is_asked_where_it_was_written(make, asked):
    with pytest.warns(UserWarning, match=asked) as caught:
        make()
    assert [one.filename for one in caught] == [__file__]


@pytest.mark.filterwarnings("error")
def test_what_is_meant_is_not_asked():
    frames = [RockingFrame(COLUMN, math.inf), RockingFrame(COLUMN, 100.0)]
    assert frames[0].restitution < frames[1].restitution
    meant = Record(0.1, [0.0, 3.13], unit="g")
    assert meant.scaled(2.0).scaled_to(pga=5.0).peak_acceleration == pytest.approx(5.0)


def test_column_says_its_whole_dimensions_and_a_pulse_its_units():
    assert "2.8 m wide, 18 m high" in repr(Column(1.4, 9.0))
    assert repr(Pulse("one-sine", 0.3, 2.0 * math.pi)).endswith(": 0.3 g, period 1 s)")


def test_swapped_width_and_height_are_suspected():
    with pytest.raises(ValueError, match=r"no rocking after an impact.* width and height swapped"):
        judge(Column.of_dimensions(width=9.0, height=1.4), Pulse("one-sine", 0.3, 6.0))


@pytest.mark.parametrize("solver", [simulate, judge])
def test_array_given_for_another_argument_is_not_printed_whole(solver):
    long = np.arange(1e4).reshape(-1, 2)
    for arguments in ((long, Pulse("one-sine", 0.3, 6.0)), (COLUMN, long)):
        with pytest.raises(ValueError, match="expected a") as refused:
            solver(*arguments)
        assert len(str(refused.value)) < 300


@pytest.mark.parametrize("structure", [3, None, Column], ids=repr)
@pytest.mark.parametrize(
    "solver",
    [
        simulate,
        judge,
        reference.simulate,
        reference.judge,
        lambda structure, pulse: overturned_by(structure, pulse, [1.0]),
    ],
)
def test_what_is_no_structure_is_refused_by_every_solver(solver, structure):
    with pytest.raises(ValueError, match=r"^structure is .*; expected a Column, a RockingFrame"):
        solver(structure, Pulse("one-sine", 0.3, 6.0))
