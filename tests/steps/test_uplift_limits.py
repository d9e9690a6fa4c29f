"""The step on what uplift limits, on cases that are known."""

import math

import numpy as np
import pandas as pd
import pytest

import topheavy as th
from replication.workbench import truth
from steps import uplift_limits
from steps.shared import peak_forces
from steps.shared.histories import history
from steps.shared.peak_forces import FORCES, GUIDED, PINNED, held, ratio_of, rocking_peaks
from tests.cases import COLUMN, FRAME, SIZES

CAP = th.Cap(5.0, 0.5)
TAN = COLUMN.uplift_acceleration


def pulse(amplitude, shape="one-sine", ratio=4.0):
    return th.Pulse(shape, amplitude * TAN, ratio * COLUMN.frequency_parameter)


# Peaks of the forces -----------------------------------------------------------------------------


def test_peaks_in_the_limits():
    """No uplift, a sudden pulse, overturning; and many more samples are within the error."""
    still, sudden, fallen = (
        rocking_peaks(FRAME, CAP, pulse(*given), 8)
        for given in ((0.9,), (3.0, "one-cosine", 8.0), (20.0,))
    )
    assert (still.outcome, fallen.outcome) == ("no uplift", "overturned")
    assert still.forces["base_shear"] == pytest.approx(0.9 * TAN, rel=1e-3)
    assert (still.rotation, still.impulse) == (0.0, 0.0)
    shear = peak_forces.shear_after_uplift(FRAME, 3.0 * TAN)
    assert sudden.forces["base_shear"] == pytest.approx(shear, rel=1e-6)
    few, many = (rocking_peaks(FRAME, CAP, pulse(2.0), count) for count in (8, 256))
    for name in FORCES:
        assert math.isnan(fallen.forces[name])
        ratio = few.forces[name] / many.forces[name]
        assert 1 - few.error - 1e-12 <= ratio <= 1 + 1e-12


def test_impulse_is_that_of_the_contacts_at_the_largest_impact():
    course = history(FRAME, pulse(2.0), 8)
    rates = course.velocity[np.abs(course.rotation[:, -1]) < 1e-8, -1]
    impulses = th.impact_impulses(FRAME, CAP, rates)
    total = impulses.base_left.horizontal + impulses.base_right.horizontal
    found = peak_forces.impact_impulse(FRAME, course)
    assert found == pytest.approx(np.abs(total).max(), rel=1e-6)


def test_history_under_a_record_begins_at_rest_and_holds_all_that_moves():
    record = th.Record(0.01, np.append(np.zeros(100), 2.0 * TAN * np.sin(np.arange(60) / 10.0)))
    course, quiet = history(FRAME, record, 4), history(FRAME, record.scaled(0.4), 4)
    assert 1.0 < course.time[0, 0] < 1.1
    assert course.time[-1, -1] > record.duration
    assert course.rotation[0, 0] == 0.0 != course.rotation[0, -1]
    peak = th.simulate(FRAME, record).peak_rotation
    assert np.abs(course.rotation).max() == pytest.approx(peak, rel=1e-2)
    assert quiet.time[0, 0] < 0.01
    assert not quiet.rotation.any()


@pytest.mark.parametrize("ratio", [0.5, 4.0])
def test_three_bodies_have_the_same_forces_and_slopes(ratio):
    frame = th.RockingFrame(COLUMN, ratio)
    assert uplift_limits.by_three_bodies(frame, CAP, pulse(2.0), 200) < 1e-9
    found = uplift_limits.slopes({"slope": {"slendernesses": [14.0], "mass_ratios": [ratio]}})
    assert found.slope[0] == pytest.approx(found.three_bodies[0], abs=1e-12)


# What the step concludes -------------------------------------------------------------------------

CASE = {
    "column": SIZES,
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


def test_forces_are_limited_beside_a_rigid_frame_alone(outputs):
    findings = outputs[-1]
    found = findings["uplift_limits_forces"]
    assert (found["holds"], found["holds_when"]) == (False, True)
    bending = found["bending_moments"]
    assert bending["guided"]["not_lower"] > bending["pinned"]["not_lower"] == 0
    assert 0 < bending["guided"]["histories"] < bending["pinned"]["histories"]  # γ = 0 has no guide
    assert 0 < found["overturned"] < found["histories"] == 12
    assert findings["uplift_is_beneficial"]["holds_when"]
    assert findings["forces_by_second_routes"]["holds"]


def scaled(name, off):
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
        *(("rocking_peaks", 1.0005, True), ("rocking_peaks", 1.002, False)),
        *(("peak_elastic_by_scipy", 1.0005, True), ("peak_elastic_by_scipy", 1.002, False)),
        *(("by_three_bodies", 5e-7, True), ("by_three_bodies", 2e-6, False)),
        *(("error", 0.004, True), ("error", 0.006, False)),
    ],
)
def test_each_second_route_can_refute(given, outputs, name, wrong, holds):
    """SciPy, the held frame's other solver, three bodies, and half of the samples."""
    table = outputs[0].assign(**({name: wrong} if name == "error" else {}))
    if name != "error":
        stub = wrong if name == "by_three_bodies" else scaled(name, wrong)
        given(uplift_limits, **{name: stub})
    frames = [th.RockingFrame(COLUMN, gamma) for gamma in CASE["mass_ratios"]]
    tried = uplift_limits.motions(COLUMN, CASE, [])[:1]
    routes = uplift_limits.second_route(table, frames, CAP, CASE, tried)
    assert uplift_limits._agreement(routes, table)["holds"] is holds


def rows(**change):
    usual = dict.fromkeys((ratio_of(name, *one) for name in FORCES for one in held(1.0, [])), 0.5)
    peak = change.get("peak_acceleration", 1.0)
    fixed = {"outcome": "rests", "rotation": 0.5, "impulse": 0.1, "shear_after_uplift": 1.0}
    fixed |= {"base_shear": 0.9, "mass_ratio": 1.0, "kind": "pulse", "peak_acceleration": peak}
    return [fixed | {"amplitude": peak / TAN} | usual | change]


RATIOS = pd.DataFrame(
    {"held": "rigid", "force": name, "top": top, "least": 0.4, "largest": 0.5}
    for name in FORCES
    for top in (PINNED, GUIDED)
)


@pytest.fixture
def concluded(given):
    """Return what the step finds of given ratios and rows."""

    def found(ratios=RATIOS, compare=None, **others):
        given(uplift_limits, summary=ratios, second_route=None, _agreement=truth(True), **others)
        given(uplift_limits, motions=[(None, {})], compare=rows() if compare is None else compare)
        return uplift_limits.main(CASE | {"periods": []}, [])[-1]

    return found


def test_slope_that_three_bodies_deny_is_noticed(concluded):
    right = uplift_limits.slopes(CASE)
    for slopes, holds in (
        (right, True),
        (right.assign(slope=right.slope + 1e-8), False),
        (right.assign(three_bodies=math.nan), False),  # none was compared
    ):
        assert concluded(slopes=slopes)["slope_by_three_bodies"]["holds"] is holds


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
    concluded, force, outcome, forces, totals, beneficial, of_the_shear
):
    ratios = RATIOS.assign(
        largest=[1.1 if f"{row.force} {row.top}" == force else 0.5 for row in RATIOS.itertuples()]
    )
    found = concluded(ratios, [*rows(), *rows(outcome=outcome)])
    limited, good = found["uplift_limits_forces"], found["uplift_is_beneficial"]
    assert (limited.holds, limited.holds_when) == (forces, totals)
    assert (good.holds, good.holds_when) == (beneficial, of_the_shear)


def test_block_that_does_not_slide_shows_no_benefit_of_sliding(concluded):
    good = concluded(RATIOS, rows(peak_acceleration=0.9 * TAN))["uplift_is_beneficial"]
    assert (good.holds, good.holds_when) == (False, False)


@pytest.mark.parametrize("factor", [1.2, 3.0])
def test_larger_forces_are_not_limited(given, factor):
    given(uplift_limits, rocking_peaks=scaled("rocking_peaks", factor))
    found = uplift_limits.main(CASE, [])[-1]
    assert not found["largest_shear_is_that_of_uplift"]["holds"]
    assert not found["uplift_limits_forces"]["holds_when"]
