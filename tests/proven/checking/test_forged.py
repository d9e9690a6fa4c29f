"""Certificates that somebody wrote: none is accepted, none takes long or raises otherwise."""

import contextlib
import copy
import gzip
import json
import math
from fractions import Fraction
from itertools import product

import pytest

import topheavy as th
from tests.cases import BLOCK, COLUMN, run_alone
from tests.proven.checking.test_checker import WITH_IMPACT, honest
from topheavy.proven import certified, survives_below
from topheavy.proven.checking import Refused, check, schema


def forged(structure, excitation, events, outcome="survives", impacts=0, **changes):
    """A certificate of a problem with events that somebody wrote."""
    change = {"events": events, "outcome": outcome, "impacts": impacts} | changes
    return json.loads(json.dumps(honest(structure, excitation) | change))


def test_event_that_calls_a_method_is_refused():
    certificate = forged(COLUMN, th.Pulse("one-cosine", 0.5, 4.2), [])
    other = certified(COLUMN, th.Pulse("one-cosine", 0.1, 4.2))[1]
    certificate["events"] = json.loads(json.dumps([{"event": "_init__"} | other]))
    with pytest.raises(Refused, match="expected one of uplift"):
        check(certificate)


def test_block_without_rebound_does_not_rest_in_the_air():
    block, pulse = th.RockingBlock(2.0, 0.2, 0.0), th.Pulse("half-sine", 1.0, 3.0)
    events = certified(block, pulse)[1]["events"]
    assert check(honest(block, pulse)) == "overturns"
    rests = {"event": "rests", "sigma": ["3", "4"], "highest": ["0", "0"]}
    with pytest.raises(Refused, match="has not just bounced"):
        check(forged(block, pulse, [*events[:2], rests]))


def test_uplift_before_the_block_came_to_rest_is_refused():
    record = th.Record(0.1, [0.0, 0.75, 0.0, -0.75, *[0.0] * 40])
    certificate = honest(COLUMN, record)
    first = certificate["events"][0]
    assert first["event"] == "uplift"
    certificate["events"] = [first | {"piece": len(record.acceleration)}]
    with pytest.raises(Refused, match="the piece is over, or there is none"):
        check(certificate)


def test_unknown_shape_of_a_certificate_is_refused():
    certificate = forged(COLUMN, th.Pulse("one-cosine", 0.1, 4.2), [])
    certificate["excitation"]["shape"] = "harmonic"
    with pytest.raises(Refused, match="shape is 'harmonic'; expected one of half-sine"):
        check(certificate)


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
    refused(forged(BLOCK, th.Pulse("one-sine", 10.0, 1.0), [bound]), "below zero")


def test_side_that_multiplies_the_motion_is_refused():
    certificate = honest(BLOCK, th.Pulse("one-sine", 1.0, 3.0))
    certificate["excitation"]["amplitude"] = "0.1"
    for event in certificate["events"]:
        if event["event"] == "uplift":
            event["side"] *= 10
    refused(certificate, r"events\[0\]\.side is -?10; expected one of 1, -1")


def test_bound_without_a_step_is_refused():
    """It would have walls beyond α, and an energy below the barrier on the far side of it."""
    certificate = honest(BLOCK, th.Pulse("one-sine", 0.60214, 4.0))
    assert certificate["outcome"] == "overturns"
    events = [event for event in certificate["events"] if event["event"] != "gone"]
    energy = repr(0.25 * (1 - math.cos(0.25)) * 0.9999)
    bound = {"event": "bounded", "energy": energy, "walls": ["1.5", "1.5"], "steps": []}
    certificate |= {"outcome": "survives", "events": [*events, bound]}
    refused(certificate, r"steps is \[\]; expected a list of 1 to")


@pytest.mark.parametrize("extra", [{}, {"axis": "0", "cap_width": "0", "cap_depth": "0"}])
def test_structure_that_does_not_rock_is_refused(extra):
    """Its √r is negative: a bounce would have a negative velocity, and rest before it began."""
    certificate = honest(COLUMN, th.Pulse("one-sine", 0.3, 3.0))
    sides = {"half_width": "3", "half_height": "1", **extra}
    certificate["structure"] |= {"kind": "body" if extra else "frame"} | sides
    refused(certificate, "√r is outside of 0 to 1")


def test_text_that_looks_like_a_number_or_a_statement_is_refused():
    certificate = honest(COLUMN, th.Pulse("one-sine", 0.1, 3.0))
    for key, value in (("half_width", "0.٥"), ("claim", "for every frame")):
        refused(certificate | {"structure": certificate["structure"] | {key: value}}, "structure")


@pytest.mark.parametrize("restitution", ["1.1", "-0.1"])
def test_block_that_gains_energy_is_refused(restitution):
    certificate = forged(BLOCK, th.Pulse("one-sine", 0.1, 1.0), [])
    certificate["structure"]["restitution"] = restitution
    refused(certificate, "expected a number from 0 to 1")


def test_short_series_is_refused():
    certificate = honest(BLOCK, th.Pulse("one-cosine", 1.3, 8.0))
    refused(certificate | {"order": 3}, "below 4")


def test_motion_that_lifts_the_block_before_the_bracket_is_refused():
    uplift = {"event": "uplift", "side": 1, "sigma": ["35/4096", "2275/4096"], "piece": 0}
    events = [uplift | {"jumps": False}]
    refused(forged(BLOCK, th.Record(0.05, [3.0, -3.0, 0.0], unit="g"), events), "lifted it before")


# Forgeries ----------------------------------------------------------------------------------------


def test_step_that_skips_pieces_is_refused():
    """As a number `last` was added to the piece: the ground rested ever after."""
    values = [0.0, 0.6, *[0.0] * 98, -0.006, 0.0]
    certificate = honest(COLUMN, th.Record(0.05, values))
    first = next(event for event in certificate["events"] if event["event"] == "step")
    first["last"] = len(values) - 1
    away = {"event": "step", "h": "4", "box": ["0", "0.2"], "impact": None, "last": False}
    place = certificate["events"].index(first)
    events = [*certificate["events"][: place + 1], *[away] * 6, {"event": "gone"}]
    forged_one = certificate | {"events": events, "outcome": "overturns", "impacts": 0}
    refused(forged_one, "last is 101; expected true or false")


def test_bound_under_a_record_is_refused():
    """Of two samples the end is exactly 1: a bound without a step was at it at once."""
    block = th.RockingBlock(2.0, 0.1, 0.9)
    certificate = honest(block, th.Record(0.1, [1.0, 1.0], unit="g"))
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


def bounded_below():
    """A certificate of the factors just above uplift, which ends in a bound."""
    pulse = th.Pulse("one-cosine", 1.0, 4.2)
    *_, last = survives_below(COLUMN, pulse, 0.17, accepts=is_accepted).certificates
    assert last["events"][-1]["event"] == "bounded"
    return last


@pytest.fixture(scope="module")
def kinds():
    """Certificates that have every kind of event between them."""
    bounded = bounded_below()
    bounded["events"][-1]["steps"][3:] = []  # the form is what counts
    record = th.Record(0.1, [0.1, 0.3, -0.3, 0.05, *[0.0] * 10, 0.4, -0.2, 0.0])
    portal = th.MonolithicPortal(COLUMN, 1.0, 4.0, 0.7, 0.2)
    found = [
        WITH_IMPACT,
        json.loads(json.dumps(bounded)),
        honest(COLUMN.block(0.6), record),
        honest(COLUMN, th.Pulse("one-sine", 1.0, 3.0)),
        honest(portal, th.Pulse("ricker-symmetric", 0.05, 4.0)),
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
    bounded = bounded_below()
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
    given = honest(COLUMN.block(0.6), th.Pulse("ricker-symmetric", 0.25, 4.0))
    parts = given["structure"], given["excitation"], *given["events"][:2]
    for part in parts:
        part |= {key: value for key, value in changes.items() if key in part}
    refused(given, "uplift|step")


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
