"""What the step on the vase finds, on cases that are known."""

import itertools
import math

import numpy as np
import pandas as pd
import pytest

import topheavy as th
from steps import vase, vase_poses, vase_searches, vase_shares
from tests.cases import COLUMN, RECORDS
from topheavy.bodies.free_rocking import Ending
from topheavy.second import reference

PULSE = th.Pulse("one-cosine", 1.0, 2 * math.pi / 1.5)
FIXED = th.FixedMassColumn(COLUMN, 1.0)
ASKED = {"longest": 2.5, "widths": [0.02]}
CASE = {"cap": {"width": 2.6, "depth": 0.6}, "period": 1.5}
CASE |= {"picture": {"mass_ratio": 1.0, "amplitudes": [0.24, 0.29]}}
FLOOR = 0.001


def minimum(structure, pulse=PULSE, highest=2.0, above=0.0):
    return vase_searches.minimum(structure, pulse, highest, FLOOR, above)


def of(structure, *ends):
    """A minimum in an interval with given ends, g."""
    low, *upper = ends
    last = (upper[0], upper[0]) if upper else None
    found = th.LowestOverturning((0.1, 2.0), FLOOR, (), (low, low), last, 1.0, 0)
    return vase_searches.Minimum(structure, PULSE, found)


def test_minimum_is_the_known_one_and_scipy_agrees(given):
    found = minimum(FIXED)
    assert found.acceleration == pytest.approx(0.20358, abs=1e-4)
    assert 0.0 < found.error < 1e-6
    assert found.is_decided(3e-12)
    given(vase_searches, judge=Ending(False, 0.1, 3))  # a tighter tolerance removes the interval
    assert not found.is_decided(3e-12)


def test_error_is_asked_inside_an_interval_and_a_minimum_that_is_wrong_has_none():
    true = minimum(COLUMN).acceleration
    for ends, has_error in (
        ([1.0], True),
        ([1.01], False),
        ([1.0 - 2e-8, 1.0 + 6e-8], True),
        ([1.0 - 2e-8, 1.0 - 1e-8], False),
    ):
        error = of(COLUMN, *(end * true for end in ends)).error
        assert error == pytest.approx(1e-7 * true) if has_error else math.isnan(error)


def test_narrow_interval_above_uplift_is_not_missed():
    """It is narrower than 0.001 of the uplift acceleration; twice the floor leads to 0.17655 g."""
    found = minimum(COLUMN, th.Pulse("one-cosine", 1.0, 0.55 * COLUMN.frequency_parameter))
    assert found.acceleration == pytest.approx(0.175426, abs=1e-6)
    assert found.lowest.width < FLOOR * COLUMN.uplift_acceleration
    # below uplift, too, and where nothing is left to search
    for highest, above in ((0.25, 0.0), (0.15, 0.0), (2.0, 2.0)):
        assert minimum(COLUMN, PULSE, highest, above).acceleration == math.inf


def test_interval_that_a_billionth_of_the_record_removes_is_passed_over():
    """Two lowest intervals of the column under El Centro are narrower than its last digits."""
    record = th.read_record(RECORDS / "el_centro_1940_NS.AT2")
    record = record.scaled(1.0 / record.peak_acceleration)
    lowest = minimum(COLUMN, record)
    assert lowest.lowest.width < 1e-9
    assert not lowest.is_decided(3e-12)
    found = vase_searches.lowest_decided(lowest, 2.0, FLOOR, 3e-12)
    assert (found.passed_over, found.is_decided(3e-12)) == (2, True)
    assert found.acceleration > lowest.acceleration
    assert found.error < 1e-7
    for off in (-1e-9, 1e-9):
        assert reference.judge(COLUMN, record.scaled(found.inside * (1.0 + off))).overturned
    lowest = minimum(COLUMN, PULSE, 0.275)  # in an interval that has no end
    whole = vase_searches.lowest_decided(lowest, 0.275, FLOOR, 3e-12)
    assert (whole.lowest.upper, whole.passed_over) == (None, 0)
    assert whole.acceleration == pytest.approx(0.27282, abs=1e-4)
    assert whole.inside == pytest.approx(0.5 * (whole.acceleration + 0.275))


def test_wide_interval_is_the_lowest_in_which_all_steps_overturn(given):
    step = FLOOR * COLUMN.uplift_acceleration
    ends = 0.2 + step * np.array([0.0, 1.5, 10.0, 13.5, 700.0, 720.5])  # across a call's end
    given(vase_searches, overturned_by=lambda *g: np.searchsorted(ends, g[2] + 1e-9) % 2 == 1)
    found = vase_searches.lowest_wide(of(COLUMN, 0.2), 2.0, FLOOR, [0.001, 0.003, 0.02, 0.021])
    over = [(found[width] - 0.2) / step for width in (0.001, 0.003, 0.02)]
    assert over == pytest.approx([0.0, 10.0, 700.0], abs=1e-6)
    assert found[0.021] == math.inf
    none = vase_searches.Minimum(COLUMN, PULSE, None)
    assert vase_searches.lowest_wide(none, 2.0, FLOOR, [0.003]) == {0.003: math.inf}


# What is compared --------------------------------------------------------------------------------


def row(structure, ours, bare, ratio=1.0, kind="pulse"):
    found, other = (of(COLUMN, value) for value in (ours, bare))
    given = {"kind": kind, "structure": structure, "frequency_ratio": ratio, "found": found}
    return given | {"bare": other, "wide": {0.02: ours}, "bare_wide": {0.02: bare}}


def test_rows_are_compared_where_one_of_both_overturns():
    assert vase.is_compared(row("free", 0.3, math.inf))
    assert not vase.is_compared(row("free", math.inf, math.inf))
    assert not vase.is_compared(row("bare", 0.3, 0.3))


@pytest.mark.parametrize(("fixed", "survives"), [(0.25, False), (0.19, True)])
def test_structure_that_falls_at_the_earlier_minimum_is_no_exception(fixed, survives):
    """A fixed mass overturns from 0.204 g on, and cannot be later than a column that falls then."""
    at = row("fixed", 0.3, 0.0) | {"found": of(FIXED, 0.3), "bare": of(COLUMN, fixed)}
    found = vase.exception(at)
    assert found["later_one_survives"] is survives
    assert math.isnan(found["error"])  # SciPy finds no boundary at 0.3 g


@pytest.mark.parametrize(
    ("errors", "survives", "holds"),
    [
        *(([1e-7], [], True), ([1e-7], [True, True], True)),
        *(([1e-7], [True, False], False), ([1e-7, math.nan], [True], False)),
    ],
)
def test_second_route_needs_every_boundary_and_every_exception(errors, survives, holds):
    rows = [row("fixed", 0.3, 0.2), row("fixed", math.inf, math.inf), row("bare", 0.2, 0.2)]
    found = vase.second_route(errors, [{"later_one_survives": one} for one in survives], rows)
    assert (found.holds, found["neither_overturns"], found["passed_over"]) == (holds, 1, 0)


def test_lowest_wide_intervals_are_ranked_beside_the_minima():
    narrow = row("free", 0.3, 0.2) | {"wide": {0.02: 0.4}, "bare_wide": {0.02: 0.5}}
    found = vase.question([narrow, narrow | {"kind": "record"}], ["free"], ASKED)
    assert found.holds
    assert found["exceptions_of_width"] == {"0.02": {"pulse": 1, "record": 1}}
    others = [row("fixed", 0.3, 0.2, kind="fresh"), row("free", 0.3, 0.2)]
    assert vase.reversed_at(others, 0.02) == {"pulse": 1, "record": 0}
    wide = {"found": of(COLUMN, 0.3, 0.31), "wide": {0.02: math.inf}}
    found = vase.searched(row("free", 0.3, 0.2) | wide)  # a row of the table, in g
    assert (found["width"], found["minimum_overturning"]) == (pytest.approx(0.01), 0.3)
    assert math.isnan(found["wider_than_0.02"])
    assert set(found).isdisjoint(vase.OBJECTS)


def test_exception_under_short_pulses_and_records_qualifies():
    usual, short = row("fixed", 0.2, 0.3), row("fixed", 0.4, 0.3, ratio=4.0)
    record = row("fixed", 0.4, 0.3, ratio=math.nan, kind="record")
    found = vase.question([usual, short, record], ["fixed"], ASKED)
    assert (found.holds, found.holds_when) == (False, True)
    assert (found["comparisons"], found["comparisons_when"], found["exceptions"]) == (3, 1, 2)
    assert found["exceptions_under_records"] == found["records"] == 1
    assert vase.question([usual], ["fixed"], ASKED).holds
    for rows in ([usual, row("fixed", 0.4, 0.3)], [short]):
        assert not vase.question(rows, ["fixed"], ASKED).holds_when


def test_fresh_grid_tests_the_condition_and_nothing_else():
    inside, beyond = row("fixed", 0.2, 0.3, kind="fresh"), row("fixed", 0.4, 0.3, 2.4, "fresh")
    found = vase.on_a_fresh_grid([inside, beyond, row("fixed", 0.4, 0.3)], 2.0)
    assert (found["holds"], found["comparisons"], found["beyond"]) == (True, 1, 1)
    assert found["exceptions_beyond"] == [2.4]
    assert not vase.on_a_fresh_grid([inside, beyond], 2.5)["holds"]
    assert not vase.on_a_fresh_grid([beyond], 2.0)["holds"]


# Shares of the gain ------------------------------------------------------------------------------


def test_exchange_of_all_three_parameters_makes_the_frame():
    fixed, free = th.FixedMassColumn(COLUMN, 4.0).block(), th.RockingFrame(COLUMN, 4.0).block()
    assert vase_shares.exchanged(fixed, free, ()) == fixed
    assert vase_shares.exchanged(fixed, free, ("α", "p", "√r")) == free
    mixed = vase_shares.exchanged(fixed, free, ("p",))
    assert mixed == th.RockingBlock(free.frequency_parameter, fixed.slenderness, fixed.restitution)
    assert len(set(vase_shares.subsets())) == 8


def test_shapley_values_of_a_sum_are_its_terms_and_a_joint_gain_is_shared():
    every, random = list(vase_shares.subsets()), np.random.default_rng(14)
    terms = {"α": 0.5, "p": -0.125, "√r": 0.25}
    summed = {subset: sum(terms[name] for name in subset) for subset in every}
    assert vase_shares.shapley(summed) == pytest.approx(terms)
    joint = {subset: float({"α", "√r"} <= set(subset)) for subset in every}
    assert vase_shares.shapley(joint) == pytest.approx({"α": 0.5, "p": 0.0, "√r": 0.5})
    worth = {subset: float(random.random()) for subset in every}
    whole = worth["α", "p", "√r"] - worth[()]
    assert sum(vase_shares.shapley(worth).values()) == pytest.approx(whole)


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
    assert rows.share_of_gain[["α", "p"]].tolist() == pytest.approx([1.0, 0.0])
    assert rows.shapley_value["α"] == pytest.approx(COLUMN.slenderness - FIXED.slenderness)
    assert rows.value["none"] == pytest.approx(FIXED.slenderness)


# The picture -------------------------------------------------------------------------------------


def test_picture_shows_what_happens_to_each_down_to_the_ground():
    poses = list(vase_poses.poses(COLUMN, CASE))
    falls = {(p["amplitude"], p["structure"]) for p in poses if p["outcome"] == "overturned"}
    assert falls == {(0.24, "fixed"), (0.29, "bare"), (0.29, "fixed")}
    assert len({(p["amplitude"], p["structure"]) for p in poses}) == 8
    key, lowest = ("amplitude", "structure", "pose", "body"), {}
    for at, rows in itertools.groupby(poses, key=lambda p: [p[name] for name in key]):
        corners = [(p["x"], p["y"], p["last"]) for p in rows]
        sides = {round(math.dist(a[:2], b[:2]), 9) for a, b in itertools.pairwise(corners)}
        width = 5.2 if at[1] in ("free", "portal") else 2.6
        assert sides == ({1.0, 6.0} if "column" in at[3] else {0.6, width})
        if corners[0][2]:
            lowest.setdefault((at[0], at[1]), []).append(min(y for _, y, _ in corners))
    assert {len(ends) > 0 for ends in lowest.values()} == {True}
    assert [min(ends) for ends in lowest.values()] == pytest.approx([0.0] * len(lowest), abs=1e-9)


@pytest.mark.parametrize(
    ("kind", "structure", "amplitude"),
    [
        ("frame", th.RockingFrame(COLUMN, 1.0), 0.5),
        ("portal", th.MonolithicPortal(COLUMN, 1.0, 4.2, 0.6), 8.0),
    ],
)
def test_frame_that_would_overturn_is_refused(kind, structure, amplitude):
    says = rf"vase\.picture: the {kind} overturns at {amplitude:g} g; expected"
    with pytest.raises(ValueError, match=says):
        vase_poses.rotations(structure, PULSE.scaled(amplitude), CASE)


def test_portal_whose_base_is_pulled_has_no_minimum():
    case = CASE | {"mass_ratios": [0.0], "shapes": ["one-cosine"], "floor": FLOOR}
    case |= {"portals": {"mass_ratio": 1.0, "spans": [2.4, 4.2]}, "spectra": {"highest": 12.0}}
    narrow, wide = vase.under_pulses(COLUMN, case)[1:]
    found = [narrow["minimum_overturning"], narrow["friction"], wide["pulled_from"]]
    assert found == pytest.approx([0.918, 0.458, 1.72], abs=2e-3)
    no = [narrow["pulled_from"], wide["minimum_overturning"], wide["error"]]
    assert np.isnan(no).all()
    assert wide["pulled_error"] < 0.002


# What the step concludes -------------------------------------------------------------------------

MINIMA = {"bare": 0.27, "fixed": 0.20, "free": 0.31, "portal": 0.9}
ANGLES = {"bare": 9.5, "fixed": 6.3, "free": 9.5, "portal": 20.0}


def summary(**change):
    """Structures under two shapes; `change` has a structure's minimum under the second."""
    return pd.DataFrame(
        {"structure": name, "shape": shape, "mass_ratio": 1.0, "slenderness_deg": ANGLES[name]}
        | {"minimum_overturning": MINIMA[name], "error": 1e-8}
        | {"friction": 0.4, "pulled_from": math.nan, "pulled_error": math.nan}
        | (change.get(name, {}) if shape == "b" else {})
        for name in MINIMA
        for shape in ("a", "b")
    )


@pytest.mark.parametrize(
    ("name", "value", "holds"),
    [("portal", 0.1, True), ("fixed", 0.28, False), ("free", 0.26, False), ("bare", 0.32, False)],
)
def test_rank_of_the_three_is_asked_under_every_pulse_of_the_period(name, value, holds):
    assert vase.ranks(summary(**{name: {"minimum_overturning": value}})) is holds


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
    assert (found.holds, found["compared"]) == (least > 1.0, 2)
    assert found["least"] == pytest.approx(least)
