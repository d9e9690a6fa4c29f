"""The second proof: it accepts what the search proves, and nothing else."""

import ast
import contextlib
import copy
import gzip
import importlib
import json
import math
import re
import subprocess
import sys
from fractions import Fraction
from itertools import product
from pathlib import Path

import pytest

from topheavy import (
    Column,
    FixedMassColumn,
    MonolithicPortal,
    Pulse,
    Record,
    RockingBlock,
    RockingFrame,
)
from topheavy.proven import BlockBox, certified, survives_below
from topheavy.proven.checking import Refused, check, concerns, intervals, schema
from topheavy.proven.checking.intervals import (
    Interval,
    arctangent,
    cosine,
    dot,
    exponential,
    of,
    sine,
)
from topheavy.shapes import ENDING

ROOT = Path(__file__).parents[3]
COLUMN = Column(0.5, 3.0)
STRUCTURES = [
    RockingFrame(COLUMN, 1.0),
    RockingFrame(COLUMN, math.inf),
    FixedMassColumn(COLUMN, 1.0, 0.4, 0.7),
    MonolithicPortal(COLUMN, 1.0, 4.0, 0.7, 0.2),
    COLUMN.block(),
]


def honest(structure, excitation):
    return json.loads(json.dumps(certified(structure, excitation)[1]))


def of_pulse(structure, shape, scale, ratio, **options):
    level = structure.block().uplift_acceleration
    found, certificate = certified(structure, Pulse(shape, scale * level, ratio * 1.5), **options)
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
    pulse, record = Pulse("one-sine", 0.05, 3.0), Record(0.1, [0.0, 0.02, 0.01])
    of_record = certified(structure, record, factor=(0.5, 1.5))[1]
    concerns(of_record, structure, record, (0.5, 1.5))
    certificate = certified(structure, pulse)[1]
    concerns(certificate, structure, pulse)
    for change, reason in (
        ((RockingFrame(COLUMN, 1.00001), pulse), "another structure"),
        ((structure.block().linear(), pulse), "another equation|another structure"),
        ((structure, pulse.scaled(1.0000001)), "another ground"),
        ((structure, Pulse("one-cosine", 0.05, 3.0)), "another ground"),
        ((structure, record), "another ground"),
        ((structure, pulse, (0.9, 1.0)), "another factor"),
    ):
        with pytest.raises(Refused, match=reason):
            concerns(certificate, *change)


def test_record_with_rests_and_a_box_of_factors_are_proven_again():
    values = [0.1, 0.3, -0.3, 0.05, *[0.0] * 60, 0.4, -0.2, 0.1, 0.1, -0.5, 0.5, 0.0]
    found, certificate = certified(COLUMN.block(0.6), Record(0.1, values), factor=0.9)
    assert "rests" in {event["event"] for event in certificate["events"]}
    assert check(certificate) == found.outcome
    found, certificate = certified(COLUMN, Pulse("one-cosine", 1.0, 4.2), factor=(0.26, 0.2600001))
    assert check(certificate) == found.outcome == "survives"


@pytest.fixture(scope="module")
def with_impact():
    """A survivor of one impact, 1e-9 below the boundary."""
    pulse = Pulse("one-cosine", 0.272822710, 2.0 * math.pi / 1.5)
    return honest(COLUMN, pulse)


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
def test_changed_certificate_is_refused(with_impact, change, reason):
    assert check(with_impact) == "survives"
    with pytest.raises(Refused, match=reason):
        check(changed(with_impact, change))


def test_box_that_does_not_hold_the_motion_is_not_believed(with_impact, monkeypatch):
    module, courses = importlib.import_module("topheavy.proven.checking.check"), []

    class Seen(module.Course):
        def __init__(self, *given):
            super().__init__(*given)
            courses.append(self)

    monkeypatch.setattr(module, "Course", Seen)
    boxes = [e for e in with_impact["events"] if e["event"] == "step"]
    empty = {"box": ["0", "0"]}
    assert check(
        changed(with_impact, lambda c: [e.update(empty) for e in c["events"] if "box" in e])
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
    _, certificate = certified(COLUMN, Record(0.1, [0.1, 0.3, -0.3, 0.05, *[0.0] * 60]))
    rests = certificate["events"][-1]
    assert rests["event"] == "rests"
    for key, value in (("sigma", "6"), ("highest", "1e-9")):
        wrong = copy.deepcopy(certificate)
        wrong["events"][-1][key] = [value, value]
        with pytest.raises(Refused, match="rests: "):
            check(wrong)


def test_box_of_structures_has_no_certificate():
    with pytest.raises(ValueError, match="a box has no certificate"):
        certified(BlockBox(2.0, 0.25, (0.8, 0.9)), Pulse("one-sine", 0.5, 3.0))


def test_checker_imports_the_standard_library_and_itself_alone():
    for path in Path(intervals.__file__).parent.glob("*.py"):
        tree = ast.parse(path.read_text(encoding="utf-8"))
        names = [a.name for n in ast.walk(tree) if isinstance(n, ast.Import) for a in n.names]
        own = [n for n in ast.walk(tree) if isinstance(n, ast.ImportFrom)]
        assert {n.level for n in own} <= {0, 1}  # 1 is its own folder
        names += [n.module for n in own if n.level == 0]
        assert all(x.split(".")[0] in sys.stdlib_module_names for x in names)


@pytest.mark.parametrize("number", [-3, -1, 0, 1, 4, 30])
@pytest.mark.parametrize("width", [0, 7])
def test_functions_of_intervals_hold_those_of_the_numbers_inside(number, width):
    from flint import arb

    from topheavy.proven.balls import precision

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


def forged(structure, excitation, events, outcome="survives", impacts=0, **changes):
    """A certificate of a problem with events that somebody wrote."""
    change = {"events": events, "outcome": outcome, "impacts": impacts} | changes
    return json.loads(json.dumps(honest(structure, excitation) | change))


def test_event_that_calls_a_method_is_refused():
    certificate = forged(COLUMN, Pulse("one-cosine", 0.5, 4.2), [])
    other = certified(COLUMN, Pulse("one-cosine", 0.1, 4.2))[1]
    certificate["events"] = json.loads(json.dumps([{"event": "_init__"} | other]))
    with pytest.raises(Refused, match="expected one of uplift"):
        check(certificate)


def test_block_without_rebound_does_not_rest_in_the_air():
    block, pulse = RockingBlock(2.0, 0.2, 0.0), Pulse("half-sine", 1.0, 3.0)
    events = certified(block, pulse)[1]["events"]
    assert check(honest(block, pulse)) == "overturns"
    rests = {"event": "rests", "sigma": ["3", "4"], "highest": ["0", "0"]}
    with pytest.raises(Refused, match="has not just bounced"):
        check(forged(block, pulse, [*events[:2], rests]))


def test_uplift_before_the_block_came_to_rest_is_refused():
    record = Record(0.1, [0.0, 0.75, 0.0, -0.75, *[0.0] * 40])
    certificate = honest(COLUMN, record)
    first = certificate["events"][0]
    assert first["event"] == "uplift"
    certificate["events"] = [first | {"piece": len(record.acceleration)}]
    with pytest.raises(Refused, match="the piece is over, or there is none"):
        check(certificate)


def test_unknown_shape_of_a_certificate_is_refused():
    certificate = forged(COLUMN, Pulse("one-cosine", 0.1, 4.2), [])
    certificate["excitation"]["shape"] = "harmonic"
    with pytest.raises(Refused, match="shape is 'harmonic'; expected one of half-sine"):
        check(certificate)


BLOCK = RockingBlock(2.0, 0.25, 0.9)


def is_accepted(certificate):
    try:
        return bool(check(certificate))
    except Refused:
        return False


def refused(certificate, words):
    with pytest.raises(Refused, match=words):
        check(certificate)


def test_wall_below_zero_is_refused():
    """The potential is periodic: a wall a turn below would be high at both of its ends."""
    below, tiny = "-6.283184307179586476925", "1/1000000000000000000000000000000"
    steps = [
        [["0", "1/10000000000"], "1/10000000000", [below, below]],
        [["0", "6.2831853071796"], "2/10000000000", [tiny, tiny]],
    ]
    bound = {"event": "bounded", "energy": "1/10000000000000000000000000"}
    bound |= {"walls": ["1/1000000", "1/1000000"], "steps": steps}
    refused(forged(BLOCK, Pulse("one-sine", 10.0, 1.0), [bound]), "below zero")


def test_side_that_multiplies_the_motion_is_refused():
    certificate = honest(BLOCK, Pulse("one-sine", 1.0, 3.0))
    certificate["excitation"]["amplitude"] = "0.1"
    for event in certificate["events"]:
        if event["event"] == "uplift":
            event["side"] *= 10
    refused(certificate, r"events\[0\]\.side is -?10; expected one of 1, -1")


def test_bound_without_a_step_is_refused():
    """It would have walls beyond α, and an energy below the barrier on the far side of it."""
    certificate = honest(BLOCK, Pulse("one-sine", 0.60214, 4.0))
    assert certificate["outcome"] == "overturns"
    events = [event for event in certificate["events"] if event["event"] != "gone"]
    energy = repr(0.25 * (1 - math.cos(0.25)) * 0.9999)
    bound = {"event": "bounded", "energy": energy, "walls": ["1.5", "1.5"], "steps": []}
    certificate |= {"outcome": "survives", "events": [*events, bound]}
    refused(certificate, r"steps is \[\]; expected a list of 1 to")


@pytest.mark.parametrize("extra", [{}, {"axis": "0", "cap_width": "0", "cap_depth": "0"}])
def test_structure_that_does_not_rock_is_refused(extra):
    """Its √r is negative: a bounce would have a negative velocity, and rest before it began."""
    certificate = honest(COLUMN, Pulse("one-sine", 0.3, 3.0))
    sides = {"half_width": "3", "half_height": "1", **extra}
    certificate["structure"] |= {"kind": "body" if extra else "frame"} | sides
    refused(certificate, "√r is outside of 0 to 1")


def test_text_that_looks_like_a_number_or_a_statement_is_refused():
    certificate = honest(COLUMN, Pulse("one-sine", 0.1, 3.0))
    for key, value in (("half_width", "0.٥"), ("claim", "for every frame")):
        refused(certificate | {"structure": certificate["structure"] | {key: value}}, "structure")


@pytest.mark.parametrize("restitution", ["1.1", "-0.1"])
def test_block_that_gains_energy_is_refused(restitution):
    certificate = forged(BLOCK, Pulse("one-sine", 0.1, 1.0), [])
    certificate["structure"]["restitution"] = restitution
    refused(certificate, "expected a number from 0 to 1")


def test_short_series_is_refused():
    certificate = honest(BLOCK, Pulse("one-cosine", 1.3, 8.0))
    refused(certificate | {"order": 3}, "below 4")


def test_motion_that_lifts_the_block_before_the_bracket_is_refused():
    uplift = {"event": "uplift", "side": 1, "sigma": ["35/4096", "2275/4096"], "piece": 0}
    events = [uplift | {"jumps": False}]
    refused(forged(BLOCK, Record(0.05, [3.0, -3.0, 0.0], unit="g"), events), "lifted it before")


# Forgeries ----------------------------------------------------------------------------------------


def test_step_that_skips_pieces_is_refused():
    """As a number `last` was added to the piece: the ground rested ever after."""
    values = [0.0, 0.6, *[0.0] * 98, -0.006, 0.0]
    certificate = honest(COLUMN, Record(0.05, values))
    first = next(event for event in certificate["events"] if event["event"] == "step")
    first["last"] = len(values) - 1
    away = {"event": "step", "h": "4", "box": ["0", "0.2"], "impact": None, "last": False}
    place = certificate["events"].index(first)
    events = [*certificate["events"][: place + 1], *[away] * 6, {"event": "gone"}]
    forged_one = certificate | {"events": events, "outcome": "overturns", "impacts": 0}
    refused(forged_one, "last is 101; expected true or false")


def test_bound_under_a_record_is_refused():
    """Of two samples the end is exactly 1: a bound without a step was at it at once."""
    block = RockingBlock(2.0, 0.1, 0.9)
    certificate = honest(block, Record(0.1, [1.0, 1.0], unit="g"))
    last = certificate["events"][-1]
    assert last["event"] in ("step", "gone")
    for steps in ([], [[["1", "1"], "1", ["0.05", "0.05"]]]):
        bound = {"event": "bounded", "energy": "0.0002", "steps": steps, "walls": ["0", "4.44"]}
        events = [*certificate["events"], bound]
        forged_one = certificate | {"events": events, "outcome": "survives", "impacts": 0}
        refused(forged_one, "steps is|a record has no bound")


def places(given, at=()):
    """Yield the place of each entry of a certificate, from the whole to its numbers."""
    yield at
    inner = given.items() if isinstance(given, dict) else ()
    for key, value in enumerate(given) if isinstance(given, list) else inner:
        yield from places(value, (*at, key))


def put(given, at, value):
    if not at:
        return value
    found, key = copy.copy(given), at[0]
    found[key] = put(given[key], at[1:], value) if at[1:] else value
    return found


def without(given, at):
    if len(at) > 1:
        return put(given, at[:1], without(given[at[0]], at[1:]))
    found = copy.copy(given)
    del found[at[0]]
    return found


WRONG = (None, True, 0, -1, 1.5, math.nan, "x", "", "nan", "1e10", "1/0", "1_0", " 1", "9" * 3000)
WRONG += ([], {}, ["0", "0"], ["0", "1", "2"], 10**30)


@pytest.fixture(scope="module")
def kinds(with_impact):
    """Certificates that have every kind of event between them."""
    bounded = next(
        certificate
        for certificate in survives_below(COLUMN, Pulse("one-cosine", 1.0, 4.2), 0.2).certificates
        if "bounded" in {event["event"] for event in certificate["events"]}
    )
    bounded["events"][-1]["steps"][3:] = []  # the form is what counts
    record = Record(0.1, [0.1, 0.3, -0.3, 0.05, *[0.0] * 10, 0.4, -0.2, 0.0])
    portal = MonolithicPortal(COLUMN, 1.0, 4.0, 0.7, 0.2)
    found = [
        with_impact,
        json.loads(json.dumps(bounded)),
        honest(COLUMN.block(0.6), record),
        honest(COLUMN, Pulse("one-sine", 1.0, 3.0)),
        honest(portal, Pulse("ricker-symmetric", 0.05, 4.0)),
    ]
    events = {event["event"] for one in found for event in one["events"]}
    assert events == set(schema.EVENTS)
    return found


def is_of_the_form(certificate):
    try:
        schema.validated(certificate)
    except Refused:
        return False
    return True


def test_entry_of_another_type_is_refused(kinds):
    """Of every type and of none: never accepted, and never another exception."""
    count = 0
    for certificate in kinds:
        for at in places(certificate):
            for value in WRONG:
                if is_of_the_form(put(certificate, at, value)):
                    types = {type(value), type(entry(certificate, at))}
                    assert len(types) == 1 or types == {list, type(None)}  # of an impact
                count += 1
            if at and isinstance(at[-1], str):
                assert not is_of_the_form(without(certificate, at))
                assert not is_of_the_form(put(certificate, (*at[:-1], "more"), "1"))
    assert count > 2000


def entry(given, at):
    for key in at:
        given = given[key]
    return given


@pytest.mark.parametrize("value", ["0", "-1", "0.5", "3"])
def test_no_number_in_the_events_makes_another_outcome(kinds, value):
    """The events are hints: a wrong one proves nothing, or the same."""
    for certificate in kinds:
        for at in places({"events": certificate["events"][:4]}):
            if isinstance(entry(certificate, at), str) and at[-1] != "event":
                with contextlib.suppress(Refused):
                    assert check(put(certificate, at, value)) == certificate["outcome"]


def test_two_events_exchanged_lost_or_twice_make_no_other_outcome(kinds):
    for certificate in kinds:
        events = certificate["events"]
        for n in range(min(6, len(events))):
            for some in (
                [*events[:n], *events[n + 1 :]],
                [*events[: n + 1], *events[n:]],
                [*events[:n], *reversed(events[n : n + 2]), *events[n + 2 :]],
                events[:n],
                [*events, events[n]],
            ):
                with contextlib.suppress(Refused):
                    found = check(certificate | {"events": some})
                    assert found == certificate["outcome"]


def test_events_of_another_certificate_prove_its_outcome_or_nothing(kinds):
    """Whole, or behind the first events of this one, with an event of any kind between them."""
    for mine, other in product(kinds, kinds):
        first, count = mine["events"], min(4, len(mine["events"]))
        rows = [other["events"]]
        rows += [first[:n] + other["events"][m:] for n in range(count) for m in range(count)]
        rows += [[*first[:n], event, *first[n:]] for n in (1, 2) for event in other["events"][-3:]]
        for events in rows:
            with contextlib.suppress(Refused):
                assert check(mine | {"events": events}) == mine["outcome"]


def test_step_of_a_bound_after_the_pulse_is_refused():
    """The ground is at rest there; the wave would go on."""
    pulse = Pulse("one-cosine", 1.0, 4.2)
    found = survives_below(COLUMN, pulse, 0.2, accepts=is_accepted).certificates
    bounded = next(x for x in found if x["events"] and x["events"][-1]["event"] == "bounded")
    until, energy, walls = bounded["events"][-1]["steps"][-1]
    later = [[until[0], str(Fraction(until[1]) + 1)], str(2 * Fraction(energy)), walls]
    bounded["events"][-1]["steps"].append(later)
    refused(bounded, "a step comes after the pulse")


@pytest.mark.parametrize(
    "changes",
    [
        {"sigma": ["1000", "1000"]},
        {"h": "1000", "last": True},
        {"frequency_parameter": "1e9", "angular_frequency": "1e-9"},
    ],
)
def test_motion_of_any_size_is_refused_without_long_series(changes):
    """These took minutes, or ended in an OverflowError."""
    given = honest(COLUMN.block(0.6), Pulse("ricker-symmetric", 0.25, 4.0))
    parts = given["structure"], given["excitation"], *given["events"][:2]
    for part in parts:
        part |= {key: value for key, value in changes.items() if key in part}
    refused(given, "uplift|step")


def test_certificate_of_one_corner_does_not_concern_a_box():
    pulse = Pulse("one-sine", 0.05, 3.0)
    certificate = honest(RockingBlock(2.0, 0.25, 0.9), pulse)
    with pytest.raises(Refused, match="a box of structures has no certificate"):
        concerns(certificate, BlockBox(2.0, 0.25, (0.9, 0.9)), pulse)


@pytest.mark.parametrize(
    "structure",
    [
        Column(0.5 + 1e-13, 3.0),
        Column(0.5, 3.0 - 1e-13),
        RockingFrame(COLUMN, 1e-13),
        COLUMN.block(),
        FixedMassColumn(COLUMN, 1e-300),
    ],
)
def test_certificate_of_a_neighbour_does_not_concern_a_structure(structure):
    pulse = Pulse("one-sine", 0.05, 3.0)
    with pytest.raises(Refused, match="it is about another structure"):
        concerns(honest(COLUMN, pulse), structure, pulse)


def run_alone(*paths):
    """The checker as a folder, without any package but the standard library."""
    folder = Path(intervals.__file__).parent
    command = [sys.executable, "-I", "-S", str(folder), *map(str, paths)]
    return subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)


def test_anyone_can_check_a_file_of_certificates(kinds, tmp_path):
    right, wrong = tmp_path / "right.jsonl.gz", tmp_path / "wrong.jsonl"
    with gzip.open(right, "wt", encoding="utf-8") as file:
        file.writelines(json.dumps(one | {"claim": "a"}) + "\n" for one in (kinds[0], kinds[3]))
    done = run_alone(right)
    assert (done.returncode, done.stderr) == (0, "")
    first, second = done.stdout.splitlines()
    assert "line 1: proven: kind frame, half_width 0.5, half_height 3.0, mass_ratio 0.0" in first
    assert "angular_frequency 3.0, factor 1 to 1: overturns, impacts: 0" in second
    for line, reason in (
        (json.dumps(kinds[0] | {"outcome": "overturns"}), "the certificate says overturns"),
        (json.dumps(kinds[0] | {"order": math.nan}), "NaN is no JSON"),
        (json.dumps(kinds[0])[:-1] + ', "impacts": 1}', "a key stands twice"),
        ("[" * 100_000, "no JSON"),
        ("{", "no JSON"),
    ):
        wrong.write_text(f"{json.dumps(kinds[0])}\n{line}\n", encoding="utf-8")
        done = run_alone(wrong)
        assert done.returncode == 1
        assert "wrong.jsonl, line 2 is refused: " in done.stderr
        assert reason in done.stderr
    wrong.write_text("", encoding="utf-8")
    assert run_alone(wrong).stderr == f"{wrong} holds no certificate\n"
    assert run_alone().returncode == run_alone(tmp_path / "none.jsonl").returncode == 1


def test_command_of_the_readme_proves_the_published_certificates():
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    (name,) = re.findall(r"python3 -I -S src/topheavy/proven/checking (\S+)`", readme)
    assert Path(intervals.__file__).parent.samefile(ROOT / "src/topheavy/proven/checking")
    done = run_alone(ROOT / name)
    assert done.returncode == 0, done.stderr
    assert done.stdout.count(": proven: ") == done.stdout.count("\n") > 200
