"""Certificates that somebody changed or wrote: none proves another outcome, none takes long."""

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
from topheavy.proven import certified
from topheavy.proven.checking import NotProven, check, schema
from topheavy.proven.prover import problem_of

PULSE = th.Pulse("one-cosine", 1.0, 2.0 * math.pi / 1.5)


def honest(structure, pulse, factor=1.0):
    return json.loads(json.dumps(certified(structure, pulse, factor)))


def refused(certificate, words):
    with pytest.raises(NotProven, match=words):
        check(certificate)


WITH_IMPACT = honest(COLUMN, PULSE, 0.272822710)
"""A survivor of one impact, 1e-9 below the boundary."""

BOUNDED = honest(COLUMN, PULSE, (0.1664, 0.1685))
"""From below uplift to 1 % above it: the lemma alone."""

KINDS = [
    WITH_IMPACT,
    BOUNDED | {"events": BOUNDED["events"][:3]},  # the form is what counts
    honest(COLUMN, th.Pulse("one-sine", 1.0, 3.0)),
    honest(th.MonolithicPortal(COLUMN, 1.0, 4.0, 0.7, 0.2), th.Pulse("half-sine", 0.3, 4.0)),
]


def test_certificates_have_every_kind_of_event_between_them():
    assert {check(WITH_IMPACT), check(BOUNDED), check(KINDS[2])} == {"survives", "overturns"}
    assert {event["event"] for event in BOUNDED["events"]} == {"walls"}
    kinds = {event["event"] for one in KINDS for event in one["events"]}
    assert kinds == {"uplift", "step", "walls", "gone"}


def impact(certificate):
    return next(event for event in certificate["events"] if event.get("impact"))


def scaled(entries, key, by):
    entries[key] = str(Fraction(entries[key]) * Fraction(by))


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        (lambda c: c.update(outcome="overturns"), "outcome in the certificate: overturns; proven"),
        (lambda c: c.update(impacts=2), "impacts in the certificate: 2; proven: 1"),
        (lambda c: c.update(impacts=None), "impacts in the certificate: None; proven: 1"),
        (lambda c: impact(c).update(impact=None), "there may be an impact"),
        (lambda c: scaled(impact(c), "impact", "11"), "nothing changes its sign|outside"),
        (lambda c: c["events"].pop(), "the pulse has not ended"),
        (lambda c: c["events"].pop(0), "the block is at rest"),
        (lambda c: c["events"].pop(3), "impact|barrier|sign|box|beyond"),
        (lambda c: c["events"].append({"event": "gone"}), "already decided"),
        (lambda c: c["events"].insert(3, {"event": "gone"}), "bring it back|not move outward"),
        (lambda c: c["events"].insert(1, c["events"][0]), "the block is not at rest"),
        (lambda c: c["events"][1].update(h="5"), "no box|beyond the pulse|may be an impact"),
        (lambda c: c["pulse"].update(amplitude="1.00001"), "proven: overturns|barrier|sign"),
        (lambda c: c.update(factor=["0.27282271", "0.2728230"]), "barrier|sign|impact"),
        (lambda c: c["structure"].update(half_height="3.01"), "proven|sign|impact|barrier"),
        (lambda c: c.update(order=6), "barrier|impact|sign|ground"),
        (lambda c: c.update(events=[], impacts=0), "the ground may lift the block"),
    ],
)
def test_changed_certificate_is_refused(change, reason):
    certificate = copy.deepcopy(WITH_IMPACT)
    change(certificate)
    refused(certificate, reason)


@pytest.mark.parametrize("sigma", ["2.2", "4.1", "6"])
def test_uplift_after_the_ground_has_lifted_the_block_is_refused(sigma):
    problem = problem_of(COLUMN, th.Pulse("one-sine", 0.2, 3.0), 1.0)
    proof = {"outcome": "survives", "impacts": 0, "bits": 112, "order": 16}
    events = [{"event": "uplift", "sigma": sigma}]
    refused(problem | proof | {"events": events}, "lift the block earlier|sign")


def walls(event, by):
    event["walls"] = [str(Fraction(x) * Fraction(by)) for x in event["walls"]]


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        (lambda c, e: e.pop(), "the bound ends before the pulse"),
        (lambda c, e: walls(e[40], "999/1000"), "a wall may be passed"),
        (lambda c, e: walls(e[40], "-1"), "a wall is below zero"),
        (lambda c, e: walls(e[40], "100"), "a wall is not below α|may be passed|barrier"),
        (lambda c, e: scaled(e[40], "sigma", "9/10"), "a step goes back"),
        (lambda c, e: e.append(e[-1] | {"sigma": "7"}), "a step comes after the pulse"),
        (lambda c, e: e.insert(40, {"event": "uplift", "sigma": "1"}), "no longer followed"),
        (lambda c, e: c.update(factor=["0.1", "0.18"]), "may be passed|barrier|α"),
        (lambda c, e: c.update(impacts=0), "impacts in the certificate: 0; proven: None"),
        (lambda c, e: e.clear(), "the ground may lift the block"),
    ],
)
def test_changed_bound_is_refused(change, reason):
    certificate = copy.deepcopy(BOUNDED)
    change(certificate, certificate["events"])
    refused(certificate, reason)


@pytest.mark.parametrize("extra", [{}, {"axis": "0", "cap_width": "0", "cap_depth": "0"}])
def test_structure_that_does_not_rock_is_refused(extra):
    """Its √r is negative: a bounce would have a negative velocity."""
    sides = {"half_width": "3", "half_height": "1", "mass_ratio": "0", "gravity": "9.81", **extra}
    structure = {"kind": "body" if extra else "frame", **sides}
    refused(WITH_IMPACT | {"structure": structure}, "√r is outside of 0 to 1")


def places(entries, at=()):
    """Yield the place of each entry of a certificate, from the whole to its numbers."""
    yield at
    inner = entries.items() if isinstance(entries, dict) else ()
    for key, value in enumerate(entries) if isinstance(entries, list) else inner:
        yield from places(value, (*at, key))


def entry(entries, at):
    for key in at:
        entries = entries[key]
    return entries


def put(entries, at, value):
    if not at:
        return value
    result, key = copy.copy(entries), at[0]
    result[key] = put(entries[key], at[1:], value) if at[1:] else value
    return result


GAINS = problem_of(BLOCK, PULSE, 1.0)["structure"] | {"restitution": "1.1"}
WRONG = (None, True, 0, -1, 1.5, math.nan, "x", "", "nan", "1e10", "1/0", "1_0", " 1", "9" * 3000)
WRONG += ([], {}, ["0", "0"], ["0", "1", "2"], 10**30, "0.٥")


def is_of_the_form(certificate):
    try:
        schema.validated(certificate)
    except NotProven:
        return False
    return True


def test_entry_of_another_type_is_refused():
    """Of every type and of none: never accepted, and never another exception."""
    count = 0
    for certificate in KINDS:
        for at in places(certificate):
            for value in WRONG:
                if is_of_the_form(put(certificate, at, value)):
                    types = {type(value), type(entry(certificate, at))}
                    assert len(types) == 1 or type(None) in types  # an impact, or their number
                count += 1
            if at and isinstance(at[-1], str):
                parent = entry(certificate, at[:-1])
                rest = {key: value for key, value in parent.items() if key != at[-1]}
                assert not is_of_the_form(put(certificate, at[:-1], rest))
                assert not is_of_the_form(put(certificate, (*at[:-1], "more"), "1"))
    assert count > 2000


@pytest.mark.parametrize(
    ("key", "value", "words"),
    [
        ("claim", "for every frame", r"certificate has 'claim'; expected structure, linearised"),
        ("factor", ["1", "0.5"], "two in ascending order"),
        ("factor", ["1/3", "1/3"], "expected a decimal as text"),
        ("structure", GAINS, "restitution is '1.1'; expected a number from 0 to 1"),
        ("order", 3, "order is 3; expected a whole number from 4"),
        ("events", [{"event": "__init__"}], "expected one of uplift, step, walls, gone"),
    ],
)
def test_entry_out_of_range_is_named(key, value, words):
    refused(WITH_IMPACT | {key: value}, words)


def test_events_of_another_certificate_prove_its_outcome_or_nothing():
    """Whole, or behind the first events of this one, exchanged, lost or twice."""
    for mine, other in product(KINDS, KINDS):
        first, count = mine["events"], min(4, len(mine["events"]))
        rows = [other["events"]]
        rows += [first[:n] + other["events"][m:] for n in range(count) for m in range(count)]
        rows += [[*first[:n], event, *first[n:]] for n in (1, 2) for event in other["events"][-3:]]
        rows += [[*first[:n], *reversed(first[n : n + 2]), *first[n + 2 :]] for n in range(count)]
        for events in rows:
            with contextlib.suppress(NotProven):
                assert check(mine | {"events": events}) == mine["outcome"]


LARGE = {"sigma": "1000", "impact": "1000", "amplitude": "1e9", "frequency_parameter": "1e9"}


@pytest.mark.parametrize("key", LARGE)
def test_motion_of_any_size_is_refused_without_long_series(key):
    """These took minutes, or ended in an OverflowError."""
    certificate = honest(COLUMN.block(0.6), th.Pulse("ricker-symmetric", 0.25, 4.0))
    for part in (certificate["structure"], certificate["pulse"], *certificate["events"][:2]):
        if key in part:
            part[key] = LARGE[key]
    refused(certificate, "uplift|step")


def test_anyone_can_check_a_file_of_certificates(tmp_path):
    path = tmp_path / "certificates.jsonl.gz"
    some = [
        *(honest(COLUMN, PULSE, factor) for factor in ((0.0, 0.1), (0.1, 0.15), 0.3)),
        honest(COLUMN, th.Pulse("one-cosine", 0.16, PULSE.angular_frequency), 1.01),
    ]
    with gzip.open(path, "wt", encoding="utf-8") as file:
        file.writelines(json.dumps(one) + "\n" for one in some)
    done = run_alone(path)
    assert (done.returncode, done.stderr) == (0, "")
    about, first, second, third, count = done.stdout.splitlines()
    assert about.startswith("frame: half_width 0.5, half_height 3.0, mass_ratio 0.0, gravity 9.81;")
    assert "wave cosine, half_periods 2, angular_frequency 4.188790204786" in about
    assert first.strip() == "survives at each amplitude from 0 to 0.15 g"
    assert second.strip() == "survives at 0.1616 g"
    assert third.strip() == "overturns at 0.3 g"
    assert count == "4 certificates are proven"


@pytest.mark.parametrize(
    ("line", "reason"),
    [
        (json.dumps(WITH_IMPACT | {"outcome": "overturns"}), "the outcome in the certificate"),
        (json.dumps(WITH_IMPACT | {"order": math.nan}), "NaN is no JSON"),
        (json.dumps(WITH_IMPACT)[:-1] + ', "impacts": 1}', "a key occurs twice"),
        ("[" * 90_000, "no JSON"),
        (" " * 200_000, "it is longer than 100000 characters"),
    ],
    ids=["outcome", "NaN", "twice", "nested", "long"],
)
def test_file_with_a_wrong_line_is_refused(tmp_path, line, reason):
    path = tmp_path / "wrong.jsonl"
    path.write_text(f"{json.dumps(WITH_IMPACT)}\n{line}\n", encoding="utf-8")
    done = run_alone(path)
    assert (done.returncode, done.stdout) == (1, "")
    assert f"{path}, line 2 is refused: " in done.stderr
    assert reason in done.stderr
