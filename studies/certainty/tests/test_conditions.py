"""Each condition in a result of the study, in a case in which it alone fails."""

import math
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest

from replication.workbench import truth
from steps.shared import sweep
from steps.shared.second import by_scipy
from studies.certainty.steps import (
    benefit,
    extensions,
    intensities,
    lowest,
    records,
    restitution,
    theorem,
)
from studies.certainty.under import factored, supported
from topheavy import Column, Record, judge
from topheavy.synthetic.ensemble import first_draws

SIZES = {"half_width": 0.5, "half_height": 3.0}


def proof(name, holds=True):
    return SimpleNamespace(id=name, holds=holds, statement=f"{name}.")


# No reversal without an impact -------------------------------------------------------------------


def tried(linearised, *, proved=(True, False), contradicts=(False, False), ahead=(True, np.nan)):
    """Two trials of either equation; the second is not proved, and not followed in time."""
    found = {"linearised": linearised, "shape": "chirp", "proved": list(proved)}
    return pd.DataFrame(
        found | {"contradicts": list(contradicts), "ahead": list(ahead), "confirmed": list(ahead)}
    )


@pytest.mark.parametrize(
    ("change", "broken"),
    [
        ({}, set()),
        ({True: {"contradicts": (True, False)}}, {"linearised"}),
        ({False: {"contradicts": (True, False)}}, {"exact"}),
        ({False: {"contradicts": (False, True)}}, {"exact_open"}),
        ({False: {"ahead": (False, np.nan)}}, {"ahead", "second_route"}),
        ({False: {"ahead": (True, False)}}, {"second_route"}),  # the theorem says nothing of it
        (
            {linearised: {"ahead": (np.nan, np.nan)} for linearised in (True, False)},
            {"ahead", "second_route"},  # none was followed
        ),
        ({"proofs": [proof("a"), proof("b", False)]}, {"proofs"}),
    ],
)
def test_trials_decide_what_they_are_about(monkeypatch, change, broken):
    def rows(case, linearised):
        usual = {"proved": (True, True)} if linearised else {}
        return tried(linearised, **usual | change.get(linearised, {}))

    monkeypatch.setattr(theorem, "rows", rows)
    proofs = change.get("proofs", [proof("a")])
    monkeypatch.setattr(theorem, "reversal_theorems", lambda: proofs)
    _, found = theorem.main({})
    assert {name for name, one in found.items() if not one.holds} == broken


EXTREME = {
    "size": 3.0,
    "mass_ratios": [0.0, np.inf],
    "extremes": [
        {"slenderness": slenderness, "duration": 4.0, "accelerations": [1.0, -1.0]}
        | {"samples": [1, 2], "amplitude": 1.0}
        for slenderness in (10.0, 20.0)
    ],
}


@pytest.mark.parametrize(
    ("light", "heavy", "holds"),
    [((True, 1), (True, 0), False), ((True, 0), (True, 0), True), ((False, 1), (True, 1), True)],
)
def test_extreme_motion_overturns_the_heavier_frame_alone_at_once(monkeypatch, light, heavy, holds):
    def judge(frame, pulse, tolerance=None):
        overturned, impacts = heavy if frame.mass_ratio else light
        return SimpleNamespace(overturned=overturned, impacts=impacts)

    monkeypatch.setattr(lowest, "judge", judge)
    monkeypatch.setattr(lowest, "reference", SimpleNamespace(judge=judge))
    monkeypatch.setattr(lowest, "at_once", lambda block, pulse: True)
    found, _ = lowest.against_the_theorem(EXTREME, 1e-12)
    assert found.holds is holds
    assert found["exceptions"] == (0 if holds else 2)
    assert found["slenderness"] == [10.0, 20.0]


def test_extreme_motion_that_scipy_denies_proves_nothing(monkeypatch):
    def judge(frame, pulse, tolerance=None):
        return SimpleNamespace(overturned=True, impacts=0 if frame.mass_ratio else 1)

    def denied(frame, pulse):
        return SimpleNamespace(overturned=False, impacts=0)

    monkeypatch.setattr(lowest, "judge", judge)
    monkeypatch.setattr(lowest, "at_once", lambda block, pulse: True)
    for other, holds in ((judge, False), (denied, True)):
        monkeypatch.setattr(lowest, "reference", SimpleNamespace(judge=other))
        assert lowest.against_the_theorem(EXTREME, 1e-12)[0].holds is holds


# Extensions --------------------------------------------------------------------------------------

PROOFS = [
    "size_only_slows_time",
    "columns_count_only_in_the_mass_ratio",
    "lagrange_agrees_for_columns",
    "impacts_do_not_count_the_columns",
    "vertical_acceleration_adds_to_gravity",
    "vertical_acceleration_changes_the_uplift",
    "vertical_acceleration_is_a_change_of_gravity_and_push",
]
COURSE = {"routes_differ_by": 1e-9, "impacts": 3, "peak": 0.4, "peak_without_vertical": 0.5}


@pytest.mark.parametrize(
    ("change", "false", "broken"),
    [
        ({}, "", set()),
        ({"routes_differ_by": 2e-6}, "", {"three_bodies"}),
        ({"impacts": 1}, "", {"three_bodies"}),
        ({}, PROOFS[0], {"size_is_slower_time"}),
        *(({}, name, {"columns"}) for name in PROOFS[1:4]),
        *(({}, name, {"vertical"}) for name in PROOFS[4:]),
    ],
)
def test_one_history_and_one_proof_are_enough_to_refute(monkeypatch, change, false, broken):
    proofs = [proof(name, name != false) for name in PROOFS]
    courses = iter([COURSE, COURSE | change])
    given = {"strongest": (None, None), "similar": None, "shows_stability": None}
    given |= {"_of_similar": truth(True), "_of_lobes": truth(True)}
    for name, found in given.items():
        monkeypatch.setattr(extensions, name, lambda *arguments, found=found: found)
    monkeypatch.setattr(extensions, "history", lambda *arguments: next(courses))
    monkeypatch.setattr(extensions, "extension_theorems", lambda: proofs)
    pair = {"horizontal": "a", "vertical": "b"}
    case = {"pairs": [pair], "mass_ratios": [0.0, 1.0], "duration": 1.0, "agreement": 1e-6}
    *_, found = extensions.main(case, {"a": None, "b": None})
    wrong = {name for name, one in found.items() if one.holds is False}
    assert wrong == broken


def test_similar_structures_have_the_same_peaks(monkeypatch):
    case = {"column": SIZES, "similarity": {"seed": 3, "pulses": 20}}
    assert extensions._of_similar(extensions.similar(case)).holds
    right = extensions.judge

    def higher(structure, pulse):
        """Judge a structure; the peaks of frames are a thousandth of α higher."""
        found = right(structure, pulse)
        off = 1e-3 * structure.slenderness * hasattr(structure, "mass_ratio")
        return SimpleNamespace(
            overturned=found.overturned, impacts=found.impacts, peak=found.peak + off
        )

    monkeypatch.setattr(extensions, "judge", higher)
    assert not extensions._of_similar(extensions.similar(case)).holds


# The impact law ----------------------------------------------------------------------------------


def changes(**broken):
    """Tables of two factors for each way; `broken` has a way's values at the lower factor."""
    rows = [
        {"way": way, "factor": factor, "helps": 0.1, "harms": 0.01, "compared": 9}
        | {"falls": 0, "least": 1.1}
        | (broken.get(way.replace(" ", "_"), {}) if factor < 1.0 else {})
        for way in ("both", "frame alone", "column alone")
        for factor in (0.9, 1.0)
    ]
    return pd.DataFrame(rows)


TOGETHER, APART = "lowest_rises_together", "lowest_rises_apart"


@pytest.mark.parametrize(
    ("way", "values", "broken", "unconditional"),
    [
        ("both", {}, set(), set()),
        ("both", {"falls": 1}, {TOGETHER, APART}, {APART}),
        ("both", {"compared": 0}, {TOGETHER, APART}, {APART}),
        ("frame_alone", {"falls": 1}, {APART}, {APART}),
        ("column_alone", {"falls": 1}, {APART}, set()),
    ],
)
def test_one_change_of_restitution_is_enough_to_refute(
    monkeypatch, way, values, broken, unconditional
):
    table = changes(**{way: values})
    monkeypatch.setattr(restitution, "under_pulses", lambda case: table)
    _, found = restitution.main({"levels": 501})
    assert {name for name, one in found.items() if one.holds is False} == broken
    assert {name for name, one in found.items() if one.holds_when is False} == unconditional


# What of the benefit remains ---------------------------------------------------------------------


BOTH, ALONE = benefit.BOTH, benefit.COLUMN_ALONE
SAID = {
    **{(BOTH, factor): "is positive" for factor in (0.9, 0.95, 1.0)},
    (ALONE, 0.9): "is negative",
    (ALONE, 0.95): "is positive",
}


@pytest.mark.parametrize(
    ("near_fault", "broadband", "broken"),
    [
        ({}, {}, {"remains"}),
        ({}, {(ALONE, 0.9): "is positive"}, {"remains", "reverses"}),
        ({}, {(ALONE, 0.9): "includes zero"}, {"remains", "reverses"}),
        ({}, {(ALONE, 0.95): "includes zero"}, {"remains"}),
        ({}, {(BOTH, 1.0): "includes zero"}, {"remains", "frame_is_safer"}),
        ({}, {(BOTH, 0.9): "is negative"}, {"remains", "frame_is_safer"}),
        (*[{(ALONE, 0.9): "is positive"}] * 2, {"reverses"}),
        (*[{(ALONE, 0.9): "includes zero"}] * 2, {"remains", "reverses"}),
    ],
)
def test_ranking_is_judged_by_whole_intervals_of_both_families(
    monkeypatch, near_fault, broadband, broken
):
    families = {"near-fault": SAID | near_fault, "broadband": SAID | broadband}
    table = pd.DataFrame(
        {"family": family, "way": way, "factor": factor, "interval": words}
        | {"less_low": 10.0 * factor - 1.0, "less_high": 10.0 * factor - 0.5}
        for family, said in families.items()
        for (way, factor), words in said.items()
    )
    monkeypatch.setattr(benefit, "differences", lambda *arguments: table)
    monkeypatch.setattr(benefit, "sampled", lambda *arguments: [])
    _, found = benefit.main({}, {"families": []}, None)
    found = {name: one for name, one in found.items() if name != "second_route"}
    assert {name for name, one in found.items() if one.holds is False} == broken
    assert found["frame_is_safer"]["shrinks"]
    wide = table.assign(less_high=table.less_high + 0.6)
    assert not benefit.findings(wide)["frame_is_safer"]["shrinks"]


ENSEMBLE = {
    "run": "default",
    "runs": {"default": {"motions": 500}},
    "seed": 2014,
    "families": ["near-fault", "broadband"],
    "scenarios": [
        {"magnitude": 6.5, "distance": 10.0, "site_velocity": 760.0, "directivity": 10.0}
    ],
}
STATED = {
    "column": SIZES,
    "mass_ratio": 1.0,
    "pgv": 0.8,
    "factors": [0.9, 1.0],
    "motions": 6,
    "seed": 3,
    "checked": 2,
    "bootstrap": {"resamples": 100, "confidence": 0.95},
}


@pytest.fixture(scope="module")
def answered():
    shard = sweep.sweep({"benefit": factored(STATED)}, ENSEMBLE, "1-of-1")
    return sweep.answers([shard], "benefit", ENSEMBLE, STATED["motions"])


def test_difference_is_that_of_column_and_frame_under_motions_of_the_stated_velocity(answered):
    table = benefit.main(STATED, ENSEMBLE, answered)[0]
    under = {one.labels["structure"]: one.block for one in factored(STATED).subjects}
    draws = first_draws(ENSEMBLE, STATED["motions"])
    assert len(table) == 2 * 4  # families, comparisons
    for row in table.itertuples():
        records = [draw.record() for draw in draws if draw.family == row.family]
        scaled = [record.scaled(STATED["pgv"] / record.peak_velocity) for record in records]
        names = benefit.compared(STATED["factors"])[row.way, row.factor]
        column, frame = ([judge(under[n], one).overturned for one in scaled] for n in names)
        assert (row.motions, row.column, row.frame) == (6, sum(column), sum(frame))
        assert row.only_column == sum(a and not b for a, b in zip(column, frame, strict=True))
        assert row.only_frame == sum(b and not a for a, b in zip(column, frame, strict=True))
        assert row.less == pytest.approx((row.column - row.frame) / 6)
        assert row.less_low <= row.less <= row.less_high
        if row.column:
            assert row.over == pytest.approx(row.frame / row.column)
    assert table.only_column.any()
    assert table.only_frame.any()


def test_sampled_ranking_has_one_that_overturns_and_one_that_does_not(answered):
    cells = list(benefit.sampled(STATED, answered))
    assert len(cells) > 1
    assert {fell for *_, fell in cells} == {True, False}
    assert by_scipy(cells) == {"told": len(cells), "differ": 0}


@pytest.mark.parametrize(("told", "differ", "holds"), [(3, 0, True), (3, 1, False), (0, 0, False)])
def test_scipy_has_to_find_the_sampled_outcomes(answered, monkeypatch, told, differ, holds):
    for module in (benefit, intensities):
        monkeypatch.setattr(module, "by_scipy", lambda cells: {"told": told, "differ": differ})
    assert benefit.main(STATED, ENSEMBLE, answered)[-1]["second_route"].holds is holds
    assert intensities.main(CASE, FAMILY, STRUCTURES, cells())[-1]["second_route"].holds is holds


# Stated intensities ------------------------------------------------------------------------------

CASE = {
    "columns": [{"structure": "temple", "scaled": k, "mass_ratio": 1.0} for k in (1.0, 2.0)],
    "pgv": [0.6, 1.0],
    "pga": [0.2],
    "motions": 100,
    "seed": 1,
    "checked": 4,
    "confidence": 0.95,
    "ample": {"height": 12.0, "pgv": 0.6, "probability": 0.1},
}
STRUCTURES, FAMILY = {"temple": SIZES}, ENSEMBLE | {"families": ["near-fault"]}


def cells(**fell):
    """Outcomes of 100 motions; `fell` counts what overturns a support at a level of a height."""
    usual = {"bare": 3, "free": 1, "fixed": 5}
    draws, found = first_draws(FAMILY, 100), {}
    for measure in ("pgv", "pga"):
        asked, counts = supported(CASE, STRUCTURES, measure), []
        for subject in asked.subjects:
            support, height = subject.labels["support"], subject.labels["structure"].split()[0]
            given = fell.get(f"{support}_{height}", {})
            counts.append([given.get(level, usual[support]) for level in asked.levels.tolist()])
        outcomes = np.arange(100)[:, None, None] < (measure == "pgv") * np.array(counts)
        found[measure] = sweep.Swept(draws, np.full(100, 0.5), outcomes)
    return found


OTHERS = {"bare_12": {0.6: 30, 1.0: 30}, "fixed_12": {0.6: 40, 1.0: 40}}


@pytest.mark.parametrize(
    ("fell", "broken", "at_stated"),
    [
        ({}, set(), True),
        ({"free_12": {1.0: 20}} | OTHERS, {"ample_stability"}, True),
        ({"free_12": {0.6: 20}} | OTHERS, {"ample_stability"}, False),
        # six of a hundred: the interval reaches beyond the margin of 10 %
        ({"free_12": {0.6: 6}} | OTHERS, {"ample_stability"}, False),
        ({"free_6": {0.6: 2, 1.0: 2}}, set(), True),  # lower columns do not count
        ({"free_6": {0.6: 5}}, {"free_cap_helps"}, True),
        ({"fixed_6": {0.6: 1}}, {"fixed_mass_harms"}, True),
    ],
)
def test_probabilities_decide_what_they_are_about(monkeypatch, fell, broken, at_stated):
    monkeypatch.setattr(intensities, "by_scipy", lambda sample: {"told": 1, "differ": 0})
    _, found = intensities.main(CASE, FAMILY, STRUCTURES, cells(**fell))
    assert {name for name, one in found.items() if one.holds is False} == broken
    assert found["ample_stability"].holds_when is at_stated


# The measured records ----------------------------------------------------------------------------

RATIOS = [0.0, 0.5, 1.0]
UNSCALED = {"columns": [{"structure": "temple", "scaled": 1.0}], "mass_ratios": RATIOS}
BARE, LIGHTER, ALL = "bare_columns_fall_first", "lighter_frames_fall_first", "records"


def under_a_record(overturned, **other):
    """Outcomes of a column and two frames under a record, by all ways but for the `other`."""
    ways = ("overturned", "smaller_record", "larger_record", "by_scipy")
    return pd.DataFrame(
        {"record": "napa_1", "structure": "6 m temple", "mass_ratio": RATIOS, "pgv": 0.5}
        | {way: list(overturned) for way in ways}
        | other
    )


@pytest.mark.parametrize(
    ("table", "broken"),
    [
        (under_a_record((False, False, False)), set()),
        (under_a_record((True, False, False)), set()),
        (under_a_record((True, True, False)), {ALL}),
        (under_a_record((True, True, True)), {ALL}),
        (under_a_record((False, True, False)), {ALL, BARE}),
        (under_a_record((True, False, True)), {ALL, LIGHTER}),
        (under_a_record((False, False, True)), {ALL, BARE, LIGHTER}),
        (under_a_record((True, False, False), by_scipy=[True, False, True]), {"second_route"}),
        (under_a_record((True, False, False), by_scipy=[None, False, None]), set()),
        (under_a_record((True, False, False), by_scipy=None), {"second_route"}),
        (under_a_record((False,) * 3, smaller_record=[False, True, False]), {"second_route"}),
        (under_a_record((False,) * 3, larger_record=[True, False, False]), {"second_route"}),
        (under_a_record((True, False, False))[:1], {ALL, BARE, LIGHTER}),  # no frame was tried
        (under_a_record((True, False, False))[:2], {LIGHTER}),  # there is no lighter frame
    ],
)
def test_one_record_is_enough_to_reverse_the_ranking(monkeypatch, table, broken):
    judged = table.pop("by_scipy")
    monkeypatch.setattr(records, "outcomes", lambda *arguments: table)
    monkeypatch.setattr(records, "by_scipy", lambda *arguments: judged)
    structures = {"temple": SIZES}
    case = UNSCALED | {"checked_by_second_route": 1}
    _, found = records.main(case, structures, [])
    assert {name for name, one in found.items() if one.holds is False} == broken


def test_scipy_judges_every_structure_that_a_record_overturns(monkeypatch):
    """Of two records, the first overturns a frame; of the second, one history is judged."""
    asked = []

    def judge(frame, record):
        asked.append((record.name, frame.mass_ratio))
        return SimpleNamespace(overturned=record.name == "a" and frame.mass_ratio == 1.0)

    monkeypatch.setattr(records, "reference", SimpleNamespace(judge=judge))
    first, second = (
        under_a_record((False, False, falls)).drop(columns="by_scipy").assign(record=name)
        for name, falls in (("a", True), ("b", False))
    )
    shaken = [Record(0.01, np.ones(3), name) for name in ("a", "b")]
    table = pd.concat([first, second], ignore_index=True)
    found = records.by_scipy(table, shaken, {"6 m temple": Column(**SIZES)}, 1)
    assert asked == [("a", 0.0), ("a", 0.5), ("a", 1.0), ("b", 0.0)]
    assert found[:4].tolist() == [False, False, True, False]
    assert found[4:].isna().all()


def test_records_are_judged_as_measured_and_a_billionth_beside(monkeypatch):
    peaks = []

    def judge(frame, record):
        peaks.append(record.peak_acceleration)
        return SimpleNamespace(overturned=record.peak_acceleration > 0.3, peak=math.nan)

    monkeypatch.setattr(records, "judge", judge)
    found = records.outcome(Record(0.01, np.array([0.0, 0.3, 0.0])), Column(**SIZES), 0.5)
    assert peaks == pytest.approx([0.3, 0.3, 0.3], rel=2e-9)
    assert (found["overturned"], found["smaller_record"]) == (False, False)
    assert found["larger_record"]
