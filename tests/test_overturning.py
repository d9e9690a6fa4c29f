"""Maps and intervals: each cell is a history, no interval is missed, and brackets bracket."""

import math
from itertools import pairwise

import numpy as np
import pytest
import xarray

from topheavy import (
    PULSE_SHAPES,
    Column,
    FixedMassColumn,
    MonolithicPortal,
    Pulse,
    Record,
    RockingBlock,
    RockingFrame,
    intervals_together,
    judge,
    minima_together,
    minimum_overturning,
    overturned_by,
    overturned_together,
    overturning_intervals,
    overturning_map,
    simulate,
)
from topheavy.kernel.grid import mixed_outcomes_of
from topheavy.kernel.outcome import TOLERANCE
from topheavy.overturning import (
    AT_A_TIME,
    SAFE,
    Interval,
    Search,
    _halved,
    outcomes_by,
    outcomes_of_subjects,
    steered,
    subjects_of,
)

BLOCK = RockingBlock(2.0, 0.25, 0.9)
BOTH = pytest.mark.parametrize("block", [BLOCK, BLOCK.linear()], ids=["exact", "linear"])
ENDING = sorted(set(PULSE_SHAPES) - {"harmonic"})
#: Zhang & Makris (2001), with amplitudes in units of αg.
LINEAR = RockingBlock(1.0, 0.25, 0.9, linearised=True)
SINE = Pulse("one-sine", 0.25, 5.0)


# ---------------------------------------------------------------------------- maps


def test_map_is_labelled_with_units():
    found = overturning_map(BLOCK, "one-cosine", [3.0, 5.0, 9.0], [0.0, 0.3, 0.6, 2.0])
    assert isinstance(found, xarray.Dataset)
    assert found.sizes == {"angular_frequency": 3, "amplitude": 4}
    for name in ("peak_rotation", "overturned", "impacts"):
        assert found[name].dims == ("angular_frequency", "amplitude")
    assert {name: value.attrs["units"] for name, value in found.variables.items()} == {
        "peak_rotation": "rad",
        "overturned": "1",
        "impacts": "1",
        "angular_frequency": "rad/s",
        "amplitude": "g",
    }
    assert (found.peak_rotation.dtype, found.overturned.dtype, found.impacts.dtype) == (
        float,
        bool,
        np.int64,
    )
    np.testing.assert_array_equal(found.angular_frequency, [3.0, 5.0, 9.0])
    np.testing.assert_array_equal(found.amplitude, [0.0, 0.3, 0.6, 2.0])
    assert found.attrs == {
        "shape": "one-cosine",
        "frequency_parameter": 2.0,
        "slenderness": 0.25,
        "restitution": 0.9,
        "linearised": 0,
    }
    assert overturning_map(BLOCK.linear(), "one-sine", 1.0, 0.3).attrs["linearised"] == 1


def test_map_can_be_written_to_a_file(tmp_path):
    found = overturning_map(BLOCK, "one-sine", [3.0, 5.0], [0.3, 2.0])
    found.to_netcdf(tmp_path / "map.nc", engine="scipy")
    with xarray.open_dataset(tmp_path / "map.nc", engine="scipy") as read:
        np.testing.assert_array_equal(read.peak_rotation, found.peak_rotation)
        np.testing.assert_array_equal(read.overturned, found.overturned)


@BOTH
@pytest.mark.parametrize("shape", ENDING)
def test_each_cell_of_a_map_is_a_history(block, shape):
    frequencies = np.array([2.5, 6.0, 13.0])
    amplitudes = block.uplift_acceleration * np.array([0.0, 0.9999, 1.01, 1.4, 2.5, 4.0, 9.0])
    found = overturning_map(block, shape, frequencies, amplitudes)
    for i, omega in enumerate(frequencies):
        for j, amplitude in enumerate(amplitudes):
            cell = found.isel(angular_frequency=i, amplitude=j)
            pulse = Pulse(shape, amplitude, omega)
            end, whole = judge(block, pulse), simulate(block, pulse, samples=2)
            assert bool(cell.overturned) == end.overturned == whole.overturned
            assert int(cell.impacts) == end.impacts == whole.number_of_impacts
            for peak in (float(cell.peak_rotation), whole.peak_rotation):
                np.testing.assert_allclose(end.peak, peak, rtol=0, atol=1e-9 * block.slenderness)
    assert (found.overturned == np.isnan(found.peak_rotation)).all()
    assert found.overturned.any()
    assert not found.peak_rotation[:, :2].any()


def test_map_takes_a_column_and_a_frame_for_their_block():
    column = Column(0.5, 2.0)
    for structure in (column, RockingFrame(column, 1.0), RockingFrame(column, math.inf)):
        grid = ("one-sine", [2.0, 5.0], [0.3, 0.5, 1.5])
        first, second = (overturning_map(x, *grid) for x in (structure, structure.block()))
        xarray.testing.assert_identical(first, second)


def test_map_leaves_what_it_was_given_alone():
    frequencies, amplitudes = np.array([2.0, 5.0]), np.array([0.3, 0.5])
    found = overturning_map(BLOCK, "one-sine", frequencies, amplitudes)
    frequencies[:], amplitudes[:] = 7.0, 7.0
    assert found.angular_frequency.values.tolist() == [2.0, 5.0]
    assert found.amplitude.values.tolist() == [0.3, 0.5]


def test_axes_may_be_in_any_order_and_need_not_be_arrays():
    back = overturning_map(BLOCK, "one-sine", (9, 3), [2, 0.3])
    forth = overturning_map(BLOCK, "one-sine", [3.0, 9.0], [0.3, 2.0])
    xarray.testing.assert_equal(back.isel(angular_frequency=[1, 0], amplitude=[1, 0]), forth)


@pytest.mark.parametrize(
    ("shape", "frequencies", "amplitudes", "says"),
    [
        ("harmonic", [1.0], [0.3], "'harmonic'.*forever.*pulse that ends"),
        ("one-sin", [1.0], [0.3], r"'one-sin' \(did you mean 'one-sine'\?\)"),
        ("ricker", [1.0], [0.3], "did you mean 'ricker"),
        ("zigzag", [1.0], [0.3], "'zigzag'; expected one of one-sine"),
        ("one-sine", [], [0.3], r"angular_frequencies has shape \(0,\).*not empty"),
        ("one-sine", [1.0], [], r"amplitudes has shape \(0,\).*not empty"),
        ("one-sine", [[1.0]], [0.3], r"angular_frequencies has shape \(1, 1\)"),
        ("one-sine", [1.0], np.ones((2, 2)), r"amplitudes has shape \(2, 2\)"),
        ("one-sine", [1.0, math.nan], [0.3], "angular_frequencies holds nan.*finite"),
        ("one-sine", [1.0, math.inf], [0.3], "angular_frequencies holds inf.*finite"),
        ("one-sine", [1.0], [0.3, math.nan], "amplitudes holds nan.*finite"),
        ("one-sine", [1.0], [-math.inf], "amplitudes holds -inf.*finite"),
        ("one-sine", [1.0, 0.0], [0.3], "angular_frequencies goes down to 0; .*zero or negative"),
        ("one-sine", [1.0, -2.5], [0.3], "angular_frequencies goes down to -2.5; .*negative"),
        ("one-sine", [1.0], [0.3, -0.1], "amplitudes goes down to -0.1; it cannot be negative"),
        ("one-sine", ["1.0"], [0.3], "angular_frequencies: element 0 is '1.0'; expected a number"),
        ("one-sine", [1.0], [0.3, None], "amplitudes: element 1 is None; expected a number"),
        ("one-sine", [1.0], np.ma.array([0.3, 9.0], mask=[0, 1]), "amplitudes has 1 masked of 2"),
    ],
)
def test_bad_map_is_refused_by_name_and_value(shape, frequencies, amplitudes, says):
    with pytest.raises(ValueError, match=says):
        overturning_map(BLOCK, shape, frequencies, amplitudes)


def test_structure_that_cannot_rock_has_no_map():
    with pytest.raises(ValueError, match=r"63\.4"):
        overturning_map(Column(2.0, 1.0), "one-sine", [1.0], [0.3])


# ---------------------------------------------------------------------------- intervals


def test_intervals_are_those_of_zhang_and_makris():
    """With impact, a survival region, then without impact; a narrow one near the first boundary."""
    found = overturning_intervals(LINEAR, SINE, (1.0, 10.0), resolution=1e-3)
    assert [interval.impacts for interval in found] == [1, 0]
    assert found[0].lower[1] == pytest.approx(3.0186, abs=1e-3)
    assert found[0].upper[0] == pytest.approx(6.3181, abs=1e-3)
    assert found[1].lower[1] == pytest.approx(7.16813, abs=1e-5)
    assert found[1].upper is None


CASES = {
    "Zhang & Makris": (LINEAR, SINE, (1.0, 10.0), 0.05),
    "exact one-sine": (BLOCK, Pulse("one-sine", 0.25, 10.0), (1.0, 14.0), 0.02),
    "one-cosine": (BLOCK, Pulse("one-cosine", 0.25, 5.0), (1.0, 9.0), 0.02),
    "antisymmetric": (BLOCK, Pulse("ricker-antisymmetric", 0.25, 5.0), (1.0, 6.0), 0.01),
    "mirrored": (BLOCK, Pulse("ricker-symmetric", -0.25, 5.0), (-5.0, -1.0), 0.01),
    "across zero": (BLOCK, Pulse("one-sine", 0.25, 5.0), (-6.0, 5.0), 0.02),
    "record": (
        BLOCK,
        Record(0.05, 0.3 * np.sin(np.linspace(0, 18, 90)) * np.hanning(90)),
        (0.5, 6.0),
        0.01,
    ),
}


@pytest.fixture(params=CASES.values(), ids=CASES.keys(), scope="module")
def case(request):
    block, excitation, scale_range, resolution = request.param
    found = overturning_intervals(block, excitation, scale_range, resolution=resolution)
    return block, excitation, scale_range, resolution, found


def test_intervals_ascend_and_do_not_overlap(case):
    *_, (first, last), _, found = case
    assert found
    edges = [first]
    for interval in found:
        assert interval.lower[0] <= interval.lower[1]
        edges += [interval.lower[0], interval.lower[1]]
        edges += [last, last] if interval.upper is None else interval.upper
    # where two meet, they share the bracket
    shared = [before.upper == after.lower for before, after in pairwise(found)]
    for before, after, meet in zip(found[:-1], found[1:], shared, strict=True):
        assert before.upper is not None
        assert meet or before.upper[1] < after.lower[0]
        assert not meet or before.impacts != after.impacts
    assert min(edges) == first
    assert max(edges) == last or found[-1].upper is not None


def test_brackets_have_the_boundary_between_them(case):
    block, excitation, (first, last), resolution, found = case
    narrow = 1.01e-10 * max(abs(first), abs(last))
    subjects = subjects_of([Search(block, excitation, (first, last))])

    def label(scale):
        ((overturned, impacts),) = outcomes_of_subjects(subjects, [np.array([scale])], TOLERANCE)
        return impacts[0] if overturned[0] else SAFE

    for interval in found:
        low, high = interval.lower
        assert label(high) == interval.impacts
        assert high - low <= max(narrow, resolution / 1024)
        if low == high:
            assert low == first
        else:
            assert label(low) != interval.impacts
        if interval.upper is None:
            assert label(last) == interval.impacts
        else:
            low, high = interval.upper
            assert label(low) == interval.impacts
            assert label(high) != interval.impacts
            assert high - low <= max(narrow, resolution / 1024)
    assert sum(i.lower[1] - i.lower[0] <= narrow for i in found) >= 0.5 * len(found)


def test_brackets_hold_the_boundary_of_a_single_history_to_its_tolerance(case):
    block, excitation, (first, last), _, found = case
    slight = 1e-8 * max(abs(first), abs(last))
    for interval in found:
        upper = last if interval.upper is None else interval.upper[0]
        for scale in (interval.lower[1] + slight, upper - slight):
            if interval.lower[1] < scale < upper:
                end = judge(block, excitation.scaled(scale))
                assert (end.overturned, end.impacts) == (True, interval.impacts)


def test_way_9_no_interval_wider_than_the_resolution_is_missed(case):
    """A scan five times as fine: runs of like outcome wider than the resolution are all there."""
    block, excitation, (first, last), resolution, found = case
    fine = np.linspace(first, last, 5 * math.ceil((last - first) / resolution) + 1)
    labels = []
    for scale in fine:
        end = judge(block, excitation.scaled(scale))
        labels.append(end.impacts if end.overturned else SAFE)
    changes = np.flatnonzero(np.diff(labels)) + 1
    begins, ends = [0, *changes], [*changes - 1, len(fine) - 1]
    wide = 0
    for begin, end in zip(begins, ends, strict=True):
        if fine[end] - fine[begin] <= resolution:
            continue
        wide += 1
        middle = [
            i for i in found
            if i.lower[0] < fine[end] and (i.upper is None or i.upper[1] > fine[begin])
        ]  # fmt: skip
        if labels[begin] == SAFE:
            # only what is narrower than the resolution is wrongly labelled as overturned
            for interval in middle:
                upper = last if interval.upper is None else interval.upper[0]
                inside = min(upper, fine[end]) - max(interval.lower[1], fine[begin])
                assert inside <= 1e-9
        else:
            holding = [i for i in middle if i.impacts == labels[begin]]
            assert len(holding) == 1
            assert holding[0].lower[0] <= fine[begin]
            assert holding[0].upper is None or holding[0].upper[1] >= fine[end]
    assert wide >= 2


@pytest.mark.parametrize("resolution", [0.1, 0.849, 1.7, 20.0])
@pytest.mark.parametrize("last", [9.0, 9.7, 10.0])
def test_way_9_first_scan_has_no_step_wider_than_the_resolution(monkeypatch, last, resolution):
    scans = []

    def scanned(blocks, shape, which, scales, amplitudes, *more, **named):
        scans.append(amplitudes)
        return mixed_outcomes_of(blocks, shape, which, scales, amplitudes, *more, **named)

    monkeypatch.setattr("topheavy.overturning.mixed_outcomes_of", scanned)
    overturning_intervals(LINEAR, SINE, (1.0, last), resolution=resolution)
    factors = scans[0] / SINE.amplitude
    assert (factors[0], factors[-1]) == (1.0, last)
    assert np.diff(factors).max() <= resolution * (1 + 1e-12)
    assert len(factors) == math.ceil((last - 1.0) / resolution) + 1


@pytest.mark.parametrize("shift", np.linspace(0.0, 1.9, 20))
def test_way_9_bay_just_wider_than_the_resolution_is_found_wherever_the_range_begins(shift):
    """The bay from 6.3181 to 7.1681."""
    found = overturning_intervals(LINEAR, SINE, (1.0 + shift, 10.0 - shift), resolution=0.849)
    assert [interval.impacts for interval in found] == [1, 0]


def test_neighbours_with_different_impacts_are_separate():
    found = overturning_intervals(BLOCK, CASES["antisymmetric"][1], (1.0, 6.0), resolution=0.01)
    touching = [(a, b) for a, b in pairwise(found) if a.upper == b.lower]
    assert touching
    assert all(a.impacts != b.impacts for a, b in touching)
    joined = overturning_intervals(
        BLOCK, CASES["antisymmetric"][1], (1.0, 6.0), resolution=0.01, most_impacts=0
    )
    assert {interval.impacts for interval in joined} == {0}
    assert len(joined) < len(found)
    assert all(a.upper != b.lower for a, b in pairwise(joined))
    two = overturning_intervals(
        BLOCK, CASES["antisymmetric"][1], (1.0, 6.0), resolution=0.01, most_impacts=2
    )
    assert max(interval.impacts for interval in two) == 2


def test_range_that_begins_or_ends_inside_an_interval_says_so():
    within = overturning_intervals(LINEAR, SINE, (4.0, 5.0), resolution=0.1)
    assert within == [Interval((4.0, 4.0), None, 1)]
    assert overturning_intervals(LINEAR, SINE, (6.4, 7.1), resolution=0.01) == []
    assert overturning_intervals(LINEAR, SINE, (-1.0, 1.0), resolution=0.5) == []
    beyond = overturning_intervals(LINEAR, SINE, (5.0, 7.0), resolution=0.1)
    assert len(beyond) == 1
    assert beyond[0].lower == (5.0, 5.0)
    assert beyond[0].upper[0] == pytest.approx(6.3181, abs=1e-3)


def test_resolution_wider_than_the_range_looks_at_both_ends():
    found = overturning_intervals(LINEAR, SINE, (2.0, 4.0), resolution=50.0)
    assert len(found) == 1
    assert found[0].lower[1] == pytest.approx(3.0186, abs=1e-3)
    assert found[0].upper is None


def test_boundary_of_a_frame_is_in_the_units_of_its_pulse():
    # Zhou, Du & Han (2019)
    frame = RockingFrame(Column(0.75, 3.5), 13.23)
    pulse = Pulse("ricker-symmetric", 0.1, 2 * math.pi / 3.14)
    found = overturning_intervals(frame, pulse, (1.0, 10.0), resolution=0.01)
    assert 0.1 * found[0].lower[1] == pytest.approx(0.3134, abs=2e-4)
    assert found == overturning_intervals(frame.block(), pulse, (1.0, 10.0), resolution=0.01)


def test_factor_on_a_record_is_that_of_its_scaled_motion():
    pulse = Pulse("one-sine", 0.25, 5.0)
    step = pulse.duration / 500
    record = Record(step, pulse.excitation(step * np.arange(501)))
    sampled = overturning_intervals(LINEAR, record, (1.0, 10.0), resolution=0.05)
    smooth = overturning_intervals(LINEAR, pulse, (1.0, 10.0), resolution=0.05)
    assert [i.impacts for i in sampled] == [i.impacts for i in smooth]
    for one, other in zip(sampled, smooth, strict=True):
        assert one.lower[0] == pytest.approx(other.lower[0], rel=1e-3)


@pytest.mark.parametrize(
    ("scale_range", "options", "says"),
    [
        ((2.0, 1.0), {}, r"scale_range is \(2, 1\); expected it to ascend"),
        ((1.0, 1.0), {}, r"scale_range is \(1, 1\)"),
        ((math.nan, 1.0), {}, "scale_range is nan"),
        ((0.0, math.inf), {}, "scale_range is inf"),
        ((0.0, 1.0), {"resolution": 0.0}, "resolution is 0"),
        ((0.0, 1.0), {"resolution": -0.1}, "resolution is -0.1"),
        ((0.0, 1.0), {"resolution": math.nan}, "resolution is nan"),
        ((0.0, 1.0), {"most_impacts": -1}, "most_impacts is -1"),
        ((0.0, 1.0), {"most_impacts": 1.5}, "most_impacts is 1.5; expected a whole number"),
        ((0.0, 1.0), {"most_impacts": math.nan}, "most_impacts is nan"),
        ((0.0, 1.0), {"most_impacts": "1"}, "most_impacts is '1'"),
    ],
)
def test_bad_search_is_refused_by_name_and_value(scale_range, options, says):
    with pytest.raises(ValueError, match=says):
        overturning_intervals(LINEAR, SINE, scale_range, **({"resolution": 0.1} | options))


def test_harmonic_has_no_intervals():
    with pytest.raises(ValueError, match=r"'harmonic'.*forever"):
        overturning_intervals(LINEAR, Pulse("harmonic", 0.3, 5.0), (0.0, 1.0), resolution=0.1)
    with pytest.raises(ValueError, match="excitation is 3; expected a Pulse or a Record"):
        overturning_intervals(LINEAR, 3, (0.0, 1.0), resolution=0.1)


# ---------------------------------------------------------------------------- the search


def halved(label, boundary, width, narrowest):
    """The boundaries of one search, whose factors a function labels."""
    search = _halved([boundary], width, narrowest)
    (found,) = steered([search], lambda asked: [label(each) for each in asked.values()])
    return found


def searched(edges, values, boundary, width=1e-9, narrowest=1e-3):
    """The boundaries of a step function with these `values` between these `edges`."""

    def label(scales):
        return np.array(values)[np.searchsorted(edges, scales)]

    low, high = boundary
    ends = label(np.array([low, high]))
    return halved(label, (low, high, ends[0], ends[1]), width, narrowest)


def test_search_closes_in_on_a_boundary():
    ((low, high, below, above),) = searched([0.3], [SAFE, 2], (0.0, 1.0))
    assert low <= 0.3 <= high
    assert 0 < high - low <= 1e-9
    assert (below, above) == (SAFE, 2)


def test_third_outcome_that_is_met_inside_a_bracket_is_kept():
    found = searched([0.3, 0.4], [SAFE, 5, 2], (0.0, 0.7))
    assert [(below, above) for *_, below, above in found] == [(SAFE, 5), (5, 2)]
    for (low, high, *_), edge in zip(found, (0.3, 0.4), strict=True):
        assert low <= edge <= high
        assert high - low <= 1e-9


def test_sliver_is_left_inside_its_bracket():
    """Without end, as where every number of impacts has an interval of its own."""
    steps = ([0.3499, 0.3501], [SAFE, 5, 2], (0.0, 1.4))
    assert searched(*steps, narrowest=0.8) == [(0.0, 0.7, SAFE, 2)]
    assert len(searched(*steps, narrowest=0.6)) == 2


def test_search_ends_where_no_number_is_left_between():
    ((low, high, *_),) = searched([0.3], [SAFE, 2], (0.0, 1.0), width=0.0)
    assert high == math.nextafter(low, 1.0)


# ---------------------------------------------------------------------------- factors


SHAKING = Record(0.02, 0.6 * np.sin(np.linspace(0.0, 40.0, 400)) * np.linspace(1.0, 0.2, 400))
FACTORS = np.linspace(0.0, 6.0, 61)


@pytest.mark.parametrize("excitation", [SINE, SHAKING], ids=["pulse", "record"])
@pytest.mark.parametrize("structure", [BLOCK, RockingFrame(Column(0.5, 3.0), 2.0)])
def test_each_factor_is_judged_as_the_scaled_excitation(structure, excitation):
    found = overturned_by(structure, excitation, FACTORS)
    assert found.any()
    assert not found.all()
    one_by_one = [judge(structure, excitation.scaled(factor)).overturned for factor in FACTORS]
    np.testing.assert_array_equal(found, one_by_one)


def test_tolerance_of_the_factors_is_passed_on():
    noise = Record(0.1, np.random.default_rng(1).normal(0.0, 0.3, 300))
    factors = np.linspace(0.5, 3.0, 1000)
    rough, fine = (overturned_by(BLOCK, noise, factors, tolerance=t) for t in (1e-2, 1e-12))
    assert (rough != fine).any()
    assert (overturned_by(BLOCK, noise, factors) != fine).mean() < 0.01


@pytest.mark.parametrize(
    ("factors", "words"), [([1.0, -1.0], "factors goes down to -1"), ([], "factors has shape")]
)
def test_factors_that_cannot_be_are_refused(factors, words):
    with pytest.raises(ValueError, match=words):
        overturned_by(BLOCK, SHAKING, factors)


def test_factors_on_a_harmonic_are_refused():
    with pytest.raises(ValueError, match="goes on forever"):
        overturned_by(BLOCK, Pulse("harmonic", 0.3, 5.0), FACTORS)


def test_halvings_ahead_find_what_halving_one_by_one_finds(monkeypatch):
    """Also intervals much narrower than the bracket, planted at random: the same, no others."""
    rng, calls, met = np.random.default_rng(3), [0, 0], 0
    for _ in range(100):
        edges = np.sort(np.concatenate([rng.uniform(0, 1, 3), 0.5 + rng.uniform(0, 1e-3, 2)]))
        labels = rng.permutation([SAFE, 0, 1, 2, 3, 4])
        found = []
        for way, together in enumerate((1, 32)):

            def label(factors, way=way, edges=edges, labels=labels):
                calls[way] += 1
                return labels[np.searchsorted(edges, factors)]

            monkeypatch.setattr("topheavy.overturning.TOGETHER", together)
            ends = label(np.array([0.0, 1.0]))
            found.append(halved(label, (0.0, 1.0, *ends), 1e-9, 1e-4))
        assert found[0] == found[1]
        met += len(found[0]) > 2
    assert met > 20
    assert calls[1] < 0.5 * calls[0]


@pytest.mark.parametrize(("block", "excitation", "scales", "_"), CASES.values(), ids=CASES)
def test_minimum_is_the_lower_end_of_the_first_interval(block, excitation, scales, _):
    """On grids of several pieces: the first factor that overturns is in one or another."""
    for first in np.linspace(*scales, 4)[:3]:
        resolution = (scales[1] - first) / (5 * AT_A_TIME)
        of = {"scale_range": (float(first), scales[1]), "resolution": resolution}
        several = overturning_intervals(block, excitation, **of, most_impacts=0)
        lowest = several[0].lower if several else None
        assert minimum_overturning(block, excitation, **of) == lowest


def test_minimum_at_the_first_factor_and_none():
    assert minimum_overturning(LINEAR, SINE, (4.0, 5.0), resolution=0.1) == (4.0, 4.0)
    assert minimum_overturning(LINEAR, SINE, (6.4, 7.1), resolution=0.01) is None
    with pytest.raises(ValueError, match="expected it to ascend"):
        minimum_overturning(LINEAR, SINE, (1.0, 1.0), resolution=0.1)


def test_outcomes_by_are_those_of_judge():
    for excitation in (SINE, CASES["antisymmetric"][1]):
        overturned, impacts = outcomes_by(BLOCK, excitation, FACTORS)
        ends = [judge(BLOCK, excitation.scaled(factor)) for factor in FACTORS]
        assert overturned.tolist() == [end.overturned for end in ends]
        assert impacts.tolist() == [end.impacts for end in ends]


# ---------------------------------------------------------------------------- many at once

COLUMN = Column(0.5, 3.0)
MANY = [
    COLUMN,
    RockingFrame(COLUMN, 2.0),
    FixedMassColumn(COLUMN, 1.0),
    MonolithicPortal(COLUMN, 1.0, 1.2),
    COLUMN.block().linear(),
]
UP = Record(0.013, 0.2 * np.cos(0.3 * np.arange(160)), "up")


def searches():
    """Unlike structures under unlike motions, of which some are the same object."""
    record = Record(0.02, 0.25 * np.sin(0.11 * np.arange(140)) + 0.1 * np.sin(0.4 * np.arange(140)))
    pulses = [Pulse("one-sine", 0.2, 3.0), Pulse("one-sine", 0.2, 5.5), Pulse("constant", 0.3, 4.0)]
    found = [Search(structure, record, (0.5, 4.0)) for structure in MANY]
    found += [Search(structure, record, (0.5, 4.0), UP) for structure in MANY[:3]]
    found += [Search(MANY[1], record, (0.5, 4.0), UP, scale_vertical=False)]
    found += [Search(one, pulse, (0.9, 7.0)) for one in MANY[::2] for pulse in pulses]
    return found


def test_searches_together_find_what_each_finds_alone():
    """To the last bit, in their order."""
    given, together = searches(), intervals_together(searches(), resolution=0.07, most_impacts=1)
    low = minima_together(given, resolution=0.07)
    assert len(together) == len(low) == len(given)
    for search, intervals, bracket in zip(given, together, low, strict=True):
        named = {"vertical": search.vertical, "scale_vertical": search.scale_vertical}
        named["resolution"] = 0.07
        assert intervals == overturning_intervals(*search[:3], most_impacts=1, **named)
        assert bracket == minimum_overturning(*search[:3], **named)
        assert bracket == (intervals[0].lower if intervals else None)
    assert len({intervals[0].lower for intervals in together if intervals}) > 12


def test_searches_together_ask_the_kernel_less_often(monkeypatch):
    calls = []

    def counted(*given, **named):
        calls.append(given[2].size)
        return mixed_outcomes_of(*given, **named)

    monkeypatch.setattr("topheavy.overturning.mixed_outcomes_of", counted)
    for search in searches():
        overturning_intervals(*search[:3], resolution=0.07)
    alone = len(calls)
    calls.clear()
    intervals_together(searches(), resolution=0.07)
    assert len(calls) < 0.6 * alone


def test_structures_under_one_motion_have_the_outcomes_of_each():
    record = searches()[0].excitation
    factors = np.linspace(0.4, 5.0, 23)
    found = overturned_together(MANY, record, factors, vertical=UP, scale_vertical=False)
    assert found.shape == (len(MANY), factors.size)
    for structure, row in zip(MANY, found, strict=True):
        alone = overturned_by(structure, record, factors, vertical=UP, scale_vertical=False)
        np.testing.assert_array_equal(row, alone)
    own = factors * np.arange(1, len(MANY) + 1)[:, np.newaxis]
    found = overturned_together(MANY, record, own)
    for structure, row, scales in zip(MANY, found, own, strict=True):
        np.testing.assert_array_equal(row, overturned_by(structure, record, scales))
    assert 0 < found.sum() < found.size


def test_several_are_refused_with_what_was_expected():
    record = searches()[0].excitation
    with pytest.raises(ValueError, match="structures is empty; expected one or more"):
        overturned_together([], record, [1.0])
    with pytest.raises(ValueError, match="structures is None; expected a list of one or more"):
        overturned_together(None, record, [1.0])
    with pytest.raises(ValueError, match=r"shape \(2, 3\); expected .* each of the 5 structures"):
        overturned_together(MANY, record, np.ones((2, 3)))
    for together in (intervals_together, minima_together):
        with pytest.raises(ValueError, match="searches is empty; expected one or more"):
            together([], resolution=0.1)
        with pytest.raises(ValueError, match="excitation is None; expected a Pulse or a Record"):
            together([*searches(), Search(COLUMN, None, (0.0, 1.0))], resolution=0.1)
    with pytest.raises(ValueError, match="factors goes down to -1; it cannot be negative"):
        overturned_together(MANY, record, [-1.0, 2.0])
