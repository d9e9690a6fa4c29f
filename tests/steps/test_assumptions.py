"""What the paper leaves open: the ledger of it, and the alternatives in their limits."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from jsonschema import Draft202012Validator

from replication.inputs.configuration import read_schema
from replication.inputs.strict_yaml import read_yaml
from replication.judging.ledger import read_ledger
from replication.workbench import truth
from steps.assumptions import choices, held, pulses, rankings, run, trilith
from steps.assumptions.alternatives import alternatives
from steps.assumptions.choices import Choices
from topheavy import Column, Pulse, Record, RockingFrame, judge

ROOT = Path(__file__).resolve().parents[2]


def read(path):
    return read_yaml(ROOT / path)


def claims_by_id():
    return {claim.id: claim for claim in read_ledger([ROOT / "paper" / "claims.yaml"])}


WHOLE = read("paper/assumptions.yaml")
LEDGER = WHOLE["open"]
SCHEMA = read_schema(ROOT / "paper/assumptions.schema.yaml")
CONFIG = read("config/config.yaml")
CLAIMS = set(claims_by_id())
COLUMN = Column(0.5, 3.0)
FRAMES = [COLUMN, *(RockingFrame(COLUMN, gamma) for gamma in (0.0, 0.434, 5.0, math.inf))]
BLOCK = COLUMN.block()
COSINE = Pulse("one-cosine", 0.25, 6.0)


# ---------------------------------------------------------------------------- the ledger


def test_the_ledger_is_well_formed():
    Draft202012Validator.check_schema(SCHEMA)
    faults = [error.message for error in Draft202012Validator(SCHEMA).iter_errors(WHOLE)]
    assert faults == []


@pytest.mark.parametrize(
    "change",
    [{"id": "Upper"}, {"alternatives": []}, {"reaches": []}, {"where": "here"}, {"extra": "x"}],
)
def test_the_schema_refuses(change):
    assert not Draft202012Validator(SCHEMA).is_valid(WHOLE | {"open": [LEDGER[0] | change]})


def test_what_an_assumption_requires_is_computed_by_claims_of_ours_that_are_tested():
    ledgers = [ROOT / "paper" / "claims.yaml", *ROOT.glob("studies/*/claims.yaml")]
    claims = {claim.id: claim for claim in read_ledger(ledgers)}
    for row in WHOLE["assumed"]:
        assert row["id"] not in claims
        assert {claims[name].expected for name in row["claims"]} <= {"confirmed", "qualified"}
        assert all(claims[name].study for name in row["claims"])


def test_every_alternative_is_run_and_no_other():
    written = {row["id"]: [item["id"] for item in row["alternatives"]] for row in LEDGER}
    made = alternatives(CONFIG["assumptions"])
    assert {name: sorted(found) for name, found in made.items()} == {
        name: sorted(found) for name, found in written.items()
    }
    assert len(written) == len(LEDGER)


def test_every_alternative_differs_from_ours():
    made = alternatives(CONFIG["assumptions"])
    assert all(item != Choices() for found in made.values() for item in found.values())


def test_every_quantity_is_reached_and_exists():
    assert {name for row in LEDGER for name in row["reaches"]} == set(run.QUANTITIES)


def test_every_claim_of_a_quantity_is_in_the_claims_ledger():
    named = {quantity.claim for quantity in run.QUANTITIES.values()} - {None}
    assert named <= CLAIMS


# ---------------------------------------------------------------------------- structure to block


@pytest.mark.parametrize("structure", FRAMES)
def test_our_choices_are_the_librarys(structure):
    assert Choices().block(structure) == structure.block()


def test_p_goes_with_the_root_of_gravity():
    doubled = Choices(gravity=2.0 * 9.81).block(COLUMN)
    assert doubled.frequency_parameter == pytest.approx(math.sqrt(2.0) * BLOCK.frequency_parameter)
    assert (doubled.slenderness, doubled.restitution) == (BLOCK.slenderness, BLOCK.restitution)


@pytest.mark.parametrize("structure", FRAMES)
def test_a_solid_rectangle_is_the_papers_column(structure):
    factor, restitution = choices.section_factors(structure, choices.RECTANGLE)
    assert factor == pytest.approx(1.0, rel=1e-14)
    assert restitution == pytest.approx(structure.restitution, rel=1e-14)


def test_a_cylinder_has_its_textbook_inertia():
    # m (b²/4 + h²/3) about the centre, and m (b² + h²) for the way to the edge of the base.
    b, h = COLUMN.half_width, COLUMN.half_height
    inertia = b**2 / 4 + h**2 / 3 + b**2 + h**2
    p = math.sqrt(9.81 * COLUMN.size / inertia)
    found = Choices(section=0.25).block(COLUMN)
    assert found.frequency_parameter == pytest.approx(p, rel=1e-14)
    # about the new edge, what was m b (2b) less: (I_o − 2 m b²)/I_o
    assert found.restitution == pytest.approx(1.0 - 2.0 * b**2 / inertia, rel=1e-14)


def test_massless_columns_have_no_section():
    frame = RockingFrame(COLUMN, math.inf)
    assert Choices(section=0.6).block(frame).frequency_parameter == frame.frequency_parameter
    assert Choices(section=0.6).block(frame).restitution == pytest.approx(frame.restitution)


def test_a_frame_with_the_solitary_restitution_has_housners():
    assert choices.solitary_restitution(FRAMES[3]) == COLUMN.restitution
    assert choices.solitary_restitution(COLUMN) == COLUMN.restitution


# ---------------------------------------------------------------------------- ground motion


def peak(motion):
    return judge(BLOCK, motion).peak / BLOCK.slenderness


def test_a_shorter_ramp_is_nearer_to_the_abrupt_start():
    away = [abs(peak(choices.ramped(COSINE, s, 4001)) - peak(COSINE)) for s in (0.1, 0.01)]
    assert 0.0 < away[1] < 0.2 * away[0]


def test_a_ramped_pulse_begins_at_rest_and_ends_as_the_pulse():
    record = choices.ramped(COSINE, 0.25, 401)
    assert record.acceleration[0] == 0.0
    np.testing.assert_allclose(
        record.acceleration[-300:], COSINE.excitation(np.linspace(0.0, COSINE.duration, 401)[-300:])
    )


def test_to_begin_at_uplift_is_the_same():
    sine = Pulse("one-sine", 0.3, 8.0)
    start = math.asin(BLOCK.uplift_acceleration / sine.amplitude) / sine.angular_frequency
    times = np.linspace(start, sine.duration, 4001)
    late = Record(times[1] - times[0], sine.excitation(times))
    assert peak(late) == pytest.approx(peak(sine), rel=1e-5)


def test_a_held_and_a_curved_record_keep_their_samples():
    record = Record(0.1, np.array([0.0, 0.3, -0.2, 0.1]))
    held, curved = choices.held(record), choices.curved(record)
    np.testing.assert_array_equal(held.excitation([0.11, 0.17]), [0.3, 0.3])
    np.testing.assert_allclose(curved.excitation([0.0, 0.1, 0.2, 0.3]), record.acceleration)


# ---------------------------------------------------------------------------- overturning


def test_to_wait_for_long_is_to_judge_by_energy():
    falls = [
        (choices.by_energy(BLOCK, pulse, 3e-10), choices.after(60.0)(BLOCK, pulse, 3e-10))
        for pulse in (COSINE.scaled(factor) for factor in np.linspace(0.8, 8.0, 20))
    ]
    assert all(first == second for first, second in falls)
    assert {first for first, _ in falls} == {True, False}


def test_nothing_is_flat_that_has_just_begun_to_fall():
    strong = Pulse("constant", 1.0, 4.0)
    assert choices.by_energy(BLOCK, strong, 3e-10)
    assert not choices.after(0.0)(BLOCK, strong, 3e-10)


def test_what_overturns_has_gone_beyond_slenderness_and_some_come_back():
    # Zhang & Makris (2001): the survival region of a one-sine, here of the exact equation
    p, level = BLOCK.frequency_parameter, BLOCK.uplift_acceleration
    pulses = [Pulse("one-sine", a * level, 5.0 * p) for a in np.linspace(1.0, 9.0, 81)]
    energy = [choices.by_energy(BLOCK, pulse, 3e-10) for pulse in pulses]
    beyond = [choices.beyond_slenderness(BLOCK, pulse, 3e-10) for pulse in pulses]
    assert all(second for first, second in zip(energy, beyond, strict=True) if first)
    assert sum(beyond) > sum(energy)


# ---------------------------------------------------------------------------- the table


def small_cases():
    entry = CONFIG["trilith"]
    column = CONFIG["structures"][entry["structure"]]
    return {"trilith": entry | {"column": column}}


def test_a_quantity_that_does_not_change_keeps_its_verdict():
    name = "trilith: below uplift"
    ledger = claims_by_id()
    row = {"id": "equation", "alternatives": [{"id": "linearised"}], "reaches": [name]}
    cases = small_cases() | {"assumptions": CONFIG["assumptions"]}
    (found,) = run.main([row], ledger, cases, 3e-12)
    alpha = math.atan(0.275)
    assert found["with_alternative"] == pytest.approx(found["ours"] * 0.275 / alpha)
    assert (found["before"], found["after"], found["changed"]) == ("confirmed", "confirmed", False)


def test_a_verdict_that_is_not_the_ledgers_is_refused():
    name, ledger = "trilith: below uplift", claims_by_id()
    claim = ledger["trilith_stays_below_uplift"]
    ledger[claim.id] = replace(claim, expected="refuted")
    row = {"id": "equation", "alternatives": [{"id": "linearised"}], "reaches": [name]}
    cases = small_cases() | {"assumptions": CONFIG["assumptions"]}
    with pytest.raises(ArithmeticError, match="refuted in the ledger"):
        run.main([row], ledger, cases, 3e-12)


def test_the_smooth_and_the_abrupt_start_are_told_apart():
    cases = small_cases()
    smooth = trilith.no_pure_rocking(Choices(table_starts=(0.0,)), cases)
    abrupt = trilith.no_pure_rocking(Choices(table_starts=(1.0,)), cases)
    assert smooth == (0.0, truth(True, holds_when=True))
    assert abrupt.number > 0.0
    assert abrupt.finding == truth(False, holds_when=False)


@pytest.mark.parametrize("last", [-1, -2])
def test_heavier_frame_that_falls_at_the_same_amplitude_does_not_survive_more(monkeypatch, last):
    found = [1.0 + 0.1 * k for k in range(len(CONFIG["heavier"]["mass_ratios"]))]
    minima = iter([*found[:-1], found[last]])
    monkeypatch.setattr(pulses, "lowest", lambda *given: next(minima))
    case = CONFIG["heavier"] | {"column": {"half_width": 0.5, "half_height": 3.0}}
    assert pulses.heavier_survives_more(Choices(), {"heavier": case}).finding.holds == (last == -1)


def test_records_shake_the_block_of_the_choice(monkeypatch):
    roots = set()

    def seen(block, record, tolerance):
        roots.add(block.restitution)
        return judge(block, record, tolerance=tolerance)

    monkeypatch.setattr(rankings, "judge", seen)
    cases = {
        "rocking_spectra": {
            "column": {"half_width": 0.5, "half_height": 3.0},
            "mass_ratios": [0.0, 1.0],
        },
        "assumptions": {"record_sizes": {"lowest": 2.0, "highest": 4.0, "points": 2}},
        "records": [Record(0.02, 0.4 * np.sin(np.arange(200) / 10))],
    }
    rankings.heavier_falls_alone_under_records(Choices(restitution=lambda frame: 0.75), cases)
    assert roots == {0.75}


@pytest.mark.parametrize(
    ("beside", "holds", "holds_when"),
    [
        (None, False, True),
        (("pinned", "rigid"), True, True),
        (("guided", "rigid"), False, True),
        (("pinned", "2 s"), False, False),
    ],
)
def test_verdict_on_what_uplift_limits_depends_on_the_held_frame(beside, holds, holds_when):
    column = {"half_width": COLUMN.half_width, "half_height": COLUMN.half_height}
    cases = {"uplift_limits": CONFIG["uplift_limits"] | {"column": column}}
    few = CONFIG["assumptions"]["held"] | {"shapes": ["one-sine"], "mass_ratios": [1.0]}
    found = held.limits(Choices(held=beside), cases | {"assumptions": {"held": few}})
    assert found.finding == truth(holds, holds_when=holds_when)
    assert (found.number < 1.0) is holds
