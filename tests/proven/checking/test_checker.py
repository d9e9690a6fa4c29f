"""The checker of certificates, and its interval arithmetic."""

import ast
import copy
import importlib
import json
import math
import sys
from fractions import Fraction
from itertools import product
from pathlib import Path

import pytest
from flint import arb

import topheavy as th
from tests.cases import COLUMN
from topheavy.ground.shapes import ENDING
from topheavy.proven import BlockBox, certified
from topheavy.proven.balls import precision
from topheavy.proven.checking import Refused, check, concerns, intervals
from topheavy.proven.checking.intervals import (
    Interval,
    arctangent,
    cosine,
    dot,
    exponential,
    of,
    sine,
)

STRUCTURES = [
    th.RockingFrame(COLUMN, 1.0),
    th.RockingFrame(COLUMN, math.inf),
    th.FixedMassColumn(COLUMN, 1.0, 0.4, 0.7),
    th.MonolithicPortal(COLUMN, 1.0, 4.0, 0.7, 0.2),
    COLUMN.block(),
]


def honest(structure, excitation):
    return json.loads(json.dumps(certified(structure, excitation)[1]))


def of_pulse(structure, shape, scale, ratio, **options):
    level = structure.block().uplift_acceleration
    found, certificate = certified(
        structure, th.Pulse(shape, scale * level, ratio * 1.5), **options
    )
    return found, json.loads(json.dumps(certificate))


@pytest.mark.parametrize("linearised", [False, True])
@pytest.mark.parametrize("shape", ENDING)
def test_proven_outcomes_are_proven_again(shape, linearised):
    place = ENDING.index(shape) + linearised
    for n, (scale, ratio) in enumerate(((0.9, 3.0), (1.7, 2.0), (3.1, 5.0), (9.0, 4.0))):
        structure = STRUCTURES[(place + n) % len(STRUCTURES)]
        found, certificate = of_pulse(structure, shape, scale, ratio, linearised=linearised)
        assert check(certificate) == found.outcome


@pytest.mark.parametrize("structure", [COLUMN, *STRUCTURES])
def test_certificate_is_about_the_problem_that_was_asked_alone(structure):
    pulse, record = th.Pulse("one-sine", 0.05, 3.0), th.Record(0.1, [0.0, 0.02, 0.01])
    of_record = certified(structure, record, factor=(0.5, 1.5))[1]
    concerns(of_record, structure, record, (0.5, 1.5))
    certificate = certified(structure, pulse)[1]
    concerns(certificate, structure, pulse)
    for change, reason in (
        ((th.RockingFrame(COLUMN, 1.00001), pulse), "another structure"),
        ((structure.block().linear(), pulse), "another equation|another structure"),
        ((structure, pulse.scaled(1.0000001)), "another ground"),
        ((structure, th.Pulse("one-cosine", 0.05, 3.0)), "another ground"),
        ((structure, record), "another ground"),
        ((structure, pulse, (0.9, 1.0)), "another factor"),
    ):
        with pytest.raises(Refused, match=reason):
            concerns(certificate, *change)


WITH_IMPACT = honest(COLUMN, th.Pulse("one-cosine", 0.272822710, 2.0 * math.pi / 1.5))
"""A survivor of one impact, 1e-9 below the boundary."""


def changed(certificate, change):
    found = copy.deepcopy(certificate)
    change(found)
    return found


def impact(certificate):
    return next(e for e in certificate["events"] if e.get("impact"))


def later(certificate, by):
    event = impact(certificate)
    event["impact"] = [str(Fraction(x) * by) for x in event["impact"]]


def of_columns_height(c):
    c["structure"]["half_height"] = "3.01"


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        (lambda c: c.update(outcome="overturns"), "the certificate says overturns"),
        (lambda c: c.update(impacts=2), "after 2 impacts"),
        (lambda c: impact(c).update(impact=None), "there may be an impact"),
        (lambda c: later(c, Fraction(9, 10)), "nothing changes its sign|barrier"),
        (lambda c: later(c, Fraction(1000001, 1000000)), "nothing changes its sign|barrier"),
        (lambda c: c["events"].pop(), "the forcing has not ended"),
        (lambda c: c["events"].pop(0), "the block is at rest"),
        (lambda c: c["events"].pop(3), "the piece|impact|prove|barrier|sign|box"),
        (lambda c: c["events"].append({"event": "gone"}), "may bring it back|not move outward"),
        (lambda c: c["events"][1].update(h="5"), "no box|beyond the piece|may be an impact"),
        (lambda c: c["excitation"].update(amplitude="0.2728228"), "proves|prove|barrier|sign"),
        (lambda c: c.update(factor=["1", "1.000001"]), "barrier|sign|impact"),
        (of_columns_height, "prove|sign|impact|barrier"),
        (lambda c: c.update(order=6), "barrier|impact|sign|land"),
    ],
)
def test_changed_certificate_is_refused(change, reason):
    assert check(WITH_IMPACT) == "survives"
    with pytest.raises(Refused, match=reason):
        check(changed(WITH_IMPACT, change))


def test_box_that_does_not_hold_the_motion_is_not_believed(monkeypatch):
    module, courses = importlib.import_module("topheavy.proven.checking.checker"), []

    class Seen(module.Course):
        def __init__(self, *given):
            super().__init__(*given)
            courses.append(self)

    monkeypatch.setattr(module, "Course", Seen)
    boxes = [e for e in WITH_IMPACT["events"] if e["event"] == "step"]
    empty = {"box": ["0", "0"]}
    assert check(
        changed(WITH_IMPACT, lambda c: [e.update(empty) for e in c["events"] if "box" in e])
    )
    assert len(courses) == len(boxes) > 3
    for course in courses:
        phi = course.at(of(Fraction(1, 2)))[0]
        assert course.box.low <= phi.low <= phi.high <= course.box.high


def test_uplift_that_comes_earlier_or_later_is_refused():
    _, certificate = of_pulse(COLUMN, "one-sine", 1.1, 3.0)
    assert check(certificate) == "survives"
    for by in (Fraction(9, 10), Fraction(11, 10)):
        wrong = copy.deepcopy(certificate)
        wrong["events"][0]["sigma"] = [str(Fraction(x) * by) for x in wrong["events"][0]["sigma"]]
        with pytest.raises(Refused, match=r"nothing changes its sign|may be an impact"):
            check(wrong)
    wrong = changed(certificate, lambda c: c.update(events=[], impacts=0))
    with pytest.raises(Refused, match="the ground may lift the block"):
        check(wrong)


def test_rest_that_is_not_proven_is_refused():
    _, certificate = certified(COLUMN, th.Record(0.1, [0.1, 0.3, -0.3, 0.05, *[0.0] * 60]))
    rests = certificate["events"][-1]
    assert rests["event"] == "rests"
    for key, value in (("sigma", "6"), ("highest", "1e-9")):
        wrong = copy.deepcopy(certificate)
        wrong["events"][-1][key] = [value, value]
        with pytest.raises(Refused, match="rests: "):
            check(wrong)


def test_box_of_structures_has_no_certificate():
    with pytest.raises(ValueError, match="a box has no certificate"):
        certified(BlockBox(2.0, 0.25, (0.8, 0.9)), th.Pulse("one-sine", 0.5, 3.0))


def test_checker_imports_the_standard_library_and_itself_alone():
    paths = [*Path(intervals.__file__).parent.glob("*.py")]
    assert len(paths) > 5
    for path in paths:
        tree = ast.parse(path.read_text(encoding="utf-8"))
        names = [a.name for n in ast.walk(tree) if isinstance(n, ast.Import) for a in n.names]
        own = [n for n in ast.walk(tree) if isinstance(n, ast.ImportFrom)]
        assert {n.level for n in own} <= {0, 1}  # 1 is its own folder
        names += [n.module for n in own if n.level == 0]
        assert all(x.split(".")[0] in sys.stdlib_module_names for x in names)


def test_certificate_of_one_corner_does_not_concern_a_box():
    pulse = th.Pulse("one-sine", 0.05, 3.0)
    certificate = honest(th.RockingBlock(2.0, 0.25, 0.9), pulse)
    with pytest.raises(Refused, match="a box of structures has no certificate"):
        concerns(certificate, BlockBox(2.0, 0.25, (0.9, 0.9)), pulse)


@pytest.mark.parametrize(
    "structure",
    [
        th.Column(0.5 + 1e-13, 3.0),
        th.Column(0.5, 3.0 - 1e-13),
        th.RockingFrame(COLUMN, 1e-13),
        COLUMN.block(),
        th.FixedMassColumn(COLUMN, 1e-300),
    ],
)
def test_certificate_of_a_neighbour_does_not_concern_a_structure(structure):
    pulse = th.Pulse("one-sine", 0.05, 3.0)
    with pytest.raises(Refused, match="it is about another structure"):
        concerns(honest(COLUMN, pulse), structure, pulse)


@pytest.mark.parametrize("number", [-3, -1, 0, 1, 4, 30])
@pytest.mark.parametrize("width", [0, 7])
def test_functions_of_intervals_hold_those_of_the_numbers_inside(number, width):
    intervals.precision(90)
    x = Fraction(number) + Fraction(1, 3)
    interval = of(x).hull(of(x + Fraction(width, 100)))
    pairs = [(sine, arb.sin), (cosine, arb.cos)]
    if number >= 0:
        pairs += [(arctangent, arb.atan), (exponential, lambda y: (-y).exp())]
    with precision(200):
        for mine, true in pairs:
            found = mine(interval)
            for k in range(width + 1):
                y = x + Fraction(k, 100)
                scaled = true(arb(y.numerator) / y.denominator) * intervals.UNIT
                assert found.low <= scaled
                assert found.high >= scaled
            assert width or found.high - found.low < 2**12


def test_arithmetic_of_intervals_is_rounded_outward():
    intervals.precision(8)
    third, seventh = of(Fraction(1, 3)), of(Fraction(-1, 7))
    for found, true in (
        (third, Fraction(1, 3)),
        (third * seventh, Fraction(-1, 21)),
        (third / seventh, Fraction(-7, 3)),
        (third / -3, Fraction(-1, 9)),
        (third - seventh, Fraction(10, 21)),
        ((third * third).root(), Fraction(1, 3)),
        (Interval(-5, 3).size(), Fraction(5, 256)),
    ):
        assert Fraction(found.low, 256) <= true <= Fraction(found.high, 256)
        assert found.high - found.low < 40


def test_sum_of_products_has_the_ends_of_its_corners_whatever_their_signs():
    intervals.precision(0)
    spans = [Interval(a, b) for a in range(-2, 3) for b in range(a, 3)]
    for x, y in product(spans, spans):
        corners = [p * q for p in (x.low, x.high) for q in (y.low, y.high)]
        for found in (x * y, dot([x, of(1), of(9)], [y, of(0)])):
            assert (found.low, found.high) == (min(corners), max(corners))
