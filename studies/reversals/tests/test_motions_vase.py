"""Vase, frame and forces over the ensemble, on cases that are known."""

import math
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from steps.shared.peak_forces import ratio_of
from steps.shared.sweep import Swept
from studies.reversals.steps import motions_uplift, motions_vase
from topheavy import simulate
from topheavy.ground.synthetic.ensemble import Draw
from topheavy.ground.synthetic.motions import Scenario
from topheavy.risk.ensemble import Ensemble

LEVELS = np.geomspace(0.25, 4.0, 9)
BOOT = {"resamples": 200, "confidence": 0.95, "seed": 14}
DRAW = Draw("near-fault", 0, 0, 2014, Scenario(6.5, 10.0, 760.0, 10.0))


def outcomes(*capacities):
    """Outcomes of two motions: structures overturn from these levels on, a tenth later in one."""
    found = [[level * late <= LEVELS for level in capacities] for late in (1.0, 1.1)]
    return np.array(found * 20)


def test_ranks_count_motions_that_change_the_order():
    case = {"column": {"half_width": 0.5, "half_height": 3.0}, "mass_ratios": [1.0], "motions": 20}
    case |= {"intensities": {"lowest": 0.25, "highest": 4.0, "points": 9}}
    fell = outcomes(0.99, 0.49, 1.9)
    fell[0, 1] = LEVELS >= 3.9  # one of forty: the fixed mass overturns last
    table, ranks = motions_vase.curves("near-fault", Ensemble(fell, None, **BOOT), case)
    fixed, free = ranks
    assert fixed["later"] == pytest.approx(1 / 40)
    assert fixed["sooner"] == pytest.approx(39 / 40)
    assert (free["sooner"], free["later"]) == pytest.approx((0.0, 1.0))
    assert fixed["over_bare_high"] < 1.0 < free["over_bare_low"]
    assert set(table.structure) == {"bare", "fixed", "free"}


def test_sampled_cells_are_just_below_the_lowest_intensity_and_at_it():
    case = {"column": {"half_width": 0.5, "half_height": 3.0}, "mass_ratios": [1.0], "motions": 1}
    case |= {"intensities": {"lowest": 0.25, "highest": 4.0, "points": 9}}
    case |= {"checked_by_second_route": 2}
    fell = outcomes(0.99, 0.49, 1.9)[:2]
    swept = Swept([DRAW, DRAW], np.array([0.5, 0.25]), fell)
    cells = list(motions_vase.sampled(case, swept, 14))
    assert [falls for *_, falls in cells] == [False, True] * 2
    for (*_, below, _), (*_, at, _) in zip(cells[::2], cells[1::2], strict=True):
        assert at / below == pytest.approx(2.0**0.5)


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
    """The findings with these peaks of the rocking frame, also by SciPy."""
    monkeypatch.setattr(motions_uplift, "rocking_peaks", peaks)
    return motions_uplift.main(CASE, ENSEMBLE)[1]


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


AGREED = {"decided": 1, "differ": 0}
ORDER = {"sooner": 0.1, "sooner_high": 0.2, "later": 0.1, "later_high": 0.2}


def ranked(monkeypatch, change, order=ORDER, agreed=AGREED):
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
    monkeypatch.setattr(motions_vase, "curves", lambda *given: (pd.DataFrame(), rows))
    monkeypatch.setattr(motions_vase, "by_scipy", lambda cells: agreed)
    swept = Swept([DRAW], np.ones(1), np.zeros((1, 1, 1), dtype=bool))
    ensemble = {"seed": 14, "families": ["near-fault"]}
    return motions_vase.main({"bootstrap": BOOT}, ensemble, swept)[-1]


OF_SCIPY = [(3, 0, True), (3, 1, False), (0, 0, False)]


@pytest.mark.parametrize(("decided", "differ", "holds"), OF_SCIPY)
def test_scipy_has_to_find_the_sampled_outcomes(monkeypatch, decided, differ, holds):
    found = ranked(monkeypatch, {}, agreed={"decided": decided, "differ": differ})
    assert found["vase_second_route"].holds is holds


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
