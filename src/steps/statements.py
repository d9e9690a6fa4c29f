"""Test statements of the paper that no other rule tests; each gives one finding."""

import numpy as np
import sympy as sp

from derivation.mechanics import cap_motion
from derivation.notation import NEGATIVE, POSITIVE, acceleration, is_identically_zero, read
from derivation.printed import EQUATIONS, rectangular_column
from replication.step import check, power_above, run, truth
from steps.shared.cases import cap_of, pulse_on
from steps.shared.three_bodies import simulate_three_bodies
from topheavy import STANDARD_GRAVITY, Column, RockingBlock, RockingFrame, simulate
from topheavy.bodies.free_rocking import quarter_period
from topheavy.bodies.kinematics import cap_acceleration, cap_displacement, column_outline
from topheavy.bodies.structures import simplified
from topheavy.forces.contacts import forces_at
from topheavy.kernel.step import TOLERANCE

AGREE = 1e-6  # difference of two integrations: rotations times α, √r, forces times the weight
ROUNDING = 1e-14  # difference of lengths, times R
CLOSE = 1e-8  # relative difference of a number by two formulas
SMALLEST = 1e-3  # rotation beyond which forces are compared, times α
SMALLEST_BOUNCE = 1e-5  # velocity at an impact, times p̂ α; both solvers cut off slower bounces
STEP_ASIDE = 1e-6  # relative distance from a threshold, to either side


# The frame as three bodies ------------------------------------------------------------------------


def three_bodies(frame, cap, pulse, duration, samples):
    """Compare three rigid bodies by Newton and Euler with the one degree of freedom of Eq. (23).

    The bodies have nine coordinates, and use neither Eq. (23) nor Eq. (25). Their equivalent column
    has the size R̂, and is given the frame's √r.
    """
    bodies = simulate_three_bodies(frame, cap, pulse, duration=duration, samples=samples)
    times, alpha, p = bodies.time, frame.slenderness, frame.frequency_parameter
    scale = frame.equivalent_size / frame.column.size
    equivalent = Column(scale * frame.column.half_width, scale * frame.column.half_height)
    block, twin, larger_column = (
        simulate(structure, pulse, duration=duration, samples=times)
        for structure in (frame, equivalent.block(frame.restitution), equivalent)
    )
    rocking = np.isfinite(block.rotation) & np.isfinite(bodies.rotation[:, 0])

    def apart(response):
        return np.nanmax(np.abs(bodies.rotation - response.rotation[:, None])[rocking]) / alpha

    before = simulate(frame, pulse, samples=block.impact_times - 1e-9 / p).velocity
    impacts = block.impact_times[np.abs(before) > SMALLEST_BOUNCE * p * alpha]
    nearest = np.abs(bodies.impacts[None, :] - impacts[:, None]).argmin(axis=1)
    ratios = bodies.velocity_ratios[nearest]

    ground, weight = pulse.excitation(times), 2.0 * (1.0 + frame.mass_ratio) * STANDARD_GRAVITY
    closed = forces_at(frame, cap, block.rotation, block.velocity, ground)
    closed = np.stack([closed.horizontal.T, closed.vertical.T], -1)
    gap = np.abs(times[:, None] - block.impact_times).min(axis=1, initial=np.inf)
    flying = rocking & (gap > 1e-3 / p) & (np.abs(block.rotation) > SMALLEST * alpha)

    # Fig. 2: at θ < 0 the forces on the cap beam balance its weight and inertia by Eqs. (6), (9).
    left = flying & (block.rotation < 0.0)
    lean = alpha + block.rotation
    turning = p**2 * (np.sin(lean) - ground * np.cos(lean))  # Eq. (19), as meant
    across, up = cap_acceleration(frame.column, block.rotation, block.velocity, turning)
    needed = np.stack([across + ground * STANDARD_GRAVITY, up + STANDARD_GRAVITY], axis=1)
    on_cap = bodies.forces[:, 2:].sum(axis=1) - 2.0 * frame.mass_ratio * needed  # columns of 1 kg
    differences = {
        "rotation_apart": apart(block),
        "equivalent_apart": apart(twin),
        "equivalent_with_its_own_restitution": apart(larger_column),
        "restitution_apart": np.abs(ratios - frame.restitution).max(initial=0.0),
        "force_apart": np.abs(bodies.forces / weight - closed)[flying].max(),
        "cap_balance_apart": np.abs(on_cap)[left].max(initial=0.0) / weight,
        "cap_tilt": np.nanmax(np.abs(bodies.coordinates[:, 8])) / alpha,
    }
    return {
        "mass_ratio": frame.mass_ratio,
        "pulse": pulse.shape,
        "impacts": len(impacts),
        "instants": int(left.sum()),
        **{name: power_above(size, TOLERANCE) for name, size in differences.items()},
        "same_outcome": (bodies.outcome == "overturned") == bool(np.isnan(block.rotation[-1])),
    }


# Geometry, algebra and single histories -----------------------------------------------------------


def oscillator(frame, pulse):
    """Yield the results of single histories and formulas: statement, quantity and number."""
    column = frame.column
    for name, share in (("above", 1.0 + STEP_ASIDE), ("below", 1.0 - STEP_ASIDE)):
        weak = pulse.scaled(share * column.uplift_acceleration / pulse.amplitude)
        response = simulate(column, weak, samples=2)
        yield "rigid_until_uplift", f"uplifts {name}", response.outcome != "no uplift"

    response = simulate(frame, pulse, samples=4001)
    first, second, *_ = response.impact_times
    before = response.rotation[response.time < first]
    after = response.rotation[(response.time > first) & (response.time < second)]
    yield "rocks_left_then_right", "ground", pulse.excitation(pulse.duration / 8)
    yield "rocks_left_then_right", "overturned", response.overturned
    for name, rotation in (("before", before), ("after", after)):
        yield "rocks_left_then_right", f"least {name}", rotation.min()
        yield "rocks_left_then_right", f"largest {name}", rotation.max()

    block = RockingBlock(1.0, column.slenderness, 1.0)
    for start in (0.1, 0.5, 0.9, 0.99):
        rotation = start * block.slenderness
        by_energy = quarter_period(block, rotation)
        impact, *_ = simulate(block, rotation=rotation, duration=10.0, samples=2).impact_times
        message = f"a quarter period is {impact} by simulation and {by_energy} by energy"
        check(abs(impact - by_energy) < 1e-7, message)
        yield "period_depends_on_amplitude", f"quarter period from {start} α, 1/p", by_energy

    nearly, limit = RockingFrame(column, 1e9).block().linear(), simplified(frame)["all"]
    for name in ("frequency_parameter", "restitution"):
        apart = abs(getattr(nearly, name) / getattr(limit, name) - 1.0)
        yield "massless_columns_are_a_limit", name, power_above(apart, TOLERANCE)


def structure(column, mass_ratios):
    """Yield the results of geometry and algebra: statement, quantity and number."""
    rotations = np.linspace(-column.slenderness, column.slenderness, 101)
    displacements, gaps = np.transpose(cap_displacement(column, rotations)), []
    for rotation, displacement in zip(rotations, displacements, strict=True):
        corner = 2 if rotation < 0.0 else 3  # the one that carries the cap beam
        seat = column_outline(column, rotation)[corner] - column_outline(column, 0.0)[corner]
        gaps.append(np.abs(seat - displacement).max())
    gap = power_above(max(gaps) / column.size, ROUNDING)
    yield "cap_stays_on_its_seats", "gap over R", gap

    for gamma in mass_ratios:  # the weight of the cap beam acts at the height of the column tops
        height = (1.0 + 2.0 * gamma) / (1.0 + gamma) * column.half_height
        size = RockingFrame(column, gamma).equivalent_size
        yield "centre_of_gravity_rises", f"height at γ = {gamma:g}", height
        yield "centre_of_gravity_rises", f"size at γ = {gamma:g}", size

    has_acceleration = cap_motion(NEGATIVE).v_ddot.has(acceleration)
    yield "reactions_need_the_acceleration", "v̈ has θ̈", has_acceleration

    names = {equation.name: equation for equation in EQUATIONS}
    p = {"p": rectangular_column(NEGATIVE)[sp.Symbol("p")]}
    for version in ("printed", "meant"):
        for name, side in {"eq19": NEGATIVE, "eq22": POSITIVE}.items():
            _, right = read(getattr(names[name], version), side)
            _, compact = read(names["eq23"].printed, side)
            is_same = is_identically_zero((right - compact).subs(p), side)
            yield "compact_form", f"{version} {name}", is_same


def compute(settings, structures):
    column, cap = Column(**structures["temple"]), cap_of(settings["cap"])
    duration, samples = settings["duration"], settings["samples"]
    pulses = [pulse_on(column, **pulse) for pulse in settings["pulses"]]
    frames = [RockingFrame(column, gamma) for gamma in settings["mass_ratios"]]
    rows = [
        *oscillator(RockingFrame(column, 1.0), pulses[0]),
        *structure(column, [0.0, *settings["mass_ratios"]]),
    ]
    return {
        "three_bodies": [
            three_bodies(frame, cap, pulse, duration, samples)
            for pulse in pulses
            for frame in frames
        ],
        "statements": [
            {"statement": statement, "quantity": quantity, "value": float(number)}
            for statement, quantity, number in rows
        ],
    }


def findings(three_bodies, statements):
    numbers = {
        name: rows.set_index("quantity").value for name, rows in statements.groupby("statement")
    }
    worst = three_bodies.filter(regex="apart$|tilt$").max()
    start, centre = numbers["rocks_left_then_right"], numbers["centre_of_gravity_rises"]
    heights, sizes = centre.filter(like="height"), centre.filter(like="size")
    return {
        "one_degree_of_freedom": truth(
            worst.max() < AGREE and three_bodies.same_outcome.all(),
            histories=len(three_bodies),
            rotation_apart=worst.rotation_apart,
        ),
        "identical_response": truth(
            three_bodies.equivalent_with_its_own_restitution.max() < AGREE,
            holds_when=worst.equivalent_apart < AGREE,
            condition="the larger column is given the frame's √r",
            apart=worst.equivalent_apart,
        ),
        "forces_on_the_cap_balance": truth(
            worst.cap_balance_apart < AGREE and three_bodies.instants.sum() > 0
        ),
        "rigid_until_uplift": truth(list(numbers["rigid_until_uplift"]) == [1.0, 0.0]),
        "rocks_left_then_right": truth(
            start["ground"] > 0.0 == start["overturned"]
            and start["least before"] < 0.0 >= start["largest before"]
            and start["least after"] >= 0.0 < start["largest after"]
        ),
        "period_depends_on_amplitude": truth(
            (np.diff(numbers["period_depends_on_amplitude"]) > 0.0).all()
        ),
        "massless_columns_are_a_limit": truth(
            (numbers["massless_columns_are_a_limit"] < CLOSE).all()
        ),
        "cap_stays_on_its_seats": truth(numbers["cap_stays_on_its_seats"].max() < 1e-12),
        "centre_of_gravity_rises": truth(
            (np.diff(heights) > 0.0).all() and (np.diff(sizes) > 0.0).all()
        ),
        "reactions_need_the_acceleration": truth(numbers["reactions_need_the_acceleration"].all()),
        "compact_form": truth((numbers["compact_form"].filter(like="meant") == 1.0).all()),
    }


if __name__ == "__main__":
    run(snakemake, compute, findings)
