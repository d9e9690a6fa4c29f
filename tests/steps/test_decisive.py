"""Each result that a claim of the paper depends on, in a small case in which it is false."""

import math
from types import SimpleNamespace as Of

import numpy as np
import pandas as pd
import pytest

import topheavy as th
from replication.inputs.strict_yaml import read_yaml
from steps import (
    allen_histories,
    equations,
    proven_below,
    restitution,
    rocking_spectra,
    spectra_shard,
    stability,
    trilith,
)
from steps.shared import spectra_compared, spectrum
from steps.shared.spectra_compared import Spectra
from tests.cases import COLUMN as PIER
from tests.cases import ROOT, broken
from topheavy.derivation import PrintedCheck
from topheavy.outcomes.overturning import Interval
from topheavy.proven import Below

COLUMN = th.Column(0.11, 0.40)
LINES = {
    "slendernesses": [14.0],
    "shapes": ["one-sine"],
    "mass_ratios": [0.0, 1.0],
    "frequency_ratios": {"lowest": 2.0, "highest": 4.0, "points": 3},
    "amplitudes": {"lowest": 0.95, "highest": 6.0, "resolution": 0.05},
    "finer": {"below": 1.3, "resolution": 0.01},
}


@pytest.fixture(scope="module")
def table():
    return spectra_shard.main(LINES, "1-of-1")


@pytest.mark.parametrize("is_swapped", [True, False])
def test_lowest_amplitude_that_falls_with_mass_is_found(table, given, is_swapped):
    """Each line has the frame of the other γ: what is heavier overturns first.

    In a table of the same frames it is proven; one that missed it is looked at again.
    """
    true = spectrum.line
    given(spectra_compared, line=lambda a, shape, gamma, *rest: true(a, shape, 1.0 - gamma, *rest))
    shown = table.assign(mass_ratio=1.0 - table.mass_ratio) if is_swapped else table
    found = Spectra(LINES, shown).lowest_rises()
    assert not found.holds
    assert found["exceptions"] == 6  # three frequencies, exact and linearised
    if is_swapped:
        assert found["apparent"] == 6
        assert found["largest_exception"] == pytest.approx(found["largest_apparent"], rel=1e-3)
    else:
        assert (found["apparent"], found["closest_looked_at_again"]) == (0, 6)


def test_widest_counterexample_is_the_widest_over_its_middle(table, monkeypatch):
    reversals = np.array([[1.0, 1.2], [4.0, 4.4]])
    monkeypatch.setattr(Spectra, Spectra.reversals.__name__, lambda *given: reversals)
    width, *_, middle = Spectra(LINES, table).counterexample([(0.0, 1.0)])
    assert (width, middle) == pytest.approx((0.2 / 1.1, 1.1))


def test_narrow_band_below_the_first_is_found_by_the_finer_search(given):
    bands = {0.05: (1.2, 1.4), 0.01: (1.05, 1.06)}

    def found(searches, *, resolution, most_impacts):
        low, high = bands[resolution]
        band = [Interval((low, low), (high, high), 0)]
        return [band if at[0] <= low <= at[1] else [] for at in (s.scale_range for s in searches)]

    given(spectrum, intervals_together=found)
    (intervals,) = spectrum.intervals([spectrum.Line({}, None, None)], LINES)
    assert [one.lower[0] for one in intervals] == [1.05, 1.2]


def test_point_of_which_the_second_route_says_otherwise_is_counted(table, given):
    spectra, true = Spectra(LINES, table[~table.linearised]), spectra_compared.reference.judge
    assert spectra_compared.of_sample(spectra.sample(4, 1, 3e-12))["differ"] == 0
    otherwise = Of(judge=lambda *case: Of(overturned=not true(*case).overturned))
    given(spectra_compared, reference=otherwise)
    found = spectra_compared.of_sample(spectra.sample(4, 1, 3e-12))
    assert (found.holds, found["differ"]) == (False, 4)


@pytest.mark.parametrize("changes", ["overturned", "peak"])
def test_history_that_a_billionth_of_the_record_changes_cannot_be_told(given, changes):
    def judge(frame, record, tolerance=None):
        nudged = record.acceleration.max() > 1.0
        peak = 0.5 * frame.slenderness * (1.0 + (nudged and changes == "peak"))
        return Of(overturned=nudged and changes == "overturned", peak=peak)

    given(rocking_spectra, judge=judge)
    records = [th.Record(0.1, np.array([0.0, peak, 0.0]), "sharp") for peak in (1.0, 0.5)]
    rows = [rocking_spectra.spectrum(record, [COLUMN], 1.0, 3e-12)[0] for record in records]
    assert [row["decided"] for row in rows] == [False, True]


@pytest.mark.parametrize(
    ("weaker", "stronger", "holds", "rises"),
    [
        ((False, True, True), (False, False, True), True, None),
        ((False, True, False), (False, False, True), False, True),
        ((False, False, True), (False, True, True), False, False),
    ],
)
def test_ranking_is_refuted_where_the_stronger_falls_first(given, weaker, stronger, holds, rises):
    outcomes = {PIER: weaker, th.Column(1.0, 6.0): stronger}

    class Known(stability.Scan):
        def overturned(self, trial):
            return outcomes[trial[0]]

        def overturned_linearised(self, trial, amplitude):
            return False

    given(stability, judge=lambda structure, *_, **__: Of(overturned=structure != PIER))
    scan = Known(PIER, "one-sine", (1.0, 2.0, 3.0), 3e-12)
    tables = map(pd.DataFrame, scan.ranking([[(structure, 4.0) for structure in outcomes]]))
    (found,) = stability.findings(*(table.assign(ranking="larger") for table in tables)).values()
    assert (found.holds, found.holds_when) == (holds, rises)


def test_frame_that_loses_no_more_than_its_column_is_noticed(given):
    case = {"largest_slenderness": 40.0, "points": 5}
    case |= {"mass_ratios": [0.0, 1.0], "slendernesses": [14.0]}
    names = {"smaller_than_solitary", "energy_loss"}
    assert not broken(restitution.main(case)[2]) & names
    given(restitution, RockingFrame=lambda c, g: Of(restitution=c.restitution + 1e-9 * (g > 0.0)))
    assert broken(restitution.main(case)[2]) >= names


# The trilith -------------------------------------------------------------------------------------

CONFIG = read_yaml(ROOT / "config/config.yaml")
PRINTED = {
    row["id"]: row["printed"]
    for row in read_yaml(ROOT / "paper/claims.yaml")
    if row["id"].startswith("trilith_") and "printed" in row
}
TRILITH = th.RockingFrame(COLUMN, 0.434)


def passage(**printed):
    ratio = trilith.of_numbers(trilith.numbers(TRILITH, CONFIG["trilith"]))["mass_ratio"]
    return trilith.passage(TRILITH, CONFIG["trilith"], PRINTED | printed, ratio)


@pytest.mark.parametrize(
    "change",
    [
        {"trilith_half_measures": "0.4 m, 0.12 m"},
        {"trilith_width": 0.23},
        {"trilith_height": 0.9},
        {"trilith_half_measures": "0.4 m, 0.12 m", "trilith_width": 0.24},  # not what is computed
    ],
)
def test_halves_that_are_no_halves_are_noticed(change):
    assert not passage(**change)["half_measures_agree"].holds


def test_mass_ratio_that_no_number_explains_is_no_misprint():
    found = passage()
    assert found["half_measures_agree"].holds
    assert (found["mass_ratio"].kind, found["mass_ratio"]["mended"]) == ("number", "115/265")
    assert passage(trilith_mass_ratio=0.0434)["mass_ratio"].meant_value is None


def test_thresholds_of_the_trilith_are_bracketed():
    table = pd.DataFrame(trilith.nearness(TRILITH, CONFIG["trilith"]))
    assert table.quantity.iloc[-1] == "tilt_of_the_base"
    assert (table.other_side_lifts & ~table.safe_side_lifts).all()
    assert trilith.of_nearness(table)["thresholds_bracketed"].holds
    for side, lifted in (("safe", True), ("other", False)):
        wrong = table.copy()
        wrong.loc[1, f"{side}_side_lifts"] = lifted
        assert not trilith.of_nearness(wrong)["thresholds_bracketed"].holds


# Statements --------------------------------------------------------------------------------------


def test_statement_that_no_mend_saves_is_not_meant(given):
    lost = PrintedCheck("eq1", 1, "", "a = b", False, meant="a = a", meant_follows=True)
    slip = PrintedCheck("eq2", 2, "", "a = b", False, "a = a", True, fault="letter", mended="a = a")
    proofs = [Of(id=name, holds=True) for name in (*equations.JUDGED, "other")]
    given(equations, check_printed=[lost, slip], theorems=proofs)
    *_, found = equations.main()
    assert (found["eq1"].meant_holds, found["eq1"].kind) == (False, None)
    assert (found["eq2"].meant_holds, found["eq2"].kind) == (True, "letter")


@pytest.mark.parametrize("name", [*equations.JUDGED[:2], "other"])
def test_theorem_that_fails_is_named_whether_or_not_a_row_judges_it(name):
    theorems = pd.DataFrame({"theorem": [*equations.JUDGED, "other"], "holds": True})
    theorems.loc[theorems.theorem == name, "holds"] = False
    none = pd.DataFrame(columns=["id", "follows", "meant_follows", "fault", "mended"])
    found = equations.findings(none, theorems)
    assert found["theorems_hold"].entries["fails"] == [name]
    assert broken(found) == {"theorems_hold", name} - {"other"}


@pytest.mark.parametrize("change", [{"solved_apart": 1e-6}, {"same_outcome_by_all": False}])
def test_one_history_of_the_model_is_enough_to_refute(change):
    row = {"motion": "pulse", "model": "all", "outcome": "came to rest", "peak_over_alpha": 0.7}
    row |= {"error_over_alpha": 1e-9, "same_outcome_by_all": True, "solved_apart": 1e-10}
    fallen = row | {"model": "exact", "outcome": "overturned", "solved_apart": math.nan}
    found = allen_histories.findings(pd.DataFrame([row, fallen]))["peaks_over_alpha"]
    assert found.holds
    assert found.entries["pulse"] == {"all": 0.7}  # what overturns has no peak
    table = pd.DataFrame([row | change, fallen])
    assert not allen_histories.findings(table)["peaks_over_alpha"].holds


# What is proven below the minima -----------------------------------------------------------------


def test_boxes_are_those_that_the_checker_accepts_too(given):
    asked, box = [], {"factor": ["0", "1/8"], "events": []}
    settings = CONFIG["vase"]
    known = pd.DataFrame([{"structure": "bare", "mass_ratio": 0.0, "shape": settings["shapes"][0]}])
    known = known.assign(minimum_overturning=0.25, relative_width=0.5)

    def below(structure, pulse, high, accepts):
        proven = [box] if accepts(box) else []
        return Below(high, proven, [] if proven else [(0.0, high)])

    given(proven_below, is_checked=lambda *case: asked.append(case), survives_below=below)
    (row,), certificates = proven_below.boxes(PIER, settings, known, [0.0])
    assert (row["kind"], row["high"], certificates) == ("open", 0.125, [])
    assert asked == [(box, PIER, th.Pulse("one-cosine", 1.0, 2.0 * math.pi / 1.5), (0.0, 0.125))]


BOXES = pd.DataFrame(
    [{"low": 0.2, "high": 0.3, "kind": "bounded"}, {"low": 0.0, "high": 0.2, "kind": "followed"}]
).assign(structure="bare", mass_ratio=0.0, minimum=0.3)


@pytest.mark.parametrize(
    ("change", "whole"),
    [
        ({}, True),
        ({"low": [0.21, 0.0]}, False),  # a gap
        ({"low": [0.2, 0.01]}, False),  # not from zero
        ({"minimum": 0.31}, False),  # not to the minimum
        ({"kind": ["open", "followed"]}, False),
    ],
)
def test_boxes_prove_what_they_cover_without_a_gap(change, whole):
    both = [BOXES, BOXES.assign(**{"mass_ratio": 1.0} | change)]
    table = proven_below.by_structure(pd.concat(both))
    assert table.whole.tolist() == [True, whole]
    found = proven_below.findings(table)["nothing_below"]
    assert (found.holds, found["whole"], found["structures"]) == (whole, 1 + whole, 2)
    counts = (found["boxes"], found["by_lemma"])
    assert counts == ((4, 2) if "kind" not in change else (3, 1))
