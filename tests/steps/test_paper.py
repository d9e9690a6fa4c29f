"""The first rules of the paper in a small case: which findings a changed table breaks."""

import math
from ast import literal_eval
from functools import cache

import numpy as np
import pandas as pd
import pytest

from documents.check import REFERENCE
from replication.step import call
from steps import allen, equations, parameters, statements, trilith, verification
from steps.shared import steered
from tests.cases import COLUMN, CONFIG, RECORDS, ROOT, as_written, broken
from topheavy import Column, RockingFrame, judge

STEPS = {
    step.__name__.removeprefix("steps."): step
    for step in (allen, equations, parameters, statements, trilith)
}
SMALL = {
    "parameters": {"points": 11, "slendernesses": 13, "rotations": 5},
    "trilith": {"frequencies": {"lowest": 1.0, "highest": 10.0, "points": 2}},
    "allen": {"errors": CONFIG["allen"]["errors"] | {"mass_ratios": [2.0]}},
    "statements": {"mass_ratios": [1.0, 10.0], "pulses": CONFIG["statements"]["pulses"][:1]},
    "equations": {},
}
SMALL["allen"]["maps"] = CONFIG["allen"]["maps"] | {
    "frequency_ratios": {"lowest": 2.0, "highest": 6.0, "points": 3}
}


def params_of(rule):
    """Return the parameters of a rule, its grids small."""
    return {
        "settings": CONFIG.get(rule, {}) | SMALL[rule],
        "structures": CONFIG["structures"],
        "solver": CONFIG["solver"],
        "record": str(RECORDS / "el_centro_1940_NS.AT2"),
    }


@pytest.fixture(scope="module")
def tables():
    """The tables of each rule, made once, but for the proofs of equations, as published."""

    @cache
    def made(rule):
        if rule == "equations":
            return {
                n: pd.read_csv(ROOT / REFERENCE / f"{n}.csv") for n in ("equations", "theorems")
            }
        return call(STEPS[rule].compute, rule, {}, params_of(rule))

    return lambda rule: as_written(made(rule))


def findings(rule, tables, **changes):
    return call(STEPS[rule].findings, rule, {}, params_of(rule) | tables | changes)


KNOWN = {
    "statements": {"identical_response"},
    "equations": {
        "eq9",
        "eq19",
        "eq20",
        "eq21",
        "eq22",
        "text_p_hat",
        "text_p_hat_trilith",
        "maximum_restitution",
    },
}


@pytest.mark.parametrize("rule", STEPS)
def test_findings_hold_but_for_the_known_ones(tables, rule):
    computed = findings(rule, tables(rule))
    assert broken(computed) == KNOWN.get(rule, set())
    meant = {
        name
        for name, finding in computed.items()
        if finding.get("meant_holds") or finding.get("holds_when")
    }
    assert meant == KNOWN.get(rule, set())


CHANGES = """
equations: equations: id == 'eq4_negative': follows: False: eq4
equations: equations: id == 'text_step_14': follows: False: text_step
equations: theorems: theorem == 'lagrange_agrees': holds: False: lagrange_agrees
parameters: mass_ratio: mass_ratio == 5: size_ratio: 1.6: heavier_is_larger
parameters: mass_ratio: mass_ratio == 5: frequency_ratio: 0.8: heavier_is_larger
parameters: restitution: slenderness_deg == 5 and mass_ratio == 2: restitution: 0.9999: \
smaller_than_solitary, energy_loss
parameters: restitution: slenderness_deg == 5 and mass_ratio == 0: restitution: 0.9: \
solitary_column_recovered
parameters: moment_rotation: rotation_over_alpha == 0.5 and mass_ratio == 4: moment: 0.7: \
frame_follows_the_columns_curve
parameters: four_structures: structure == 'frame 4': minimum_overturning: 0.3: \
order_of_the_four_structures
trilith: trilith_numbers: quantity == 'base_acceleration_in_g': value: 0.28: stays_below_uplift
trilith: trilith_starts: outcome == 'no uplift': outcome: 'rests': no_pure_rocking
statements: three_bodies: mass_ratio == 10: equivalent_apart: 1e-4: \
one_degree_of_freedom, identical_response
statements: three_bodies: mass_ratio == 10: rotation_apart: 1e-4: one_degree_of_freedom
statements: three_bodies: mass_ratio == 10: same_outcome: False: one_degree_of_freedom
statements: three_bodies: mass_ratio == 10: cap_balance_apart: 1e-3: \
one_degree_of_freedom, forces_on_the_cap_balance
statements: statements: quantity == 'uplifts below': value: 1.0: rigid_until_uplift
statements: statements: quantity == 'largest before': value: 0.1: rocks_left_then_right
statements: statements: quantity == 'meant eq22': value: 0.0: compact_form
statements: statements: quantity == 'gap over R': value: 1e-3: cap_stays_on_its_seats
statements: statements: quantity == 'height at γ = 10': value: 3.0: centre_of_gravity_rises
"""  # rule, table, which row, column, what it becomes, which findings it breaks


@pytest.mark.parametrize("change", CHANGES.strip().splitlines())
def test_changed_number_breaks_its_findings(tables, change):
    rule, table, row, column, number, breaks = change.split(": ")
    changed = tables(rule)
    (chosen,) = changed[table].query(row).index
    changed[table].loc[chosen, column] = literal_eval(number)
    assert broken(findings(rule, changed)) == KNOWN.get(rule, set()) | set(breaks.split(", "))


def test_response_is_identical_only_with_the_restitution_of_the_frame(tables):
    changed = tables("statements")
    assert findings("statements", changed)["identical_response"]["holds_when"]
    changed["three_bodies"].loc[0, "equivalent_apart"] = 1e-4
    assert not findings("statements", changed)["identical_response"]["holds_when"]


def test_discrepancy_of_no_kind_is_not_meant(tables):
    changed = tables("equations")
    lost = changed["equations"].id == "eq19"
    changed["equations"].loc[lost, "kind"] = math.nan
    assert not findings("equations", changed)["eq19"]["meant_holds"]


def test_overshoot_to_uplift_is_a_number(tables):
    computed = findings("trilith", tables("trilith"))
    assert computed["overshoot_to_uplift"]["value"] == pytest.approx(0.275 / 0.219 - 1.0, rel=0.01)


@pytest.mark.parametrize(
    "change", [{"half_measures": [0.4, 0.12]}, {"width": 0.23}, {"height": 0.9}]
)
def test_halves_that_are_no_halves_are_noticed(tables, change):
    settings = CONFIG["trilith"] | {"printed": CONFIG["trilith"]["printed"] | change}
    computed = findings("trilith", tables("trilith"), settings=settings)
    assert not computed["half_measures_agree"]["holds"]


def test_mass_ratio_that_the_printed_p_hat_implies_gives_it_back(tables):
    implied = findings("trilith", tables("trilith"))["mass_ratio_by_p_hat"]
    column = Column(**CONFIG["structures"]["trilith"])
    ends = [RockingFrame(column, implied[end]).frequency_parameter for end in ("least", "most")]
    assert ends == pytest.approx([3.795, 3.785])
    assert implied["least"] < 0.434 < implied["most"] < 1.0


def test_small_column_is_the_large_one_in_slower_time():
    small = RockingFrame(Column(COLUMN.half_width / 2, COLUMN.half_height / 2), 1.0)
    slower = parameters.minimum(RockingFrame(COLUMN, 1.0), "one-cosine", 1.5 * math.sqrt(2.0))
    assert parameters.minimum(small, "one-cosine", 1.5) == pytest.approx(slower, rel=1e-8)


def test_wrong_outcomes_are_shares_of_all_pulses(tables):
    maps = {"exact": [1, 1, 1, 0, 0], "linearised": [1, 1, 1, 0, 0], "all": [0, 0, 1, 1, 0]}
    computed = allen.findings(tables("allen")["allen_errors"], pd.DataFrame(maps))
    wrong = {
        name: finding["value"] for name, finding in computed.items() if name.startswith("falsely")
    }
    assert list(wrong.values()) == [0.0, 0.0, 0.4, 0.2]  # safe, overturned; linearised, all


def test_errors_are_of_pulses_that_overturn_neither_and_have_a_range_over_pulses(tables):
    computed = tables("allen")
    heavy = computed["allen_errors"].query("model == 'all' and mass_ratio == 2")
    assert len(heavy) == len(CONFIG["allen"]["errors"]["pulses"])
    assert (heavy.compared + heavy.wrong <= heavy.pulses).all()
    assert (heavy.too_small <= heavy.compared).all()
    error = findings("allen", computed)["error_all_2"]
    names = ("median_error", "pulses", "compared", "wrong")
    assert [error[n] for n in ("value", *names[1:])] == heavy.iloc[0][[*names]].tolist()
    assert (error["least"], error["most"]) == (heavy.median_error.min(), heavy.median_error.max())
    assert error["least"] < error["value"] < error["most"]


@pytest.mark.parametrize(
    ("row", "change", "words"),
    [
        ("routes", "outcomes_that_differ", "outcomes differ"),
        ("published", "computed", "literature, one differ"),
        ("closed", "computed", "closed form"),
        ("order", "order_lost", "Theorem 2 fails in 1 cases"),
    ],
)
def test_solver_that_differs_stops_verification(row, change, words):
    routes = pd.DataFrame([{"outcomes_that_differ": 0, "error_99": 1e-9, "cells": 9}])
    number = {"quantity": "one", "printed": 0.99, "to": 1.01, "expected": 1.0, "computed": 1.0}
    closed = pd.DataFrame([{"closed_form": 1.0, "computed": 1.0}])
    lost = {"factor": [1.0, 1.5], "order_lost": [0, 3], "lighter_first": 0, "histories": 9}
    inputs = {
        "routes": routes,
        "published": pd.DataFrame([number | {"tolerance": 1e-3}]),
        "closed": closed,
        "order": pd.DataFrame(lost),
    }
    assert verification.findings(*inputs.values())["farthest_from_print"]["value"] == 0.0
    inputs[row].loc[0, change] += 1
    with pytest.raises(SystemExit, match=words):
        verification.findings(*inputs.values())


def test_steered_motions_keep_the_order_within_the_bound_only():
    kept, lost = (
        steered.attack(math.radians(20.0), [(0.0, math.inf)], factor, 300, 1)
        for factor in (1.0, 1.5)
    )
    assert kept["order_lost"] == kept["lighter_first"] == 0 < lost["order_lost"]
    assert kept["samples_beyond_alpha"] > 0


def test_sample_of_verification_is_half_at_boundaries():
    settings = CONFIG["verification"] | {"sample": 8}
    sample = list(verification.cells(settings, "one-sine", True))
    near = [judge(block, pulse.scaled(0.98)).overturned for block, pulse in sample[1::2]]
    beyond = [judge(block, pulse.scaled(1.02)).overturned for block, pulse in sample[1::2]]
    assert len(sample) == 8
    assert sum(weaker != stronger for weaker, stronger in zip(near, beyond, strict=True)) >= 2
    assert all(block.linearised for block, _ in sample)


def test_table_motion_is_the_second_derivative_of_its_displacement():
    motion, omega, step = trilith.table_motion(0.005, 3.3), 2 * math.pi * 3.3, 1e-4
    times = np.linspace(0.01, 1.0, 57)
    before, now, after = (0.005 * np.sin(omega * (times + k * step)) for k in (-1, 0, 1))
    expected = (before - 2 * now + after) / step**2 / 9.81
    np.testing.assert_allclose(motion.excitation(times), expected, atol=1e-6)
    assert motion.duration == math.inf
