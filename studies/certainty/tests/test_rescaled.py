"""Reversals under a rescaled and a filtered record, where the answer is known."""

import math
from types import SimpleNamespace as Of

import numpy as np
import pandas as pd
import pytest

from studies.certainty.steps import rescaled
from tests.cases import COLUMN, SIZES
from topheavy import Record
from topheavy.second import reference

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
