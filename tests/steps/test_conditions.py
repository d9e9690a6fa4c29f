"""Steps on conditions and on overturning by Allen et al."""

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest

from replication.inputs.strict_yaml import read_yaml
from replication.workbench import truth, value
from steps import (
    allen_overturning,
    heavier,
    moment_rotation,
    scale_effects,
    spectra,
    stability,
    statements,
    trilith,
    verification,
)
from steps.shared.spectra_compared import Place
from topheavy import Column, Pulse, RockingFrame, simulate

ROOT = Path(__file__).resolve().parents[2]
CONFIG = read_yaml(ROOT / "config/config.yaml")
TEMPLE = {"half_width": 0.5, "half_height": 3.0}
SOLVER = {"tightened": 1e-12}


def case_of(rule, **changes):
    return CONFIG[rule] | {"column": CONFIG["structures"][CONFIG[rule]["structure"]]} | changes


# Rankings ----------------------------------------------------------------------------------------


def test_counterexample_that_the_tightened_tolerance_does_not_bear_stops_the_run(monkeypatch):
    weak, strong = (Column(0.5, 3.0), 4.0), (Column(1.0, 6.0), 4.0)

    class Known(stability.Scan):
        def overturned(self, trial):
            return (False, trial == strong, True)

    survives = SimpleNamespace(overturned=False)
    monkeypatch.setattr(stability, "judge", lambda *arguments, **options: survives)
    scan = Known(weak[0], "one-sine", (1.0, 2.0, 3.0), 1e-12)
    with pytest.raises(ArithmeticError, match="not a counterexample"):
        scan.ranking([[weak, strong]])


def test_counterexample_of_the_spectra_is_borne_by_both_solvers(monkeypatch):
    class Known:
        def __init__(self, case, table):
            pass

        def lowest_rises(self):
            return truth(True)

        def areas(self, light, heavy):
            return []

        def counterexample(self, pairs):
            return 0.1, Place(14.0, "one-sine", False, 3.0), 0.0, 1.0, 2.0

        def judged(self, place, gamma, amplitude, tightened):
            return [gamma == 1.0, False]  # SciPy: neither overturns

    monkeypatch.setattr(spectra, "Spectra", Known)
    with pytest.raises(ArithmeticError, match="not a counterexample"):
        spectra.main({"pairs": [], "mass_ratios": [0.0, 1.0]}, SOLVER, None)


@pytest.mark.parametrize(
    ("brackets", "agrees", "holds"),
    [
        ([(1.0, 1.1), (1.2, 1.3)], True, True),
        ([(1.0, 1.25), (1.2, 1.3)], True, False),  # overlapping brackets
        ([(1.2, 1.3), (1.0, 1.1)], True, False),
        ([(1.0, 1.1), (1.2, 1.3)], False, False),  # SciPy says otherwise
    ],
)
def test_heavier_survives_more_by_apart_brackets_and_all_solvers(
    monkeypatch, brackets, agrees, holds
):
    left = iter(brackets)
    monkeypatch.setattr(
        heavier, "lowest_overturning", lambda *_, floor: SimpleNamespace(bracket=next(left))
    )
    if not agrees:
        otherwise = SimpleNamespace(overturned=False, peak=0.0)
        monkeypatch.setattr(
            heavier, "reference", SimpleNamespace(judge=lambda frame, pulse: otherwise)
        )
    _, _, found = heavier.main(case_of("heavier", mass_ratios=[0.0, 4.0]), SOLVER)
    assert found["heavier_survives_more"].holds is holds


@pytest.mark.parametrize(("larger", "holds"), [(2.0, True), (1.001, False)])
def test_larger_column_survives_the_pulse_that_overturns_the_smaller(larger, holds):
    *_, found = scale_effects.main(case_of("scale_effects", larger=larger), SOLVER)
    assert found["larger_column_survives"].holds is holds


@pytest.mark.parametrize("module", ["judge", "reference"])
def test_one_route_that_denies_an_outcome_ends_the_comparison(monkeypatch, module):
    def denied(column, pulse, **options):
        return SimpleNamespace(overturned=not simulate(column, pulse, samples=2).overturned)

    other = denied if module == "judge" else SimpleNamespace(judge=denied)
    monkeypatch.setattr(scale_effects, module, other)
    with pytest.raises(ArithmeticError, match="the routes disagree"):
        scale_effects.main(case_of("scale_effects"), SOLVER)


# Statements --------------------------------------------------------------------------------------


GIVEN = RockingFrame(Column(**TEMPLE), 1.0), [0.0, 1.0]


def judged(measured):
    return statements.findings(statements.table_of(measured))


def test_compact_form_needs_both_equations(monkeypatch):
    assert judged(statements.structure(*GIVEN))["compact_form"].holds
    wrong = tuple(
        replace(one, meant=one.printed) if one.name == "eq22" else one
        for one in statements.EQUATIONS
    )
    monkeypatch.setattr(statements, "EQUATIONS", wrong)
    assert not judged(statements.structure(*GIVEN))["compact_form"].holds


def test_column_of_another_size_does_not_move_like_the_frame(monkeypatch):
    case = CONFIG["statements"]
    frame = RockingFrame(Column(**TEMPLE), case["mass_ratio"])
    pulse = Pulse("one-sine", case["pulse"]["amplitude"], 2 * np.pi / case["pulse"]["period"])
    monkeypatch.setattr(statements, "similar", lambda column, scale: column)
    found = judged(statements.from_below(frame, case["cap"], pulse))["identical_response"]
    assert (found.holds, found.holds_when) == (False, False)


# Trilith and moment ------------------------------------------------------------------------------


@pytest.mark.parametrize(("amplitude", "holds"), [(0.0062, True), (0.0064, False)])
def test_shake_table_is_below_uplift_up_to_uplift(amplitude, holds):
    frame = RockingFrame(Column(0.11, 0.40), 0.434)
    case = CONFIG["trilith"] | {"table_amplitude": amplitude}
    found = trilith.of_numbers(trilith.numbers(frame, case))
    assert found["stays_below_uplift"].holds is holds


@pytest.mark.parametrize("rests", [True, False])
def test_no_pure_rocking_needs_rest_from_rest(rests):
    started = {
        "rest_from_rest": truth(rests),
        "abrupt_start_keeps_it_rocking": truth(True),
        "least_share_that_keeps_rocking": value(0.3, 0.01),
    }
    found = trilith.no_pure_rocking(started)
    assert found.holds is False
    assert found.holds_when is rests


def test_moment_that_is_off_by_a_billionth_and_lost_energy_are_noticed(monkeypatch):
    case = case_of("moment_rotation", points=11, start_fractions=[0.3, 0.6])
    names = ("moment_at_uplift", "frame_follows_the_columns_curve", "no_area_enclosed")
    _, _, found = moment_rotation.main(case)
    assert [found[name].holds for name in names] == [True] * 3
    moment = moment_rotation.restoring_moment
    off = lambda frame, rotation: moment(frame, rotation) * (1.0 + 1e-9)  # noqa: E731
    monkeypatch.setattr(moment_rotation, "restoring_moment", off)
    monkeypatch.setattr(moment_rotation, "energy_drift", lambda *arguments, **options: 1e-6)
    _, _, found = moment_rotation.main(case)
    assert [found[name].holds for name in names] == [False] * 3


@pytest.mark.parametrize(
    ("computed", "expected", "numbers", "holds"),
    [
        (1.0, 1.0, 10, True),
        (1.004, 1.004, 10, True),
        (1.002, 1.0, 10, False),  # off ours
        (1.006, 1.006, 10, False),  # off the print
        (1.0, 1.0, 9, False),  # too few
        (1.0, 1.0, 0, False),
    ],
)
def test_number_of_the_literature_is_held_against_ours_and_the_print(
    monkeypatch, computed, expected, numbers, holds
):
    routes = {"verdicts_that_differ": [0], "error_99": [0.0], "cells": [9]}
    row = {"printed": 1.0, "expected": expected, "tolerance": 1e-3, "computed": computed}
    literature = {name: [number] * numbers for name, number in row.items()}
    given = {"agreement": routes, "convergence": {}, "published": literature}
    for name, table in given.items():
        found = pd.DataFrame(table)
        monkeypatch.setattr(verification, name, lambda *given, found=found: found)
    monkeypatch.setattr(verification, "drift", lambda case: 0.0)
    monkeypatch.setattr(verification, "distance_from_derivation", lambda: 0.0)
    _, found = verification.main({}, 1e-12)
    assert found["published_numbers"].holds == holds


def test_neighbours_of_one_verdict_are_a_run():
    cells = [(1.0, "a"), (2.0, "a"), (3.0, "b"), (4.0, "a")]
    found = pd.DataFrame(allen_overturning.runs(cells))
    assert found.lowest.tolist() == [1.0, 3.0, 4.0]
    assert found.highest.tolist() == [2.0, 3.0, 4.0]
    assert found.cells.tolist() == [2, 1, 1]
    assert found.verdict.tolist() == ["a", "b", "a"]


def test_share_is_that_of_the_cells():
    rows = [
        ("all", 3, "falsely safe"),
        ("all", 1, "both survive"),
        ("linearised", 2, "falsely safe"),
    ]
    table = pd.DataFrame(rows, columns=["model", "cells", "verdict"])
    found = allen_overturning.findings(table)
    assert found["all"]["falsely_safe"] == pytest.approx(0.75)
    assert found["linearised"]["falsely_safe"] == pytest.approx(1.0)
