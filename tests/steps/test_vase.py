"""What the step on the vase finds, on cases that are known."""

import itertools
import math

import numpy as np
import pandas as pd
import pytest

from replication.workbench import truth
from steps import vase, vase_poses, vase_searches, vase_shares
from topheavy import Column, FixedMassColumn, Pulse, RockingBlock, RockingFrame

COLUMN = Column(0.5, 3.0)
PULSE = Pulse("one-cosine", 1.0, 2 * math.pi / 1.5)
CASE = {
    "cap": {"width": 2.6, "depth": 0.6},
    "period": 1.5,
    "picture": {"mass_ratio": 1.0, "amplitudes": [0.24, 0.29]},
}


def test_minimum_is_the_known_one_and_scipy_agrees():
    found = vase_searches.minimum(FixedMassColumn(COLUMN, 1.0), PULSE, 2.0)
    assert found.acceleration == pytest.approx(0.20358, abs=1e-4)
    assert 0.0 < found.error < 1e-6
    assert found.told(3e-12)


def test_minimum_that_is_wrong_has_no_error():
    found = vase_searches.minimum(COLUMN, PULSE, 2.0)
    wrong = vase_searches.Minimum(COLUMN, PULSE, tuple(1.01 * end for end in found.bracket))
    assert math.isnan(wrong.error)
    assert not wrong.told(3e-12)


def test_narrow_interval_above_uplift_is_not_missed():
    pulse = Pulse("one-sine", 1.0, 0.607059 * COLUMN.frequency_parameter)
    least = [vase_searches.minimum(one, pulse, 2.0) for one in (COLUMN, RockingFrame(COLUMN, 0.1))]
    over = [found.acceleration / COLUMN.uplift_acceleration for found in least]
    assert over == pytest.approx([1.05316, 1.05507], abs=1e-5)  # from 1.06030 on if it is missed


def test_bare_column_is_searched_as_finely_as_its_rivals(monkeypatch):
    coarse = vase_searches.Minimum(COLUMN, PULSE, (0.9, 0.9))
    monkeypatch.setattr(vase, "minimum", lambda *_: coarse)
    (bare, *_) = vase.search(COLUMN, PULSE, [1.0], 2.0, {})
    assert bare["found"].acceleration == pytest.approx(0.27282, abs=1e-4)


def test_nothing_overturns_below_the_highest_acceleration():
    assert vase_searches.minimum(COLUMN, PULSE, 0.25).acceleration == math.inf


def test_refinement_finds_what_a_minimum_missed():
    true = vase_searches.minimum(COLUMN, PULSE, 2.0)
    missed = vase_searches.Minimum(COLUMN, PULSE, (0.9, 0.9))
    assert vase_searches.refined(missed, 0.5).acceleration == pytest.approx(true.acceleration)
    assert vase_searches.refined(missed, 0.25) == missed


def test_minimum_has_the_step_of_the_search_that_found_it():
    uplift = COLUMN.uplift_acceleration
    found = vase_searches.minimum(COLUMN, PULSE, 2.0)
    (step,) = (
        step
        for low, high, step in vase_searches.WINDOWS[Pulse]
        if low * uplift < found.acceleration <= high * uplift
    )
    assert found.step == pytest.approx(step * uplift)
    missed = vase_searches.Minimum(COLUMN, PULSE, (0.9, 0.9), 0.05 * uplift)
    finest = vase_searches.FINEST[Pulse] * uplift
    assert vase_searches.refined(missed, 0.5).step == pytest.approx(finest)
    assert vase_searches.refined(missed, 0.25).step == missed.step


def row(structure, ours, bare, ratio=1.0, kind="pulse"):
    found, other = (vase_searches.Minimum(COLUMN, PULSE, (value, value)) for value in (ours, bare))
    return {
        "kind": kind,
        "structure": structure,
        "frequency_ratio": ratio,
        "found": found,
        "bare": other,
    }


def test_exceptions_are_a_later_fixed_mass_and_an_earlier_frame():
    assert vase.is_exception(row("fixed", 0.3, 0.2))
    assert vase.is_exception(row("fixed", math.inf, 0.2))
    assert not vase.is_exception(row("fixed", 0.2, 0.3))
    assert vase.is_exception(row("free", 0.2, 0.3))
    assert not vase.is_exception(row("free", math.inf, 0.3))
    assert not vase.is_exception(row("bare", 0.3, 0.2))


def of(structure, acceleration):
    return vase_searches.Minimum(structure, PULSE, (acceleration, acceleration))


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
        found = vase.second_route(errors, exceptions, rows, [])
        assert found.holds is holds
        assert (found["neither_overturns"], found["not_told"]) == (1, 1)


def test_minimum_that_a_tighter_tolerance_moves_is_not_compared():
    right, other = (vase_searches.minimum(COLUMN, PULSE, 2.0) for _ in range(2))
    wrong = of(COLUMN, 1.01 * right.acceleration)
    given = row("free", 0.0, 0.0) | {"bare": other}
    assert vase.is_compared(given | {"found": right}, 3e-12)
    assert not vase.is_compared(given | {"found": wrong}, 3e-12)
    assert not vase.is_compared(given | {"found": right, "structure": "bare"}, 3e-12)
    assert not vase.is_compared(row("free", math.inf, math.inf), 3e-12)


def test_exception_under_short_pulses_and_records_qualifies():
    usual = row("fixed", 0.2, 0.3)
    short = row("fixed", 0.4, 0.3, ratio=4.0)
    record = row("fixed", 0.4, 0.3, ratio=math.nan, kind="record")
    assert vase.question([usual], ["fixed"], 2.5).holds
    found = vase.question([usual, short, record], ["fixed"], 2.5)
    assert (found.holds, found.holds_when) == (False, True)
    assert (found["comparisons"], found["comparisons_when"], found["exceptions"]) == (3, 1, 2)
    assert found["exceptions_under_records"] == found["records"] == 1
    long_one = vase.question([usual, row("fixed", 0.4, 0.3)], ["fixed"], 2.5)
    assert not long_one.holds_when
    assert not vase.question([short], ["fixed"], 2.5).holds_when


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
        (0.29, "bare"): True,
        (0.29, "fixed"): True,
        (0.29, "free"): False,
    }


def test_bodies_keep_their_sides_and_lie_on_the_ground_at_last(poses):
    key = ("amplitude", "structure", "pose", "body")
    lowest = {}
    for of, rows in itertools.groupby(poses, key=lambda p: [p[name] for name in key]):
        corners = [(p["x"], p["y"], p["last"]) for p in rows]
        sides = [math.dist(a[:2], b[:2]) for a, b in itertools.pairwise(corners)]
        expected = {1.0, 6.0} if "column" in of[3] else {0.6, 5.2 if of[1] == "free" else 2.6}
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


def test_frame_that_would_overturn_is_refused():
    pulse = Pulse("one-cosine", 0.5, 2 * math.pi / 1.5)
    with pytest.raises(ValueError, match=r"vase\.picture: the frame overturns at 0\.5 g; expected"):
        vase_poses.rotations(RockingFrame(COLUMN, 1.0), pulse, CASE)


# What the step concludes ------------------------------------------------------------------------

MINIMA = {"bare": 0.27, "fixed": 0.20, "free": 0.31, "portal": 0.9}
ANGLES = {"bare": 9.5, "fixed": 6.3, "free": 9.5, "portal": 20.0}


def summary(**change):
    """Structures under two shapes; `change` has a structure's values under the second."""
    rows = [
        {"structure": name, "shape": shape, "mass_ratio": 1.0, "slenderness_deg": ANGLES[name]}
        | {"minimum_overturning": MINIMA[name], "error": 1e-8}
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


@pytest.mark.parametrize(("angle", "holds"), [(9.6, True), (9.4, False)])
def test_portal_stands_on_a_wider_base_or_not(monkeypatch, angle, holds):
    table = summary(portal={"slenderness_deg": angle}).query("shape == 'b'").reset_index()
    monkeypatch.setattr(vase, "whole_gain", lambda shares: truth(True))
    none = pd.DataFrame(columns=["structure", "kind", "frequency_ratio"])
    assert vase.findings(table, none, None)["portal_has_a_wider_base"].holds == holds


@pytest.mark.parametrize(
    ("change", "least"),
    [
        ({}, 0.9 / 0.31),
        ({"portal": {"minimum_overturning": 0.30}}, 0.30 / 0.31),  # above bare and fixed
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
