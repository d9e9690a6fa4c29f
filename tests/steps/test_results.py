"""Columns of tables that no claim reads: by another way, or from the history beside them."""

import math

import numpy as np
import pytest
from scipy.stats import binom, norm

from replication.config import read_yaml
from steps import trilith, uplift
from steps.beyond import records, test_plan
from steps.shared import plain
from tests.cases import COLUMN, ROOT, SIZES
from topheavy import Column, Record, RockingFrame, simulate

CONFIG = read_yaml(ROOT / "config/config.yaml")


def test_late_peak_is_that_of_the_last_quarter(monkeypatch):
    monkeypatch.setattr(plain, "simulate", simulate)  # compared elsewhere
    frame = RockingFrame(Column(0.11, 0.40), 0.434)
    rows, history = trilith.starts(frame, CONFIG["trilith"], CONFIG["solver"]["tightened"])
    late = history["time"] > 0.75 * CONFIG["trilith"]["duration"]
    largest = np.abs(history["abrupt"][late]).max()
    assert rows[-1]["late_peak_over_alpha"] == pytest.approx(largest)
    assert rows[-1]["peak_over_alpha"] > 1.01 * largest


def test_base_shear_after_uplift_rises_from_that_level_by_the_known_slope():
    settings = CONFIG["uplift"] | {"shapes": ["one-sine"], "mass_ratios": [0.0, 1.0, 4.0]}
    settings |= {"frequency_ratios": {"lowest": 8.0, "highest": 8.0, "points": 1}, "sample": 0}
    for row in uplift.compute(settings, SIZES):
        beyond = row["peak_acceleration"] - 1 / 6  # tan α
        slope = {0.0: 0.270270, 1.0: 0.179054, 4.0: 0.090644}[row["mass_ratio"]]
        assert row["shear_after_uplift"] == pytest.approx(1 / 6 + slope * beyond, rel=1e-5)


def test_repeats_are_those_of_minima_that_scatter_about_both():
    settings = CONFIG["test_plan"] | {"reductions": [], "scatters": [0.05, 0.1, 0.2]}
    for row in test_plan.compute(settings).itertuples():
        falls = norm.cdf(math.log(row.pulse / row.minimum_of_column) / row.scatter)
        stands = norm.cdf(math.log(row.minimum_of_other / row.pulse) / row.scatter)
        assert falls == pytest.approx(stands)
        wrong = [binom.cdf(n // 2, n, falls) for n in (row.repeats, row.repeats - 2) if n > 0]
        assert wrong[0] <= settings["risk"] < min([*wrong[1:], 1.0])


def test_outcome_that_a_tighter_tolerance_changes_is_not_known(monkeypatch):
    def tolerant(frame, record, factors, tolerance=None):
        return factors > (1.0 if tolerance is None else 2.0)

    monkeypatch.setattr(records, "overturned_by", tolerant)
    known = records.overturned(COLUMN, Record(0.01, [0.1, 0.2]), np.array([0.5, 1.5, 2.5]), 1e-13)
    assert known.tolist() == [-1, 0, 1]
