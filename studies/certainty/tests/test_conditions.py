"""Each condition in a result of the study, in a case in which it alone fails."""

from types import SimpleNamespace as Of

import numpy as np
import pandas as pd
import pytest

import topheavy as th
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
from studies.certainty.subjects import factored, supported
from tests.cases import COLUMN, SIZES, broken
from topheavy.ground.synthetic.ensemble import first_draws


def proof(name, holds=True):
    return Of(id=name, holds=holds, statement=f"{name}.")


# No reversal without an impact -------------------------------------------------------------------

NO, NOT = (False, False), (np.nan, np.nan)


@pytest.mark.parametrize(
    ("change", "false"),
    [
        ({}, set()),
        ({True: {"contradicts": (True, False)}}, {"linearised"}),
        ({False: {"contradicts": (True, False)}}, {"exact"}),
        ({False: {"contradicts": (False, True)}}, {"exact_open"}),
        ({False: {"ahead": (False, np.nan)}}, {"ahead", "second_route"}),
        ({False: {"ahead": (True, False)}}, {"second_route"}),  # the theorem says nothing of it
        ({True: {"ahead": NOT}, False: {"ahead": NOT}}, {"ahead", "second_route"}),  # none followed
        ({"proofs": [proof("a"), proof("b", False)]}, {"proofs"}),
    ],
)
def test_trials_decide_what_they_are_about(given, change, false):
    """Two trials of either equation; the second of the exact one is not proved."""

    def rows(case, linearised):
        found = {"proved": (True, linearised), "contradicts": NO, "ahead": (True, np.nan)}
        found |= change.get(linearised, {})
        found = {name: list(pair) for name, pair in found.items()}
        found |= {"linearised": linearised, "shape": "chirp", "confirmed": found["ahead"]}
        return pd.DataFrame(found)

    given(theorem, rows=rows, reversal_theorems=change.get("proofs", [proof("a")]))
    assert {name for name, one in theorem.main({})[1].items() if not one.holds} == false


EXTREME = {"size": 3.0, "mass_ratios": [0.0, np.inf]}
EXTREME["extremes"] = [
    {"slenderness": slenderness, "duration": 4.0, "accelerations": [1.0, -1.0]}
    | {"samples": [1, 2], "amplitude": 1.0}
    for slenderness in (10.0, 20.0)
]


@pytest.mark.parametrize(
    ("light", "heavy", "scipy", "holds"),
    [
        ((True, 1), (True, 0), None, False),
        ((True, 0), (True, 0), None, True),
        ((False, 1), (True, 1), None, True),
        ((True, 1), (True, 0), (False, 0), True),  # SciPy denies it: it proves nothing
    ],
)
def test_extreme_motion_overturns_the_heavier_alone_at_once(given, light, heavy, scipy, holds):
    def judge(frame, pulse, tolerance=None, known=None):
        overturned, impacts = known or (heavy if frame.mass_ratio else light)
        return Of(overturned=overturned, impacts=impacts)

    second = Of(judge=lambda frame, pulse: judge(frame, pulse, known=scipy))
    given(lowest, judge=judge, reference=second, at_once=True)
    found, _ = lowest.against_the_theorem(EXTREME, 1e-12)
    assert found.holds is holds
    assert found["exceptions"] == (0 if holds else 2)
    assert found["slenderness"] == [10.0, 20.0]


# Extensions --------------------------------------------------------------------------------------

PROOFS = {
    "size_only_slows_time": "size_is_slower_time",
    "columns_count_only_in_the_mass_ratio": "columns",
    "lagrange_agrees_for_columns": "columns",
    "impacts_do_not_count_the_columns": "columns",
    "vertical_acceleration_adds_to_gravity": "vertical",
    "vertical_acceleration_changes_the_uplift": "vertical",
    "vertical_acceleration_is_a_change_of_gravity_and_push": "vertical",
}
COURSE = {"routes_differ_by": 1e-9, "impacts": 3, "peak": 0.4, "peak_without_vertical": 0.5}


@pytest.mark.parametrize(
    ("change", "lost", "false"),
    [
        ({}, "", set()),
        ({"routes_differ_by": 2e-6}, "", {"three_bodies"}),
        ({"impacts": 1}, "", {"three_bodies"}),
        *(({}, name, {finding}) for name, finding in PROOFS.items()),
    ],
)
def test_one_history_and_one_proof_are_enough_to_refute(given, change, lost, false):
    courses = iter([COURSE, COURSE | change])
    given(extensions, strongest=(None, None), similar=None, shows_stability=None)
    given(extensions, _of_similar=truth(True), _of_lobes=truth(True))
    given(extensions, history=lambda *_: next(courses))
    given(extensions, extension_theorems=[proof(name, name != lost) for name in PROOFS])
    case = {"pairs": [{"horizontal": "a", "vertical": "b"}], "mass_ratios": [0.0, 1.0]}
    *_, found = extensions.main(case | {"duration": 1.0, "agreement": 1e-6}, {"a": None, "b": None})
    assert broken(found) == false


def test_similar_structures_have_the_same_peaks(given):
    case, right = {"column": SIZES, "similarity": {"seed": 3, "pulses": 20}}, extensions.judge
    assert extensions._of_similar(extensions.similar(case)).holds

    def higher(structure, pulse):  # by a thousandth of α, of frames
        found = right(structure, pulse)
        off = 1e-3 * structure.slenderness * hasattr(structure, "mass_ratio")
        return Of(overturned=found.overturned, impacts=found.impacts, peak=found.peak + off)

    given(extensions, judge=higher)
    assert not extensions._of_similar(extensions.similar(case)).holds


# The impact law ----------------------------------------------------------------------------------

APART = {"lowest_rises_apart"}
RISES = APART | {"lowest_rises_together"}


@pytest.mark.parametrize(
    ("way", "values", "false", "unconditional"),
    [
        ("both", {}, set(), set()),
        ("both", {"falls": 1}, RISES, APART),
        ("both", {"compared": 0}, RISES, APART),
        ("frame alone", {"falls": 1}, APART, APART),
        ("column alone", {"falls": 1}, APART, set()),
    ],
)
def test_one_change_of_restitution_is_enough_to_refute(given, way, values, false, unconditional):
    """In tables of two factors for each way; a way has the values at the lower factor."""
    usual = {"helps": 0.1, "harms": 0.01, "compared": 9, "falls": 0, "least": 1.1}
    table = pd.DataFrame(
        {"way": one, "factor": factor} | usual | (values if (one, factor) == (way, 0.9) else {})
        for one in ("both", "frame alone", "column alone")
        for factor in (0.9, 1.0)
    )
    given(restitution, under_pulses=table)
    _, found = restitution.main({"levels": 501})
    assert (broken(found), broken(found, "holds_when")) == (false, unconditional)


# What of the benefit remains ---------------------------------------------------------------------

BOTH, ALONE = benefit.BOTH, benefit.COLUMN_ALONE
SAID = {(BOTH, factor): "is positive" for factor in (0.9, 0.95, 1.0)}
SAID |= {(ALONE, 0.9): "is negative", (ALONE, 0.95): "is positive"}


@pytest.mark.parametrize(
    ("near_fault", "broadband", "false"),
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
def test_ranking_is_judged_by_whole_intervals_of_both_families(given, near_fault, broadband, false):
    table = pd.DataFrame(
        {"family": family, "way": way, "factor": factor, "interval": words}
        | {"less_low": 10.0 * factor - 1.0, "less_high": 10.0 * factor - 0.5}
        for family, said in (("near-fault", near_fault), ("broadband", broadband))
        for (way, factor), words in (SAID | said).items()
    )
    given(benefit, differences=table, sampled=[])
    _, found = benefit.main({}, {"families": []}, None)
    assert broken(found) - {"second_route"} == false
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
STATED = {"column": SIZES, "mass_ratio": 1.0, "pgv": 0.8, "factors": [0.9, 1.0]}
STATED |= {"motions": 6, "seed": 3, "checked": 2}
STATED |= {"bootstrap": {"resamples": 100, "confidence": 0.95}}


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
        motions = [draw.record() for draw in draws if draw.family == row.family]
        scaled = [one.scaled(STATED["pgv"] / one.peak_velocity) for one in motions]
        names = benefit.compared(STATED["factors"])[row.way, row.factor]
        column, frame = (
            np.array([th.judge(under[n], one).overturned for one in scaled]) for n in names
        )
        counts = (row.motions, row.column, row.frame, row.only_column, row.only_frame)
        only = (column & ~frame).sum(), (frame & ~column).sum()
        assert counts == (6, column.sum(), frame.sum(), *only)
        assert row.less == pytest.approx((row.column - row.frame) / 6)
        assert row.less_low <= row.less <= row.less_high
        assert not row.column or row.over == pytest.approx(row.frame / row.column)
    assert table.only_column.any()
    assert table.only_frame.any()
    sampled = list(benefit.sampled(STATED, answered))
    assert {fell for *_, fell in sampled} == {True, False}
    assert by_scipy(sampled) == {"decided": len(sampled), "differ": 0}


OF_SCIPY = [(3, 0, True), (3, 1, False), (0, 0, False)]


@pytest.mark.parametrize(("decided", "differ", "holds"), OF_SCIPY)
def test_scipy_has_to_find_the_sampled_outcomes(answered, given, decided, differ, holds):
    for module in (benefit, intensities):
        given(module, by_scipy={"decided": decided, "differ": differ})
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
            those = fell.get(f"{support}_{height}", {})
            counts.append([those.get(level, usual[support]) for level in asked.levels.tolist()])
        outcomes = np.arange(100)[:, None, None] < (measure == "pgv") * np.array(counts)
        found[measure] = sweep.Swept(draws, np.full(100, 0.5), outcomes)
    return found


OTHERS = {"bare_12": {0.6: 30, 1.0: 30}, "fixed_12": {0.6: 40, 1.0: 40}}


@pytest.mark.parametrize(
    ("fell", "false", "at_stated"),
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
def test_probabilities_decide_what_they_are_about(given, fell, false, at_stated):
    given(intensities, by_scipy={"decided": 1, "differ": 0})
    _, found = intensities.main(CASE, FAMILY, STRUCTURES, cells(**fell))
    assert broken(found) == false
    assert found["ample_stability"].holds_when is at_stated


# The measured records ----------------------------------------------------------------------------

RATIOS = [0.0, 0.5, 1.0]
UNSCALED = {"columns": [{"structure": "temple", "scaled": 1.0}], "mass_ratios": RATIOS}
BARE, LIGHTER, ALL = "bare_columns_fall_first", "lighter_frames_fall_first", "records"
FIRST, STANDS = (True, False, False), (False, False, False)


def under_a_record(overturned, **other):
    """Outcomes of a column and two frames under a record, by all ways but for the `other`."""
    ways = ("overturned", "smaller_record", "larger_record", "by_scipy")
    fixed = {"record": "napa_1", "structure": "6 m temple", "mass_ratio": RATIOS, "pgv": 0.5}
    return pd.DataFrame(fixed | {way: list(overturned) for way in ways} | other)


@pytest.mark.parametrize(
    ("table", "false"),
    [
        (under_a_record(STANDS), set()),
        (under_a_record(FIRST), set()),
        (under_a_record((True, True, False)), {ALL}),
        (under_a_record((True, True, True)), {ALL}),
        (under_a_record((False, True, False)), {ALL, BARE}),
        (under_a_record((True, False, True)), {ALL, LIGHTER}),
        (under_a_record((False, False, True)), {ALL, BARE, LIGHTER}),
        (under_a_record(FIRST, by_scipy=[True, False, True]), {"second_route"}),
        (under_a_record(FIRST, by_scipy=[None, False, None]), set()),
        (under_a_record(FIRST, by_scipy=None), {"second_route"}),
        (under_a_record(STANDS, smaller_record=[False, True, False]), {"second_route"}),
        (under_a_record(STANDS, larger_record=[True, False, False]), {"second_route"}),
        (under_a_record(FIRST)[:1], {ALL, BARE, LIGHTER}),  # no frame was tried
        (under_a_record(FIRST)[:2], {LIGHTER}),  # there is no lighter frame
    ],
)
def test_one_record_is_enough_to_reverse_the_ranking(given, table, false):
    given(records, outcomes=table.drop(columns="by_scipy"), by_scipy=table.by_scipy)
    _, found = records.main(UNSCALED | {"checked_by_second_route": 1}, {"temple": SIZES}, [])
    assert broken(found) == false


def test_scipy_judges_every_structure_that_a_record_overturns(given):
    """Of two records, the first overturns a frame; of the second, one history is judged."""
    asked = []

    def judge(frame, record):
        asked.append((record.name, frame.mass_ratio))
        return Of(overturned=record.name == "a" and frame.mass_ratio == 1.0)

    given(records, reference=Of(judge=judge))
    table = pd.concat(
        [
            under_a_record((False, False, name == "a")).drop(columns="by_scipy").assign(record=name)
            for name in "ab"
        ],
        ignore_index=True,
    )
    shaken = [th.Record(0.01, np.ones(3), name) for name in "ab"]
    found = records.by_scipy(table, shaken, {"6 m temple": COLUMN}, 1)
    assert asked == [("a", 0.0), ("a", 0.5), ("a", 1.0), ("b", 0.0)]
    assert found[:4].tolist() == [False, False, True, False]
    assert found[4:].isna().all()


def test_records_are_judged_as_measured_and_a_billionth_beside(given):
    peaks = []

    def judge(frame, record):
        peaks.append(record.peak_acceleration)
        return Of(overturned=record.peak_acceleration > 0.3, peak=np.nan)

    given(records, judge=judge)
    found = records.outcome(th.Record(0.01, np.array([0.0, 0.3, 0.0])), COLUMN, 0.5)
    assert peaks == pytest.approx([0.3, 0.3, 0.3], rel=2e-9)
    assert [found[f"{name}"] for name in ("overturned", "smaller_record")] == [False, False]
    assert found["larger_record"]
