"""What is read off overturning spectra, on intervals that are known."""

import numpy as np
import pandas as pd
import pytest

from steps import spectra_shard
from steps.shared.spectra_compared import Place, Spectra, inside

CASE = {
    "slendernesses": [14.0],
    "shapes": ["one-sine"],
    "mass_ratios": [0.0, 1.0],
    "frequency_ratios": {"lowest": 2.0, "highest": 4.0, "points": 3},
    "amplitudes": {"lowest": 0.95, "highest": 6.0, "resolution": 0.05},
    "finer": {"below": 1.3, "resolution": 0.01},
    "pairs": [[0.0, 1.0]],
}


@pytest.fixture(scope="module")
def table():
    return spectra_shard.main(CASE, "1-of-1")


def test_shards_together_are_the_whole(table):
    shards = [spectra_shard.main(CASE, f"{number}-of-3") for number in (1, 2, 3)]
    columns = list(table.columns)
    together = pd.concat(shards).sort_values(columns, ignore_index=True)
    pd.testing.assert_frame_equal(together, table.sort_values(columns, ignore_index=True))


def test_interval_holds_what_overturns(table):
    spectra = Spectra(CASE, table)
    place = Place(14.0, "one-sine", False, 3.0)
    (low, high), *_ = spectra.at(place, 0.0)
    for amplitude, falls in ((low - 1e-6, False), (low + 1e-6, True), (high - 1e-6, True)):
        assert spectra.judged(place, 0.0, amplitude, 3e-12) == [falls, falls]
        assert inside(spectra.at(place, 0.0), amplitude) == falls


def test_lowest_amplitude_that_falls_with_mass_is_found(table):
    assert Spectra(CASE, table).lowest_rises().holds
    swapped = table.assign(mass_ratio=1.0 - table.mass_ratio)
    finding = Spectra(CASE, swapped).lowest_rises()
    assert finding["apparent"] == 6  # three frequencies, exact and linearised
    assert finding.holds  # the second look computes anew, and finds no exception


def test_areas_are_those_of_known_intervals():
    rows = [
        {"mass_ratio": gamma, "frequency_ratio": ratio, "lower": low, "upper": high}
        for ratio in (2.0, 3.0, 4.0)
        for gamma, low, high in ((0.0, 2.0, 3.0), (0.0, 4.0, np.nan), (1.0, 2.5, 3.5))
    ]
    labels = {"slenderness_deg": 14.0, "shape": "one-sine", "linearised": False, "mode": ""}
    (exact,) = Spectra(CASE, pd.DataFrame(rows).assign(**labels)).areas(0.0, 1.0)
    assert exact["only_lighter_overturns"] == pytest.approx((0.5 + 2.0) / 5.0)
    assert exact["only_heavier_overturns"] == pytest.approx(0.5 / 5.0)
    assert exact["heavier_overturns"] == pytest.approx(1.0 / 5.0)
