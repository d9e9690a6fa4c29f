"""Steps and figures of rocking spectra, and the animation."""

import copy
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from PIL import Image

from figures.rocking_spectra import draw
from replication.inputs.strict_yaml import read_yaml
from steps import animation, spectra_shard
from steps.inputs import check_inputs
from steps.shared.spectra_compared import Place, Spectra, inside
from steps.spectra_dimensional import lines

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


ROOT = Path(__file__).resolve().parents[2]
CONFIG = read_yaml(ROOT / "config" / "config.yaml")


def with_pier(caps):
    config = copy.deepcopy(CONFIG)
    config["structures"]["my_pier"] = {"half_width": 1.0, "half_height": 8.0}
    config["spectra_dimensional"]["frames"]["my_pier"] = caps
    return config


def check(config):
    schema = ROOT / "config" / "config.schema.yaml"
    check_inputs(config, "config.yaml", str(schema), str(ROOT / "data" / "records"))


def test_structure_of_ones_own_has_lines_for_each_cap():
    config = with_pier([0.0, {"cap_mass": 3000.0, "column_mass": 1000.0}])
    check(config)
    found = lines(config["spectra_dimensional"], config["structures"])
    own = [line.labels for line in found if line.labels["structure"] == "my_pier"]
    assert {labels["mass_ratio"] for labels in own} == {0.0, 1.5}
    assert {labels["height"] for labels in own} == {16.0}


SIZES = [0.5, 1.0, 2.0]


def rows_of(records):
    rows = [
        {
            "record": f"record_{number}",
            "mass_ratio": ratio,
            "size": size,
            "peak_over_alpha": 0.5,
            "overturned": size < 1.0,
            "decided": True,
        }
        for number in range(records)
        for ratio in (0.0, 1.0)
        for size in SIZES
    ]
    return pd.DataFrame(rows)


@pytest.mark.parametrize("records", [1, 5, 6, 8])
def test_key_has_a_place_of_its_own(records):
    *panels, key = draw(rocking_spectra=rows_of(records)).axes
    titles = [axis.get_title() for axis in panels]
    assert len([title for title in titles if title]) == records
    assert key.get_title() == ""
    assert [text.get_text() for text in key.texts]


PLAYED = {
    "column": {"half_width": 0.5, "half_height": 3.0},
    "mass_ratio": 1.0,
    "cap": {"width": 2.6, "depth": 0.6},
    "pulse": {"shape": "one-cosine", "amplitude": 0.29, "period": 1.5},
    "duration": 7.0,
    "frames_per_second": 1,
}


def test_frame_that_overturns_is_refused():
    strong = PLAYED | {"pulse": PLAYED["pulse"] | {"amplitude": 0.5}}
    with pytest.raises(ArithmeticError, match="the frame overturns; expected a pulse"):
        animation.main(strong)


def test_it_is_played_three_times(tmp_path):
    pictures = animation.main(PLAYED)
    for name, loop in (("a.gif", 2), ("a.png", 3)):  # a GIF counts the repetitions
        animation.save(str(tmp_path / name), pictures, PLAYED)
        with Image.open(tmp_path / name) as found:
            assert found.info["loop"] == loop
            assert found.n_frames == len(pictures) == 7
