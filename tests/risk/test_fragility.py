"""Fragility of an ensemble, and what it refuses."""

import numpy as np
import pytest

import topheavy as th
from steps.shared import plain

PIER = th.Column(0.25, 1.5)
STRUCTURES = {
    "pier": PIER,
    "bent": th.RockingFrame(PIER, 2.0),
    "vase": th.FixedMassColumn(PIER, 1.0),
    "portal": th.MonolithicPortal(PIER, 1.0, 1.2),
    "block": th.RockingBlock(2.0, 0.2, 0.9),
}
LEVELS = np.array([0.3, 0.5, 0.8, 1.2, 2.0])


def wave(number, size=1.0):
    """A motion of two frequencies that differ from motion to motion, with pauses at both ends."""
    random = np.random.default_rng([5, number])
    time = np.arange(0.0, 6.0, 0.02)
    slow, fast = random.uniform([2.0, 7.0], [5.0, 15.0])
    sums = np.sin(slow * time) + 0.5 * np.sin(fast * time + random.uniform(0.0, 6.0))
    return th.Record(0.02, size * sums * np.sin(np.pi * time / 6.0) ** 2, f"wave {number}")


MOTIONS = [wave(number) for number in range(8)]


@pytest.fixture(scope="module")
def ensemble():
    return th.fragility(STRUCTURES, MOTIONS, LEVELS, resamples=200)


@pytest.mark.parametrize("measure", ["PGV", "PGA"])
def test_each_outcome_is_that_of_the_motion_scaled_to_the_level(measure):
    levels = LEVELS if measure == "PGV" else LEVELS / 2.0
    result = th.fragility(STRUCTURES, MOTIONS[:3], levels, measure, resamples=100)
    units = {"PGV": "m/s", "PGA": "g"}
    assert (result.measure, result.curves.level.units) == (measure, units[measure])
    for number, motion in enumerate(MOTIONS[:3]):
        for place, structure in enumerate(STRUCTURES.values()):
            peak = motion.peak_velocity if measure == "PGV" else motion.peak_acceleration
            row = [th.judge(structure, motion.scaled(level / peak)).overturned for level in levels]
            assert result.outcomes[number, place].tolist() == row
    assert 0.1 < result.outcomes.mean() < 0.9


UPS = [th.Record(0.013, 0.4 * wave(number + 20).acceleration) for number in range(8)]


@pytest.mark.parametrize("scale_vertical", [True, False])
def test_vertical_component_of_each_motion_acts_with_it(ensemble, scale_vertical):
    options = {"vertical": UPS, "scale_vertical": scale_vertical}
    levels = LEVELS[:4]
    outcomes = th.fragility(STRUCTURES, MOTIONS, levels, resamples=100, **options).outcomes
    for number, (motion, up) in enumerate(zip(MOTIONS, UPS, strict=True)):
        factors = levels / motion.peak_velocity
        lifts = factors if scale_vertical else np.ones(4)
        for place, structure in enumerate(STRUCTURES.values()):
            for level, (factor, lift) in enumerate(zip(factors, lifts, strict=True)):
                arguments = (structure, motion.scaled(factor))
                judges = [th.judge, plain.judge] if place == number == 1 else [th.judge]
                for judge in judges:
                    truth = judge(*arguments, vertical=up.scaled(lift)).overturned
                    assert outcomes[number, place, level] == truth
    assert (outcomes != ensemble.outcomes[:, :, :4]).sum() > 5


def test_measure_may_be_a_function_and_a_motion_a_pulse():
    def peak_of_pulse(pulse):
        return pulse.amplitude

    pulses = [th.Pulse("one-sine", 1.0, angular_frequency=omega) for omega in (2.0, 3.0, 4.0)]
    result = th.fragility([PIER], pulses, [0.2, 0.5, 1.0], peak_of_pulse, resamples=100)
    for number, pulse in enumerate(pulses):
        np.testing.assert_array_equal(
            result.outcomes[number, 0], th.overturned_by(PIER, pulse, [0.2, 0.5, 1.0])
        )
    assert result.measure == "peak_of_pulse"
    assert "units" not in result.curves.level.attrs


def test_result_is_labelled(ensemble):
    assert isinstance(ensemble, th.Fragility)
    curves, pairs = ensemble.curves, ensemble.pairs
    names = list(STRUCTURES)
    assert curves.structure.to_numpy().tolist() == names
    np.testing.assert_array_equal(curves.overturned, ensemble.outcomes.sum(axis=0))
    for pair in range(10):
        first, second = (names.index(pairs[key][pair]) for key in ("first", "second"))
        less = curves.probability[first] - curves.probability[second]
        assert pairs.less[pair].to_numpy() == pytest.approx(less.to_numpy(), abs=1e-15)
    assert (ensemble.confidence, ensemble.measure) == (0.95, "PGV")
    assert str(ensemble).splitlines()[0].endswith("sampling of 8 motions")


def test_limit_of_rotation_is_exceeded_where_the_peak_is_larger_or_overturns(ensemble):
    limit = 0.4 * PIER.slenderness
    result = th.fragility(STRUCTURES, MOTIONS, LEVELS, rotation_limit=limit, resamples=100)
    for number, motion in enumerate(MOTIONS[:3]):
        for place, structure in enumerate(STRUCTURES.values()):
            scaled = [motion.scaled(level / motion.peak_velocity) for level in LEVELS]
            ends = [th.judge(structure, shaking) for shaking in scaled]
            exceeded = [end.overturned or end.peak_rotation > limit for end in ends]
            assert result.outcomes[number, place].tolist() == exceeded
    assert (result.outcomes >= ensemble.outcomes).all()
    assert result.outcomes.sum() > ensemble.outcomes.sum() + 10
    assert (result.rotation_limit, ensemble.rotation_limit) == (limit, None)


@pytest.mark.parametrize(
    ("levels", "reason"),
    [
        ([2.0, 4.0], "overturning under all motions at every level: levels are in m/s; begin"),
        ([0.001, 0.002], "no overturning at any level; go higher"),
        ([0.35, 0.4, 0.45], "the fitted curve rises past 1/2 at 0.535, outside the levels"),
    ],
)
def test_text_says_why_there_is_no_median(levels, reason):
    motions = [wave(number) for number in range(20)]
    result = th.fragility({"pier": PIER}, motions, levels, resamples=100)
    assert f"pier: median unknown: {reason}" in str(result)
