"""The lowest factor that overturns: nested grids, no factor passed over, and words that say so."""

import math

import numpy as np
import pytest

import topheavy as th
from tests.cases import RECORDS
from topheavy.outcomes import minimum
from topheavy.second import reference

EL_CENTRO = th.read_record(RECORDS / "el_centro_1940_NS.AT2")
PIER = th.Column(0.8, 4.8)
BENT = th.RockingFrame.of_masses(PIER, cap_mass=400.0, column_mass=60.0)
BLOCK = th.RockingBlock(2.0, 0.25, 0.9)
LINEAR = th.RockingBlock(1.0, 0.25, 0.9, linearised=True)
SINE = th.Pulse("one-sine", 0.25, 5.0)
SHAKING = th.Record(0.05, 0.3 * np.sin(np.linspace(0, 18, 90)) * np.hanning(90))


@pytest.fixture(scope="module")
def pier():
    """The pier under El Centro, in steps that are those of an engineer's search."""
    return th.lowest_overturning(PIER, EL_CENTRO, (0.0, 3.2), floor=4e-4)


# ---------------------------------------------------------------------------- El Centro


def test_narrow_interval_below_a_minimum_that_four_steps_agree_on_is_found(pier):
    found = dict(pier.steps)
    for step in (0.025, 0.0125, 0.00625, 0.003125):
        assert found[step] == pytest.approx(2.31890, abs=1e-5)
    assert pier.factor == pytest.approx(1.96720, abs=1e-5)
    assert pier.width == pytest.approx(4.4e-4, abs=1e-5)
    assert pier.acceleration == pier.factor * EL_CENTRO.peak_acceleration
    assert pier.acceleration == pytest.approx(0.6272, abs=1e-4)


@pytest.mark.parametrize("judged", [th.judge, reference.judge], ids=["Taylor", "SciPy"])
def test_both_solvers_have_the_narrow_interval(pier, judged):
    ends = zip((*pier.bracket, *pier.upper), (-1e-7, 1e-7, -1e-7, 1e-7), strict=True)
    fell = [judged(PIER, EL_CENTRO.scaled(at + off)).overturned for at, off in ends]
    assert fell == [False, True, True, False]


def test_minimum_rises_on_grids_that_are_not_nested_and_never_on_nested_ones():
    apart = [
        th.overturning_intervals(BENT, EL_CENTRO, (0.0, 5.0), resolution=step)[0].lower[1]
        for step in (0.1, 0.01, 0.001, 0.0005)
    ]
    assert apart == pytest.approx([4.003, 3.2263, 3.2297, 3.2212], abs=5e-4)
    assert apart[2] > apart[1]
    nested = th.lowest_overturning(BENT, EL_CENTRO, (0.0, 5.0), floor=5e-4)
    assert nested.factor <= min(apart) + 1e-9
    factors = [factor for _, factor in nested.steps if factor is not None]
    assert factors == sorted(factors, reverse=True)


# ---------------------------------------------------------------------------- the search


def planted(monkeypatch, edges):
    """Let the factors between each second pair of ascending edges overturn, whatever is shaken."""

    def outcomes(subjects, which, factors):
        return np.searchsorted(edges, factors, side="right") % 2 == 1, None

    monkeypatch.setattr(minimum, "outcomes_by", outcomes)


def test_every_interval_wider_than_the_last_step_is_found_and_its_width_measured(monkeypatch):
    """Planted at random: intervals of all widths, in ranges of all kinds."""
    random, narrower = np.random.default_rng(2014), 0
    for _ in range(300):
        first = random.choice([0.0, random.uniform(0.0, 3.0)])
        last = first + random.uniform(0.5, 4.0)
        begins = np.sort(random.uniform(first, last, 4))
        room = np.diff([*begins, last])
        widths = np.minimum(10.0 ** random.uniform(-6.0, 0.0, 4), 0.5 * room)
        planted(monkeypatch, np.column_stack([begins, begins + widths]).ravel())
        found = th.lowest_overturning(
            BLOCK, SHAKING, (first, last), floor=10 ** random.uniform(-4, 0)
        )
        step, bracket = found.steps[-1][0], 1e-10 * last
        wide = np.flatnonzero(widths > step)
        if found.bracket is None:
            assert wide.size == 0
            continue
        (at,) = np.flatnonzero((begins <= found.factor) & (found.factor < begins + widths))
        assert wide.size == 0 or at <= wide[0]
        narrower += widths[at] < step
        assert found.bracket[0] < begins[at] <= found.factor <= begins[at] + bracket
        assert found.upper[0] < begins[at] + widths[at] <= found.upper[1]
        assert found.width == pytest.approx(widths[at], abs=2 * bracket)
    assert narrower > 50


# ---------------------------------------------------------------------------- ends and words


def test_range_that_begins_in_an_interval_ends_in_one_or_has_none_says_so():
    begun, cut, none = (
        th.lowest_overturning(LINEAR, SINE, ends, floor=0.1)
        for ends in ((4.0, 8.0), (6.5, 8.0), (0.0, 1.0))
    )
    assert begun.bracket == (4.0, 4.0)
    assert {factor for _, factor in begun.steps} == {4.0}
    assert begun.upper[0] == pytest.approx(6.3181, abs=1e-3)
    assert str(begun).startswith("The first factor of the range overturns; it is 4 (1 g), in an ")
    assert cut.factor == pytest.approx(7.16813, abs=1e-5)
    assert (cut.upper, math.isnan(cut.width)) == (None, True)
    assert "open at the end of the range" in str(cut)
    assert (none.bracket, none.upper) == (None, None)
    assert np.isnan([none.factor, none.acceleration, none.width]).all()
    assert {factor for _, factor in none.steps} == {None}
    assert str(none).startswith("No factor tried from 0 to 1 overturns. The step was halved")


@pytest.mark.parametrize(
    ("changes", "says"),
    [
        ({"scale_range": (2.0, 1.0)}, r"scale_range is \(2, 1\); expected it to ascend"),
        (
            {"scale_range": (-1.0, 1.0)},
            r"scale_range begins at -1; .* give excitation.scaled\(-1\)",
        ),
        ({"scale_range": (0.0, math.inf)}, "scale_range is inf"),
        ({"scale_range": (0.0, 1.0, 2.0)}, r"scale_range has shape \(3,\); expected two factors"),
        ({"scale_range": 3.0}, r"scale_range has shape \(\); expected two factors"),
        ({"floor": 0.0}, "floor is 0; expected more than zero"),
        ({"floor": math.nan}, "floor is nan"),
        ({"floor": "fine"}, "floor is 'fine'; expected a number"),
        (
            # from a factor that overturns, so that no search without end would follow
            {"floor": 1e-11, "scale_range": (4.5, 8.0)},
            "floor is 1e-11; expected at least 8e-10, 1e-10 of the last factor",
        ),
        ({"structure": 3}, "structure is 3; expected a Column, a RockingFrame"),
        ({"excitation": 3}, "excitation is 3; expected a Pulse or a Record"),
        ({"excitation": None}, "excitation is None; expected a Pulse or a Record"),
        ({"excitation": th.Pulse("harmonic", 0.3, 5.0)}, "'harmonic'.*forever"),
    ],
)
def test_bad_search_is_refused_by_name_and_value(changes, says):
    given = {"structure": BLOCK, "excitation": SHAKING, "scale_range": (0.0, 3.0), "floor": 0.1}
    with pytest.raises(ValueError, match=says):
        th.lowest_overturning(**given | changes)


def test_first_wide_interval_is_found_beside_a_narrow_lower_one():
    column = th.Column.of_dimensions(width=1.4, height=9.0)
    found = th.lowest_overturning(column, EL_CENTRO, (0.0, 8.0), floor=0.01, wider_than=0.05)
    every = th.overturning_intervals(column, EL_CENTRO, (0, 8), resolution=0.005, most_impacts=0)
    wide = [one for one in every if not one.upper or one.upper[0] - one.lower[1] > 0.05]
    assert found.wide.lower == pytest.approx(wide[0].lower, abs=0.02)
    assert found.wide.lower[1] >= found.factor
    told = f"wider than 0.05 begins at {found.wide.lower[1]:.6g}"
    assert told in str(found)
    assert f"({found.wide.lower[1] * EL_CENTRO.peak_acceleration:.6g} g)" in str(found)
    assert "wider than" not in str(th.lowest_overturning(column, EL_CENTRO, (0.0, 8.0), floor=0.01))


def test_no_wide_interval_in_the_range_is_said():
    found = th.lowest_overturning(PIER, SINE, (0.0, 1e-3), floor=1e-3, wider_than=1e-3)
    assert found.wide is None
    assert "The first interval wider than 0.001 is not in the range" in str(found)
    with pytest.raises(ValueError, match="wider_than is 0; expected more than zero"):
        th.lowest_overturning(PIER, SINE, (0.0, 1.0), floor=0.1, wider_than=0.0)
