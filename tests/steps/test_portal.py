"""Steps on portals: their forces and how their bases bear."""

import math

import numpy as np
import pandas as pd
import pytest

import topheavy as th
from steps import portal
from steps.shared import bearing
from steps.shared.histories import History, history
from tests.cases import COLUMN, FRAME, RECORDS
from topheavy import Column, MonolithicPortal, Pulse, simulate
from topheavy.forces.portal import resting_portal_forces
from topheavy.second import reference

VASE = {"portals": {"mass_ratio": 1.0, "spans": [2.4]}, "cap": {"width": 2.6, "depth": 0.6}}
VASE |= {"shapes": ["one-cosine"], "period": 1.5, "floor": 1e-3}
SIZES = {"sizes": {"lowest": 1.0, "highest": 4.0, "points": 5}, "highest": 2.0}
OVER = [f"{name}_over_frame" for name in portal.FORCES]


def labels(peak):
    return {"kind": "pulse", "motion": "one-cosine", "peak_acceleration": peak}


def pulse(peak):
    return th.Pulse("one-cosine", peak, 2 * math.pi / 1.5)


def compared(peak, samples=8, case=VASE):
    return pd.DataFrame(portal.compare(COLUMN, pulse(peak), labels(peak), case, samples))


# Forces ------------------------------------------------------------------------------------------


def test_shears_at_the_ends_of_a_frames_column_differ_by_its_own_load():
    theta, rate, ground = 0.05, 0.2, 0.1
    state = (np.array([[value]]) for value in (0.0, theta, rate, ground))
    found = portal.of_frame(FRAME, th.Cap(2.4, 0.3), History(*state, 0, "rests"))
    lean, p = FRAME.slenderness - theta, FRAME.frequency_parameter
    second = -(p**2) * (math.sin(lean) + ground * math.cos(lean)) / th.STANDARD_GRAVITY
    load = ground * math.cos(theta) - math.sin(theta) + second * 3.0
    load += 0.5 * rate**2 / th.STANDARD_GRAVITY  # towards the pivot, beside the axis
    np.testing.assert_allclose(found["base_shear"] - found["joint_shear"], 0.25 * load, atol=1e-14)


def test_there_are_no_forces_of_rest_while_rocking_none_if_pulled_and_none_overturned():
    (rocks,) = (found := compared(0.6)).itertuples()
    assert (rocks.state, rocks.portal, rocks.resisted) == ("rocks", "rests", True)
    assert 0.36 < rocks.friction < 0.5  # tan α' just after uplift
    assert found[OVER].isna().all(axis=None)  # the frame overturns, the portal does not
    assert found[[*portal.FORCES]].notna().all(axis=None)
    wide = VASE | {"portals": {"mass_ratio": 1.0, "spans": [5.0]}}
    for peak, pulled in ((1.6, False), (1.8, True)):
        found = compared(peak, case=wide).iloc[0]
        assert (found.portal, found.resisted) == ("rests", not pulled)  # it does not overturn
        assert found[[*portal.FORCES]].isna().all() == pulled
    fallen = compared(0.95)
    assert set(fallen.portal) == set(fallen.frame) == {"overturned"}
    assert fallen[[*portal.FORCES, *OVER]].isna().all(axis=None)


def test_peaks_are_those_of_many_more_samples_within_their_error():
    few, many = (compared(0.6, samples) for samples in (4, 64))
    ratio = few[[*portal.FORCES]] / many[[*portal.FORCES]]
    assert (ratio <= 1.0 + 1e-12).all(axis=None)
    assert (ratio.ge(1.0 - few.error - 1e-12, axis=0)).all(axis=None)


@pytest.mark.parametrize(
    ("bases", "ground", "resists"),
    [("fixed", 0.1, True), ("fixed", 0.3, False), ("pinned", 0.2, True), ("pinned", 0.3, False)],
)
def test_ground_without_tension_resists_forces_within_the_bases(bases, ground, resists):
    one = th.MonolithicPortal(COLUMN, 1.0, 2.4, 0.6)
    assert portal.resisted(one, resting_portal_forces(one, bases, ground).base) is resists


# Larger columns ----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("goal", "size"),
    [
        (th.Column(1.7 * 0.5, 1.7 * 3.0), 1.7),
        # Without the impacts' part, the frame is the equivalent column of Eq. (24).
        (FRAME.block(COLUMN.restitution), 4.0 / 3.0),
    ],
    ids=["column", "frame"],
)
def test_larger_column_is_the_one_that_it_is_compared_with(given, goal, size):
    given(portal, RockingFrame=lambda *_: goal)
    spans = VASE | {"portals": {"mass_ratio": 1.0, "spans": [2.4, 5.0]}}  # the last one is pulled
    found, other = portal.larger_columns(COLUMN, pulse(1.0), SIZES | {"highest": 12.0}, spans)
    assert found["size_low"] < size * (1 + 1e-9)
    assert size * (1 - 1e-9) < found["size_high"] < found["size_low"] * (1 + 1e-4)
    assert found["bracket"] < 1e-4
    numbers = [found[name] for name in ("height", "mass_same_depth", "mass_similar")]
    assert numbers == pytest.approx([6.0 * size, size**2, size**3], rel=1e-3)
    assert found["mass_of_structure"] == other["mass_of_structure"] == 4.0
    assert found["rises"]
    assert found["by_scipy"]
    assert other["minimum_overturning"] == pytest.approx(0.918, abs=1e-3)


@pytest.mark.parametrize("ends", [(1.0, 2.0), (1.4, 4.0)])  # too small for the portal; too large
def test_sizes_have_to_reach_both_sides(ends):
    sizes = {"lowest": ends[0], "highest": ends[1], "points": 3}
    with pytest.raises(ValueError, match=r"^portal\.sizes: no size after .*; expected one"):
        portal.larger_columns(COLUMN, pulse(1.0), SIZES | {"sizes": sizes}, VASE)


# What the step concludes -------------------------------------------------------------------------


def test_motions_are_brought_to_the_peaks():
    case = {"amplitudes": [0.2, 0.9], "points": {"pulse": 8, "record": 1}}
    tried = portal.motions(case, VASE, [str(RECORDS / "el_centro_1940_NS.AT2")])
    assert [labels["peak_acceleration"] for _, labels, _ in tried] == [0.2, 0.9] * 2
    assert [one.peak_acceleration for one, *_ in tried] == pytest.approx([0.2, 0.9] * 2)
    assert [(at["kind"], points) for _, at, points in tried[1:3]] == [("pulse", 8), ("record", 1)]


def test_second_route_sees_another_outcome_another_peak_and_few_samples():
    tried = [(pulse(peak), labels(peak), 2) for peak in (0.2, 0.6)]
    table = pd.concat([compared(peak, 2) for peak in (0.2, 0.6)])
    wrong = ({"frame": "rests"}, {"joint_shear": 1.01 * table.joint_shear}, {"error": 0.01})
    for change in ({}, *wrong):
        found = portal.second_route(table.assign(**change), tried, COLUMN, VASE, 5)
        assert (found.holds, found["motions"]) == (not change, 1)  # which uplifts the portal


PULLED = ("fixed", "pulled", "none")


def rows(**over):
    """A portal that rests on each bases, three that rock and one that overturns; NaN: no frame."""
    ratios = {"fixed": 0.7, "pinned": 1.5, "rocks": 5.0, "pulled": 0.5, "none": math.nan} | over
    states = {name: f"rests_{name}" for name in ("fixed", "pinned")}
    return pd.DataFrame(
        {"span": 2.4, "state": states.get(name, "rocks"), "resisted": name not in PULLED}
        | {"joint_moment": ratio / 4.0, "friction": math.nan if name == "none" else 0.4}
        | dict.fromkeys(OVER, ratio)
        for name, ratio in ratios.items()
    )


def columns(**change):
    """A larger column as good as the frame, and one as good as the portal."""
    usual = {"structure": ["frame", "portal"], "mass_of_structure": 4.0, "rises": True}
    usual |= {"friction": 0.4, "by_scipy": True, "bracket": 0.0, "height": 9.0}
    usual |= {"size_low": [1.3, 3.0], "size_high": [1.3, 3.0]}
    return pd.DataFrame(
        usual | {"mass_same_depth": [1.7, 9.0], "mass_similar": [2.2, 27.0]} | change
    )


@pytest.mark.parametrize(
    ("over", "holds"),
    [({}, True), ({"fixed": 1.1}, True), ({"pinned": 0.9}, False), ({"rocks": 0.9}, False)],
)
def test_joints_carry_more_where_the_ground_holds_the_portal_or_not(over, holds):
    found = portal.findings(rows(**over), columns())["joints_carry_more"]
    assert found.holds is holds
    counts = [found[name] for name in ("compared", "resting", "rocking", "pulled")]
    assert counts == [2, 1, 1, 1]
    assert found["resisted"] == {"rocks": 1, "rests_fixed": 0, "rests_pinned": 1}
    assert found["rocks"]["2.4"]["base_shear"] == [over.get("rocks", 5.0)] * 2
    assert (found["of_one_moment"], found["largest_friction"]) == (1, 0.4)


@pytest.mark.parametrize(
    ("change", "lighter", "heavier"),
    [
        ({}, True, True),
        ({"mass_similar": [4.1, 69.0]}, False, True),
        ({"mass_same_depth": [1.7, 3.9]}, True, False),
        ({"rises": [True, False]}, False, False),
        ({"by_scipy": [False, True]}, False, False),
    ],
)
def test_larger_columns_are_weighed(change, lighter, heavier):
    found = portal.findings(rows(), columns(**change))
    assert found["larger_column_is_lighter_than_the_frame"].holds is lighter
    assert found["larger_column_is_heavier_than_the_portal"].holds is heavier


WIDE = MonolithicPortal(Column(0.5, 3.0), 1.0, 5.0, 0.6)
PULSE = Pulse("one-cosine", 1.0, 2 * math.pi / 1.5)
G = 9.81


def test_normal_force_and_friction_are_those_of_the_moving_centre_of_mass():
    pulse, time = PULSE.scaled(1.6), np.linspace(0.2, 0.5, 4001)
    course = simulate(WIDE, pulse, samples=time)
    lean = WIDE.slenderness - np.abs(course.rotation)
    size = math.hypot(WIDE.half_base, WIDE.centre_height)
    up, across = size * np.cos(lean), -np.sign(course.rotation) * size * np.sin(lean)
    step = time[1] - time[0]
    lift = np.gradient(np.gradient(up, step), step) / G
    push = np.gradient(np.gradient(across, step), step) / G + pulse.excitation(time)
    inner = slice(5, -5)
    normal, required = (1.0 + lift)[inner], np.abs(push / (1.0 + lift))[inner]
    whole = history(WIDE, pulse, 8)
    part = bearing.on_the_ground(
        WIDE,
        type(whole)(
            *(x[None, inner] for x in (time, course.rotation, course.velocity)),
            pulse.excitation(time)[None, inner],
            0,
            "rests",
        ),
    )
    assert part == pytest.approx((normal.min(), required.max()), rel=1e-4)


def test_base_is_pulled_from_where_it_begins_to_be():
    found = bearing.bearing(WIDE, PULSE, 3.0)
    assert 1.6 < found.pulled_from < 1.75
    for side, pulled in ((-1, False), (1, True)):
        motion = PULSE.scaled(found.pulled_from * (1.0 + side * 1e-6))
        for route in (simulate, reference.simulate):
            course = history(WIDE, motion, bearing.SAMPLES, route)
            assert (bearing.on_the_ground(WIDE, course)[0] <= 0.0) is pulled


def test_base_that_bears_has_no_such_peak_and_a_friction():
    found = bearing.bearing(WIDE, PULSE, 1.0)
    assert found.pulled_from == math.inf
    assert math.tan(WIDE.slenderness) < found.friction < 1.0
