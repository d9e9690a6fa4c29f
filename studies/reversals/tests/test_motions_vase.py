"""Vase, frame and forces over the ensemble, on cases that are known."""

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest

from replication.workbench import truth
from steps.shared.peak_forces import ratio_of
from studies.reversals.steps import motions_uplift, motions_uplift_shard, motions_vase
from topheavy import Column, FixedMassColumn, Record, simulate
from topheavy.synthetic.ensemble import Draw
from topheavy.synthetic.motions import Scenario, peak_velocity

COLUMN = Column(0.5, 3.0)
LEVELS = np.geomspace(0.25, 4.0, 9)
BOOT = {"resamples": 200, "confidence": 0.95, "seed": 14}
DRAW = Draw("near-fault", 0, 0, 2014, Scenario(6.5, 10.0, 760.0, 10.0))


def outcomes(*capacities):
    """Outcomes of two motions: structures overturn from these levels on, a tenth later in one."""
    found = [[level * late <= LEVELS for level in capacities] for late in (1.0, 1.1)]
    return np.array(found * 20)


UNDER = [("bare", 0.0, None), ("fixed", 1.0, None), ("free", 1.0, None)]


def test_first_level_that_overturns_is_found_and_none_is_infinite():
    fell = np.array([LEVELS >= 1.0, (LEVELS > 0.6) & (LEVELS < 0.8), np.zeros(9, bool)])
    assert motions_vase.first(fell, LEVELS).tolist() == pytest.approx([1.0, 2**-0.5, math.inf])


def test_capacity_ratio_is_that_of_curves_that_are_shifted():
    one = LEVELS >= 0.99
    other = LEVELS >= 0.49  # two levels earlier: half
    found = motions_vase.capacity_ratio(LEVELS, one.astype(float), other.astype(float))
    assert found == pytest.approx(0.5)


def test_ranks_count_motions_that_change_the_order():
    case = {"bootstrap": BOOT}
    fell = outcomes(0.99, 0.49, 1.9)
    fell[0, 1] = LEVELS >= 3.9  # one of forty: the fixed mass overturns last
    table, ranks = motions_vase.curves("near-fault", UNDER, fell, LEVELS, case)
    fixed, free = ranks
    assert fixed["later"] == pytest.approx(1 / 40)
    assert fixed["sooner"] == pytest.approx(39 / 40)
    assert (free["sooner"], free["later"]) == pytest.approx((0.0, 1.0))
    assert fixed["over_bare_high"] < 1.0 < free["over_bare_low"]
    assert set(table.structure) == {"bare", "fixed", "free"}


def test_factors_bring_a_motion_to_its_intensity():
    record = Record(0.01, np.sin(np.arange(400) / 20.0), "any")
    (factor,) = motions_vase.factors(COLUMN, record, np.array([0.7]))
    speed = peak_velocity(record.scaled(factor))
    assert COLUMN.frequency_parameter * speed / (9.81 / 6) == pytest.approx(0.7)


def test_told_refuses_what_a_nudge_changes(monkeypatch):
    record = DRAW.record()
    calm = np.array([0.01])
    assert motions_vase.told(COLUMN, record, calm, 3e-12)
    nudged = iter([[False], [False], [True], [False]])
    monkeypatch.setattr(motions_vase, "overturned_by", lambda *_, **__: np.array(next(nudged)))
    assert not motions_vase.told(COLUMN, record, calm, 3e-12)


def test_second_route_sees_a_wrong_outcome():
    cells = [(FixedMassColumn(COLUMN, 1.0), DRAW.record(), 0.01)]
    assert motions_vase.second_route(cells, [False], 3e-12)["holds"]
    assert not motions_vase.second_route(cells, [True], 3e-12)["holds"]


def row(outcome, ratio, **more):
    held = {
        ratio_of(name, top, "rigid"): ratio
        for name in motions_uplift.FORCES
        for top in ("pinned", "guided")
    }
    labels = {"family": "near-fault", "mass_ratio": 1.0, "intensity": 0.4}
    return labels | {"outcome": outcome, "rotation": 0.2} | held | more


def test_summary_counts_what_overturns_and_averages_the_others():
    rows = [row("rests", 0.4)] * 10 + [row("rests", 0.8)] * 10 + [row("overturned", math.nan)] * 20
    rows += [row("no uplift", 1.0)] * 40
    found = motions_uplift.summary(pd.DataFrame(rows), {"periods": []}, BOOT)
    assert found.top.tolist() == ["pinned", "guided"] * 3
    assert found.ratio.tolist() == pytest.approx([0.6] * 6)
    assert found.survivors.tolist() == [20] * 6
    assert found.overturned.tolist() == [0.25] * 6
    assert ((found.ratio_low < 0.6) & (found.ratio_high > 0.6)).all()


CASE = {
    "column": {"half_width": 0.5, "half_height": 3.0},
    "cap": {"span": 5.0, "depth": 1.0},
    "mass_ratios": [1.0],
    "motions": 3,
    "intensities": [0.4],
    "periods": [0.5],
    "points": 1,
    "bootstrap": BOOT,
    "checked_by_second_route": 1,
}
ENSEMBLE = {
    "families": ["near-fault"],
    "scenarios": [
        {"magnitude": 6.5, "distance": 10.0, "site_velocity": 760.0, "directivity": 10.0}
    ],
    "seed": 2014,
    "run": "default",
    "runs": {"default": {"motions": 3}},
}


PEAKS, ONCE = motions_uplift.rocking_peaks, {}


def right(frame, cap, motion, *given):
    """The peaks of the rocking frame, computed once for all tests, and theirs to change."""
    key = frame, cap, motion.time_step, motion.acceleration.tobytes(), given
    if key not in ONCE:
        ONCE[key] = PEAKS(frame, cap, motion, *given)
    return replace(ONCE[key], forces=dict(ONCE[key].forces))


def uplifted(monkeypatch, peaks):
    """The findings with these peaks of the rocking frame, in the shards and by SciPy."""
    for module in (motions_uplift, motions_uplift_shard):
        monkeypatch.setattr(module, "rocking_peaks", peaks)
    shards = [motions_uplift_shard.main(CASE, ENSEMBLE, f"{n}-of-2") for n in (2, 1)]
    return motions_uplift.main(CASE, ENSEMBLE, shards)[1]


def test_missing_histories_are_missed():
    with pytest.raises(ValueError, match="the shards have 2 histories; expected 3: a shard is inc"):
        motions_uplift.main(CASE, ENSEMBLE, [motions_uplift_shard.main(CASE, ENSEMBLE, "1-of-2")])


@pytest.mark.parametrize(("factor", "holds"), [(1.0, True), (5.0, False)])
def test_larger_forces_are_not_limited(monkeypatch, factor, holds):
    def larger(*arguments):
        found = right(*arguments)
        found.forces.update({name: factor * force for name, force in found.forces.items()})
        return found

    findings = uplifted(monkeypatch, larger)
    assert findings["uplift_limits_totals"]["holds"] == holds
    assert findings["shear_is_at_most_that_of_uplift"]["holds"] == holds
    assert findings["uplift_limits_totals"]["survivors_that_uplift"] > 0
    assert findings["uplift_second_route"]["holds"]  # both routes have these forces


@pytest.mark.parametrize("name", motions_uplift.FORCES)
def test_each_force_beside_a_cantilever_can_refute(monkeypatch, name):
    """In single histories, whatever the means are."""
    monkeypatch.setattr(motions_uplift, "summary", lambda *arguments: NOTHING)

    def larger(*arguments):
        found = right(*arguments)
        found.forces[name] *= 5.0
        return found

    findings = uplifted(monkeypatch, larger)
    assert not findings["uplift_limits_totals"]["holds"]


ORDER = {"sooner": 0.1, "sooner_high": 0.2, "later": 0.1, "later_high": 0.2}


def ranked(monkeypatch, change, order=ORDER):
    """The findings of the vase over the ensemble, of which only these ranks are given."""
    usual = {
        "fixed": {"over_bare": 0.7, "over_bare_low": 0.6, "over_bare_high": 0.8},
        "free": {"over_bare": 1.2, "over_bare_low": 1.1, "over_bare_high": 1.3},
    }
    rows = [
        {"structure": name} | ORDER | order | usual[name] | changed
        for name in usual
        for changed in ({}, change.get(name, {}))
    ]
    draw = SimpleNamespace(family="near-fault", record=lambda: None)
    given = {"first_draws": [draw], "factors": LEVELS, "curves": (pd.DataFrame(), rows)}
    given |= {"overturned_together": [LEVELS > 1.0] * 5, "second_route": truth(True)}
    for name, found in given.items():
        monkeypatch.setattr(motions_vase, name, lambda *arguments, found=found: found)
    case = {"column": {"half_width": 0.5, "half_height": 3.0}, "mass_ratios": [0.0, 1.0]}
    case |= {"intensities": {"lowest": 0.25, "highest": 4.0, "points": 9}, "motions": 1}
    ensemble = {"seed": 14, "families": ["near-fault"]}
    return motions_vase.main(case | {"checked_by_second_route": 1}, ensemble, 3e-12)[-1]


@pytest.mark.parametrize(
    ("change", "lowers", "raises", "most"),
    [
        ({}, True, True, True),
        ({"fixed": {"over_bare_high": 1.01}}, False, True, True),  # the end of the interval
        ({"free": {"over_bare_low": 0.99}}, True, False, True),
        ({"fixed": {"later_high": 0.51}}, True, True, False),
        ({"free": {"sooner_high": 0.51}}, True, True, False),
        ({"free": {"later_high": 0.99}}, True, True, True),  # that is the rank
    ],
)
def test_rank_over_the_ensemble_needs_whole_intervals(monkeypatch, change, lowers, raises, most):
    found = ranked(monkeypatch, change)
    assert found["fixed_mass_lowers_the_capacity"].holds is lowers
    assert found["free_mass_raises_the_capacity"].holds is raises
    assert found["every_motion"].holds is False
    assert found["every_motion"].holds_when is most


@pytest.mark.parametrize(
    ("fixed", "free", "holds"),
    [({"later": 0.0}, {"sooner": 0.0}, True)]
    + [({"later": 0.01}, {"sooner": 0.0}, False), ({"later": 0.0}, {"sooner": 0.01}, False)],
)
def test_one_motion_that_changes_the_order_refutes_every_motion(monkeypatch, fixed, free, holds):
    found = ranked(monkeypatch, {"fixed": fixed, "free": free}, {"sooner": 0.0, "later": 0.0})
    assert found["every_motion"].holds is holds


def test_no_survivor_that_uplifts_shows_no_limit(monkeypatch):
    """All motions overturn, or none uplifts: then nothing was compared."""

    def overturned(*arguments):
        found = right(*arguments)
        nothing = dict.fromkeys(found.forces, math.nan)
        return replace(found, outcome="overturned", forces=nothing, rotation=math.nan)

    monkeypatch.setattr(motions_uplift, "summary", lambda *arguments: NOTHING)
    findings = uplifted(monkeypatch, overturned)
    assert findings["uplift_limits_totals"]["overturned"] == 3
    for name in ("uplift_limits_totals", "shear_is_at_most_that_of_uplift"):
        assert not findings[name]["holds"]


NOTHING = pd.DataFrame(
    {"held": ["rigid"], "top": ["pinned"], "force": ["base_shear"], "ratio_high": [0.5]}
)


def test_peaks_that_scipy_denies_are_noticed(monkeypatch):
    def other(frame, cap, motion, samples, route=simulate):
        found = right(frame, cap, motion, samples, route)
        off = 1.0 if route is simulate else 1.0 + 2e-6
        return replace(found, forces={name: off * force for name, force in found.forces.items()})

    assert not uplifted(monkeypatch, other)["uplift_second_route"]["holds"]
