"""A user's script: the library as an engineer would use it. Type-checked by test_types."""

import math
import sys
from typing import Any, assert_type

import numpy as np
from numpy.typing import NDArray

import topheavy
from topheavy import (
    STANDARD_GRAVITY,
    Cap,
    Capacity,
    Column,
    ContactForces,
    FactorInterval,
    FiniteShape,
    FixedMassColumn,
    Fragility,
    LowestOverturning,
    MonolithicPortal,
    Outcome,
    Pulse,
    PulseShape,
    Record,
    Response,
    RockingBlock,
    RockingFrame,
    Structure,
    Structures,
    capacity,
    contact_forces,
    fragility,
    impact_impulses,
    judge,
    lowest_overturning,
    overturned_by,
    overturning_intervals,
    overturning_map,
    overturning_spectrum,
    peak_rotations,
    plot,
    proven,
    read_record,
    simulate,
)

pier = Column.of_dimensions(width=1.6, height=9.6)
bent = RockingFrame.of_masses(pier, cap_mass=400e3, column_mass=60e3)
block = RockingBlock(2.0, 0.25, 0.9)
pulse = Pulse("one-sine", 1.0, 3.0)
long = Pulse("one-sine", 1.0, period=6.0)
assert_type(long.period, float)
times = np.linspace(0.0, 1.0, 5)
shaking = Record(0.02, [0.0, 0.1, -0.1, 0.0], "mine")
measured = read_record(sys.argv[1])

for motion in (pulse, shaking, measured.scaled(1.5)):
    assert_type(simulate(bent, motion), Response)
    assert_type(judge(bent, motion), Outcome)
    assert_type(judge(bent, motion).peak_rotation, float)
    assert_type(motion.excitation(0.1), float)
    assert_type(motion.excitation(times), NDArray[np.float64])
    assert_type(motion.excitation([0.0, 1]), NDArray[np.float64])
    assert_type(overturned_by(pier, motion, [1.0, 2.0]).any(), np.bool_)
    print(peak_rotations(pier, motion, [1.0, 2.0]).attrs["units"])
    minimum = lowest_overturning(bent, motion, (0, 5), floor=0.5)
    assert_type(minimum.acceleration, float)
    print(minimum)

structures: list[Structure] = [pier, bent, block, block.linear()]
for structure in structures:
    response = simulate(structure, pulse, duration=2, samples=[0.0, 0.5, 1.0])
    assert_type(response.rotation, NDArray[np.float64])
    if not response.overturned:
        print(f"{response.outcome}: {math.degrees(response.peak_rotation):.3g}°")
free = simulate(block, rotation=0.1, samples=200)

print(free.impact_times)

strength = capacity(pier, measured)
assert_type(strength, Capacity)
print(strength, strength.range, strength.over(0.1))
both: Structures = {"pier": pier, "bent": bent}
shape: FiniteShape = "one-sine"
any_shape: PulseShape = shape
minima = overturning_spectrum(both, shape, [1.0, 2.0])
print(minima["acceleration"].to_numpy())
spectrum = overturning_map(bent, "one-cosine", np.linspace(1.0, 4.0, 3), [0.5, 1.0])
print(spectrum.sizes["amplitude"], spectrum["overturned"].to_numpy().sum())
by_size = overturning_map(bent, measured, [2.0, 5.0], np.linspace(0.2, 1.0, 3))
print(by_size["overturned"].to_numpy().sum())
for interval in overturning_intervals(bent, pulse, (0.0, 2.0), resolution=0.5):
    assert_type(interval, FactorInterval)
    print(interval.lower[0], interval.number_of_impacts)
cap = Cap(span=6.0, half_depth=0.5)

motions = [shaking, measured, measured.scaled(2.0)]
curves = fragility({"pier": pier, "bent": bent}, motions, [0.2, 0.5, 1.0])
assert_type(curves, Fragility)
assert_type(fragility([pier, block], motions, times[1:], "PGA"), Fragility)
by_peak = fragility([bent], [long], [1.0], lambda motion: motion.peak_acceleration)
print(curves.pairs["gain"].to_numpy())

vase = FixedMassColumn(pier, 0.5, cap_width=3.0, cap_depth=1.0)
portal = MonolithicPortal(pier, 1.0, span=12.0)
assert_type(lowest_overturning(vase, pulse, (0, 5), floor=0.5), LowestOverturning)
assert_type(overturned_by([vase, portal, bent], pulse, [1.0, 2.0]), NDArray[np.bool_])

forces_over_time = contact_forces(bent, cap, simulate(bent, shaking), shaking)
print(float(forces_over_time["required_friction"].max()))
assert_type(impact_impulses(bent, cap, 0.1), ContactForces)
print(topheavy.__version__)
print(STANDARD_GRAVITY)

assert_type(measured.scaled_to(pgv=0.5), Record)
assert_type(measured.time, NDArray[np.float64])
assert_type(proven.certified(pier, pulse), dict[str, Any] | None)
for axes in (
    plot.history(simulate(bent, shaking, samples=times)),
    plot.forces(forces_over_time),
    plot.map(spectrum),
    plot.fragility(curves),
    plot.spectrum(minima),
    plot.rotations(peak_rotations([pier, bent], measured, [1.0, 2.0])),
    plot.capacity(strength),
    plot.structure(portal, 0.05),
):
    print(axes.get_xlabel())
