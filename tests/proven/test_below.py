"""Boxes of factors from zero: whole where nothing overturns, open where something does."""

import copy
import json
import math
from fractions import Fraction
from itertools import pairwise

import pytest

from topheavy import Column, Pulse, judge
from topheavy.proven import certified, survives_below
from topheavy.proven.checking import Refused, check

COLUMN = Column(0.5, 3.0)
PULSE = Pulse("one-cosine", 1.0, 2.0 * math.pi / 1.5)


def edges(certificates):
    return [[float(Fraction(x)) for x in each["factor"]] for each in certificates]


def without_gap(found, high):
    """Return the number of boxes, which have to follow each other from zero up to `high`."""
    assert not found.open
    boxes = edges(found.certificates)
    assert (boxes[0][0], boxes[-1][1]) == (0.0, high)
    assert all(one[1] == other[0] for one, other in pairwise(boxes))
    return len(boxes)


def kinds(certificates):
    return [{event["event"] for event in each["events"]} for each in certificates]


@pytest.mark.parametrize("shape", ["one-cosine", "one-sine"])
def test_boxes_are_whole_below_a_bound(shape):
    pulse, high = Pulse(shape, 1.0, PULSE.angular_frequency), 0.172
    found = survives_below(COLUMN, pulse, high)
    without_gap(found, high)
    assert any("bounded" in each for each in kinds(found.certificates))
    assert not any(
        judge(COLUMN, pulse.scaled(top)).overturned for _, top in edges(found.certificates)
    )


def bounded(factor):
    found, certificate = certified(COLUMN, PULSE, factor=factor, bits=72, bounded=True)
    return found, json.loads(json.dumps(certificate))


@pytest.mark.parametrize("factor", [(0.2728, 0.2729), (0.2728, 0.3), (0.28, 0.29)])
def test_box_in_which_one_overturns_is_not_said_to_survive(factor):
    assert judge(COLUMN, PULSE.scaled(factor[1])).overturned
    assert bounded(factor)[0].outcome in ("undecided", "overturns")


@pytest.fixture(scope="module")
def box():
    """From below uplift to 1 % above it: the lemma alone."""
    found, certificate = bounded((0.1664, 0.1685))
    assert found.outcome == "survives"
    assert kinds([certificate]) == [{"bounded"}]
    return certificate


def test_lemma_is_proven_again(box):
    assert check(box) == "survives"


def smaller(event, place, by="9999/10000"):
    steps = event["steps"]
    steps[40][place] = str(Fraction(steps[40][place]) * Fraction(by))


def wall(event, by="999/1000"):
    steps = event["steps"]
    steps[40][2] = [str(Fraction(x) * Fraction(by)) for x in steps[40][2]]


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        (lambda c, e: e.update(steps=e["steps"][:-1]), "the bound ends before the pulse"),
        (lambda c, e: smaller(e, 1, "9/10"), "the energy may grow more"),
        (lambda c, e: wall(e), "a wall may be passed"),
        (lambda c, e: e.update(energy="-1"), "not negative"),
        (lambda c, e: c.update(factor=["1/10", "18/100"]), "may be passed|may grow|barrier"),
        (lambda c, e: c["events"].clear(), "may lift"),
    ],
)
def test_changed_bound_is_refused(box, change, reason):
    wrong = copy.deepcopy(box)
    change(wrong, wrong["events"][0])
    with pytest.raises(Refused, match=reason):
        check(wrong)


@pytest.mark.parametrize(("shape", "high"), [("half-sine", 0.3571855), ("one-cosine", 0.181)])
def test_boxes_of_the_column_are_proven_twice(shape, high):
    """Under the half-sine up to its minimum, under the one-cosine the first part only."""
    pulse, answers = Pulse(shape, 1.0, PULSE.angular_frequency), []

    def proven_twice(certificate):
        try:
            answers.append(check(certificate) == "survives")
        except Refused:
            answers.append(False)
        return answers[-1]

    assert judge(COLUMN, pulse.scaled(high * 1.000001)).overturned == (shape == "half-sine")
    found = survives_below(COLUMN, pulse, high, accepts=proven_twice)
    assert sum(answers) == without_gap(found, high)
    assert not all(answers)  # what is refused is tried again narrower
