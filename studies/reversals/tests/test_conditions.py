"""Each condition in a result of the study, in a case in which it alone fails."""

from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest

from studies.reversals.steps import motions_fragility, pulses

PLACE = (14.0, "one-sine", False, 3.0)
BANDS = pd.DataFrame(
    [(*PLACE, 0.0, 1.0, 2.0, 3.0)],
    columns=["slenderness", "shape", "linearised", "frequency_ratio"]
    + ["light", "heavy", "low", "high"],
)


# Pulses ------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("harms", "caused", "spared"),
    [
        ({"both": 1.0, "size": 2.0, "restitution": 0.1}, True, True),
        ({"both": 1.0, "size": 2.0, "restitution": 0.3}, False, True),
        ({"both": 2.0, "size": 2.0, "restitution": 0.1}, True, False),
    ],
)
def test_cause_of_the_reversals_is_ten_times_the_other(harms, caused, spared):
    found = pulses.causes(harms)
    assert (found["size_harms"].holds, found["restitution_spares"].holds) == (caused, spared)


def test_pair_without_a_reversal_is_noticed():
    shares = pd.DataFrame({"lighter": [0.0, 0.0, 1.0], "heavier": [1.0, 1.0, 4.0]})
    assert pulses.at_every_pair(shares.assign(harms=[0.1, 0.0, 0.1])).holds
    assert not pulses.at_every_pair(shares.assign(harms=[0.1, 0.1, 0.0])).holds


@pytest.mark.parametrize(
    ("lighter", "heavier", "holds"),
    [
        ([False, False], [True, True], True),
        ([False, False], [True, False], False),  # the second solver: the heavier one survives
        ([False, True], [True, True], False),
    ],
)
def test_sampled_reversal_is_borne_by_both_solvers(lighter, heavier, holds):
    def judged(place, gamma, amplitude, tightened):
        return heavier if gamma else lighter

    found = pulses.sample(
        SimpleNamespace(judged=judged), BANDS, {"seed": 1, "points": 3}, tightened=1e-12
    )
    assert found.holds is holds


@pytest.mark.parametrize(("again", "holds"), [(3.0, False), (2.0, True)])
def test_minimum_that_falls_with_one_cause_alone_is_proven_or_not(again, holds):
    spectra = SimpleNamespace(
        places=lambda: [pulses.Place(*PLACE)],
        lowest=lambda place, gamma: 2.0 if gamma else 3.0,
        again=lambda place, gamma, lowest: (again, again),
    )
    assert pulses.lowest_apart(spectra, [1.0]).holds is holds


def test_counterexample_that_one_solver_denies_stops_the_run():
    def judged(place, gamma, amplitude, tightened):
        return [gamma > 0.0, False]  # SciPy: neither overturns

    spectra = SimpleNamespace(judged=judged)
    found = (0.1, pulses.Place(*PLACE), 0.0, 1.0, 2.0)
    with pytest.raises(ArithmeticError, match="routes say"):
        pulses.confirmed(spectra, found, 1e-12)


# Motions -----------------------------------------------------------------------------------------


def findings(monkeypatch, *, reversed_high=0.4, beyond=((0.01, 0.03),), half_high=0.8):
    """The findings on an ensemble of which only these numbers are given."""
    pair = {"only_heavier": 0.1, "cells": 9, "reversed": 0.3, "reversed_high": reversed_high}
    less = {"less": 0.1, "less_low": 0.05, "less_high": 0.2}
    nothing = SimpleNamespace(means=lambda: None, means_of=lambda several: [], outcomes=None)
    given = {
        "cases": [SimpleNamespace(labels={}, levels=None, motions=0, ensemble=nothing)],
        "differing": [],
        "middles": np.ones(1),
        "curves": pd.DataFrame([{"probability": 0.5, "fitted": 0.5}]),
        "capacities": pd.DataFrame(),
        "pairs": pd.DataFrame([pair]),
        "falls": pd.DataFrame([less]),
        "beyond_size": [{"excess_low": low, "excess_high": high} for low, high in beyond],
        "shares_of_gain": [{"share": 0.5, "mass_ratio_low": 0.2, "mass_ratio_high": half_high}],
    }
    for name, found in given.items():
        monkeypatch.setattr(
            motions_fragility, name, lambda *arguments, found=found, **options: found
        )
    case = {"shares_of_gain": [0.5], "largest_rise": 0.05, "intensities": {"points": 9}}
    return motions_fragility.main(case, {}, {})[1]


@pytest.mark.parametrize(
    ("name", "holds", "given"),
    [
        ("probability_is_lower", True, {"reversed_high": 0.49}),
        ("probability_is_lower", False, {"reversed_high": 0.51}),  # the end of the interval counts
        ("half_by_one", True, {"half_high": 0.9}),
        ("half_by_one", False, {"half_high": 1.1}),
        ("gain_is_that_of_size", True, {"beyond": ((-0.01, 0.02), (-0.02, 0.01))}),
        ("gain_is_that_of_size", False, {"beyond": ((-0.01, 0.02), (0.01, 0.02))}),
        ("gain_is_that_of_size", False, {"beyond": ((-0.02, -0.01),)}),
    ],
)
def test_whole_interval_decides(monkeypatch, name, holds, given):
    assert findings(monkeypatch, **given)[name].holds == holds
