"""Forces in frames: while they rock, and while their bases are held."""

import math

import numpy as np
import pytest
import sympy as sp

import topheavy as th
from tests.cases import COLUMN, RECORDS
from topheavy import STANDARD_GRAVITY, Cap, RockingFrame, base_shear_slope, contact_forces
from topheavy.bodies.kinematics import cap_acceleration
from topheavy.forces.frame import SECTIONS, centre_height, frame_forces, largest_forces

CAP = Cap(5.0, 0.5)
STATES = [(0.05, 0.2, 0.1), (-0.03, 0.1, -0.4), (0.12, -0.3, 0.5), (-1e-9, 0.0, 0.3)]
RATIOS = [0.0, 1.0, 4.0, math.inf]


def angular(frame, theta, ground):
    side, lean = math.copysign(1.0, theta), frame.slenderness - abs(theta)
    return -(frame.frequency_parameter**2) * (side * math.sin(lean) + ground * math.cos(lean))


def particles(theta, rate, second, ground, count=40):
    """Of a column of unit mass: places from the pivot and forces (g included) of its particles."""
    b, h, side = COLUMN.half_width, COLUMN.half_height, math.copysign(1.0, theta)
    nodes, weights = np.polynomial.legendre.leggauss(count)
    across, along = np.meshgrid(b * nodes, h * (1.0 + nodes), indexing="ij")
    mass = np.outer(weights, weights) / 4.0
    t, a = across - side * b, along  # from the pivot, in the axes of the column
    x = t * math.cos(theta) + a * math.sin(theta)
    z = a * math.cos(theta) - t * math.sin(theta)
    pull_x = ground * STANDARD_GRAVITY + second * z - rate**2 * x
    pull_z = STANDARD_GRAVITY - second * x - rate**2 * z
    return along, x, z, mass * pull_x, mass * pull_z


@pytest.mark.parametrize("ratio", RATIOS)
@pytest.mark.parametrize("state", STATES)
def test_base_shear_is_the_inertia_of_all_bodies(ratio, state):
    frame = RockingFrame(COLUMN, ratio)
    second = angular(frame, state[0], state[2])
    columns = 0.0 if ratio == math.inf else 1.0 / (1.0 + ratio)
    pull = particles(*state[:2], second, state[2])[3].sum()
    u, _ = cap_acceleration(COLUMN, *state[:2], second)
    inertia = columns * pull / STANDARD_GRAVITY
    inertia += (1.0 - columns) * (state[2] + u / STANDARD_GRAVITY)
    assert frame_forces(frame, CAP, *state).base_shear == pytest.approx(inertia, abs=1e-12)


@pytest.mark.parametrize("ratio", RATIOS)
@pytest.mark.parametrize("state", STATES)
def test_overturning_moment_is_that_of_weight_and_inertia(ratio, state):
    frame = RockingFrame(COLUMN, ratio)
    theta, rate, ground = state
    second, side = angular(frame, theta, ground), math.copysign(1.0, theta)
    columns = 0.0 if ratio == math.inf else 1.0 / (1.0 + ratio)
    _, x, z, px, pz = particles(theta, rate, second, ground)
    place = side * COLUMN.half_width + x  # from the axis of the resting column; ± L/2 cancel
    moment = columns * (z * px - place * pz).sum() / STANDARD_GRAVITY
    u, v = cap_acceleration(COLUMN, theta, rate, second)
    lean, double = frame.slenderness - abs(theta), 2.0 * COLUMN.size
    along = side * double * (math.sin(frame.slenderness) - math.sin(lean))
    height = double * math.cos(lean) + CAP.half_depth
    cap = height * (ground + u / STANDARD_GRAVITY) - along * (1.0 + v / STANDARD_GRAVITY)
    moment += (1.0 - columns) * cap
    found = frame_forces(frame, CAP, *state).overturning_moment
    assert found == pytest.approx(moment, abs=1e-11)


@pytest.mark.parametrize("ratio", RATIOS)
@pytest.mark.parametrize("state", STATES)
def test_bending_moment_is_that_of_all_below_the_section(ratio, state):
    frame = RockingFrame(COLUMN, ratio)
    theta, rate, ground = state
    weight = 0.0 if ratio == math.inf else 0.5 / (1.0 + ratio)
    second, side = angular(frame, theta, ground), math.copysign(1.0, theta)
    along, x, z, px, pz = particles(theta, rate, second, ground)
    forces, found = contact_forces(frame, CAP, *state), frame_forces(frame, CAP, *state)
    b, height = COLUMN.half_width, 2.0 * COLUMN.half_height
    for place, foot in enumerate((forces.base_left, forces.base_right)):
        for section in (0.0, 1.0):  # Gauss points lie on either side of no other section
            level = section * height
            t, a = -side * b, level
            at_x = t * math.cos(theta) + a * math.sin(theta)
            at_z = a * math.cos(theta) - t * math.sin(theta)
            below = along < level
            load = (z - at_z) * px - (x - at_x) * pz
            moment = -at_z * foot.horizontal + at_x * foot.vertical
            moment -= weight * load[below].sum() / STANDARD_GRAVITY
            ours = found.bending_moment[place, SECTIONS.index(section)]
            assert ours == pytest.approx(-moment, abs=1e-11)


@pytest.mark.parametrize(
    ("ratio", "slope"), [(0.0, 0.270270), (1.0, 0.179054), (4.0, 0.090644), (math.inf, 0.027027)]
)
def test_slope_after_uplift_is_the_known_one(ratio, slope):
    frame = RockingFrame(COLUMN, ratio)
    shear = frame_forces(frame, CAP, 0.0, 0.0, np.array([0.2, 0.5])).base_shear
    assert base_shear_slope(frame) == pytest.approx(slope, abs=1e-6)
    assert (shear[1] - shear[0]) / 0.3 == pytest.approx(slope, abs=1e-6)


@pytest.mark.parametrize("ratio", RATIOS)
@pytest.mark.parametrize("sign", [-1.0, 1.0])
def test_uplift_begins_without_a_jump(ratio, sign):
    frame, level = RockingFrame(COLUMN, ratio), sign * COLUMN.uplift_acceleration
    rests, moves = (frame_forces(frame, CAP, 0.0, 0.0, level * (1 + d)) for d in (-1e-12, 1e-12))
    assert rests.base_shear == pytest.approx(level, rel=1e-9)
    assert rests.overturning_moment == pytest.approx(level * centre_height(frame, CAP), rel=1e-9)
    assert moves.base_shear == pytest.approx(rests.base_shear, rel=1e-9)
    assert moves.overturning_moment == pytest.approx(rests.overturning_moment, rel=1e-9)
    assert np.isnan(rests.bending_moment).all()


@pytest.mark.parametrize("ratio", RATIOS)
def test_largest_forces_are_those_of_arcs_that_move_or_of_all_if_none_does(ratio):
    frame = RockingFrame(COLUMN, ratio)
    theta, rate, ground = 1e-3 * np.random.default_rng(3).normal(size=(3, 50, 3))
    theta[:25], rate[:25], ground[:25] = 0.0, 0.0, 0.99 * COLUMN.uplift_acceleration
    theta[25, 0] = 0.0  # one instant without rotation is not rest
    for arcs, counted in ((slice(None), slice(25, None)), (slice(25), slice(25))):
        found = frame_forces(frame, CAP, *(each[counted] for each in (theta, rate, ground)))
        for row, step in zip(
            largest_forces(frame, CAP, theta[arcs], rate[arcs], ground[arcs]), (1, 2), strict=True
        ):
            assert row.tolist() == [
                np.nanmax(np.abs(force[:, ::step]), initial=0.0)
                for force in (found.base_shear, found.overturning_moment, found.bending_moment)
            ]


ENDS = pytest.mark.parametrize("top", ["pinned", "guided"])
HELD = [(0.0, "pinned")]


HELD += [(ratio, top) for ratio in (1.0, 4.0, math.inf) for top in ("pinned", "guided")]


RECORD = th.read_record(RECORDS / "el_centro_1940_NS.AT2")
PULSE = th.Pulse("one-cosine", 0.4, 2.0 * math.pi / 1.5)


def held(ratio, top="pinned", cap=CAP):
    return th.FixedFrame(th.RockingFrame(COLUMN, ratio), cap, top)


def shape_of(top, x):
    """The deflection by a force at the top, over that of the top."""
    x = sp.sympify(x)
    return {"pinned": (3 * x**2 - x**3) / 2, "guided": 3 * x**2 - 2 * x**3}[top]


def of_beam(load_over_weight, ratio, end):
    """Shear, overturning moment, and end moments of a beam fixed at its base, pinned or guided.

    The load of a column is its weight per length times the given function of x; at the top acts
    half the cap beam's times its value there. EI w⁗ = q is solved with w = w′ = 0 at the base and
    at the top w″ = 0 if it is pinned, or w′ = 0; the shear there is the cap beam's load.
    """
    x, second, force = sp.symbols("x b c")
    height = 2 * sp.Rational(3)
    columns = 0 if ratio == math.inf else sp.Rational(1) / (1 + sp.nsimplify(ratio))
    spread = columns / 2 / height * load_over_weight(x)
    tip = (1 - columns) / 2 * load_over_weight(1)
    load = spread
    for _ in range(4):
        load = sp.integrate(load, x)
    deflection = load * height**4 + force * x**3 + second * x**2
    top = {x: 1}
    turns = sp.diff(deflection, x, {"pinned": 2, "guided": 1}[end])
    shear = sp.diff(deflection, x, 3) / height**3
    found = sp.solve([turns.subs(top), shear.subs(top) + tip], [second, force])
    moment = sp.diff(deflection, x, 2).subs(found) / height**2
    total = 2 * (sp.integrate(spread, (x, 0, 1)) * height + tip)
    over = 2 * (
        sp.integrate(spread * x, (x, 0, 1)) * height**2 + tip * (height + sp.Rational(1, 2))
    )
    return [float(total), float(over), float(moment.subs(x, 0)), float(-moment.subs(top))]


@pytest.mark.parametrize(("ratio", "top"), HELD)
def test_rigid_frame_is_a_beam_under_its_inertia(ratio, top):
    fixed = held(ratio, top)
    expected = of_beam(lambda x: sp.Integer(1), ratio, top)
    assert fixed.rigid == pytest.approx(expected, rel=1e-12, abs=1e-12)


@pytest.mark.parametrize(("ratio", "top"), HELD)
def test_mode_is_a_beam_under_the_inertia_of_its_shape(ratio, top):
    x = sp.Symbol("x")
    columns = 0.0 if ratio == math.inf else 1.0 / (1.0 + ratio)
    linear, square = (float(sp.integrate(shape_of(top, x) ** power, (x, 0, 1))) for power in (1, 2))
    participation = (1 - columns + columns * linear) / (1 - columns + columns * square)
    expected = participation * np.array(of_beam(lambda x: shape_of(top, x), ratio, top))
    fixed = held(ratio, top)
    assert fixed.mode == pytest.approx(expected, rel=1e-12, abs=1e-12)


def test_column_without_a_cap_beam_is_a_cantilever_of_its_own():
    """By hand: a mass m at h moves with the ground, M = m ü_g h; the weight of both is 2mg."""
    found = th.peak_rigid(held(0.0), PULSE)
    assert found.bending_moment == pytest.approx(0.4 * 3.0 / 2.0, rel=1e-12)
    assert found.overturning_moment == pytest.approx(2.0 * found.bending_moment, rel=1e-12)
    deeper, usual = (
        th.peak_elastic([one], PULSE, 0.5) for one in (held(0.0, cap=th.Cap(9.0, 2.0)), held(0.0))
    )
    assert deeper == usual


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda: held(0.0, "guided"), r"no cap beam \(γ = 0\) that guides its columns"),
        (lambda: held(1.0, "fixed"), "top is 'fixed'; expected 'pinned'"),
        *(
            (
                lambda peaks=peaks, motion=motion: peaks(held(1.0), motion),
                r"excitation is .* that ends",
            )
            for motion in (None, 3.0, th.Pulse("harmonic", 0.3, 5.0))
            for peaks in (
                th.peak_rigid,
                lambda one, motion: th.peak_elastic([one], motion, 0.4),
                lambda one, motion: th.peak_elastic_by_scipy(one, motion, 0.4),
            )
        ),
        *(
            (lambda of=of, period=period: of(held(1.0), period), "period is")
            for period in (0.0, -1.0, math.inf, "1", None)
            for of in (
                lambda one, period: th.peak_elastic([one], PULSE, period),
                lambda one, period: th.peak_elastic_by_scipy(one, PULSE, period),
            )
        ),
    ],
)
def test_bad_frame_motion_or_period_is_refused_by_both_solvers(call, says):
    with pytest.raises(ValueError, match=says):
        call()


@pytest.mark.parametrize(("ratio", "top"), HELD)
def test_stiff_frame_is_nearly_rigid(ratio, top):
    fixed = held(ratio, top)
    pulse = th.Pulse("one-sine", 0.4, 2.0 * math.pi / 1.5)  # begins without a jump
    (found,) = th.peak_elastic([fixed], pulse, 0.005)
    assert found == pytest.approx(th.peak_rigid(fixed, pulse), rel=0.01)


def test_resonance_is_that_of_five_per_cent_damping():
    fixed = held(math.inf)
    times = np.arange(0.0, 60.0, 0.005)
    record = th.Record(0.005, 0.1 * np.sin(2.0 * math.pi * times), "harmonic")
    (found,) = th.peak_elastic([fixed], record, 1.0)
    transmitted = math.sqrt(1.0 + 0.1**2) / 0.1  # √(1 + 4ζ²)/2ζ of a steady state
    assert found.base_shear == pytest.approx(0.1 * transmitted, rel=1e-3)


@pytest.mark.parametrize("period", [0.1, 0.5, 2.0])
@pytest.mark.parametrize("motion", [PULSE, th.Record(0.02, RECORD.acceleration[:120], "part")])
@ENDS
def test_two_solvers_agree(motion, period, top):
    fixed = held(1.0, top)
    (found,) = th.peak_elastic([fixed], motion, period, 1000)
    other = th.peak_elastic_by_scipy(fixed, motion, period, 1000)
    assert found == pytest.approx(other, rel=5e-5)
