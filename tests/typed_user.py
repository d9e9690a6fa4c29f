"""A user's script: the library as an engineer would use it. Type-checked by test_types."""

import sys
from typing import assert_type

import numpy as np
from numpy.typing import NDArray

import topheavy as th

pier = th.Column.of_dimensions(width=1.6, height=9.6)
bent = th.RockingFrame.of_masses(pier, cap_mass=400e3, column_mass=60e3)
block = th.RockingBlock(2.0, 0.25, 0.9)
pulse = th.Pulse("one-sine", 1.0, angular_frequency=3.0)
long = th.Pulse("one-sine", 1.0, period=6.0)
assert_type(long.period, float)
times = np.linspace(0.0, 1.0, 5)
shaking = th.Record(0.02, [0.0, 0.1, -0.1, 0.0], "mine")
measured = th.read_record(sys.argv[1])

for motion in (pulse, shaking, measured.scaled(1.5)):
    assert_type(th.simulate(bent, motion), th.Response)
    assert_type(th.judge(bent, motion), th.Outcome)
    assert_type(th.judge(bent, motion).peak_rotation, float)
    assert_type(motion.excitation(0.1), float)
    assert_type(motion.excitation(times), NDArray[np.float64])
    assert_type(th.overturned_by(pier, motion, [1.0, 2.0]).any(), np.bool_)
    print(th.peak_rotations(pier, motion, [1.0, 2.0]).attrs["units"])
    minimum = th.lowest_overturning(bent, motion, (0, 5), floor=0.5)
    assert_type(minimum.acceleration, float)

structures: list[th.Structure] = [pier, bent, block, block.linear()]
for structure in structures:
    response = th.simulate(structure, pulse, duration=2, samples=[0.0, 0.5, 1.0])
    assert_type(response.rotation, NDArray[np.float64])
strength = th.capacity(pier, measured)
assert_type(strength, th.Capacity)
pair: th.Structures = {"pier": pier, "bent": bent}
shape: th.FiniteShape = "one-sine"
any_shape: th.PulseShape = shape
minima = th.overturning_spectrum(pair, shape, [1.0, 2.0])
spectrum = th.overturning_map(bent, "one-cosine", np.linspace(1.0, 4.0, 3), [0.5, 1.0])
for interval in th.overturning_intervals(bent, pulse, (0.0, 2.0), resolution=0.5):
    assert_type(interval, th.FactorInterval)
cap = th.Cap(span=6.0, half_depth=0.5)

motions = [shaking, measured, measured.scaled(2.0)]
curves = th.fragility({"pier": pier, "bent": bent}, motions, [0.2, 0.5, 1.0])
assert_type(curves, th.Fragility)
assert_type(th.fragility([pier, block], motions, times[1:], "PGA"), th.Fragility)

vase = th.FixedMassColumn(pier, 0.5, cap_width=3.0, cap_depth=1.0)
portal = th.MonolithicPortal(pier, 1.0, span=12.0)
assert_type(th.lowest_overturning(vase, pulse, (0, 5), floor=0.5), th.LowestOverturning)
assert_type(th.overturned_by([vase, portal, bent], pulse, [1.0, 2.0]), NDArray[np.bool_])

forces_over_time = th.contact_forces(bent, cap, th.simulate(bent, shaking), shaking)
assert_type(th.impact_impulses(bent, cap, 0.1), th.ContactForces)
print(th.__version__)
print(th.STANDARD_GRAVITY)

assert_type(measured.scaled_to(pgv=0.5), th.Record)
assert_type(measured.time, NDArray[np.float64])
for axes in (
    th.plot.history(th.simulate(bent, shaking, samples=times)),
    th.plot.forces(forces_over_time),
    th.plot.map(spectrum),
    th.plot.fragility(curves),
    th.plot.spectrum(minima),
    th.plot.rotations(th.peak_rotations([pier, bent], measured, [1.0, 2.0])),
    th.plot.capacity(strength),
    th.plot.structure(portal, 0.05),
):
    print(axes.get_xlabel())
