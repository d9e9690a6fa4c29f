"""What the step on the vase finds, on cases that are known."""

import itertools
import math

import numpy as np
import pandas as pd
import pytest

from steps import vase, vase_poses, vase_searches, vase_shares
from topheavy import (
    Column,
    FixedMassColumn,
    LowestOverturning,
    MonolithicPortal,
    Pulse,
    RockingBlock,
    RockingFrame,
    read_record,
    reference,
)
from topheavy.free_rocking import Ending

COLUMN = Column(0.5, 3.0)
PULSE = Pulse("one-cosine", 1.0, 2 * math.pi / 1.5)
ASKED = {"longest": 2.5, "widths": [0.02]}
CASE = {
    "cap": {"width": 2.6, "depth": 0.6},
    "period": 1.5,
    "picture": {"mass_ratio": 1.0, "amplitudes": [0.24, 0.29]},
}


FLOOR = 0.001
RECORD = read_record("data/records/el_centro_1940_NS.AT2")
RECORD = RECORD.scaled(1.0 / RECORD.peak_acceleration)


def test_minimum_is_the_known_one_and_scipy_agrees():
    found = vase_searches.minimum(FixedMassColumn(COLUMN, 1.0), PULSE, 2.0, FLOOR)
    assert found.acceleration == pytest.approx(0.20358, abs=1e-4)
    assert 0.0 < found.error < 1e-6
    assert found.told(3e-12)


def of(structure, *ends):
    """A minimum in an interval with given ends, g."""
    low, *upper = ends
    last = (upper[0], upper[0]) if upper else None
    found = LowestOverturning((0.1, 2.0), FLOOR, (), (low, low), last, 1.0, 0)
    return vase_searches.Minimum(structure, PULSE, found)


def test_minimum_that_is_wrong_has_no_error():
    true = vase_searches.minimum(COLUMN, PULSE, 2.0, FLOOR).acceleration
    assert of(COLUMN, true).error == pytest.approx(1e-7 * true)
    assert math.isnan(of(COLUMN, 1.01 * true).error)


def test_error_of_a_narrow_interval_is_asked_inside_it():
    true = vase_searches.minimum(COLUMN, PULSE, 2.0, FLOOR).acceleration
    around = [(1.0 + off) * true for off in (-2e-8, -1e-8, 6e-8)]
    assert of(COLUMN, around[0], around[2]).error == pytest.approx(1e-7 * true)
    assert math.isnan(of(COLUMN, around[0], around[1]).error)


def test_narrow_interval_above_uplift_is_not_missed():
    """It is narrower than 0.001 of the uplift acceleration; twice the floor leads to 0.17655 g."""
    pulse = Pulse("one-cosine", 1.0, 0.55 * COLUMN.frequency_parameter)
    found = vase_searches.minimum(COLUMN, pulse, 2.0, FLOOR)
    assert found.acceleration == pytest.approx(0.175426, abs=1e-6)
    assert found.found.width < FLOOR * COLUMN.uplift_acceleration


@pytest.mark.parametrize(("highest", "above"), [(0.25, 0.0), (0.15, 0.0), (2.0, 2.0)])
def test_nothing_overturns_below_the_highest_acceleration(highest, above):
    """Also where the highest is below uplift, or nothing is left to search."""
    found = vase_searches.minimum(COLUMN, PULSE, highest, FLOOR, above)
    assert found.acceleration == math.inf


def test_interval_that_a_billionth_of_the_record_removes_is_passed_over():
    """Two lowest intervals of the column under El Centro are narrower than its last digits."""
    lowest = vase_searches.minimum(COLUMN, RECORD, 2.0, FLOOR)
    assert lowest.found.width < 1e-9
    assert not lowest.told(3e-12)
    found = vase_searches.lowest_told(lowest, 2.0, FLOOR, 3e-12)
    assert found.passed_over == 2
    assert found.acceleration > lowest.acceleration
    assert found.told(3e-12)
    assert found.error < 1e-7
    outcomes = [
        reference.judge(COLUMN, RECORD.scaled(found.inside * (1.0 + off))).overturned
        for off in (-1e-9, 1e-9)
    ]
    assert outcomes == [True, True]


def test_interval_that_a_tighter_tolerance_removes_is_not_told(monkeypatch):
    one = vase_searches.minimum(COLUMN, PULSE, 2.0, FLOOR)
    assert one.told(3e-12)
    monkeypatch.setattr(vase_searches, "judge", lambda *_, tolerance: Ending(False, 0.1, 3))
    assert not one.told(3e-12)


def test_minimum_without_an_interval_that_ends_is_not_passed_over():
    lowest = vase_searches.minimum(COLUMN, PULSE, 0.275, FLOOR)
    whole = vase_searches.lowest_told(lowest, 0.275, FLOOR, 3e-12)
    assert whole.found.upper is None
    assert (whole.acceleration, whole.passed_over) == (pytest.approx(0.27282, abs=1e-4), 0)
    assert whole.inside == pytest.approx(0.5 * (whole.acceleration + 0.275))


def test_wide_interval_is_the_lowest_in_which_all_steps_overturn(monkeypatch):
    step = FLOOR * COLUMN.uplift_acceleration
    ends = 0.2 + step * np.array([0.0, 1.5, 10.0, 13.5, 700.0, 720.5])  # across a call's end
    monkeypatch.setattr(
        vase_searches,
        "overturned_by",
        lambda structure, motion, factors: np.searchsorted(ends, factors + 1e-9) % 2 == 1,
    )
    found = vase_searches.lowest_wide(of(COLUMN, 0.2), 2.0, FLOOR, [0.001, 0.003, 0.02, 0.021])
    over = [(found[width] - 0.2) / step for width in (0.001, 0.003, 0.02)]
    assert over == pytest.approx([0.0, 10.0, 700.0], abs=1e-6)
    assert found[0.021] == math.inf
    none = vase_searches.Minimum(COLUMN, PULSE, None)
    assert vase_searches.lowest_wide(none, 2.0, FLOOR, [0.003]) == {0.003: math.inf}


def row(structure, ours, bare, ratio=1.0, kind="pulse"):
    found, other = (of(COLUMN, value) for value in (ours, bare))
    return {
        "kind": kind,
        "structure": structure,
        "frequency_ratio": ratio,
        "found": found,
        "bare": other,
        "wide": {0.02: ours},
        "bare_wide": {0.02: bare},
    }


def test_exceptions_are_a_later_fixed_mass_and_an_earlier_frame():
    assert vase.is_exception(row("fixed", 0.3, 0.2))
    assert vase.is_exception(row("fixed", math.inf, 0.2))
    assert not vase.is_exception(row("fixed", 0.2, 0.3))
    assert vase.is_exception(row("free", 0.2, 0.3))
    assert not vase.is_exception(row("free", math.inf, 0.3))
    assert not vase.is_exception(row("bare", 0.3, 0.2))


@pytest.mark.parametrize(("fixed", "survives"), [(0.25, False), (0.19, True)])
def test_structure_that_falls_at_the_earlier_minimum_is_no_exception(fixed, survives):
    """A fixed mass overturns from 0.204 g on, and cannot be later than a column that falls then."""
    given = row("fixed", 0.3, 0.0) | {"found": of(FixedMassColumn(COLUMN, 1.0), 0.3)}
    found = vase.exception(given | {"bare": of(COLUMN, fixed)})
    assert found["later_one_survives"] is survives
    assert math.isnan(found["error"])  # SciPy finds no boundary at 0.3 g


def test_second_route_needs_every_boundary_and_every_exception():
    rows = [row("fixed", 0.3, 0.2), row("fixed", math.inf, math.inf), row("bare", 0.2, 0.2)]
    for errors, survives, holds in (
        ([1e-7], [], True),
        ([1e-7], [True, True], True),
        ([1e-7], [True, False], False),
        ([1e-7, math.nan], [True], False),
    ):
        exceptions = [{"later_one_survives": one} for one in survives]
        found = vase.second_route(errors, exceptions, rows)
        assert found.holds is holds
        assert (found["neither_overturns"], found["passed_over"]) == (1, 0)


def test_rows_are_compared_where_one_of_both_overturns():
    assert vase.is_compared(row("free", 0.3, math.inf))
    assert not vase.is_compared(row("free", math.inf, math.inf))
    assert not vase.is_compared(row("bare", 0.3, 0.3))


def test_row_of_the_table_has_the_interval_in_g():
    wide = {"wide": {0.02: math.inf}}
    found = vase.searched(row("free", 0.3, 0.2) | {"found": of(COLUMN, 0.3, 0.31)} | wide)
    assert found["width"] == pytest.approx(0.01)
    assert found["minimum_overturning"] == 0.3
    assert math.isnan(found["wider_than_0.02"])
    assert set(found).isdisjoint(vase.OBJECTS)


def test_lowest_wide_intervals_are_ranked_beside_the_minima():
    narrow = row("free", 0.3, 0.2) | {"wide": {0.02: 0.4}, "bare_wide": {0.02: 0.5}}
    found = vase.question([narrow, narrow | {"kind": "record"}], ["free"], ASKED)
    assert found.holds
    assert found["exceptions_of_width"] == {"0.02": {"pulse": 1, "record": 1}}
    others = [row("fixed", 0.3, 0.2, kind="fresh"), row("free", 0.3, 0.2)]
    assert vase.reversed_at(others, 0.02) == {"pulse": 1, "record": 0}


def test_exception_under_short_pulses_and_records_qualifies():
    usual = row("fixed", 0.2, 0.3)
    short = row("fixed", 0.4, 0.3, ratio=4.0)
    record = row("fixed", 0.4, 0.3, ratio=math.nan, kind="record")
    assert vase.question([usual], ["fixed"], ASKED).holds
    found = vase.question([usual, short, record], ["fixed"], ASKED)
    assert (found.holds, found.holds_when) == (False, True)
    assert (found["comparisons"], found["comparisons_when"], found["exceptions"]) == (3, 1, 2)
    assert found["exceptions_under_records"] == found["records"] == 1
    long_one = vase.question([usual, row("fixed", 0.4, 0.3)], ["fixed"], ASKED)
    assert not long_one.holds_when
    assert not vase.question([short], ["fixed"], ASKED).holds_when


def test_fresh_grid_tests_the_condition_and_nothing_else():
    inside, beyond = row("fixed", 0.2, 0.3, kind="fresh"), row("fixed", 0.4, 0.3, 2.4, "fresh")
    found = vase.on_a_fresh_grid([inside, beyond, row("fixed", 0.4, 0.3)], 2.0)
    assert found["holds"]
    assert (found["comparisons"], found["beyond"]) == (1, 1)
    assert found["exceptions_beyond"] == [2.4]
    assert not vase.on_a_fresh_grid([inside, beyond], 2.5)["holds"]
    assert not vase.on_a_fresh_grid([beyond], 2.0)["holds"]


def test_exchange_of_all_three_parameters_makes_the_frame():
    fixed, free = FixedMassColumn(COLUMN, 4.0).block(), RockingFrame(COLUMN, 4.0).block()
    assert vase_shares.exchanged(fixed, free, ()) == fixed
    assert vase_shares.exchanged(fixed, free, ("α", "p", "√r")) == free
    mixed = vase_shares.exchanged(fixed, free, ("p",))
    assert mixed == RockingBlock(free.frequency_parameter, fixed.slenderness, fixed.restitution)


def test_subsets_are_the_eight():
    assert len(set(vase_shares.subsets())) == 8


def test_shapley_values_of_a_sum_are_its_terms():
    terms = {"α": 0.5, "p": -0.125, "√r": 0.25}
    worth = {subset: sum(terms[name] for name in subset) for subset in vase_shares.subsets()}
    assert vase_shares.shapley(worth) == pytest.approx(terms)


def test_shapley_values_share_a_joint_gain_equally():
    worth = {subset: float({"α", "√r"} <= set(subset)) for subset in vase_shares.subsets()}
    assert vase_shares.shapley(worth) == pytest.approx({"α": 0.5, "p": 0.0, "√r": 0.5})


def test_shapley_values_add_up_to_the_whole():
    random = np.random.default_rng(14)
    worth = {subset: float(random.random()) for subset in vase_shares.subsets()}
    whole = worth["α", "p", "√r"] - worth[()]
    assert sum(vase_shares.shapley(worth).values()) == pytest.approx(whole)


@pytest.fixture(scope="module")
def poses():
    return list(vase_poses.poses(COLUMN, CASE))


def test_picture_shows_what_happens_to_each(poses):
    outcomes = {(p["amplitude"], p["structure"]): p["outcome"] == "overturned" for p in poses}
    assert outcomes == {
        (0.24, "bare"): False,
        (0.24, "fixed"): True,
        (0.24, "free"): False,
        (0.24, "portal"): False,
        (0.29, "bare"): True,
        (0.29, "fixed"): True,
        (0.29, "free"): False,
        (0.29, "portal"): False,
    }


def test_bodies_keep_their_sides_and_lie_on_the_ground_at_last(poses):
    key = ("amplitude", "structure", "pose", "body")
    lowest = {}
    for of, rows in itertools.groupby(poses, key=lambda p: [p[name] for name in key]):
        corners = [(p["x"], p["y"], p["last"]) for p in rows]
        sides = [math.dist(a[:2], b[:2]) for a, b in itertools.pairwise(corners)]
        width = 5.2 if of[1] in ("free", "portal") else 2.6
        expected = {1.0, 6.0} if "column" in of[3] else {0.6, width}
        assert {round(side, 9) for side in sides} == expected
        if corners[0][2]:
            lowest.setdefault((of[0], of[1]), []).append(min(y for _, y, _ in corners))
    assert all(min(ends) == pytest.approx(0.0, abs=1e-9) for ends in lowest.values())


def test_fixed_cap_meets_the_ground_before_its_column_lies_flat():
    corners = np.concatenate(
        list(vase_poses.bodies(FixedMassColumn(COLUMN, 1.0, 2.6, 0.6), 0.0, CASE).values())
    )
    last = vase_poses.lying(COLUMN, corners)
    assert last == pytest.approx(math.pi / 2 - math.atan2(0.8, 6.0), rel=1e-12)


@pytest.mark.parametrize(
    ("kind", "structure", "amplitude"),
    [
        ("frame", RockingFrame(COLUMN, 1.0), 0.5),
        ("portal", MonolithicPortal(COLUMN, 1.0, 4.2, 0.6), 8.0),
    ],
)
def test_frame_that_would_overturn_is_refused(kind, structure, amplitude):
    pulse = Pulse("one-cosine", amplitude, 2 * math.pi / 1.5)
    with pytest.raises(
        ValueError, match=rf"vase\.picture: the {kind} overturns at {amplitude:g} g; expected"
    ):
        vase_poses.rotations(structure, pulse, CASE)


def test_portal_whose_base_is_pulled_has_no_minimum():
    case = CASE | {"mass_ratios": [0.0], "shapes": ["one-cosine"], "period": 1.5, "floor": 1e-3}
    case |= {"portals": {"mass_ratio": 1.0, "spans": [2.4, 4.2]}, "spectra": {"highest": 12.0}}
    narrow, wide = vase.under_pulses(COLUMN, case)[1:]
    assert narrow["minimum_overturning"] == pytest.approx(0.918, abs=1e-3)
    assert math.isnan(narrow["pulled_from"])
    assert narrow["friction"] == pytest.approx(0.458, abs=1e-3)
    assert math.isnan(wide["minimum_overturning"])
    assert math.isnan(wide["error"])
    assert wide["pulled_from"] == pytest.approx(1.72, abs=0.01)
    assert wide["pulled_error"] < 0.002


# What the step concludes ------------------------------------------------------------------------

MINIMA = {"bare": 0.27, "fixed": 0.20, "free": 0.31, "portal": 0.9}
ANGLES = {"bare": 9.5, "fixed": 6.3, "free": 9.5, "portal": 20.0}


def summary(**change):
    """Structures under two shapes; `change` has a structure's values under the second."""
    rows = [
        {"structure": name, "shape": shape, "mass_ratio": 1.0, "slenderness_deg": ANGLES[name]}
        | {"minimum_overturning": MINIMA[name], "error": 1e-8}
        | {"friction": 0.4, "pulled_from": math.nan, "pulled_error": math.nan}
        | (change.get(name, {}) if shape == "b" else {})
        for name in MINIMA
        for shape in ("a", "b")
    ]
    return pd.DataFrame(rows)


@pytest.mark.parametrize(
    ("change", "holds"),
    [
        ({}, True),
        ({"fixed": {"minimum_overturning": 0.28}}, False),
        ({"free": {"minimum_overturning": 0.26}}, False),
        ({"bare": {"minimum_overturning": 0.32}}, False),
    ],
)
def test_rank_of_the_three_is_asked_under_every_pulse_of_the_period(change, holds):
    assert vase.ranks(summary(**change)) is holds


@pytest.mark.parametrize(
    ("change", "least"),
    [
        ({}, 0.9 / 0.31),
        ({"portal": {"minimum_overturning": 0.30}}, 0.30 / 0.31),  # above bare and fixed
        ({"portal": {"minimum_overturning": math.nan, "pulled_from": 0.30}}, 0.30 / 0.31),
        ({"free": {"minimum_overturning": 1.0}}, 0.9),
    ],
)
def test_portal_is_beside_the_frame_under_every_pulse(change, least):
    other = summary().assign(mass_ratio=2.0, minimum_overturning=0.01)
    frames = other[other.structure == "free"]  # of another mass: not compared
    found = vase.beside_frames(pd.concat([summary(**change), frames]))
    assert found.holds is (least > 1.0)
    assert found["compared"] == 2
    assert found["least"] == pytest.approx(least)


@pytest.mark.parametrize(("lost", "holds"), [(0.0, True), (0.01, False)])
def test_shares_carry_the_whole_gain(lost, holds):
    rows = [
        {"worth": worth, "shape": "a", "mass_ratio": 1.0, "taken_from_the_frame": name}
        | {"shapley_value": 1.0, "share_of_gain": share}
        for worth in vase_shares.WORTHS
        for name, share in (("α", 0.9 - lost), ("p", 0.06), ("√r", 0.04))
    ]
    found = vase.whole_gain(pd.DataFrame(rows))
    assert found.holds is holds
    for worth in vase_shares.WORTHS:
        assert found[worth]["p"] == pytest.approx([0.06] * 3)


def test_gain_is_that_of_the_frame_over_the_fixed_mass(monkeypatch):
    """Each parameter of the frame is worth as much as it is larger than that of the fixed mass."""
    monkeypatch.setattr(vase_shares, "WORTHS", {"α": lambda block, *rest: block.slenderness})
    case = {"shapes": ["one-sine"], "shares": {"mass_ratios": [1.0]}}
    rows = pd.DataFrame(vase_shares.shares(COLUMN, case)).set_index("taken_from_the_frame")
    assert rows.share_of_gain["α"] == pytest.approx(1.0)
    assert rows.share_of_gain["p"] == pytest.approx(0.0)
    gain = COLUMN.slenderness - FixedMassColumn(COLUMN, 1.0).slenderness
    assert rows.shapley_value["α"] == pytest.approx(gain)
    assert rows.value["none"] == pytest.approx(FixedMassColumn(COLUMN, 1.0).slenderness)
