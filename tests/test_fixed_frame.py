"""The frame held against uplift: beam theory, limits, and two solvers."""

import math

import numpy as np
import pytest
import sympy as sp

from topheavy import (
    Cap,
    Column,
    FixedFrame,
    Pulse,
    Record,
    RockingFrame,
    peak_elastic,
    peak_elastic_by_scipy,
    peak_rigid,
    read_record,
)

COLUMN, CAP = Column(0.5, 3.0), Cap(5.0, 0.5)
RATIOS = [0.0, 1.0, 4.0, math.inf]
RECORD = read_record("data/records/el_centro_1940_NS.AT2")
PULSE = Pulse("one-cosine", 0.4, 2.0 * math.pi / 1.5)


def of_beam(load_over_weight, ratio):
    """Shear, overturning moment, and end moments of a beam fixed at its base, guided at its top.

    The load of a column is its weight per length times the given function of x; at the top acts
    half the cap beam's times its value there. EI w⁗ = q is solved with w = w′ = 0 at the base and
    w′ = 0 at the top, where the shear is the cap beam's load.
    """
    x, first, second, force = sp.symbols("x a b c")
    height = 2 * sp.Rational(3)
    columns = 0 if ratio == math.inf else sp.Rational(1) / (1 + sp.nsimplify(ratio))
    spread = columns / 2 / height * load_over_weight(x)
    tip = (1 - columns) / 2 * load_over_weight(1)
    deflection = force * x**3 + second * x**2 + first
    load, places = spread, 4
    for _ in range(places):
        load = sp.integrate(load, x)
    deflection = load * height**4 + force * x**3 + second * x**2
    top = {x: 1}
    slope, shear = sp.diff(deflection, x) / height, sp.diff(deflection, x, 3) / height**3
    found = sp.solve([slope.subs(top), shear.subs(top) + tip], [second, force])
    moment = sp.diff(deflection, x, 2).subs(found) / height**2
    total = 2 * (sp.integrate(spread, (x, 0, 1)) * height + tip)
    over = 2 * (
        sp.integrate(spread * x, (x, 0, 1)) * height**2 + tip * (height + sp.Rational(1, 2))
    )
    return [float(total), float(over), float(moment.subs(x, 0)), float(-moment.subs(top))]


@pytest.mark.parametrize("ratio", RATIOS)
def test_rigid_frame_is_a_guided_beam_under_its_inertia(ratio):
    fixed = FixedFrame(RockingFrame(COLUMN, ratio), CAP)
    assert fixed.rigid == pytest.approx(of_beam(lambda x: sp.Integer(1), ratio), rel=1e-12)


@pytest.mark.parametrize("ratio", RATIOS)
def test_mode_is_a_guided_beam_under_the_inertia_of_its_shape(ratio):
    def shape(x):
        return 3 * sp.sympify(x) ** 2 - 2 * sp.sympify(x) ** 3

    x = sp.Symbol("x")
    columns = 0.0 if ratio == math.inf else 1.0 / (1.0 + ratio)
    linear, square = (float(sp.integrate(shape(x) ** power, (x, 0, 1))) for power in (1, 2))
    participation = (1 - columns + columns * linear) / (1 - columns + columns * square)
    expected = participation * np.array(of_beam(shape, ratio))
    fixed = FixedFrame(RockingFrame(COLUMN, ratio), CAP)
    assert fixed.mode == pytest.approx(expected, rel=1e-12)


def test_shape_is_that_of_a_force_at_the_guided_top():
    x = sp.Symbol("x")
    shape = 3 * x**2 - 2 * x**3
    assert [shape.subs(x, 0), shape.subs(x, 1)] == [0, 1]
    assert [sp.diff(shape, x).subs(x, end) for end in (0, 1)] == [0, 0]
    assert sp.diff(shape, x, 4) == 0


def test_peak_of_a_rigid_frame_is_that_of_the_ground():
    fixed = FixedFrame(RockingFrame(COLUMN, 1.0), CAP)
    assert peak_rigid(fixed, PULSE).base_shear == pytest.approx(0.4)
    assert peak_rigid(fixed, RECORD).base_shear == pytest.approx(RECORD.peak_acceleration)
    ricker = Pulse("ricker-symmetric", -0.3, 4.0)
    assert peak_rigid(fixed, ricker).base_shear == pytest.approx(0.3)


@pytest.mark.parametrize("ratio", RATIOS)
def test_stiff_frame_is_nearly_rigid(ratio):
    fixed = FixedFrame(RockingFrame(COLUMN, ratio), CAP)
    pulse = Pulse("one-sine", 0.4, 2.0 * math.pi / 1.5)  # begins without a jump
    (found,) = peak_elastic([fixed], pulse, 0.005)
    assert found == pytest.approx(peak_rigid(fixed, pulse), rel=0.01)


def test_resonance_is_that_of_five_per_cent_damping():
    fixed = FixedFrame(RockingFrame(COLUMN, math.inf), CAP)
    times = np.arange(0.0, 60.0, 0.005)
    record = Record(0.005, 0.1 * np.sin(2.0 * math.pi * times), "harmonic")
    (found,) = peak_elastic([fixed], record, 1.0)
    transmitted = math.sqrt(1.0 + 0.1**2) / 0.1  # √(1 + 4ζ²)/2ζ of a steady state
    assert found.base_shear == pytest.approx(0.1 * transmitted, rel=1e-3)


def test_suddenly_accelerated_frame_overshoots():
    fixed = FixedFrame(RockingFrame(COLUMN, math.inf), CAP)
    (found,) = peak_elastic([fixed], Record(5.0, np.array([0.2, 0.2]), "step"), 0.5, 2000)
    overshoot = 1.0 + math.exp(-0.05 * math.pi / math.sqrt(1.0 - 0.05**2))
    # the total acceleration also has the damper's part, at most 2ζ of it
    assert 0.2 * overshoot <= found.base_shear < 0.2 * overshoot * 1.01


@pytest.mark.parametrize("period", [0.1, 0.5, 2.0])
@pytest.mark.parametrize("motion", [PULSE, Record(0.02, RECORD.acceleration[:120], "part")])
def test_two_solvers_agree(motion, period):
    fixed = FixedFrame(RockingFrame(COLUMN, 1.0), CAP)
    (found,) = peak_elastic([fixed], motion, period, 1000)
    other = peak_elastic_by_scipy(fixed, motion, period, 1000)
    assert found == pytest.approx(other, rel=5e-5)
