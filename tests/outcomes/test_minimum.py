"""The lowest factor that overturns: nested grids, no factor passed over, and words that say so."""

import math
import re

import numpy as np
import pytest

import topheavy as th
from steps.shared import plain
from tests.cases import RECORDS
from topheavy.outcomes import minimum, search

EL_CENTRO = th.read_record(RECORDS / "el_centro_1940_NS.AT2")
PIER = th.Column(0.8, 4.8)
BENT = th.RockingFrame.of_masses(PIER, cap_mass=400.0, column_mass=60.0)
BLOCK = th.RockingBlock(2.0, 0.25, 0.9)
LINEAR = th.RockingBlock(1.0, 0.25, 0.9, linearised=True)
SINE = th.Pulse("one-sine", 0.25, angular_frequency=5.0)
SHAKING = th.Record(0.05, 0.3 * np.sin(np.linspace(0, 18, 90)) * np.hanning(90))


@pytest.fixture(scope="module")
def pier():
    """The pier under El Centro, in steps that are those of an engineer's search."""
    return th.lowest_overturning(PIER, EL_CENTRO, (0.0, 3.2), floor=4e-4)


# ---------------------------------------------------------------------------- El Centro


def test_an_interval_narrower_than_four_steps_is_the_minimum(pier):
    for floor in (0.025, 0.0125, 0.00625, 0.003125):
        coarse = th.lowest_overturning(PIER, EL_CENTRO, (0.0, 3.2), floor=floor)
        assert coarse.factor == pytest.approx(2.31890, abs=1e-5)
    assert pier.factor == pytest.approx(1.96720, abs=1e-5)
    assert pier.width == pytest.approx(4.4e-4, abs=1e-5)
    assert pier.acceleration == pier.factor * EL_CENTRO.peak_acceleration
    assert pier.acceleration == pytest.approx(0.6272, abs=1e-4)


@pytest.mark.parametrize("judged", [th.judge, plain.judge], ids=["Taylor", "plain"])
def test_both_solvers_have_the_narrow_interval(pier, judged):
    ends = zip((*pier.bracket, *pier.upper), (-1e-7, 1e-7, -1e-7, 1e-7), strict=True)
    fell = [judged(PIER, EL_CENTRO.scaled(factor + off)).overturned for factor, off in ends]
    assert fell == [False, True, True, False]


# ---------------------------------------------------------------------------- the search


def planted(monkeypatch, edges):
    """Let the factors between each second pair of ascending edges overturn, under any motion."""

    def outcomes(cases, which, factors, detail=None):
        overturned = np.searchsorted(edges, factors, side="right") % 2 == 1
        return None, overturned, np.zeros(factors.size, np.int64)

    monkeypatch.setattr(minimum, "outcomes_of_factors", outcomes)
    monkeypatch.setattr(search, "outcomes_of_factors", outcomes)


def test_no_interval_wider_than_the_floor_is_missed_and_its_width_is_measured(monkeypatch):
    """Planted at random: intervals of all widths, in ranges of all kinds."""
    random, narrower = np.random.default_rng(2014), 0
    for _ in range(100):
        first = random.choice([0.0, random.uniform(0.0, 3.0)])
        last = first + random.uniform(0.5, 4.0)
        begins = np.sort(random.uniform(first, last, 4))
        room = np.diff([*begins, last])
        widths = np.minimum(10.0 ** random.uniform(-6.0, 0.0, 4), 0.5 * room)
        planted(monkeypatch, np.column_stack([begins, begins + widths]).ravel())
        floor = 10 ** random.uniform(-4, 0)
        minimum = th.lowest_overturning(BLOCK, SHAKING, (first, last), floor=floor)
        bracket = 1e-10 * last
        wide = np.flatnonzero(widths > floor)
        if minimum.bracket is None:
            assert wide.size == 0
            continue
        (place,) = np.flatnonzero((begins <= minimum.factor) & (minimum.factor < begins + widths))
        assert wide.size == 0 or place <= wide[0]
        narrower += widths[place] < floor
        assert minimum.bracket[0] < begins[place] <= minimum.factor <= begins[place] + bracket
        ends = begins + widths
        last_in = np.flatnonzero((minimum.upper[0] < ends) & (begins <= minimum.upper[0]))
        assert last_in.size == 1
        assert minimum.upper[0] < ends[last_in[0]] <= minimum.upper[1]
        gaps = begins[place + 1 : last_in[0] + 1] - ends[place : last_in[0]]
        distances = ends[place : last_in[0]] - begins[place]
        assert (gaps < np.maximum(floor, 0.1 * distances)).all()
    assert narrower > 3


# ---------------------------------------------------------------------------- ends and words


def test_range_that_begins_in_an_interval_ends_in_one_or_has_none_says_so():
    begun, cut, none = (
        th.lowest_overturning(LINEAR, SINE, ends, floor=0.1)
        for ends in ((4.0, 8.0), (6.5, 8.0), (0.0, 1.0))
    )
    assert begun.bracket == (4.0, 4.0)
    assert begun.upper[0] == pytest.approx(6.3181, abs=1e-3)
    assert str(begun).startswith("The lowest factor that overturns is 4 (1 g), in an interval ")
    assert cut.factor == pytest.approx(7.16813, abs=1e-5)
    assert (cut.upper, math.isnan(cut.width)) == (None, True)
    assert "open at the end of the range" in str(cut)
    assert (none.bracket, none.upper) == (None, None)
    assert np.isnan([none.factor, none.acceleration, none.width]).all()
    assert str(none) == (
        "No factor from 0 to 1 overturns. Intervals narrower than 0.1 are not excluded."
    )


# ---------------------------------------------------------------------------- spectrum, capacity


@pytest.mark.parametrize("shape", ["one-sine", "ricker-symmetric"])
def test_spectrum_has_the_minimum_of_each_period(shape):
    periods = [0.4, 1.0, 4.0]
    spectrum = th.overturning_spectrum(BLOCK, shape, periods, highest=12.0)
    uplift = BLOCK.uplift_acceleration
    for period, acceleration in zip(periods, spectrum.acceleration.to_numpy(), strict=True):
        pulse = th.Pulse(shape, 1.0, period=period)
        ends = (uplift, 12.0 * uplift)
        minimum = th.lowest_overturning(BLOCK, pulse, ends, floor=1e-3 * uplift)
        assert acceleration == pytest.approx(minimum.acceleration, rel=1e-9, nan_ok=True)
        if not math.isnan(acceleration):
            after_impact = th.judge(BLOCK, pulse.scaled(acceleration)).number_of_impacts > 0
            assert after_impact == spectrum.after_impact.sel(period=period)
    assert np.isfinite(spectrum.acceleration).sum() >= 1


def by_counting(factors, overturned, window, share):
    """The capacity on a grid of equal ratios, window by window."""
    size = round(math.log1p(window) / math.log(factors[1] / factors[0])) + 1
    for begin in range(len(factors) - size + 1):
        if sum(overturned[begin : begin + size]) >= share * size:
            return factors[begin]
    return math.nan


def test_capacity_is_the_first_window_with_enough_that_overturn():
    random = np.random.default_rng(5)
    factors = 1.002 ** np.arange(800)
    for share in (0.5, 0.8, 0.9, 1.0):
        overturned = random.random(factors.size) < np.linspace(0.0, 1.2, factors.size)
        capacity = th.Capacity(factors, overturned, share=share)
        expected = [by_counting(factors, overturned, width, share) for width in (0.025, 0.1, 0.2)]
        assert [capacity.over(width) for width in (0.025, 0.1, 0.2)] == expected
        assert capacity.factor == by_counting(factors, overturned, 0.05, share)


def test_capacity_under_a_record_is_that_of_its_outcomes():
    chosen = th.capacity(PIER, EL_CENTRO)
    factors = chosen.factors
    assert factors[0] == pytest.approx(PIER.uplift_acceleration / EL_CENTRO.peak_acceleration)
    np.testing.assert_array_equal(chosen.overturned, th.overturned_by(PIER, EL_CENTRO, factors))
    for capacity in (chosen, th.capacity(PIER, EL_CENTRO, np.geomspace(0.5, 8.0, 3000))):
        inside = (capacity.factors >= capacity.factor) & (
            capacity.factors <= 1.05 * capacity.factor
        )
        assert capacity.overturned[inside].mean() >= 0.88
        low, high = capacity.range
        assert low <= capacity.factor <= high
        assert capacity.factor == pytest.approx(chosen.factor, rel=0.01)
        assert capacity.acceleration == capacity.factor * EL_CENTRO.peak_acceleration
        assert str(capacity).startswith(f"A factor of {capacity.factor:.3g} (")


@pytest.mark.parametrize("scale_vertical", [True, False])
def test_capacity_chooses_factors_that_keep_contact(scale_vertical):
    up = th.Record(EL_CENTRO.time_step, 0.5 * EL_CENTRO.acceleration)
    options = {"vertical": up, "scale_vertical": scale_vertical}
    capacity = th.capacity(th.Column(2.0, 4.0), EL_CENTRO, **options)
    contact = -1.0 / up.acceleration.min()
    assert (capacity.factors[-1] < contact) == scale_vertical
    assert capacity.factors[0] < 0.2 * math.tan(0.46) / EL_CENTRO.peak_acceleration
    assert math.isnan(capacity.factor) == scale_vertical
    assert str(capacity).startswith("No capacity") == scale_vertical


def test_capacity_is_nan_where_no_window_of_the_grid_has_enough():
    factors = np.geomspace(1.0, 2.0, 301)
    capacity = th.Capacity(factors, factors > 1.8)
    assert "; 1.79 to more than 2 over" in str(capacity)
    assert math.isnan(capacity.over(0.2))
    assert str(th.Capacity(factors, factors > 1.93)) == (
        "No capacity from a factor of 1 to 2: in no window of 5 % do 90 % of the factors overturn; "
        "16 of 301 factors overturn."
    )


@pytest.mark.parametrize("factors", [[1.0, 2.0, 3.0], np.linspace(0.1, 5.0, 50)])
def test_grid_that_is_too_coarse_is_refused_with_one_that_is_not(factors):
    with pytest.raises(ValueError, match=r"steps of up to .*at most 0\.25% .* np\.geo") as error:
        th.capacity(PIER, EL_CENTRO, factors)
    first, last, size = re.findall(r"geomspace\((.*), (.*), (\d+)\)", str(error.value))[0]
    th.Capacity(np.geomspace(float(first), float(last), int(size)), np.zeros(int(size), bool))
    coarser = int(size) - 1
    with pytest.raises(ValueError, match="steps of up to"):
        th.Capacity(np.geomspace(float(first), float(last), coarser), np.zeros(coarser, bool))
