"""Frames in a rigid-body engine: restitution, outcomes near the minimum, and across the plane."""

import math
from dataclasses import replace
from itertools import product

import numpy as np
import pandas as pd

from replication.step import check, run, truth
from steps.beyond.rigid_bodies import Bodies, overturns, rebound
from steps.shared.cases import HIGHEST, cap_of, lowest, pulse_on
from topheavy import Column, FixedMassColumn, RockingFrame, judge, simulate

CLOSE = 0.005  # of √r: agreement with Eq. (25)
NO_REBOUND = 0.2  # coefficient of restitution of a point, below which a contact has no rebound
HARD = 0.01  # normalised by 1/p: time constant up to which a contact is hard
FRICTION = 1.0  # of the contacts of a release
STEPS_IN_CONTACT = 4  # time steps in the time constant, or in the period of a stiffer contact
BELOW = 0.2  # steps below a known minimum: from where the first amplitude that overturns is sought
IN_PLANE, ACROSS = 0.0, 90.0  # degrees
COLUMN, FIXED, IN_LINE, SLAB = "column", "fixed mass", "two in line", "2 × 2"
LABELS = "structure", "direction", "section", "depth_over_width", "mass_ratio", "frequency_ratio"


def compute(settings, structures):
    return {
        "restitution": restitution(settings, structures),
        "outcomes": outcomes(settings, structures),
        "across": across(settings, structures),
    }


def frames_of(frames, settings, structures):
    """Yield structure, frame and cap beam of an entry of mass ratios by structure."""
    for name, mass_ratios in frames.items():
        for gamma in mass_ratios:
            frame = RockingFrame(Column(**structures[name]), gamma)
            yield name, frame, cap_of(settings["caps"][name])


def planar(frame, cap, time_step, **contact):
    """Return a column or a frame in its plane, as deep as a column is wide."""
    column, in_row = frame.column, 2 if frame.mass_ratio else 1
    shape = {"in_row": in_row, "is_planar": True}
    return Bodies(column, column.half_width, frame.mass_ratio, cap, time_step, **shape, **contact)


def restitution_of(bodies, frame, lean):
    """Return the coefficient of restitution at the first impact after a release at θ = lean α."""
    rotation = lean * frame.slenderness
    first, second = simulate(frame, rotation=rotation, samples=2).impact_times[:2]
    return rebound(bodies, rotation, float(first + 0.75 * (second - first)))


def restitution(settings, structures):
    """Return √r in free rocking and that of Eq. (25), by damping and time constant of contacts."""
    spec = settings["restitution"]
    return pd.DataFrame(
        {
            "structure": name,
            "mass_ratio": frame.mass_ratio,
            "damping_ratio": ratio,
            "time_constant": constant,
            "point_restitution": point_restitution(ratio),
            "engine": restitution_of(
                planar(
                    frame,
                    cap,
                    constant * min(1.0, ratio) / STEPS_IN_CONTACT,
                    time_constant=constant,
                    damping_ratio=ratio,
                    friction=FRICTION,
                ),
                frame,
                spec["lean"],
            ),
            "theory": frame.restitution,
        }
        for name, frame, cap in frames_of(spec["frames"], settings, structures)
        for ratio in spec["damping_ratios"]
        for constant in spec["time_constants"]
    )


def point_restitution(damping_ratio):
    """Return the coefficient of restitution of a point that hits a spring and damper.

    They push only, and let go when their force vanishes (Schwager & Pöschel 2007), so that even
    critical damping gives back e⁻². Gravity is left out: it matters to slow hits on soft contacts.
    """
    root = math.sqrt(abs(1.0 - damping_ratio**2))
    if root == 0.0:
        return math.exp(-2.0)
    # Half the contact's length in phase, by the angle or its hyperbolic counterpart.
    angle = math.atan2 if damping_ratio < 1.0 else lambda s, c: math.atanh(s / c)
    return math.exp(-2.0 * damping_ratio / root * angle(root, damping_ratio))


def outcomes(settings, structures):
    """Return the outcomes in engine and theory near the minimum overturning acceleration."""
    spec, rows = settings["outcomes"], []
    for name, frame, cap in frames_of(spec["frames"], settings, structures):
        pulses = [(kind, minimum(frame, kind)) for kind in spec["pulses"]]
        for contact, properties in spec["contacts"].items():
            solver = {name: spec[name] for name in ("time_step", "friction")} | properties
            bodies = planar(frame, cap, **solver)
            measured = restitution_of(bodies, frame, spec["lean"])
            refitted = frame.block().with_restitution(measured)
            rows += [
                {
                    "structure": name,
                    "mass_ratio": frame.mass_ratio,
                    "contact": contact,
                    **kind,
                    "factor": factor,
                    "engine": overturns(bodies, pulse := lowest.scaled(factor)),
                    "theory": judge(frame, pulse).overturned,
                    "theory_with_rebound": judge(refitted, pulse).overturned,
                }
                for kind, lowest in pulses
                for factor in spec["factors"]
            ]
    return pd.DataFrame(rows)


def minimum(frame, kind, column=None):
    """Return the pulse of the minimum in theory; ω is over p of its own or of a given column."""
    pulse = pulse_on(column or frame.column, **kind)
    return replace(pulse, amplitude=lowest(frame, pulse).factor)


def across(settings, structures):
    """Return the first amplitudes that overturn in the plane and across it.

    They are over the minimum of the square column in theory, as are the uplift acceleration by hand
    and the minimum in theory, which is not known for round columns and oblique directions. There
    they are sought from just below the column's own in the same direction, if it is known.
    """
    spec, free = settings["across"], [(IN_LINE, IN_PLANE), (IN_LINE, ACROSS), (SLAB, IN_PLANE)]
    frequency, (light, *_, heavy) = spec["frequency_ratios"][0], spec["mass_ratios"]
    square = [(COLUMN, IN_PLANE, "square", 1.0, 0.0, ratio) for ratio in spec["frequency_ratios"]]
    square += [
        (*one, "square", 1.0, gamma, ratio)
        for ratio, gamma in product(spec["frequency_ratios"], spec["mass_ratios"])
        for one in ((FIXED, IN_PLANE), *free)
    ]
    deep = [
        (IN_LINE, ACROSS, "square", depth, gamma, frequency)
        for gamma, depth in product(spec["mass_ratios"], spec["depths"])
    ]
    oblique = [
        (name, direction, "square", 1.0, gamma, frequency)
        for direction in spec["oblique"]
        for name, gamma in ((COLUMN, 0.0), *((SLAB, gamma) for gamma in spec["mass_ratios"]))
    ]
    cases = [(row, {}) for row in square + deep + oblique]
    cases += [((*one, "round", 1.0, light, frequency), {}) for one in free]
    again = [row for row in square if row[4:] == (heavy, frequency)]
    cases += product(again, spec["checks"])
    rows, of_column = [], {}
    for row, changed in cases:
        rows.append(first(row, changed, of_column.get(row[1], 0.0), settings, structures))
        if row[0] == COLUMN:
            of_column[row[1]] = rows[-1]["engine"]
    return pd.DataFrame(rows)


def first(row, changed, of_column, settings, structures):
    spec, (name, direction, section, depth, gamma, ratio) = settings["across"], row
    column = Column(**structures[spec["structure"]])
    cap = cap_of(settings["caps"][spec["structure"]])
    side = Column(depth * column.half_width, column.half_height)
    kind = {"shape": spec["shape"], "frequency_ratio": ratio}
    alone, theory = minimum(column, kind, column), RockingFrame(column, gamma)
    if name == FIXED or direction == ACROSS:
        theory = FixedMassColumn(side, gamma, 2.0 * side.half_width, 2.0 * cap.half_depth)
    solver = {"time_step": spec["time_step"], "friction": spec["friction"]} | changed
    bodies = Bodies(
        column,
        side.half_width,
        gamma,
        cap,
        in_row=1 if name in (COLUMN, FIXED) else 2,
        rows=2 if name == SLAB else 1,
        is_round=section == "round",
        is_fixed=name == FIXED,
        **solver,
    )
    uplift, step = theory.uplift_acceleration / alone.amplitude, spec["step"]
    expected = math.nan
    if section == "square" and direction in (IN_PLANE, ACROSS):
        expected = minimum(theory, kind, column).amplitude / alone.amplitude
    begin = max(uplift, np.nan_to_num(expected, nan=of_column) - BELOW * step)
    factors = step * np.arange(math.floor(begin / step), math.ceil(HIGHEST / step))
    lowest = next(f for f in factors if overturns(bodies, alone.scaled(f), direction))
    message = f"{row}, {changed}: from {lowest:.2f} on; expected {expected:.3f} within a step"
    check(lowest > factors[0] and not abs(lowest - expected) > 1.5 * step, message)
    numbers = {"uplift": uplift, "theory": expected, "engine": lowest}
    return dict(zip(LABELS, row, strict=True)) | solver | numbers


def findings(engine_restitution, engine_outcomes, engine_across):
    difference = engine_restitution.engine / engine_restitution.theory - 1.0
    frames = engine_restitution.mass_ratio > 0.0
    hard = engine_restitution.time_constant <= HARD
    rebounds = engine_restitution.point_restitution >= NO_REBOUND
    agrees = engine_outcomes.engine == engine_outcomes.theory
    refitted = engine_outcomes.engine == engine_outcomes.theory_with_rebound
    plain = engine_outcomes.contact == "no rebound"
    square = engine_across[engine_across.depth_over_width == 1.0]
    is_oblique = ~square.direction.isin([IN_PLANE, ACROSS])
    table, slab = square[~is_oblique], square[is_oblique & (square.structure == SLAB)]
    oblique = square[is_oblique & (square.structure == COLUMN)].set_index("direction").engine
    margin = slab.engine / slab.direction.map(oblique)
    alone = table[table.structure == COLUMN].set_index("frequency_ratio").engine
    gain = table.engine - table.frequency_ratio.map(alone)
    deep = engine_across[(engine_across.section == "square") & (engine_across.direction == ACROSS)]
    enough = deep[deep.engine >= deep.frequency_ratio.map(alone)].groupby("mass_ratio")
    weaker = table.direction == ACROSS
    stronger = table.structure.isin([IN_LINE, SLAB]) & ~weaker
    return {
        "maximum_restitution": truth(
            difference.max() < CLOSE,
            holds_when=difference[hard].max() < CLOSE,
            condition="the contacts are hard",
            apart_without_rebound=difference[frames & hard & ~rebounds].abs().max(),
            lowest_with_rebound=difference[frames & rebounds].min(),
        ),
        "same_verdicts": truth(
            agrees.all(),
            holds_when=agrees[plain].all(),
            condition="the contacts do not rebound",
            pulses=plain.sum(),
            share_without_rebound=agrees[plain].mean(),
            share_with_rebound=agrees[~plain].mean(),
            share_with_rebound_in_theory=refitted[~plain].mean(),
            apart=(~agrees).sum(),
            apart_that_survive=(~engine_outcomes.engine[~agrees]).sum(),
        ),
        "across_the_plane": truth(
            gain[weaker].max() < 0.0 < min(gain[stronger].min(), margin.min() - 1.0),
            lowest=table.engine[weaker].min(),
            highest=table.engine[weaker].max(),
            lowest_of_slab=table.engine[table.structure == SLAB].min(),
            highest_of_slab=table.engine[table.structure == SLAB].max(),
            lowest_of_slab_in_theory=table.theory[table.structure == SLAB].min(),
            highest_of_slab_in_theory=table.theory[table.structure == SLAB].max(),
            least_oblique=margin.min(),
            most_oblique=margin.max(),
            enough_depths=enough.depth_over_width.min().to_list(),
            apart_from_theory=(engine_across.engine - engine_across.theory).abs().max(),
        ),
    }


if __name__ == "__main__":
    run(snakemake, compute, findings)
