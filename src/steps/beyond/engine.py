"""Frames in a rigid-body engine: coefficient of restitution, and outcomes near the minimum."""

import math

import pandas as pd

from replication.step import run, truth
from steps.beyond.boxes import Boxes, overturns, rebound
from topheavy import Cap, Column, Pulse, RockingFrame, judge, lowest_overturning, simulate

CLOSE = 0.005  # of √r: agreement with Eq. (25)
NO_REBOUND = 0.2  # coefficient of restitution of a point, below which a contact has no rebound
HARD = 0.01  # over 1/p: time constant up to which a contact is hard
STEPS_IN_CONTACT = 4  # time steps in the time constant, or in the period of a stiffer contact
HIGHEST = 40.0  # over g tan α: end of the search for the minimum overturning acceleration


def compute(settings, structures):
    return {
        "restitution": restitution(settings, structures),
        "outcomes": outcomes(settings, structures),
    }


def frames_of(frames, settings, structures):
    """Yield structure, frame and cap beam of an entry of mass ratios by structure."""
    for name, mass_ratios in frames.items():
        span, depth = settings["caps"][name].values()
        for gamma in mass_ratios:
            yield name, RockingFrame(Column(**structures[name]), gamma), Cap(span, depth / 2.0)


def boxes_of(frame, cap, time_step, time_constant, **contact):
    """Return boxes from a time step and a time constant over 1/p."""
    scale = 1.0 / frame.column.frequency_parameter
    return Boxes(frame, cap, scale * time_step, scale * time_constant, **contact)


def released(boxes, lean):
    """Return the coefficient of restitution at the first impact after a release at θ = lean α."""
    rotation = lean * boxes.frame.slenderness
    first, second = simulate(boxes.frame, rotation=rotation, samples=2).impacts[:2]
    return rebound(boxes, rotation, float(first + 0.75 * (second - first)))


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
            "engine": released(
                boxes_of(
                    frame,
                    cap,
                    constant * min(1.0, ratio) / STEPS_IN_CONTACT,
                    constant,
                    damping_ratio=ratio,
                ),
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
            boxes = boxes_of(frame, cap, spec["time_step"], friction=spec["friction"], **properties)
            found = released(boxes, spec["lean"])
            refitted = frame.block().with_restitution(found)
            rows += [
                {
                    "structure": name,
                    "mass_ratio": frame.mass_ratio,
                    "contact": contact,
                    **kind,
                    "factor": factor,
                    "engine": overturns(boxes, pulse := lowest.scaled(factor)),
                    "theory": judge(frame, pulse).overturned,
                    "theory_with_rebound": judge(refitted, pulse).overturned,
                }
                for kind, lowest in pulses
                for factor in spec["factors"]
            ]
    return pd.DataFrame(rows)


def minimum(frame, kind):
    """Return the pulse of the minimum overturning acceleration in theory."""
    omega, tan = (
        kind["frequency_ratio"] * frame.column.frequency_parameter,
        frame.uplift_acceleration,
    )
    unit = Pulse(kind["shape"], 1.0, omega)
    return unit.scaled(
        lowest_overturning(frame, unit, (tan, HIGHEST * tan), floor=0.01 * tan).factor
    )


def findings(engine_restitution, engine_outcomes):
    difference = engine_restitution.engine / engine_restitution.theory - 1.0
    frames = engine_restitution.mass_ratio > 0.0
    hard = engine_restitution.time_constant <= HARD
    rebounds = engine_restitution.point_restitution >= NO_REBOUND
    agrees = engine_outcomes.engine == engine_outcomes.theory
    refitted = engine_outcomes.engine == engine_outcomes.theory_with_rebound
    plain = engine_outcomes.contact == "no rebound"
    return {
        "maximum_restitution": truth(
            difference.max() < CLOSE,
            holds_when=difference[hard].max() < CLOSE,
            condition="the contacts are hard",
            largest_of_hard=difference[hard].max(),
            largest_of_soft=difference.max(),
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
    }


if __name__ == "__main__":
    run(snakemake, compute, findings)
