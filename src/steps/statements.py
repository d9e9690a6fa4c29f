"""Test statements of the paper that no other rule tests; each gives one finding."""

import numpy as np
import sympy as sp

from derivation.mechanics import cap_motion
from derivation.notation import NEGATIVE, POSITIVE, acceleration, is_identically_zero, read
from derivation.printed import EQUATIONS, rectangular_column
from replication.step import check, power_above, run, truth
from steps.shared.cases import cap_of, pulse_on
from steps.shared.three_bodies import simulate_three_bodies
from topheavy import (
    STANDARD_GRAVITY,
    Column,
    RockingBlock,
    RockingFrame,
    simulate,
)
from topheavy.bodies.free_rocking import quarter_period
from topheavy.bodies.kinematics import cap_acceleration, cap_displacement, column_outline
from topheavy.bodies.structures import simplified
from topheavy.forces.contacts import forces_at
from topheavy.kernel.step import TOLERANCE

AGREE = 1e-6  # of α, of √r and of the weight: what two integrations may differ by
ROUNDING = 1e-14  # of lengths over R
CLOSE = 1e-8  # of a number that two formulas give
SMALLEST = 1e-3  # of α: forces are compared beyond this rotation, away from impacts
SMALLEST_BOUNCE = 1e-5  # of p̂ α: the last bounces before rest, which both cut off, are left out
STEP_ASIDE = 1e-6  # of a threshold, to either side


# The frame as three bodies ------------------------------------------------------------------------


def three_bodies(frame, cap, pulse, duration, samples):
    """Compare three rigid bodies by Newton and Euler with the one degree of freedom of Eq. (23).

    The bodies have nine coordinates, and use neither Eq. (23) nor Eq. (25). Their equivalent column
    has the size R̂, and is given the frame's √r.
    """
    shape = {"span": cap["span"], "cap_depth": cap["depth"], "duration": duration}
    bodies = simulate_three_bodies(frame, pulse, **shape, samples=samples)
    times, alpha, p = bodies.time, frame.slenderness, frame.frequency_parameter
    block = simulate(frame, pulse, duration=duration, samples=times)
    both = np.isfinite(block.rotation) & np.isfinite(bodies.rotation[:, 0])

    def apart(other):
        return np.nanmax(np.abs(bodies.rotation - other.rotation[:, None])[both]) / alpha

    scale = frame.equivalent_size / frame.column.size
    equivalent = Column(scale * frame.column.half_width, scale * frame.column.half_height)
    twin, other = (
        simulate(equivalent.block(ratio), pulse, duration=duration, samples=times)
        for ratio in (frame.restitution, equivalent.restitution)
    )

    before = simulate(frame, pulse, samples=block.impact_times - 1e-9 / p).velocity
    impacts = block.impact_times[np.abs(before) > SMALLEST_BOUNCE * p * alpha]
    nearest = np.abs(bodies.impacts[None, :] - impacts[:, None]).argmin(axis=1)
    ratios = bodies.velocity_ratios[nearest]

    ground, weight = pulse.excitation(times), 2.0 * (1.0 + frame.mass_ratio) * STANDARD_GRAVITY
    closed = forces_at(frame, cap_of(cap), block.rotation, block.velocity, ground)
    closed = np.stack([closed.horizontal.T, closed.vertical.T], -1)
    gap = np.abs(times[:, None] - block.impact_times).min(axis=1, initial=np.inf)
    flying = both & (gap > 1e-3 / p) & (np.abs(block.rotation) > SMALLEST * alpha)

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
        "equivalent_with_its_own_restitution": apart(other),
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
    """Yield what single histories and formulas give: statement, quantity and number."""
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
    for name, part in (("before", before), ("after", after)):
        yield "rocks_left_then_right", f"least {name}", part.min()
        yield "rocks_left_then_right", f"largest {name}", part.max()

    for start in (0.1, 0.5, 0.9, 0.99):
        block = RockingBlock(1.0, column.slenderness, 1.0)
        by_energy = quarter_period(block, start * block.slenderness)
        motion = simulate(block, rotation=start * block.slenderness, duration=10.0, samples=2)
        check(
            abs(motion.impact_times[0] - by_energy) < 1e-7,
            f"quarter periods {motion.impact_times[0]}, {by_energy}",
        )
        yield "period_depends_on_amplitude", f"quarter period from {start} α, 1/p", by_energy

    nearly, limit = RockingFrame(column, 1e9).block().linear(), simplified(frame)["all"]
    for name in ("frequency_parameter", "restitution"):
        apart = abs(getattr(nearly, name) / getattr(limit, name) - 1.0)
        yield "massless_columns_are_a_limit", name, power_above(apart, TOLERANCE)


def structure(column, mass_ratios):
    """Yield what geometry and algebra give: statement, quantity and number."""
    rotations = np.linspace(-column.slenderness, column.slenderness, 101)
    moved = np.transpose(cap_displacement(column, rotations))
    seats = [2 if theta < 0.0 else 3 for theta in rotations]  # the corner that carries the cap beam
    at_rest = column_outline(column, 0.0)
    corners = [
        column_outline(column, theta)[seat] - at_rest[seat]
        for theta, seat in zip(rotations, seats, strict=True)
    ]
    gap = np.abs(corners - moved).max() / column.size
    yield "cap_stays_on_its_seats", "gap over R", power_above(gap, ROUNDING)

    for gamma in mass_ratios:  # the weight of the cap beam acts at the height of the column tops
        height = (1.0 + 2.0 * gamma) / (1.0 + gamma) * column.half_height
        yield "centre_of_gravity_rises", f"height at γ = {gamma:g}", height
        yield (
            "centre_of_gravity_rises",
            f"size at γ = {gamma:g}",
            RockingFrame(column, gamma).equivalent_size,
        )

    has_it = cap_motion(NEGATIVE).v_ddot.has(acceleration)
    yield "reactions_need_the_acceleration", "v̈ has θ̈", has_it

    names = {equation.name: equation for equation in EQUATIONS}
    p = {"p": rectangular_column(NEGATIVE)[sp.Symbol("p")]}
    for version in ("printed", "meant"):
        for name, side in {"eq19": NEGATIVE, "eq22": POSITIVE}.items():
            sides = read(getattr(names[name], version), side), read(names["eq23"].printed, side)
            same = is_identically_zero((sides[0][1] - sides[1][1]).subs(p), side)
            yield "compact_form", f"{version} {name}", same


def compute(settings, structures):
    column = Column(**structures["temple"])
    duration, samples = settings["duration"], settings["samples"]
    pulses = [pulse_on(column, **pulse) for pulse in settings["pulses"]]
    frames = [RockingFrame(column, gamma) for gamma in settings["mass_ratios"]]
    rows = [
        *oscillator(RockingFrame(column, 1.0), pulses[0]),
        *structure(column, [0.0, *settings["mass_ratios"]]),
    ]
    return {
        "three_bodies": [
            three_bodies(frame, settings["cap"], pulse, duration, samples)
            for pulse in pulses
            for frame in frames
        ],
        "statements": [
            dict(zip(("statement", "quantity", "value"), (s, q, float(x)), strict=True))
            for s, q, x in rows
        ],
    }


def findings(three_bodies, statements):
    of = {name: rows.set_index("quantity").value for name, rows in statements.groupby("statement")}
    worst = three_bodies.filter(regex="apart$|tilt$").max()
    left, right = (
        of["rocks_left_then_right"][[f"least {one}", f"largest {one}"]]
        for one in ("before", "after")
    )
    ground, overturned = of["rocks_left_then_right"][["ground", "overturned"]]
    heights, sizes = (
        of["centre_of_gravity_rises"].filter(like=name) for name in ("height", "size")
    )
    compact = of["compact_form"] == 1.0
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
        "rigid_until_uplift": truth(list(of["rigid_until_uplift"]) == [1.0, 0.0]),
        "rocks_left_then_right": truth(
            ground > 0.0 == overturned
            and left.iloc[0] < 0.0 >= left.iloc[1]
            and right.iloc[0] >= 0.0 < right.iloc[1]
        ),
        "period_depends_on_amplitude": truth(
            (np.diff(of["period_depends_on_amplitude"]) > 0.0).all()
        ),
        "massless_columns_are_a_limit": truth((of["massless_columns_are_a_limit"] < CLOSE).all()),
        "cap_stays_on_its_seats": truth(of["cap_stays_on_its_seats"].max() < 1e-12),
        "centre_of_gravity_rises": truth(
            (np.diff(heights) > 0.0).all() and (np.diff(sizes) > 0.0).all()
        ),
        "reactions_need_the_acceleration": truth(of["reactions_need_the_acceleration"].all()),
        "compact_form": truth(compact.filter(like="meant").all()),
    }


if __name__ == "__main__":
    run(snakemake, compute, findings)
