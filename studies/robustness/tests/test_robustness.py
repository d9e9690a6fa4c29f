"""Other models of motions, what contacts give and vertical motion: limits, and what decides."""

import math

import numpy as np
import pandas as pd
import pytest

from replication.inputs.strict_yaml import read_yaml
from studies.robustness.steps import friction, models, vertical
from tests.cases import COLUMN, FRAME, ROOT, SIZES, broken
from topheavy import Record, judge
from topheavy.ground.synthetic import filtered_noise as noise
from topheavy.ground.synthetic.motions import TIME_STEP

CONFIG = read_yaml(ROOT / "studies/robustness/config.yaml")
ENSEMBLE = read_yaml(ROOT / "studies/reversals/config.yaml")["motions_ensemble"]
MODELS = CONFIG["models"] | {"column": SIZES}
SMALL = MODELS | {"motions": 4, "soils": [1.0], "corners": [0.2], "checked": 4}
SMALL |= {"bootstrap": {"resamples": 100, "confidence": 0.95}}
SOIL = noise.Soil(2.5, 0.2)


# Filtered noise ----------------------------------------------------------------------------------


def test_densities_and_envelope_have_their_limits():
    ends, at_one = np.array([0.0, 1.0, 1e6]), 1.0 / (4.0 * noise.DAMPING**2)
    assert noise.density_of_soil(ends) == pytest.approx([1.0, 1.0 + at_one, 0.0], abs=1e-9)
    assert noise.density_of_filter(ends) == pytest.approx([0.0, at_one, 1.0])
    times, decayed = np.array([0.0, 1.5, 3.0, 13.0, 17.0]), math.exp(-1.0)
    assert noise.envelope(times) == pytest.approx([0.0, 0.25, 1.0, 1.0, decayed])


def test_spectrum_is_that_of_both_filters():
    """The mean of |FFT|² over many motions, smoothed by the envelope: by two octaves apart."""
    power = 0.0
    for number in range(200):
        samples = noise.motion(1, number, SOIL).acceleration
        of = np.abs(np.fft.rfft(samples)) ** 2
        power = power + of / of.sum()
    frequency = np.fft.rfftfreq(samples.size, TIME_STEP)

    def band(centre):
        return power[(frequency > 0.8 * centre) & (frequency < 1.25 * centre)].mean()

    def density(f):
        at = np.array([f])
        return (noise.density_of_soil(at / 2.5) * noise.density_of_filter(at / 0.2)).item()

    for low, high in ((2.5, 10.0), (0.5, 2.5), (0.1, 0.5)):
        assert band(high) / band(low) == pytest.approx(density(high) / density(low), rel=0.25)


# Models ------------------------------------------------------------------------------------------


def test_models_are_those_of_the_config():
    found = list(models.models(MODELS, ENSEMBLE))
    names = [one.labels["model"] for one in found]
    assert names == [models.NOISE] * 6 + ["near-fault", "broadband"]
    assert {len(one.motions) for one in found} == {400}
    labels = [(one.labels["soil"], one.labels["corner"]) for one in found[:2]]
    assert labels == [(1.0, 0.1), (1.0, 0.2)]
    assert found[0].motions[5]().name != found[1].motions[5]().name
    levels = models.asked(MODELS).levels
    assert levels == pytest.approx([*np.geomspace(0.15, 4.0, 17), 0.6])


def test_outcomes_are_those_of_single_histories():
    (model, *_), question = models.models(SMALL, ENSEMBLE), models.asked(SMALL)
    found, record = models.swept(model, question), model.motions[2]()
    scaled = record.scaled(SMALL["pgv"] / record.peak_velocity)
    fell = [judge(one, scaled).overturned for one in (COLUMN, FRAME)]
    assert found.outcomes[2, [models.COLUMN, models.FRAME], -1].tolist() == fell
    assert found.velocities[2] == record.peak_velocity


def test_numbers_of_a_row_are_those_of_its_outcomes():
    levels = models.asked(SMALL).levels
    fell = np.zeros((40, 3, levels.size), bool)
    falls_from = {models.COLUMN: 8, models.VASE: 4, models.FRAME: 10}
    for place, level in falls_from.items():
        for motion in range(40):
            fell[motion, place, level + motion % 5 : -1] = True
    fell[:20, models.COLUMN, -1] = fell[10:18, models.FRAME, -1] = fell[:30, models.VASE, -1] = True
    fell[38:, models.FRAME, -1] = True
    velocities = np.linspace(0.1, 0.5, 40)
    swept = models.Swept(fell, velocities, np.full(40, 0.2))
    row = models.row({}, [0] * 40, swept, SMALL)
    assert [row[name] for name in models.NAMES] == [0.5, 0.75, 0.25]
    names = ("harm", "benefit", "only_frame", "only_column", "factor_largest", "pga_largest")
    expected = (0.25, 0.25, 2 / 40, 12 / 40, 6.0, 1.2)
    assert [row[name] for name in names] == pytest.approx(expected)
    assert row["gain"] == pytest.approx(levels[10] / levels[8] - 1.0, rel=1e-3)
    few, groups = models.restricted(swept, models.Model({}, [], list(range(40))), SMALL)
    kept = (SMALL["pgv"] / velocities <= 4.0).sum()
    assert len(groups) == len(few.velocities) == few.outcomes.shape[0] == kept


NAMES = ("harm", "benefit", "gain", "only_frame", "column", "frame")
ENDS = {"": [0.2, 0.3], "_low": [0.1, 0.2], "_high": [0.3, 0.4]}
NUMBERS = {f"{name}{end}": values for name in NAMES for end, values in ENDS.items()}


@pytest.mark.parametrize(
    ("change", "false"),
    [
        ({}, set()),
        ({"benefit_low": [0.1, -0.01]}, {"order"}),
        ({"harm_low": [0.0, 0.1]}, {"order"}),
        ({"gain_low": [-0.1, 0.1]}, {"gain"}),
        ({"only_frame": [0.0, 0.1]}, {"some_only_frame"}),
        ({"gain_high": [0.15, 0.4]}, {"one_gain"}),
        ({"column_low": [0.1, 0.35]}, {"one_column"}),
        ({"frame_low": [0.1, 0.35]}, {"one_frame"}),
    ],
)
def test_one_row_is_enough_to_refute(change, false):
    assert broken(models.findings(pd.DataFrame(NUMBERS | change))) == false


# Friction and vertical motion --------------------------------------------------------------------


def test_shares_are_of_the_motions_that_uplift():
    histories = pd.DataFrame({"outcome": ["rests", "rests", "no uplift", "overturned"]}).assign(
        family="broadband",
        mass_ratio=1.0,
        friction=[0.2, 0.6, math.nan, 0.8],
        error=[0.0, 1e-3, math.nan, 0.0],
        pulls=[False, False, False, True],
    )
    table = friction.summed(histories, [0.3, 0.5, 0.7]).set_index("motions")
    assert table.uplifted.to_dict() == {"survive": 2, "overturn": 1, "all": 3}
    assert table.loc["all", ["above_0.3", "above_0.7"]].tolist() == pytest.approx([2 / 3, 1 / 3])
    assert (table.largest["survive"], table.tension["survive"], table.tension["all"]) == (0.6, 0, 1)


VERTICAL = CONFIG["vertical"] | {"column": SIZES, "motions": 4, "checked": 2}


def test_vertical_motion_has_its_share_and_its_time():
    draw, other = next(vertical.partners(VERTICAL, ENSEMBLE))
    assert (draw.family, draw.place, draw.number, other.number) == ("near-fault", 0, 0, 2)
    across, up = vertical.pair(draw, other, VERTICAL, 1.7)
    assert across.peak_velocity == pytest.approx(0.6)
    assert up.peak_acceleration == pytest.approx(2.0 / 3.0 * across.peak_acceleration)
    assert up.duration == pytest.approx(other.record().duration / 1.7)


def test_no_vertical_motion_changes_nothing_and_free_fall_is_left_out(given):
    def still(draw, other, settings, faster):
        across = draw.record().scaled_to(pgv=settings["pgv"])
        falls = draw.number == 1
        return across, Record(across.time_step, [0.0, -1.2 if falls else 0.0, 0.0])

    given(vertical, pair=still)
    table = vertical.changes(vertical.compared(VERTICAL, ENSEMBLE), VERTICAL)
    assert set(table.free_fall) == set(table.motions) == {2}  # of four, one of each scenario
    assert (table.change == 0.0).all()
    assert (table["column"] == table.column_vertical).all()
    across = Record(0.02, 0.4 * np.sin(np.linspace(0.0, 6.0, 200)), "across")
    row = vertical.measured(VERTICAL, [(across, Record(0.02, np.zeros(200), "up"))] * 2)
    assert (row["motions"], row["column"]) == (2, row["column_vertical"])


def test_change_of_outcome_is_found_in_a_range():
    assert vertical.beside(lambda factor: factor > 0.7) == pytest.approx(0.7, abs=2e-3)
    assert vertical.beside(lambda factor: True) == 1.0
