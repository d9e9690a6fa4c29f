"""The step on what uplift limits, on cases that are known."""

import math

import numpy as np
import pandas as pd
import pytest
from scipy.integrate import solve_ivp

from replication.workbench import truth
from steps import uplift_limits
from steps.shared.histories import history
from steps.shared.peak_forces import (
    FORCES,
    GUIDED,
    PINNED,
    held,
    held_peaks,
    impact_impulse,
    ratio_of,
    rocking_peaks,
    shear_after_uplift,
)
from topheavy import (
    Cap,
    Column,
    FixedFrame,
    Pulse,
    Record,
    RockingFrame,
    impact_impulses,
    peak_elastic,
    peak_rigid,
    simulate,
)

COLUMN, CAP = Column(0.5, 3.0), Cap(5.0, 0.5)
FRAME = RockingFrame(COLUMN, 1.0)
TAN = COLUMN.uplift_acceleration


def pulse(amplitude, shape="one-sine", ratio=4.0):
    return Pulse(shape, amplitude * TAN, ratio * COLUMN.frequency_parameter)


def test_frame_that_does_not_uplift_has_the_forces_of_the_ground():
    found = rocking_peaks(FRAME, CAP, pulse(0.9), 8)
    assert found.outcome == "no uplift"
    assert found.forces["base_shear"] == pytest.approx(0.9 * TAN, rel=1e-3)
    assert (found.rotation, found.impulse) == (0.0, 0.0)


def test_frame_that_overturns_has_no_peaks():
    found = rocking_peaks(FRAME, CAP, pulse(20.0), 8)
    assert found.outcome == "overturned"
    assert all(math.isnan(found.forces[name]) for name in FORCES)


def test_sudden_pulse_has_the_shear_of_uplift_as_its_largest():
    found = rocking_peaks(FRAME, CAP, pulse(3.0, "one-cosine", 8.0), 8)
    expected = shear_after_uplift(FRAME, 3.0 * TAN)
    assert found.forces["base_shear"] == pytest.approx(expected, rel=1e-6)


def test_peaks_are_those_of_many_more_samples_within_their_error():
    few, many = (rocking_peaks(FRAME, CAP, pulse(2.0), count) for count in (8, 256))
    for name in FORCES:
        assert few.forces[name] <= many.forces[name] * (1 + 1e-12)
        assert few.forces[name] >= many.forces[name] * (1 - few.error - 1e-12)


def test_impulse_is_that_of_the_contacts_at_the_largest_impact():
    course = history(FRAME, pulse(2.0), 8)
    rates = [
        row[-1]
        for row, angle in zip(course.velocity, course.rotation, strict=True)
        if abs(angle[-1]) < 1e-8
    ]
    impulses = impact_impulses(FRAME, CAP, np.array(rates))
    total = impulses.base_left.horizontal + impulses.base_right.horizontal
    assert impact_impulse(FRAME, course) == pytest.approx(np.abs(total).max(), rel=1e-6)


def test_history_under_a_record_begins_at_rest_and_holds_all_that_moves():
    record = Record(0.01, np.append(np.zeros(100), 2.0 * TAN * np.sin(np.arange(60) / 10.0)))
    course = history(FRAME, record, 4)
    assert 1.0 < course.time[0, 0] < 1.1
    assert course.time[-1, -1] > record.duration
    assert course.rotation[0, 0] == 0.0 != course.rotation[0, -1]
    peak = simulate(FRAME, record).peak_rotation
    assert np.abs(course.rotation).max() == pytest.approx(peak, rel=1e-2)
    quiet = history(FRAME, record.scaled(0.4), 4)
    assert quiet.time[0, 0] < 0.01
    assert not quiet.rotation.any()


def test_held_frames_are_pinned_and_guided_rigid_and_of_each_period():
    (found,) = held_peaks([FRAME], CAP, pulse(2.0), [0.2, 1.0])
    assert sorted(found) == sorted(held(1.0, [0.2, 1.0]))
    assert len(found) == 6
    for top in (PINNED, GUIDED):
        rigid = peak_rigid(FixedFrame(FRAME, CAP, top), pulse(2.0))._asdict()
        assert found[top, "rigid"] == rigid
        (elastic,) = peak_elastic([FixedFrame(FRAME, CAP, top)], pulse(2.0), 0.2)
        assert found[top, "0.2 s"] == elastic._asdict()
    moments = [found[top, "rigid"]["bending_moment"] for top in (PINNED, GUIDED)]
    assert moments[0] > moments[1]


def test_column_alone_is_compared_with_a_cantilever_only():
    alone, frame = held_peaks([RockingFrame(COLUMN, 0.0), FRAME], CAP, pulse(2.0), [0.2])
    assert list(alone) == held(0.0, [0.2]) == [(PINNED, "rigid"), (PINNED, "0.2 s")]
    assert len(frame) == 4
    assert alone[PINNED, "rigid"]["bending_moment"] == pytest.approx(2.0 * TAN * 3.0 / 2.0)


@pytest.mark.parametrize("ratio", [0.5, 4.0])
def test_three_bodies_have_the_same_forces(ratio):
    frame = RockingFrame(COLUMN, ratio)
    assert uplift_limits.by_three_bodies(frame, CAP, pulse(2.0), 200) < 1e-9


def test_slopes_are_those_of_three_bodies():
    found = uplift_limits.slopes({"slope": {"slendernesses": [14.0], "mass_ratios": [1.0]}})
    assert found.slope[0] == pytest.approx(found.three_bodies[0], abs=1e-12)


def test_summary_counts_what_overturns_and_does_not_average_it():
    ratios = [ratio_of(name, *one) for name in FORCES for one in held(1.0, [1.0])]
    rows = [
        {"kind": "pulse", "mass_ratio": 1.0, "outcome": outcome} | dict.fromkeys(ratios, ratio)
        for outcome, ratio in (("rests", 0.5), ("rests", 1.5), ("overturned", math.nan))
    ]
    found = uplift_limits.summary(pd.DataFrame(rows), {"periods": [1.0]})
    assert found.top.tolist() == [PINNED, PINNED, GUIDED, GUIDED] * 3
    assert found.histories.tolist() == [3] * 12
    assert found.overturned.tolist() == [1] * 12
    assert found["median"].tolist() == [1.0] * 12
    assert found.least.tolist() == [0.5] * 12
    assert found.largest.tolist() == [1.5] * 12
    assert found.lower.tolist() == [0.5] * 12


CASE = {
    "column": {"half_width": 0.5, "half_height": 3.0},
    "cap": {"span": 5.0, "depth": 1.0},
    "mass_ratios": [0.0, 1.0],
    "periods": [0.2, 2.0],
    "shapes": ["one-sine"],
    "frequency_ratios": {"lowest": 4.0, "highest": 8.0, "points": 2},
    "pulses": {"amplitudes": [1.1, 3.0, 9.0], "points": 8},
    "slope": {"slendernesses": [9.462322], "mass_ratios": [1.0]},
    "three_bodies": {
        "mass_ratios": [0.5],
        "pulses": [{"shape": "one-sine", "frequency_ratio": 4.0, "amplitude": 2.0}],
    },
    "sample": {"points": 2, "record_steps": 100},
    "checked_by_second_route": 1,
}


@pytest.fixture(scope="module")
def outputs():
    return uplift_limits.main(CASE, [])


@pytest.fixture(scope="module")
def findings(outputs):
    return outputs[-1]


def test_forces_are_limited_beside_a_rigid_frame_alone(findings):
    found = findings["uplift_limits_forces"]
    assert (found["holds"], found["holds_when"]) == (False, True)
    bending = found["bending_moments"]
    assert bending["guided"]["not_lower"] > 0
    assert bending["pinned"]["not_lower"] == 0
    assert 0 < bending["guided"]["histories"] < bending["pinned"]["histories"]  # γ = 0 has no guide
    assert 0 < found["overturned"] < found["histories"] == 12
    assert findings["uplift_is_beneficial"]["holds_when"]
    assert findings["forces_by_second_routes"]["holds"]


def higher(name, off):
    """The forces of a solver, so many times as large."""
    right = getattr(uplift_limits, name)

    def found(*arguments):
        forces = right(*arguments)
        if name == "rocking_peaks":
            forces.forces.update({one: off * force for one, force in forces.forces.items()})
            return forces
        return tuple(off * force for force in forces)

    return found


@pytest.mark.parametrize(
    ("name", "wrong", "holds"),
    [
        ("rocking_peaks", 1.0005, True),
        ("rocking_peaks", 1.002, False),
        ("peak_elastic_by_scipy", 1.0005, True),
        ("peak_elastic_by_scipy", 1.002, False),
        ("by_three_bodies", 5e-7, True),
        ("by_three_bodies", 2e-6, False),
        ("error", 0.004, True),
        ("error", 0.006, False),
    ],
)
def test_each_second_route_can_refute(monkeypatch, outputs, name, wrong, holds):
    """SciPy, the held frame's other solver, three bodies, and half of the samples."""
    table, column = outputs[0].assign(**({name: wrong} if name == "error" else {})), COLUMN
    if name == "by_three_bodies":
        monkeypatch.setattr(uplift_limits, name, lambda *arguments: wrong)
    elif name != "error":
        monkeypatch.setattr(uplift_limits, name, higher(name, wrong))
    frames = [RockingFrame(column, gamma) for gamma in CASE["mass_ratios"]]
    tried = uplift_limits.motions(column, CASE, [])[:1]
    routes = uplift_limits.second_route(table, frames, CAP, CASE, tried)
    assert uplift_limits._agreement(routes, table)["holds"] is holds


def test_slope_that_three_bodies_deny_is_noticed(monkeypatch):
    case = CASE | {"periods": []}
    right = uplift_limits.slopes(case)
    given = {"summary": RATIOS, "second_route": None, "_agreement": truth(True)}
    for name, found in given.items():
        monkeypatch.setattr(uplift_limits, name, lambda *arguments, found=found: found)
    monkeypatch.setattr(uplift_limits, "motions", lambda *arguments: [(None, {})])
    monkeypatch.setattr(uplift_limits, "compare", lambda *arguments: ROWS)
    for slopes, holds in (
        (right, True),
        (right.assign(slope=right.slope + 1e-8), False),
        (right.assign(three_bodies=math.nan), False),  # none was compared
    ):
        monkeypatch.setattr(uplift_limits, "slopes", lambda given, slopes=slopes: slopes)
        found = uplift_limits.main(case, [])[-1]["slope_by_three_bodies"]
        assert found["holds"] is holds


def rows(**change):
    usual = dict.fromkeys((ratio_of(name, *one) for name in FORCES for one in held(1.0, [])), 0.5)
    peak = change.get("peak_acceleration", 1.0)
    return [
        {"outcome": "rests", "rotation": 0.5, "impulse": 0.1, "shear_after_uplift": 1.0}
        | {"base_shear": 0.9, "mass_ratio": 1.0, "kind": "pulse", "peak_acceleration": peak}
        | {"amplitude": peak / TAN}
        | usual
        | change
    ]


ROWS = rows()
RATIOS = pd.DataFrame(
    [
        {"held": "rigid", "force": name, "top": top, "least": 0.4, "largest": 0.5}
        for name in FORCES
        for top in (PINNED, GUIDED)
    ]
)


@pytest.mark.parametrize(
    ("force", "outcome", "forces", "totals", "beneficial", "of_the_shear"),
    [
        (None, "rests", True, True, True, True),
        ("bending_moment guided", "rests", False, True, False, True),  # the portal is no condition
        ("bending_moment pinned", "rests", False, False, False, True),  # the cantilever is
        ("overturning_moment guided", "rests", False, False, False, True),
        ("overturning_moment pinned", "rests", False, False, False, True),
        ("base_shear guided", "rests", False, False, False, False),
        (None, "overturned", True, True, False, True),  # one that overturns is no benefit
    ],
)
def test_each_force_counts_where_it_is_claimed(
    monkeypatch, force, outcome, forces, totals, beneficial, of_the_shear
):
    ratios = RATIOS.assign(
        largest=[1.1 if f"{row.force} {row.top}" == force else 0.5 for row in RATIOS.itertuples()]
    )
    given = {"summary": ratios, "second_route": None, "_agreement": truth(True)}
    given |= {"motions": [(None, {})], "compare": [*ROWS, *rows(outcome=outcome)]}
    for name, found in given.items():
        monkeypatch.setattr(uplift_limits, name, lambda *arguments, found=found: found)
    found = uplift_limits.main(CASE | {"periods": []}, [])[-1]
    limited, good = found["uplift_limits_forces"], found["uplift_is_beneficial"]
    assert (limited.holds, limited.holds_when) == (forces, totals)
    assert (good.holds, good.holds_when) == (beneficial, of_the_shear)


def test_block_that_does_not_slide_shows_no_benefit_of_sliding(monkeypatch):
    given = {"summary": RATIOS, "second_route": None, "_agreement": truth(True)}
    given |= {"motions": [(None, {})], "compare": rows(peak_acceleration=0.9 * TAN)}
    for name, found in given.items():
        monkeypatch.setattr(uplift_limits, name, lambda *arguments, found=found: found)
    good = uplift_limits.main(CASE | {"periods": []}, [])[-1]["uplift_is_beneficial"]
    assert (good.holds, good.holds_when) == (False, False)


@pytest.mark.parametrize("factor", [1.2, 3.0])
def test_larger_forces_are_not_limited(monkeypatch, factor):
    right = uplift_limits.rocking_peaks

    def larger(*arguments):
        found = right(*arguments)
        found.forces.update({name: factor * value for name, value in found.forces.items()})
        return found

    monkeypatch.setattr(uplift_limits, "rocking_peaks", larger)
    found = uplift_limits.main(CASE, [])[-1]
    assert not found["largest_shear_is_that_of_uplift"]["holds"]
    assert not found["uplift_limits_forces"]["holds_when"]


@pytest.mark.parametrize(("amplitude", "friction"), [(0.4, 0.2), (0.15, 0.2)])
def test_sliding_block_has_at_most_the_shear_of_its_friction(amplitude, friction):
    """By SciPy, with a friction that is full from a small velocity on."""
    smooth = 1e-4  # m/s

    def force(velocity):  # over the weight
        return -friction * np.tanh(velocity / smooth)

    def moves(t, y):
        return [9.81 * (force(y[0]) - amplitude * np.sin(6.0 * t))]

    found = solve_ivp(moves, (0.0, 3.0), [0.0], method="Radau", max_step=0.005, rtol=1e-8)
    largest = np.abs(force(found.y[0])).max()
    shear = uplift_limits.sliding_shear(pd.Series([amplitude]), friction)
    assert largest == pytest.approx(shear[0], rel=2e-3)
