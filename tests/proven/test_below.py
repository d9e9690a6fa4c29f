"""Boxes of factors from zero: whole where nothing overturns, open where something does."""

import copy
import json
import math
from fractions import Fraction

import pytest

from topheavy import Column, Pulse, judge
from topheavy.proven import certified, survives_below
from topheavy.proven.checking import Refused, check

COLUMN = Column(0.5, 3.0)
PULSE = Pulse("one-cosine", 1.0, 2.0 * math.pi / 1.5)


def edges(certificates):
    return [[float(Fraction(x)) for x in each["factor"]] for each in certificates]


def kinds(certificates):
    return [{event["event"] for event in each["events"]} for each in certificates]


@pytest.mark.parametrize("shape", ["one-cosine", "one-sine"])
def test_boxes_are_whole_below_a_bound(shape):
    pulse, high = Pulse(shape, 1.0, PULSE.angular_frequency), 0.178
    found = survives_below(COLUMN, pulse, high)
    assert not found.open
    boxes = edges(found.certificates)
    assert (boxes[0][0], boxes[-1][1]) == (0.0, high)
    assert all(one[1] == other[0] for one, other in zip(boxes[:-1], boxes[1:], strict=True))
    assert any("bounded" in each for each in kinds(found.certificates))
    assert not any(judge(COLUMN, pulse.scaled(top)).overturned for _, top in boxes)


def test_range_that_overturns_stays_open():
    found = survives_below(COLUMN, Pulse("one-cosine", 0.2728, PULSE.angular_frequency), 1.0002)
    assert found.open
    assert all(low <= 1.00009 < 1.0002 >= high for low, high in found.open[-1:])
    assert edges(found.certificates)[-1][1] < 0.272822712 / 0.2728


def bounded(factor):
    found, certificate = certified(COLUMN, PULSE, factor=factor, bits=72, bounded=True)
    return found, json.loads(json.dumps(certificate))


@pytest.fixture(scope="module")
def box():
    """From below uplift to 2 % above it: the lemma alone."""
    found, certificate = bounded((0.166, 0.17))
    assert found.outcome == "survives"
    assert kinds([certificate]) == [{"bounded"}]
    return certificate


def test_lemma_is_proven_again(box):
    assert check(box) == "survives"
    for factor in ((0.1701, 0.17012), (0.2168456, 0.2168458)):  # impacts, and then the lemma
        found, certificate = bounded(factor)
        assert check(certificate) == found.outcome == "survives"
    assert certificate["events"][-2].get("about_end")  # it lands as the pulse ends


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
        (lambda c, e: e.update(released=True, steps=e["steps"][:60]), "it may|may still"),
        (lambda c, e: c.update(factor=["1/10", "18/100"]), "may be passed|may grow|barrier"),
        (lambda c, e: c["events"].clear(), "may lift"),
    ],
)
def test_changed_bound_is_refused(box, change, reason):
    wrong = copy.deepcopy(box)
    change(wrong, wrong["events"][0])
    with pytest.raises(Refused, match=reason):
        check(wrong)
