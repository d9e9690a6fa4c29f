"""Findings of tables that decide the study's claims, and the claims' own numbers."""

import math
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

import topheavy as th
from replication.inputs.strict_yaml import read_yaml
from steps.shared import sweep
from studies.certainty.shapes import record
from studies.certainty.steps import benefit, extensions, intensities, lowest, restitution, theorem
from studies.certainty.subjects import HIGHEST, changed, factored, supported
from tests.cases import COLUMN, FRAME, SIZES
from topheavy.ground.synthetic.ensemble import Draw
from topheavy.second import reference

JUDGES = (th.judge, reference.judge)


# No reversal without an impact -------------------------------------------------------------------


@pytest.mark.parametrize(("found", "holds"), [((0, 0), True), ((0, 1), False), ((), False)])
def test_one_contradiction_refutes_the_theorem(found, holds):
    assert theorem.counted(pd.DataFrame({"motions": 1, "contradictions": found}))["holds"] is holds


def test_frames_in_the_wrong_order_contradict_the_theorem():
    """With the lighter frame taken for the heavier, many trials contradict."""
    random, found = np.random.default_rng(4), 0
    for _ in range(60):
        if (one := theorem.trial(random, True)) is not None:
            assert theorem.at_once(one.lighter, one.motion)
            assert theorem.is_ahead(one)
            found += not theorem.is_ahead(theorem.Trial(one.heavier, one.lighter, one.motion))
    assert found > 20


def test_theorem_covers_what_its_conditions_say():
    light, heavy = COLUMN.block(), FRAME.block()
    for inward, proved in ((0.5, True), (0.9, False)):
        motion = th.Record(0.002, np.repeat([0.0, 1.5, -inward, 0.0], 40))
        one = theorem.Trial(light, heavy, motion)
        assert theorem.peaks(one) == pytest.approx((1.5, inward))
        assert theorem.is_proved(one) is (1.5 * inward < 1.0) is proved
    assert theorem.is_proved(theorem.Trial(light.linear(), heavy.linear(), motion))


# Minimum overturning acceleration ----------------------------------------------------------------

LOBES = {"seed": 7, "pulses": 4, "slendernesses": [5.0, 20.0]}
LOBES |= {"lowest": 1.0, "highest": 8.0, "resolution": 0.05}
LOBES = {"mass_ratios": [0.0, 1.0, math.inf], "lobes": LOBES}


def test_second_lobe_is_an_exception(given):
    assert lowest.single_lobes(LOBES, 3e-12)["holds"]
    given(lowest, single_lobe=np.array([1.0, 0.0, -1.0]))
    found = lowest.single_lobes(LOBES, 3e-12)
    assert (found["holds"], found["exceptions"] > 0) == (False, True)


SEARCH = {"seed": 1, "values": 8, "highest": 6.0, "steps": [0.0001, 0.002, 0.05]}


@pytest.mark.parametrize(("ratios", "trials"), [([0.0, math.inf], 400), ([math.inf, 0.0], 20)])
def test_fall_on_the_coarse_grid_alone_is_apparent_and_on_all_grids_found(ratios, trials):
    """With the heavier frame first, the minimum falls for nearly every shape."""
    case = {"column": SIZES, "mass_ratios": ratios, "search": SEARCH | {"trials": trials}}
    rows, found = lowest.search(case)
    if trials == 400:
        assert found["holds"]
        assert found["apparent"] == len(rows) > 0
        assert all(row["coarse"] < 1.0 <= row["last"] for row in rows)
    else:
        assert (found["holds"], found["confirmed"] > 5) == (False, True)


# Extensions --------------------------------------------------------------------------------------

SIMILAR = {"column": SIZES, "mass_ratios": [0.0, 4.0], "similarity": {"seed": 3, "pulses": 60}}


def test_frame_with_the_columns_restitution_is_not_similar(monkeypatch):
    assert extensions._of_similar(extensions.similar(SIMILAR)).holds
    own = th.Column.block
    monkeypatch.setattr(th.Column, "block", lambda self, restitution=None: own(self))
    assert not extensions._of_similar(extensions.similar(SIMILAR)).holds


def test_stability_is_not_shown_by_pulses_of_several_lobes():
    case = SIMILAR | {"similarity": {"seed": 24, "pulses": 400}}
    found = extensions._of_lobes(extensions.shows_stability(case))
    assert (found["holds"], found["holds_when"], found["only_the_frame"] > 0) == (False, True, True)


def test_both_components_keep_their_common_time():
    across = th.Record(0.01, np.concatenate([np.zeros(300), np.ones(100), np.zeros(300)]))
    one, other = extensions.strongest(across, th.Record(0.01, np.arange(700.0) / 1000.0), 1.5)
    assert other.acceleration[np.flatnonzero(one.acceleration)[0]] == pytest.approx(0.300)


# The impact law ----------------------------------------------------------------------------------


def shaken(random, values, most):
    motion = record(random.uniform(-1.0, 1.0, values), random.uniform(2.0, 20.0), COLUMN)
    return motion.scaled(random.uniform(1.0, most))


def test_equal_restitutions_are_those_of_the_block_and_none_the_librarys_own():
    random = np.random.default_rng(3)
    for _ in range(100):
        motion = shaken(random, 8, 8.0)
        equal = th.judge(FRAME, motion, restitutions=[FRAME.restitution] * 60)
        assert equal.overturned == th.judge(FRAME, motion).overturned
    for judge in JUDGES:
        assert repr(judge(COLUMN, motion, restitutions=[])) == repr(judge(COLUMN, motion))
        with pytest.raises(ValueError, match=r"restitutions is 1\.2"):
            judge(COLUMN, motion, restitutions=[1.2])


def test_each_impact_has_its_own_restitution():
    """Some motions overturn the column, and not if its second impact takes all its speed."""
    random, differ = np.random.default_rng(5), 0
    for _ in range(60):
        motion, fell = shaken(random, 10, 4.0), []
        for row in ([0.95, 0.95, 0.95], [0.95, 0.0, 0.95]):
            ours, scipys = (judge(COLUMN, motion, restitutions=row) for judge in JUDGES)
            assert (ours.overturned, ours.impacts) == (scipys.overturned, scipys.impacts)
            fell.append(ours.overturned)
        differ += fell[0] != fell[1]
    assert differ > 2


def test_factors_are_applied_to_column_and_frame_as_named_up_to_the_highest():
    own = COLUMN.block()
    assert changed(own, 1.05).restitution == HIGHEST == 0.995
    assert changed(own, 0.9).restitution == pytest.approx(0.9 * own.restitution)
    assert changed(own, 1.0) == own
    expected = {"both": (0.9, 0.9), "frame alone": (1.0, 0.9), "column alone": (0.9, 1.0)}
    found = restitution.pairs([0.9, 1.0])
    assert {way: found[way, 0.9] for way in expected} == expected


PULSES = {"slendernesses": [14.0], "shapes": ["one-sine"], "levels": 501, "factors": [0.7, 1.0]}
PULSES |= {"frequency_ratios": {"lowest": 2.0, "highest": 6.0, "points": 5}}
PULSES |= {"amplitudes": {"lowest": 1.0, "highest": 10.0, "resolution": 0.05, "finer": 0.0005}}


def test_lowered_restitution_of_the_column_alone_reverses_the_order():
    table = restitution.under_pulses(PULSES).set_index(["way", "factor"])
    assert table.falls["both", 1.0] == table.falls["both", 0.7] == 0
    assert table.falls["column alone", 0.7] > 0
    assert table.harms["column alone", 0.7] > table.harms["both", 0.7]
    assert table.helps["frame alone", 0.7] > table.helps["both", 1.0]


BENEFIT = {"column": SIZES, "mass_ratio": 1.0, "factors": [0.9, 1.0], "pgv": 0.6, "motions": 1}


def test_restitution_is_lowered_of_both_or_of_one_alone():
    found = {one.labels["structure"]: one.block for one in factored(BENEFIT).subjects}
    compared = benefit.compared([0.9, 1.0])
    for (way, factor), names in compared.items():
        for name, own, other in zip(
            names, (COLUMN, FRAME), ("frame alone", "column alone"), strict=True
        ):
            lowered = 1.0 if way == other else factor
            assert found[name].restitution == pytest.approx(lowered * own.restitution)
    assert found["frame"] == FRAME.block()
    ways = [("both", 0.9), ("both", 1.0), ("column alone", 0.9), ("frame alone", 0.9)]
    assert list(compared) == ways


# Stated intensities ------------------------------------------------------------------------------


def test_supports_carry_the_same_mass():
    case = {"columns": [{"structure": "temple", "scaled": 2.0, "mass_ratio": 1.5}]}
    case |= {"pgv": [0.4], "motions": 1}
    asked, column = supported(case, {"temple": SIZES}, "pgv").subjects, th.Column(1.0, 6.0)
    same = column, th.RockingFrame(column, 1.5), th.FixedMassColumn(column, 1.5)
    assert [one.block for one in asked] == [one.block() for one in same]
    assert {one.labels["structure"] for one in asked} == {"12 m temple"}
    assert [one.labels["support"] for one in asked] == ["bare", "free", "fixed"]


def test_ample_stability_needs_the_upper_end_of_the_interval():
    asked = sweep.Asked([sweep.Subject({"support": "free"}, COLUMN.block())], np.array([0.6]), 30)
    draws = [Draw("a", 0, number, 0, None) for number in range(30)]
    swept = sweep.Swept(draws, np.ones(30), np.zeros((30, 1, 1), dtype=bool))
    table = intensities.probabilities({"pgv": (asked, swept)}, ["a"], 0.95)
    assert table.probability.item() == 0.0
    assert intensities.worst(table) > 0.1  # thirty survivors do not show 10 %


STUDY = Path(__file__).parents[1]
CONFIG = read_yaml(STUDY / "config.yaml")
ENSEMBLE = read_yaml(STUDY.parent / "reversals" / "config.yaml")["motions_ensemble"]
CLAIMS = {row["id"]: row for row in read_yaml(STUDY / "claims.yaml")}


def of_a_family(section):
    """Return how many motions of each family a section of the config takes."""
    return CONFIG[section]["motions"] * len(ENSEMBLE["scenarios"])


def lowered():
    """Return by how many per cent √r is lowered: "5 or 10 %"."""
    parts = sorted(round(100 * (1 - one)) for one in CONFIG["benefit"]["factors"] if one < 1)
    return " or ".join(map(str, parts)) + " %"


EVEN = CONFIG["break_even"]
ENDS = "certainty_deficit_ends_the_benefit"


@pytest.mark.parametrize(
    ("claim", "words"),
    [
        (ENDS, f"alone is {100 * EVEN['deficits']['highest']:g} % lower"),
        (ENDS, f"γ = {', '.join(f'{g:g}' for g in EVEN['mass_ratios'][:-1])} or"),
        (ENDS, f"or {EVEN['mass_ratios'][-1]:g} over columns of"),
        (ENDS, f"of {' or '.join(f'{6 * size:g}' for size in EVEN['sizes'])} m"),
        (ENDS, f"at {len(EVEN['pgv'] + EVEN['scaled'])} intensities"),
        (ENDS, f"{of_a_family('break_even')} synthetic"),
        ("certainty_frame_is_safer", f"a PGV of {CONFIG['benefit']['pgv']} m/s"),
        ("certainty_frame_is_safer", f"γ = {CONFIG['benefit']['mass_ratio']:g} than"),
        ("certainty_frame_is_safer", f"{of_a_family('benefit')} synthetic motions"),
        ("certainty_frame_is_safer", f"both is {lowered()} lower"),
        ("certainty_benefit_remains", f"alone is {lowered()} lower"),
        ("certainty_benefit_reverses", f"alone is {lowered().split(' or ')[-1]} lower"),
    ],
)
def test_claim_states_the_numbers_of_the_config(claim, words):
    assert words in " ".join(CLAIMS[claim]["statement"].split())


@pytest.mark.parametrize("section", ["benefit", "intensities", "rates", "break_even"])
def test_stated_probabilities_take_all_motions_of_the_ensemble(section):
    assert CONFIG[section]["motions"] == ENSEMBLE["runs"][ENSEMBLE["run"]]["motions"]


def test_benefit_is_asked_at_a_velocity_whose_probabilities_are_stated():
    assert CONFIG["benefit"]["pgv"] in CONFIG["intensities"]["pgv"]
    stated = [(one["structure"], one["scaled"]) for one in CONFIG["intensities"]["columns"]]
    assert (CONFIG["benefit"]["structure"], 1.0) in stated
