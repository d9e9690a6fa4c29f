"""What the paper leaves open: the ledger of it, and the alternatives in their limits."""

import math
from dataclasses import replace

import numpy as np
import pytest
from jsonschema import Draft202012Validator

import topheavy as th
from replication.inputs.configuration import read_schema
from replication.inputs.strict_yaml import read_yaml
from replication.judging.ledger import read_ledger
from replication.workbench import truth
from steps.assumptions import choices, held, pulses, rankings, run, trilith
from steps.assumptions.alternatives import alternatives
from steps.assumptions.choices import Choices
from tests.cases import COLUMN, ROOT, SIZES

WHOLE = read_yaml(ROOT / "paper/assumptions.yaml")
LEDGER = WHOLE["open"]
SCHEMA = Draft202012Validator(read_schema(ROOT / "paper/assumptions.schema.yaml"))
CONFIG = read_yaml(ROOT / "config/config.yaml")
CLAIMS = {claim.id: claim for claim in read_ledger([ROOT / "paper" / "claims.yaml"])}
FRAMES = [COLUMN, *(th.RockingFrame(COLUMN, gamma) for gamma in (0.0, 0.434, 5.0, math.inf))]
BLOCK = COLUMN.block()
P, LEVEL = BLOCK.frequency_parameter, BLOCK.uplift_acceleration
COSINE = th.Pulse("one-cosine", 0.25, 6.0)


# ---------------------------------------------------------------------------- the ledger


def test_the_ledger_is_well_formed_and_each_alternative_in_it_is_run():
    Draft202012Validator.check_schema(SCHEMA.schema)
    assert [error.message for error in SCHEMA.iter_errors(WHOLE)] == []
    written = {row["id"]: sorted(item["id"] for item in row["alternatives"]) for row in LEDGER}
    made = alternatives(CONFIG["assumptions"])
    assert {name: sorted(found) for name, found in made.items()} == written
    assert len(written) == len(LEDGER)
    assert all(item != Choices() for found in made.values() for item in found.values())
    assert {name for row in LEDGER for name in row["reaches"]} == set(run.QUANTITIES)
    assert {quantity.claim for quantity in run.QUANTITIES.values()} - {None} <= set(CLAIMS)


def test_what_an_assumption_requires_is_computed_by_claims_of_ours_that_are_tested():
    ledgers = [ROOT / "paper" / "claims.yaml", *ROOT.glob("studies/*/claims.yaml")]
    claims = {claim.id: claim for claim in read_ledger(ledgers)}
    assert WHOLE["assumed"]
    for row in WHOLE["assumed"]:
        assert row["id"] not in claims
        assert {claims[name].expected for name in row["claims"]} <= {"confirmed", "qualified"}
        assert all(claims[name].study for name in row["claims"])


# ---------------------------------------------------------------------------- structure to block


@pytest.mark.parametrize("structure", FRAMES)
def test_our_choices_are_the_librarys_and_a_solid_rectangle_the_papers_column(structure):
    assert Choices().block(structure) == structure.block()
    factor, restitution = choices.section_factors(structure, choices.RECTANGLE)
    assert (factor, restitution) == pytest.approx((1.0, structure.restitution), rel=1e-14)


def test_gravity_section_and_restitution_change_what_they_are_about():
    doubled = Choices(gravity=2.0 * 9.81).block(COLUMN)
    assert doubled.frequency_parameter == pytest.approx(math.sqrt(2.0) * P)
    assert (doubled.slenderness, doubled.restitution) == (BLOCK.slenderness, BLOCK.restitution)
    massless = th.RockingFrame(COLUMN, math.inf)  # its columns have no section
    found = Choices(section=0.6).block(massless)
    assert found.frequency_parameter == massless.frequency_parameter
    assert found.restitution == pytest.approx(massless.restitution)
    for structure in (FRAMES[3], COLUMN):
        assert choices.solitary_restitution(structure) == COLUMN.restitution


# ---------------------------------------------------------------------------- ground motion


def peak(motion):
    return th.judge(BLOCK, motion).peak / BLOCK.slenderness


def test_a_ramped_pulse_begins_at_rest_and_a_shorter_ramp_is_nearer_to_the_abrupt_start():
    away = [abs(peak(choices.ramped(COSINE, s, 4001)) - peak(COSINE)) for s in (0.1, 0.01)]
    assert 0.0 < away[1] < 0.2 * away[0]
    record = choices.ramped(COSINE, 0.25, 401).acceleration
    assert record[0] == 0.0
    later = COSINE.excitation(np.linspace(0.0, COSINE.duration, 401)[-300:])
    np.testing.assert_allclose(record[-300:], later)


def test_a_held_and_a_curved_record_keep_their_samples():
    record = th.Record(0.1, np.array([0.0, 0.3, -0.2, 0.1]))
    curved = choices.curved(record).excitation([0.0, 0.1, 0.2, 0.3])
    np.testing.assert_array_equal(choices.held(record).excitation([0.11, 0.17]), [0.3, 0.3])
    np.testing.assert_allclose(curved, record.acceleration)


# ---------------------------------------------------------------------------- overturning


def falls(judged, pulses):
    return [judged(BLOCK, pulse, 3e-10) for pulse in pulses]


def test_to_wait_for_long_is_to_judge_by_energy():
    pulses = [COSINE.scaled(factor) for factor in np.linspace(0.8, 8.0, 20)]
    found = falls(choices.by_energy, pulses)
    assert found == falls(choices.after(60.0), pulses)
    assert set(found) == {True, False}
    strong = [th.Pulse("constant", 1.0, 4.0)]  # nothing is flat that has just begun to fall
    assert (falls(choices.by_energy, strong), falls(choices.after(0.0), strong)) == ([1], [0])


def test_what_overturns_has_gone_beyond_slenderness_and_some_come_back():
    # Zhang & Makris (2001): the survival region of a one-sine, here of the exact equation
    pulses = [th.Pulse("one-sine", a * LEVEL, 5.0 * P) for a in np.linspace(1.0, 9.0, 81)]
    energy, beyond = (
        falls(each, pulses) for each in (choices.by_energy, choices.beyond_slenderness)
    )
    assert all(second for first, second in zip(energy, beyond, strict=True) if first)
    assert sum(beyond) > sum(energy) > 0


# ---------------------------------------------------------------------------- the table

ENTRY = CONFIG["trilith"]
CASES = {"trilith": ENTRY | {"column": CONFIG["structures"][ENTRY["structure"]]}}
CASES |= {"assumptions": CONFIG["assumptions"]}
LINEARISED = {"id": "equation", "alternatives": [{"id": "linearised"}]}
LINEARISED |= {"reaches": ["trilith: below uplift"]}


def test_a_quantity_that_does_not_change_keeps_its_verdict_and_it_is_the_ledgers():
    (found,) = run.main([LINEARISED], CLAIMS, CASES, 3e-12)
    alpha = math.atan(0.275)
    assert found["with_alternative"] == pytest.approx(found["ours"] * 0.275 / alpha)
    assert (found["before"], found["after"], found["changed"]) == ("confirmed", "confirmed", False)
    name = "trilith_stays_below_uplift"
    refuted = CLAIMS | {name: replace(CLAIMS[name], expected="refuted")}
    with pytest.raises(ArithmeticError, match="refuted in the ledger"):
        run.main([LINEARISED], refuted, CASES, 3e-12)


def test_the_smooth_and_the_abrupt_start_are_told_apart():
    smooth = trilith.no_pure_rocking(Choices(table_starts=(0.0,)), CASES)
    abrupt = trilith.no_pure_rocking(Choices(table_starts=(1.0,)), CASES)
    assert smooth == (0.0, truth(True, holds_when=True))
    assert abrupt.number > 0.0
    assert abrupt.finding == truth(False, holds_when=False)


@pytest.mark.parametrize("last", [-1, -2])
def test_heavier_frame_that_falls_at_the_same_amplitude_does_not_survive_more(given, last):
    found = [1.0 + 0.1 * k for k in range(len(CONFIG["heavier"]["mass_ratios"]))]
    minima = iter([*found[:-1], found[last]])
    given(pulses, lowest=lambda *case: next(minima))
    case = {"heavier": CONFIG["heavier"] | {"column": SIZES}}
    assert pulses.heavier_survives_more(Choices(), case).finding.holds == (last == -1)


def test_records_shake_the_block_of_the_choice(given):
    roots = set()

    def seen(block, record, tolerance):
        roots.add(block.restitution)
        return th.judge(block, record, tolerance=tolerance)

    given(rankings, judge=seen)
    cases = {
        "rocking_spectra": {"column": SIZES, "mass_ratios": [0.0, 1.0]},
        "assumptions": {"record_sizes": {"lowest": 2.0, "highest": 4.0, "points": 2}},
        "records": [th.Record(0.02, 0.4 * np.sin(np.arange(200) / 10))],
    }
    rankings.heavier_falls_alone_under_records(Choices(restitution=lambda frame: 0.75), cases)
    assert roots == {0.75}


@pytest.mark.parametrize(
    ("beside", "holds", "holds_when"),
    [
        *((None, False, True), (("pinned", "rigid"), True, True)),
        *((("guided", "rigid"), False, True), (("pinned", "2 s"), False, False)),
    ],
)
def test_verdict_on_what_uplift_limits_depends_on_the_held_frame(beside, holds, holds_when):
    few = CONFIG["assumptions"]["held"] | {"shapes": ["one-sine"], "mass_ratios": [1.0]}
    cases = {"uplift_limits": CONFIG["uplift_limits"] | {"column": SIZES}}
    found = held.limits(Choices(held=beside), cases | {"assumptions": {"held": few}})
    assert found.finding == truth(holds, holds_when=holds_when)
    assert (found.number < 1.0) is holds
