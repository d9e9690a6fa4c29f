"""Rates, shares and rescaled records of the study."""

import math
from types import SimpleNamespace as Of

import numpy as np
import pandas as pd
import pytest

from steps.shared import sweep
from studies.certainty.steps import rates, rates_check, rescaled, shares
from studies.certainty.subjects import BARE, FIXED, FREE, exchanges, rated, stated, velocities
from tests.cases import COLUMN, SIZES, broken
from topheavy import FixedMassColumn, Record, RockingFrame
from topheavy.ground.synthetic.ensemble import first_draws
from topheavy.second import reference

ENSEMBLE = {
    "run": "default",
    "runs": {"default": {"motions": 500}},
    "seed": 2014,
    "families": ["near-fault", "broadband"],
    "scenarios": [
        {"magnitude": 6.5, "distance": 10.0, "site_velocity": 760.0, "directivity": 10.0},
        {"magnitude": 7.3, "distance": 10.0, "site_velocity": 760.0, "directivity": 30.0},
    ],
}
CASE = {
    "column": SIZES,
    "mass_ratios": [1.0, math.inf],
    "lowered": [0.1],
    "motions": 6,
    "velocities": {"lowest": 0.125, "highest": 8.0, "points": 13},
    "pgv": [0.6, 1.0],
    "scaled": [0.8],
    "exponents": [2.0],
    "ends": [2.0, 8.0],
    "bootstrap": {"resamples": 100, "confidence": 0.95},
    "seed": 30,
    "sample": {"points": 8},
}
UNDER = rated(CASE).subjects
NAMES = [tuple(one.labels.values()) for one in UNDER]


@pytest.fixture(scope="module")
def swept() -> sweep.Swept:
    asked = {"rates": rated(CASE)}
    shards = [sweep.sweep(asked, ENSEMBLE, shard) for shard in ("1-of-2", "2-of-2")]
    return sweep.answers(shards, "rates", ENSEMBLE, 6)


def overturning_from(*capacities, seconds=None):
    """Outcomes with which each structure overturns from its PGV on; the second quake's `seconds`.

    Structures are in the order of `rated`: two columns, then two with each kind of cap beam.
    """
    of_quakes = [np.array(those) for those in (capacities, seconds or capacities)]
    draws = first_draws(ENSEMBLE, 6)
    outcomes = [velocities(CASE) >= of_quakes[draw.place][:, None] for draw in draws]
    return sweep.Swept(draws, np.full(len(draws), 0.5), np.array(outcomes))


def found_in(swept):
    return list(rates.ensembles(swept, CASE, ENSEMBLE))


# Structures and outcomes --------------------------------------------------------------------------


def test_structures_have_the_same_columns_and_cap_beams():
    own = COLUMN.block()
    assert [one.block for one in UNDER[:2]] == [own, own.with_restitution(0.9 * own.restitution)]
    carry = [
        make(COLUMN, g) for make in (RockingFrame, FixedMassColumn) for g in CASE["mass_ratios"]
    ]
    assert [one.block for one in UNDER[2:]] == [one.block() for one in carry]
    assert [name for name, *_ in NAMES] == [BARE] * 2 + [FREE] * 2 + [FIXED] * 2
    (_, level, pgv) = stated(COLUMN, CASE)[-1]
    assert COLUMN.frequency_parameter * pgv / (9.81 / 6.0) == pytest.approx(level)


def test_sample_is_judged_again_on_all_structures_in_turn(swept):
    checks, found = rates_check.main(CASE, ENSEMBLE, swept, 3e-12)
    counts = checks.groupby(["family", "structure", "mass_ratio", "lowered"]).size()
    assert counts.tolist() == [2] * 4
    for route in ("tightened_agrees", "second_route_agrees"):
        assert found[route].holds
        assert found[route]["near_a_boundary"] >= 3
        assert (found[route]["cells"], found[route]["structures"]) == (checks.decided.sum(), 2)
        assert checks.decided.sum() > 4
        for wrong in ({"overturns": ~checks.overturns}, {"decided": False}):
            assert not rates_check.findings(checks.assign(**wrong))[route].holds


# Rates --------------------------------------------------------------------------------------------


def test_rate_is_the_hazard_from_the_boundary_on():
    """Boundaries are midway between levels, which double every other step: 0.5, 0.707, 1, 1.41."""
    table = overturning_from(1.0, 0.7, 1.4, 9.0, 0.7, 0.5)
    for labels, _, outcomes in found_in(table):
        found = pd.DataFrame(rates.rates(labels, outcomes, CASE))
        assert np.allclose(found.rate_low, found.rate_high, rtol=1e-12)  # all have one boundary
        for row in found.itertuples():
            place = NAMES.index((row.structure, row.mass_ratio, row.lowered))
            capacity = (1.0, 0.7071, 1.4142, math.inf, 0.7071, 0.5)[place]
            edge = capacity / 2.0**0.25
            exact = edge**-2.0 - row.highest**-2.0 if edge < row.highest else 0.0
            assert row.rate == pytest.approx(exact, rel=1e-3)
            assert row.overturning == (row.motions if edge < row.highest else 0)
            own = (2.0**-0.25 if row.column == 0.0 else 0.7071 / 2.0**0.25) ** -2.0
            assert row.change == pytest.approx(row.over - row.over_coarser, abs=1e-12)
            assert row.over == pytest.approx(exact / (own - row.highest**-2.0), rel=1e-3)


def test_motions_are_resampled_within_their_earthquake():
    one = overturning_from(*[0.5] * 6, seconds=[2.0] * 6)
    both, *apart = found_in(one)[:3]
    names = [labels["earthquake"] for labels, *_ in (both, *apart)]
    assert names == ["both", "M 6.5", "M 7.3"]
    at = [np.flatnonzero(np.isclose(velocities(CASE), v))[0] for v in (1.0, 4.0)]
    for (_, _, found), first in zip((both, *apart), (0.5, 1.0, 0.0), strict=True):
        shares = (first, 1.0)
        assert found.means()[:, 0, at] == pytest.approx(np.tile(shares, (101, 1)))
    assert len(both[-1].outcomes) == 2 * len(apart[0][-1].outcomes) == 12


def test_difference_of_probabilities_is_that_of_the_column(swept):
    for labels, _, outcomes in found_in(swept):
        table = rates.probabilities(labels, outcomes, CASE)
        own = table[(table.structure == BARE)].set_index(["lowered", "measure", "level"])
        for row in table[table.structure == FREE].itertuples():
            column = own.loc[(row.column, row.measure, row.level)]
            assert row.less == pytest.approx(column.probability - row.probability)
            assert row.less_low <= row.less <= row.less_high
            assert row.probability == row.overturned / row.motions
            assert row.probability_low <= row.probability <= row.probability_high


def test_factors_bring_motions_to_the_stated_velocity():
    rows = rates.scales({}, np.full(24, 0.5), CASE)  # every motion has a PGV of 0.5 m/s
    found = [row[name] for row in rows for name in ("pgv", "median", "p95")]
    assert found == pytest.approx([0.6, 1.2, 1.2, 1.0, 2.0, 2.0])
    peaks = np.linspace(0.3, 0.6, 41)
    row, factors = rates.scales({}, peaks, CASE)[0], np.sort(0.6 / peaks)
    # of 41: 95 % of the way to the last
    assert (row["p95"], row["median"]) == pytest.approx((factors[38], factors[20]))


# What decides -------------------------------------------------------------------------------------


def tables(**change):
    """Rates over the column's as they are expected, but for the `change` of a structure."""
    rows = [
        {"structure": name, "column": column, "exponent": 2.0, "overturning": 5}
        | {f"{which}_low": low for which in ("over", "rate")}
        | {"over": middle, "rate": middle, "over_high": high, "rate_high": high}
        | {"over_coarser": 1.001 * middle, "over_coarsest": 1.002 * middle}
        | {"change_low": -0.1, "change_high": 0.1}
        | change.get(f"{name}_{column:g}", {})
        for name, (low, middle, high) in {FREE: (0.4, 0.5, 0.6), FIXED: (1.5, 1.8, 2.0)}.items()
        for column in (0.0, 0.1)
    ]
    stated_one = {"structure": FREE, "column": 0.0, "less_low": 0.1, "interval": "is positive"}
    return pd.DataFrame([stated_one | change.get("stated", {})]), pd.DataFrame(rows)


@pytest.mark.parametrize(
    ("change", "false"),
    [
        ({}, set()),
        ({"free_0": {"over_high": 1.01}}, {"cap_lowers_the_rate"}),
        ({"fixed_0": {"over_low": 0.99}}, {"fixed_mass_raises_the_rate"}),
        ({"free_0.1": {"over_high": 1.01}}, {"lower_column_keeps_the_order"}),
        ({"stated": {"interval": "is negative"}}, {"cap_never_raises_the_probability"}),
        ({"stated": {"interval": "includes zero"}}, set()),
        ({"stated": {"structure": FIXED}}, {"cap_never_raises_the_probability"}),
        ({"fixed_0": {"over_coarser": 2.31}}, {"sum_is_fine_enough"}),
        ({"fixed_0": {"over_coarser": 1.29}}, {"sum_is_fine_enough"}),
    ],
)
def test_one_row_is_enough_to_refute(change, false):
    assert broken(rates.findings(*tables(**change))) == false


GAMMAS = [0.0, 1.0, 4.0]
TIME = 0.01 * np.arange(3000)
RECORD = Record(0.01, 0.4 * np.exp(-(((TIME - 8.0) / 2.0) ** 2)) * np.sin(5.0 * TIME), "a")
SPEC = {"widths": [0.01, 0.3], "points": 41, "checked": 4}
FILTERS = {"orders": [2, 4], "corners": [0.1]}


@pytest.mark.parametrize(
    ("falls", "reversed_"),
    [
        *((falls, False) for falls in ([0, 0, 0], [1, 1, 1], [1, 0, 0])),
        *((falls, True) for falls in ([0, 1, 0], [1, 0, 1], [0, 0, 1])),
    ],
)
def test_order_is_reversed_if_a_heavier_one_overturns_and_a_lighter_one_survives(falls, reversed_):
    assert rescaled.is_reversed(np.array([falls], bool).T).tolist() == [reversed_]


@pytest.mark.parametrize("order", [2, 4])
def test_filter_passes_what_is_fast_in_phase_and_stops_what_is_slow(order):
    fast, slow = np.sin(2.0 * math.pi * TIME), np.sin(2.0 * math.pi * 0.01 * TIME + 0.3)
    found = rescaled.filtered(Record(0.01, fast + slow, "b"), order, 0.1)
    pad = round(1.5 * order / 0.1 / 0.01)
    inside = found.acceleration[pad:-pad]
    assert inside.size == TIME.size
    middle = slice(1000, 2000)
    np.testing.assert_allclose(inside[middle], fast[middle], atol=0.05)
    assert (found.name, found.time_step) == ("b", 0.01)
    assert rescaled.filtered(RECORD, 0, 0.0) is RECORD
    # the ground comes to rest within the pads, also after a step of its velocity
    push = Record(0.01, np.where((TIME > 5.0) & (TIME < 5.5), 0.2, 0.0))
    found = rescaled.filtered(push, order, 0.1).acceleration
    velocity = np.cumsum(found) * 0.01
    assert abs(velocity[-1]) < 0.02 * np.abs(velocity).max()


def test_only_records_that_overturn_anything_are_rescaled(given):
    columns = [{"structure": "temple", "scaled": scale} for scale in (1.0, 2.0)]
    known = pd.DataFrame(
        {"record": "a", "structure": ["6 m temple", "12 m temple"], "overturned": [True, False]}
    )
    given(rescaled, second_route=None)
    settings, spec = {"columns": columns, "mass_ratios": GAMMAS}, SPEC | {"filter": FILTERS}
    table, _ = rescaled.main(settings, spec, {"temple": SIZES}, [RECORD], known)
    assert set(table.structure) == {"6 m temple"}
    counts = table.groupby(["order", "corner"]).size().to_dict()
    assert counts == {(0, 0.0): 2, (2, 0.1): 1, (4, 0.1): 1}


def test_scipy_has_to_give_the_same_outcomes(given):
    assert rescaled.second_route([(RECORD, COLUMN)], GAMMAS, SPEC).holds
    right = reference.judge
    given(rescaled, reference=Of(judge=lambda *of: Of(overturned=not right(*of).overturned)))
    assert not rescaled.second_route([(RECORD, COLUMN)], GAMMAS, SPEC).holds


def table(*cells, moved=0.0):
    """Of each order, what overturns and whether that is reversed; order 0 is the record."""
    return pd.DataFrame(
        {"record": "a", "structure": "c", "order": order, "corner": 0.1 * (order > 0)}
        | {"overturned": fell or None, "reversed": reversed_, "width": 0.01}
        | {"share": 0.5, "coarser": 0.5 + moved}
        for order, (fell, reversed_) in zip((0, 2, 4), cells, strict=True)
    )


@pytest.mark.parametrize(
    ("second", "fourth", "said"),
    [
        (("1", True), ("0.5", True), "is reversed"),
        (("", False), ("", False), "overturns nothing"),
        (("0", False), ("", False), "is not reversed"),
        (("1", True), ("0", False), "depends on the order of the filter"),
        (("1", True), ("", False), "depends on the order of the filter"),
    ],
)
def test_words_say_what_all_orders_share(second, fourth, said):
    found = rescaled.findings(table(("1", True), second, fourth))["shares_hold_at_half_the_step"]
    assert [one["said"] for one in found["filtered"]] == [said]
    assert found["shares"] == {"a, c": {"0.01": 0.5}}


@pytest.mark.parametrize(("moved", "holds"), [(0.019, True), (-0.021, False)])
def test_shares_may_not_depend_on_the_number_of_scales(moved, holds):
    found = rescaled.findings(table(*[("1", True)] * 3, moved=moved))
    assert found["shares_hold_at_half_the_step"].holds is holds


RESAMPLED = {"seed": 1, "resamples": 200, "confidence": 0.95}


def values(alpha, root_r):
    labels = {"family": "near-fault", "mass_ratio": 1.0, "pgv": 0.6}
    pairs = zip(alpha, root_r, strict=True)
    return pd.DataFrame([labels | {"α": a, "p": 0.0, "√r": r} for a, r in pairs])


@pytest.mark.parametrize(
    ("alpha", "root_r", "holds"),
    [
        ([1.0] * 60 + [0.0] * 20, [0.0] * 60 + [1.0] * 20, True),
        ([1.0] * 42 + [0.0] * 38, [0.0] * 42 + [1.0] * 38, False),  # its interval includes one half
        ([1.0] * 20 + [0.0] * 60, [0.0] * 20 + [1.0] * 60, False),
    ],
)
def test_slenderness_has_most_if_its_interval_is_above_one_half(alpha, root_r, holds):
    table = shares.shares(values(alpha, root_r), RESAMPLED)
    assert shares.findings(table)["slenderness_has_most"].holds is holds


def test_worth_of_a_block_is_that_it_survives():
    """All that have α of the fixed mass overturn, and no others: α has all."""
    case = RESAMPLED | {"column": {"half_width": 0.5, "half_height": 3.0}, "motions": 1}
    case |= {"mass_ratios": [1.0, 4.0], "pgv": [0.4, 0.6]}
    fixed = ["α" not in one.labels["free"] for one in exchanges(case).subjects]
    draws = first_draws(ENSEMBLE, 1)
    outcomes = np.broadcast_to(np.array(fixed)[:, None], (len(draws), len(fixed), 2))
    found = shares.values_of(case, sweep.Swept(draws, np.ones(len(draws)), outcomes))
    assert len(found) == len(draws) * 2 * 2
    assert found.α.to_numpy() == pytest.approx(1.0)
    assert not found[["p", "√r"]].any(axis=None)
