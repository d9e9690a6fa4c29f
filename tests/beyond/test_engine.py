"""The engines in limits whose answer is known without them, and findings that break."""

import math

import mujoco
import numpy as np
import pandas as pd
import pytest
from scipy.special import bdtr, ndtr

import topheavy as th
from steps.beyond import colonnades, engine, gaps, rigid_bodies, stones, test_plan
from steps.beyond.inclinations import free_rocking, overturn
from steps.beyond.rigid_bodies import Bodies, motion, overturns
from steps.beyond.stones import BEAM, HINGED, OPEN, Stones
from tests.cases import COLUMN, CONFIG

TRILITH, PIER = th.Column(0.11, 0.40), th.Column(0.75, 3.50)
LINTEL, DECK = th.Cap(span=0.80, half_depth=0.11), th.Cap(span=20.0, half_depth=1.0)
CASES = {
    "column": (TRILITH, 0.0, LINTEL),
    "trilith": (TRILITH, 0.434, LINTEL),
    "bridge": (PIER, 2.0, DECK),
}
ENGINES = {"MuJoCo": rigid_bodies, "pymunk": stones}


def in_engine(name, code, step=4e-4):
    """A structure in its plane, by its time step over 1/p."""
    column, gamma, cap = CASES[name]
    if code == "MuJoCo":
        spec = {"time_step": step, "friction": 5.0}
        return engine.planar(th.RockingFrame(column, gamma), cap, spec)
    return Stones(column, gamma, cap, step / column.frequency_parameter)


def seconds(rig):
    return getattr(rig, "seconds", rig.time_step)


@pytest.mark.parametrize("code", ENGINES)
@pytest.mark.parametrize("name", CASES)
def test_structure_at_rest_stays_at_rest(name, code):
    rig = in_engine(name, code)
    angles = ENGINES[code].released(rig, 0.0, 1000 * seconds(rig))
    assert np.abs(angles).max() < 1e-4 * rig.column.slenderness


@pytest.mark.parametrize("code", ENGINES)
@pytest.mark.parametrize("name", CASES)
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_released_structure_has_the_impact_and_the_restitution_of_theory(name, sign, code):
    column, gamma, _ = CASES[name]
    rig, rotation = in_engine(name, code), sign * 0.5 * column.slenderness
    frame = th.RockingFrame(column, gamma)
    first, second = th.simulate(frame, rotation=rotation, samples=2).impact_times[:2]
    angles = sign * ENGINES[code].released(rig, rotation, second)
    time, roots = free_rocking(angles, seconds(rig), column)
    assert time == pytest.approx(first, rel=1e-3)
    assert roots[0] == pytest.approx(frame.restitution, rel=2e-3)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_ground_that_accelerates_forward_tilts_it_back(sign):
    pulse = th.Pulse(
        "constant", sign * 1.5 * TRILITH.uplift_acceleration, angular_frequency=math.pi / 0.1
    )
    expected = th.simulate(TRILITH, pulse, duration=0.1, samples=2).rotation[-1]
    *_, (_, last) = motion(in_engine("column", "MuJoCo"), pulse.excitation, 0.1, look=1)
    assert math.asin(last[0, 0, 2]) == pytest.approx(expected, rel=0.05)
    *_, (_, last) = stones.motion(in_engine("column", "pymunk"), pulse.excitation, 0.1, look=1)
    assert last[0] == pytest.approx(expected, rel=0.05)


@pytest.mark.parametrize(
    ("inclined", "falls"),
    [
        ([0.1, 1.1], True),
        ([0.1, 0.0, 0.1, 0.0, 1.1], False),  # it has turned back after the pulse
        ([0.1, 0.0, 0.1, 1.1], True),  # it has returned from the rotation at the end of the pulse
        ([0.0] * 12 + [1.1], False),  # it has come to rest
    ],
)
def test_outcome_of_inclinations(inclined, falls):
    pulse = th.Pulse("half-sine", 0.3, angular_frequency=math.pi / 0.05)
    looks = [(0.1 * number, angle) for number, angle in enumerate(inclined, 1)]
    assert overturn(looks, COLUMN, pulse) is falls


@pytest.mark.parametrize("code", ENGINES)
@pytest.mark.parametrize("factor", [0.9, 1.1])
def test_long_push_overturns_from_uplift_on(factor, code):
    pulse = th.Pulse(
        "constant", factor * TRILITH.uplift_acceleration, angular_frequency=math.pi / 2.0
    )
    rig = in_engine("column", code, 8e-4)
    assert ENGINES[code].overturns(rig, pulse) is (factor > 1.0)


@pytest.mark.parametrize(("joints", "uplift"), [(BEAM, 1.0), (OPEN, 0.858), (HINGED, 1.0)])
@pytest.mark.parametrize("factor", [0.97, 1.03])
def test_joints_decide_at_which_push_a_colonnade_uplifts(joints, uplift, factor):
    rig = Stones(COLUMN, 4.0, th.Cap(5.0, 0.5), 2e-3, columns=5, joints=joints, gap=0.02)
    push = factor * uplift * COLUMN.uplift_acceleration
    pulse = th.Pulse("constant", push, angular_frequency=math.pi / 6.0)
    assert stones.overturns(rig, pulse) is (factor > 1.0)


@pytest.mark.parametrize(
    ("module", "package", "message"),
    [("3.17.0", "4.0.1", "the module mujoco is 3.17.0"), ("4.0.0", "4.0.0", "MuJoCo is 4.0.0")],
)
def test_another_or_an_older_mujoco_stops_the_step(monkeypatch, module, package, message):
    monkeypatch.setattr(mujoco, "__version__", module)
    monkeypatch.setattr(rigid_bodies, "version", lambda _: package)
    with pytest.raises(SystemExit, match=message):
        rigid_bodies.checked_version()


STACK = th.FixedMassColumn(TRILITH, 0.434, cap_depth=0.22)
FRAME = th.RockingFrame(TRILITH, 0.434)
IN_SPACE = {
    "frame in its plane": (FRAME, 0.0, {}),
    "frame across its plane": (STACK, 90.0, {}),
    "column with a fixed mass": (STACK, 90.0, {"in_row": 1, "is_fixed": True}),
    "four under a slab": (FRAME, 90.0, {"rows": 2}),
    "round frame across its plane": (STACK, 90.0, {"is_round": True}),
}


@pytest.mark.parametrize("name", IN_SPACE)
@pytest.mark.parametrize("factor", [0.9, 1.1])
def test_in_space_a_long_push_overturns_from_the_uplift_by_hand_on(name, factor):
    by_hand, direction, changed = IN_SPACE[name]
    bodies = Bodies(TRILITH, 0.11, 0.434, LINTEL, 1.6e-3, **changed)
    pulse = th.Pulse(
        "constant", factor * by_hand.uplift_acceleration, angular_frequency=math.pi / 2.0
    )
    assert overturns(bodies, pulse, direction) is (factor > 1.0)


RESTITUTION = pd.DataFrame(
    [(stones.VERSION, 1.0001, 0.9001), ("MuJoCo 4.0.1", 1.0, 0.9)],
    columns=["solver", "frequency_parameter_over_theory", "engine"],
).assign(theory=0.9)
OUTCOMES = pd.DataFrame([(0.99, True), (1.03, True)], columns=["factor", "engine"]).assign(
    theory=True
)
ACROSS = pd.DataFrame(
    [
        ("column", 0.0, 1.0),
        ("fixed mass", 0.0, 0.7),
        ("two in line", 0.0, 1.1),
        ("two in line", 90.0, 0.7),
        ("2 × 2", 0.0, 1.1),
        ("column", 45.0, 1.2),
        ("2 × 2", 45.0, 1.3),
    ],
    columns=["structure", "direction", "engine"],
).assign(section="square", mass_ratio=1.0, frequency_ratio=3.0, depth_over_width=1.0, theory=1.0)


@pytest.mark.parametrize(
    ("name", "changed"), [("engine", 0.902), ("frequency_parameter_over_theory", 0.999)]
)
def test_free_rocking_apart_from_theory_stops_the_step(name, changed):
    table = RESTITUTION.assign(**{name: [changed, 1.0]})
    with pytest.raises(SystemExit, match="pymunk: p̂ is"):
        engine.findings(table, OUTCOMES, ACROSS)


@pytest.mark.parametrize(
    ("row", "holds", "holds_when"), [(None, True, True), (0, False, True), (1, False, False)]
)
def test_one_other_outcome_breaks_the_same_outcomes(row, holds, holds_when):
    table = OUTCOMES.assign(engine=OUTCOMES.index != row)
    finding = engine.findings(RESTITUTION, table, ACROSS)["same_verdicts"]
    assert (finding["holds"], finding["holds_when"]) == (holds, holds_when)
    assert finding["agree"] == 2 - (row is not None)


@pytest.mark.parametrize(
    ("row", "changed", "holds"),
    [(2, 1.0, False), (3, 1.0, False), (4, 0.9, False), (6, 1.15, False), (1, 1.2, True)],
)
def test_a_frame_as_strong_across_as_its_column_breaks_the_plane(row, changed, holds):
    table = ACROSS.assign(engine=ACROSS.engine.where(ACROSS.index != row, changed))
    finding = engine.findings(RESTITUTION, OUTCOMES, table)["across_the_plane"]
    assert finding["holds"] is holds


STONES = pd.DataFrame(
    [
        (OPEN, 1.0, "one-sine", 2.0, 0.92),
        (OPEN, 1.0, "one-sine", 4.0, 1.09),
        (OPEN, 1.0, "constant", 0.3, 0.89),
        (OPEN, 4.0, "one-sine", 2.0, 0.90),
        (OPEN, 4.0, "constant", 0.3, 0.86),
        (HINGED, 1.0, "one-sine", 2.0, 1.03),
        (OPEN, 1.0, "one-sine", 2.0, 0.92),
    ],
    columns=["joints", "mass_ratio", "shape", "frequency_ratio", "theory"],
)


@pytest.mark.parametrize(
    ("row", "changed", "holds"),
    [(1, 1.2, True), (0, 1.01, False), (2, 1.01, False), (4, 0.9, False)],
)
def test_colonnades_that_gain_break_the_finding(row, changed, holds):
    table = STONES.assign(theory=STONES.theory.where(STONES.index != row, changed))
    table = table.assign(engine=table.theory)
    finding = colonnades.findings(table, {"slow": 3.0})["stones_of_single_bays"]
    assert finding["holds"] is holds
    assert finding["hinged"] == 1.03


def test_colonnade_whose_engine_is_apart_stops_the_step():
    table = STONES.assign(engine=STONES.theory + 0.04)
    with pytest.raises(SystemExit, match="theory differ by"):
        colonnades.findings(table, {"slow": 3.0})


SETTINGS = {"time_step": 1.6e-3, "friction": 0.6, "rocking": 1.0, "draws": 2}
GAPS = pd.DataFrame(
    [(0.0, 0.1, 0.0), (0.5, 2.0, 9.0), (0.5, 2.0, 9.0)], columns=["gap_mm", "in_plane", "yaw"]
).assign(depth=0.22, time_step=1.6e-3, friction=0.6)


@pytest.mark.parametrize(
    ("row", "name", "changed", "holds"),
    [
        (0, "yaw", 0.0, True),
        (0, "in_plane", 2.0, False),
        (1, "in_plane", 0.5, False),
        ([1, 2], "yaw", 0.5, False),
    ],
)
def test_whole_contacts_that_rock_or_gaps_that_do_not_break_the_anomalies(
    row, name, changed, holds
):
    table = GAPS.copy()
    table.loc[row, name] = changed
    assert gaps.findings(table, SETTINGS)["gaps_make_it_rock"]["holds"] is holds


def test_repeats_are_those_of_minima_that_scatter_about_both():
    settings = CONFIG["test_plan"] | {"reductions": [], "scatters": [0.05, 0.1, 0.2]}
    for row in test_plan.compute(settings).itertuples():
        falls = ndtr(math.log(row.pulse / row.minimum_of_column) / row.scatter)
        stands = ndtr(math.log(row.minimum_of_other / row.pulse) / row.scatter)
        assert falls == pytest.approx(stands)
        wrong = [bdtr(n // 2, n, falls) for n in (row.repeats, row.repeats - 2) if n > 0]
        assert wrong[0] <= settings["risk"] < min([*wrong[1:], 1.0])


def test_column_survives_the_pulse_from_the_stated_reduction_on():
    settings = CONFIG["test_plan"] | {"reductions": [], "scatters": [0.02]}
    plan = test_plan.compute(settings).iloc[0]
    column = th.Column(**settings["column"])
    omega = settings["frequency_ratio"] * column.frequency_parameter
    pulse = th.Pulse(settings["shape"], plan.pulse, angular_frequency=omega)
    least = plan.survived_if_lower_by
    for reduction, overturned in ((least - 0.01, True), (least, False)):
        block = column.block(column.restitution * (1.0 - reduction))
        assert th.judge(block, pulse).overturned == overturned
