"""Fragility of an ensemble, and what it refuses."""

import re

import numpy as np
import pytest

import topheavy as th
from topheavy import Column, Pulse, Record, RockingFrame, fragility
from topheavy.second import reference

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
def found():
    return th.fragility(STRUCTURES, MOTIONS, LEVELS, lowered=(0.05, 0.1), resamples=200)


def test_outcomes_are_those_of_scipy(found):
    """The second route: solve_ivp judges the scaled record of some cells."""
    compared = set()
    for motion, place, level in [(0, 0, 2), (1, 1, 3), (2, 2, 1), (3, 3, 4), (4, 4, 2), (5, 0, 3)]:
        record = MOTIONS[motion].scaled(LEVELS[level] / MOTIONS[motion].peak_velocity)
        assert record.peak_velocity == pytest.approx(LEVELS[level])
        structure = list(STRUCTURES.values())[place]
        other = reference.judge(structure, record).overturned
        assert found.outcomes[motion, place, level] == other
        compared.add(bool(other))
    assert compared == {False, True}


@pytest.mark.parametrize("measure", ["PGV", "PGA"])
def test_each_outcome_is_that_of_the_motion_scaled_to_the_level(measure):
    levels = LEVELS if measure == "PGV" else LEVELS / 2.0
    result = th.fragility(STRUCTURES, MOTIONS[:3], levels, measure, resamples=100)
    units = {"PGV": "m/s", "PGA": "g"}
    assert (result.measure, result.curves.level.units) == (measure, units[measure])
    for number, motion in enumerate(MOTIONS[:3]):
        for place, structure in enumerate(STRUCTURES.values()):
            of = motion.peak_velocity if measure == "PGV" else motion.peak_acceleration
            each = [th.judge(structure, motion.scaled(level / of)).overturned for level in levels]
            assert result.outcomes[number, place].tolist() == each
    assert 0.1 < result.outcomes.mean() < 0.9


UPS = [th.Record(0.013, 0.4 * wave(number + 20).acceleration) for number in range(8)]


@pytest.mark.parametrize("scale_vertical", [True, False])
def test_vertical_component_of_each_motion_acts_with_it(found, scale_vertical):
    both = {"vertical": UPS, "scale_vertical": scale_vertical}
    levels = LEVELS[:4]
    outcomes = th.fragility(STRUCTURES, MOTIONS, levels, resamples=100, **both).outcomes
    for number, (motion, up) in enumerate(zip(MOTIONS, UPS, strict=True)):
        factors = levels / motion.peak_velocity
        lifts = factors if scale_vertical else np.ones(4)
        for place, structure in enumerate(STRUCTURES.values()):
            for level, (factor, lift) in enumerate(zip(factors, lifts, strict=True)):
                given = (structure, motion.scaled(factor))
                judges = [th.judge, reference.judge] if place == number == 1 else [th.judge]
                for route in judges:
                    truth = route(*given, vertical=up.scaled(lift)).overturned
                    assert outcomes[number, place, level] == truth
    assert (outcomes != found.outcomes[:, :5, :4]).sum() > 5


@pytest.mark.parametrize(
    ("vertical", "says"),
    [
        (UPS[0], r"vertical is .*Record.*; expected a list of 8 Records"),
        (UPS[:7], "vertical is .*; expected a list of 8 Records, the vertical component of each"),
        ([*UPS[:7], 0.1], r"vertical\[7\]: excitation is Record and vertical float; expected two"),
        (
            [*UPS[:7], th.Record(0.05, [0.0, 0.4, -8.0, 0.0], unit="g")],
            r"^vertical\[7\]: at 0\.1 s its acceleration .* factors less than 0\.125 are allowed",
        ),
    ],
)
def test_bad_vertical_is_refused_by_its_motion(vertical, says):
    with pytest.raises(ValueError, match=says):
        th.fragility([PIER], MOTIONS, LEVELS, resamples=100, vertical=vertical)


def test_measure_may_be_a_function_and_a_motion_a_pulse():
    def peak_of_pulse(pulse):
        return pulse.amplitude

    pulses = [th.Pulse("one-sine", 1.0, omega) for omega in (2.0, 3.0, 4.0)]
    result = th.fragility([PIER], pulses, [0.2, 0.5, 1.0], peak_of_pulse, resamples=100)
    for number, pulse in enumerate(pulses):
        np.testing.assert_array_equal(
            result.outcomes[number, 0], th.overturned_by(PIER, pulse, [0.2, 0.5, 1.0])
        )
    assert result.measure == "peak_of_pulse"
    assert "units" not in result.curves.level.attrs


def test_result_is_labelled(found):
    assert isinstance(found, th.Fragility)
    curves, pairs = found.curves, found.pairs
    names = [*STRUCTURES, "pier, √r 5 % lower", "pier, √r 10 % lower"]
    assert curves.structure.to_numpy().tolist() == names
    assert curves.lowered.to_numpy().tolist() == [0, 0, 0, 0, 0, 0.05, 0.1]
    assert curves.sizes == {"structure": 7, "level": 5, "term": 3}
    assert pairs.sizes == {"pair": 10 + 2 * 4, "level": 5}
    np.testing.assert_array_equal(curves.level, LEVELS)
    np.testing.assert_array_equal(curves.overturned, found.outcomes.sum(axis=0))
    for pair in range(18):
        first, second = (names.index(pairs[key][pair]) for key in ("first", "second"))
        less = curves.probability[first] - curves.probability[second]
        assert pairs.less[pair].to_numpy() == pytest.approx(less.to_numpy(), abs=1e-15)
    assert (found.confidence, found.measure) == (0.95, "PGV")
    assert found.sampling == "sampling of 8 motions, each drawn independently of the others"


def test_restitution_of_the_column_alone_is_lowered(found):
    names = found.curves.structure.to_numpy().tolist()
    for share in (0.05, 0.1):
        lower = PIER.block().with_restitution((1.0 - share) * PIER.restitution)
        place = names.index(f"pier, √r {100 * share:g} % lower")
        for number, motion in enumerate(MOTIONS):
            factors = LEVELS / motion.peak_velocity
            np.testing.assert_array_equal(
                found.outcomes[number, place], th.overturned_by(lower, motion, factors)
            )
    assert (found.outcomes[:, 0] != found.outcomes[:, -1]).any()
    unchanged = th.fragility(STRUCTURES, MOTIONS, LEVELS, resamples=200)
    np.testing.assert_array_equal(unchanged.outcomes, found.outcomes[:, :5])


def test_lowered_column_is_compared_with_what_is_no_column():
    under = {"a": PIER, "b": th.Column(0.3, 1.5), "bent": th.RockingFrame(PIER, 1.0)}
    pairs = th.fragility(under, MOTIONS[:2], [0.3, 0.6], lowered=[0.1], resamples=100).pairs
    assert list(zip(pairs["first"].to_numpy(), pairs["second"].to_numpy(), strict=True)) == [
        ("a", "b"),
        ("a", "bent"),
        ("b", "bent"),
        ("a, √r 10 % lower", "bent"),
        ("b, √r 10 % lower", "bent"),
    ]


def test_scatter_between_groups_is_not_in_the_result():
    """Four times one motion, four times another: within each group, nothing is left to chance."""
    twice = [wave(0)] * 4 + [wave(3)] * 4
    wide, none = (
        th.fragility([PIER, STRUCTURES["bent"]], twice, [0.5], groups=members, resamples=200).pairs
        for members in (None, ["a"] * 4 + ["b"] * 4)
    )
    assert (wide.less.item(), none.less.item()) == (0.5, 0.5)  # the pier alone overturns, in one
    assert wide.less_low.item() < 0.3
    assert (none.less_low.item(), none.less_high.item()) == (0.5, 0.5)


def test_same_seed_same_result(found):
    again = th.fragility(STRUCTURES, MOTIONS, LEVELS, lowered=(0.05, 0.1), resamples=200)
    assert again.curves.identical(found.curves)
    assert again.pairs.identical(found.pairs)


def test_text_has_medians_gains_and_reasons():
    motions = [wave(number) for number in range(20)]
    told = str(
        th.fragility(
            {"pier": PIER, "bent": th.RockingFrame(PIER, 2.0)}, motions, np.geomspace(0.05, 2.0, 12)
        )
    )
    first, pier, bent, pair = told.splitlines()
    assert first.startswith("20 motions, PGV from 0.05 to 2 m/s; 95% intervals, sampling of 20")
    assert re.fullmatch(r"pier: median [\d.]+ \([\d.]+ to [\d.]+\) m/s", pier)
    assert bent.startswith("bent: median ")
    assert pair.startswith(("bent over pier: gain ", "pier over bent: gain "))
    with pytest.warns(UserWarning, match="in cm/s"):
        in_cm = str(th.fragility([PIER], motions, [20.0, 60.0, 200.0]))  # taken as m/s
    assert re.search(r"Column 1: median nan \(nan to nan\) m/s: \w+", in_cm)


SHAKE = Record(0.02, [0.0, 0.3, -0.2, 0.1, 0.0], "shake")
STILL = Record(0.02, [0.0, 0.0, 0.0], "still")
TINY = Record(1e-9, [0.0, 1.0, 0.0], "tiny")


class Crate:
    """What has a block, and is no structure of the library."""

    def __init__(self, block):
        self._block = block

    def block(self):
        return self._block


GIVEN = {"structures": {"pier": PIER}, "motions": [SHAKE, SHAKE], "levels": [0.1, 0.2]}


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("structures", None, "structures is None; expected a mapping from names to structures"),
        (
            "structures",
            PIER,
            "structures is Column(half_width=0.25, half_height=1.5: 0.5",
        ),
        ("structures", "pier", "structures is 'pier'; expected a mapping"),
        ("structures", {}, "structures is empty; expected at least one structure"),
        ("structures", [], "structures is empty; expected at least one structure"),
        (
            "structures",
            [PIER, 3],
            "structures[1] is 3; expected a structure",
        ),
        ("structures", {"x": Column}, "structures['x'] is <class"),
        (
            "structures",
            [PIER, None],
            "structures[1] is None; expected a structure, for example Col",
        ),
        ("structures", [Crate(3)], "structures[0]: block() gives 3; expected a RockingBlock"),
        (
            "structures",
            [Crate(PIER)],
            "block() gives Column(half_width=0.25, half_height=1.5: 0.5 m",
        ),
        ("structures", {1: PIER}, "structures has the name 1; expected a text"),
        ("structures", {"x": SHAKE}, "structures['x'] is"),
        ("structures", [Column(2.0, 1.0)], "structures[0]: slenderness is 1.10715 rad"),
        ("motions", SHAKE, "expected a list of motions"),
        ("motions", None, "motions is None; expected a list of motions"),
        ("motions", [], "motions is empty; expected at least one motion"),
        ("motions", [SHAKE, "x"], "motions[1] is 'x'; expected a Record or a Pulse"),
        ("motions", [None], "motions[0] is None; expected a Record or a Pulse"),
        ("motions", [SHAKE, STILL], "motions[1]: PGV of record 'still' is 0 m/s; expected more"),
        ("motions", [TINY], "motions[0] scaled to 0.2: record 'tiny': sample 1 of 3 is"),
        ("motions", [Pulse("one-sine", 1.0, 3.0)], "which has no PGV; expected a Record, or a fun"),
        ("motions", [Pulse("harmonic", 1.0, 3.0)], "motions[0] goes on forever; expected a motion"),
        ("levels", [], "levels has shape (0,); expected a list of numbers, not empty"),
        ("levels", 0.5, "levels has shape (); expected a list"),
        ("levels", [[0.1, 0.2]], "levels has shape (1, 2); expected a list"),
        ("levels", [0.1, 0.3, 0.3], "levels[2] is 0.3 after 0.3; expected levels that increase"),
        ("levels", [0.3, 0.1], "levels[1] is 0.1 after 0.3; expected levels that increase"),
        ("levels", [0.0, 0.1], "levels[0] is 0; expected a positive number"),
        ("levels", [-0.1, 0.1], "levels[0] is -0.1; expected a positive number"),
        ("levels", None, "levels: element 0 is None; expected a number"),
        ("levels", [0.1, np.nan], "levels[1] is nan; expected a positive number"),
        ("levels", ["a"], "levels: element 0 is 'a'; expected a number"),
        ("measure", "PGD", "measure is 'PGD'; expected 'PGV', 'PGA' or a function of a motion"),
        ("measure", None, "measure is None; expected 'PGV', 'PGA' or a function of a motion"),
        ("measure", lambda motion: -1.0, "measure of motions[0] is -1; expected more than zero"),
        ("measure", lambda motion: "x", "measure of motions[0] is 'x'; expected a number"),
        ("groups", "ab", "groups is 'ab'; expected a list, the group of each motion"),
        ("groups", ["a"], "groups has 1 elements; expected 2, one for a motion"),
        ("groups", ["a", "b"], "groups is ['a', 'b'], a group for each motion; expected one at"),
        ("lowered", 0.05, "lowered is 0.05; expected a list of shares"),
        ("lowered", [0.05, 1.2], "lowered[1] is 1.2; expected a value from 0 to 1"),
        ("lowered", [0.0], "lowered[0] is 0; expected different shares of √r, each more than 0"),
        ("lowered", [0.1, 0.1], "lowered[1] is 0.1; expected different shares"),
        ("confidence", 1.0, "confidence is 1; expected more than 0 and less than 1"),
        ("confidence", 95, "confidence is 95; expected a value from 0 to 1"),
        ("resamples", 10, "resamples is 10; expected a whole number from 100 on"),
        ("resamples", 1e3, "resamples is 1000.0; expected a whole number"),
        ("seed", -1, "seed is -1; expected a whole number from 0 on"),
    ],
)
def test_bad_argument_is_named_with_its_value(name, value, message):
    with pytest.raises(ValueError, match=re.escape(message)) as caught:
        fragility(**{**GIVEN, name: value})
    error = caught.value
    assert error.__suppress_context__ or error.__context__ is None  # one message, and no other


def test_lowered_needs_a_column():
    with pytest.raises(ValueError, match=re.escape("lowered is [0.1], and structures has no Col")):
        fragility([RockingFrame(PIER, 1.0)], [SHAKE], [0.1], lowered=[0.1])
