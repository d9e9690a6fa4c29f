"""Verified outcomes: those of the solver, on both sides of boundaries, and in boxes of factors."""

import json
import math
from fractions import Fraction
from itertools import pairwise

import pytest

import topheavy as th
from tests.cases import BLOCK, COLUMN
from topheavy.ground.shapes import FINITE_SHAPES
from topheavy.proven import certified, survives_below
from topheavy.proven.checking import Check, check
from topheavy.proven.prover import problem_of

OMEGA = 2.0 * math.pi / 1.5
PULSE = th.Pulse("one-cosine", 1.0, OMEGA)
MINIMUM = 0.272822711046  # g, of the column

STRUCTURES = [
    COLUMN,
    *(th.RockingFrame(COLUMN, gamma) for gamma in (0.25, 1.0, 4.0, math.inf)),
    *(th.FixedMassColumn(COLUMN, gamma) for gamma in (0.25, 1.0, math.inf)),
    th.FixedMassColumn(COLUMN, 1.0, 2.6, 0.6),
    th.MonolithicPortal(COLUMN, 1.0, 4.2, 0.6),
    BLOCK.linear(),
]


def again(certificate):
    return check(json.loads(json.dumps(certificate)))


@pytest.mark.sampled(2)
@pytest.mark.parametrize("structure", STRUCTURES, ids=repr)
def test_both_sides_of_each_minimum_are_proven(structure):
    """The outcomes and impacts of the kernel, 1e-8 below and above the boundary it finds."""
    for shape in FINITE_SHAPES:
        pulse = th.Pulse(shape, structure.block().uplift_acceleration, OMEGA)
        low, high = th.overturning_intervals(structure, pulse, (1.0, 60.0), resolution=0.02)[
            0
        ].lower
        middle = 0.5 * (low + high)
        for side, outcome in ((-1.0, "survives"), (1.0, "overturns")):
            factor = middle * (1.0 + 1e-8 * side)
            certificate = certified(structure, pulse, factor)
            assert again(certificate) == outcome
            ending = th.judge(structure, pulse.scaled(factor))
            assert ending.overturned == (outcome == "overturns")
            if ending.overturned:
                assert certificate["impacts"] == ending.number_of_impacts


@pytest.mark.parametrize(
    ("shape", "block"), [("one-sine", BLOCK), ("one-cosine", BLOCK.linear())], ids=str
)
def test_outcomes_under_several_cycles_are_those_of_the_kernel(shape, block):
    seen = set()
    for scale in (1.2, 2.1, 3.2, 5.0):
        pulse = th.Pulse(shape, scale * block.uplift_acceleration, 7.0, cycles=3)
        outcome = again(certified(block, pulse))
        assert (outcome == "overturns") == th.judge(block, pulse).overturned
        seen.add(outcome)
    assert len(seen) == 2


@pytest.mark.parametrize(
    "factor", [(0.27282271, 0.27282272), (0.2728, 0.2729), (0.2728, 0.3), (0.1, 0.28)]
)
def test_box_that_contains_a_boundary_is_undecided(factor):
    assert certified(COLUMN, PULSE, factor) is None


def test_search_that_tries_its_last_step_says_so(monkeypatch):
    monkeypatch.setattr("topheavy.proven.prover.MAX_POINT_TRIES", 3)
    with pytest.warns(UserWarning, match="no proof within 3 steps"):
        assert certified(COLUMN, PULSE, 0.28) is None


def test_boundary_is_bracketed_to_twelve_digits_and_boxes_beside_it_are_proven():
    factors = MINIMUM, MINIMUM + 1e-12, (0.2701, 0.2702), (0.28, 0.2801)
    outcomes = [again(certified(COLUMN, PULSE, factor)) for factor in factors]
    assert outcomes == ["survives", "overturns"] * 2


@pytest.mark.parametrize(
    ("shape", "high"), [("half-sine", 0.3571855), ("one-cosine", 0.172), ("one-sine", 0.172)]
)
def test_boxes_are_whole_below_a_bound(shape, high):
    """Under the half-sine up to the minimum, under the others just beyond uplift."""
    pulse = th.Pulse(shape, 1.0, OMEGA)
    assert th.judge(COLUMN, pulse.scaled(high * 1.000001)).overturned == (shape == "half-sine")
    certificates, left = survives_below(COLUMN, pulse, high)
    assert left == []
    assert {again(one) for one in certificates} == {"survives"}
    boxes = [[Fraction(x) for x in one["factor"]] for one in certificates]
    assert (boxes[0][0], boxes[-1][1]) == (0, Fraction(repr(high)))
    assert all(one[1] == other[0] for one, other in pairwise(boxes))
    assert any(one["impacts"] is None for one in certificates)


def test_amplitude_that_overturns_stays_open():
    certificates, left = survives_below(COLUMN, th.Pulse("half-sine", 1.0, OMEGA), 0.36)
    assert left
    assert all(float(one["factor"][1]) < 0.3572 for one in certificates)


@pytest.mark.parametrize("structure", STRUCTURES, ids=repr)
def test_certificate_is_about_the_structure(structure):
    """The checker computes α, p and √r of the dimensions; they are those of the floats."""
    proof = {"outcome": "survives", "impacts": 0, "bits": 112, "order": 4, "events": []}
    block, floats = Check(problem_of(structure, PULSE, 1.0) | proof).block, structure.block()
    for interval, number in (
        (block.alpha, floats.slenderness),
        (block.p_squared, floats.frequency_parameter**2),
        (block.restitution, floats.restitution),
        (block.uplift_level, floats.uplift_acceleration),
        (block.sine, math.sin(floats.slenderness)),
    ):
        assert (interval.high - interval.low) / 2**112 < 1e-30
        assert interval.low / 2**112 == pytest.approx(number, rel=4e-15)
