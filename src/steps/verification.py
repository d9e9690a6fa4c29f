"""Compare the solvers with each other, and our numbers with the literature.

A seeded sample represents all cells of the ensembles. Half of it comes from the grid, and half lies
near a boundary of overturning (in amplitude), where errors of the outcome are likely.
"""

import math
from dataclasses import replace

import numpy as np
from scipy.special import ellipkinc

from replication.step import check, power_above, run, value
from steps.shared import plain
from steps.shared.linear import simulate_linear_exact
from steps.shared.steered import attack
from topheavy import (
    Column,
    Pulse,
    RockingBlock,
    RockingFrame,
    judge,
    overturning_intervals,
    simulate,
)
from topheavy.bodies.free_rocking import Outcome, energy_drift
from topheavy.ground.shapes import ELEMENTARY
from topheavy.kernel.step import TOLERANCE

OF_PRINT = 0.005  # of a number: the prints, which have three digits, are that far off at most
OF_FORM = 1e-7  # of itself: a closed form
AGREE = 1e-6  # of α: 99 % of the peaks of two solvers

SLENDER = RockingBlock(1.0, 0.25, 0.9, linearised=True)
ONE_SINE = Pulse("one-sine", 0.25, angular_frequency=5.0)  # of the amplitude α g
QUICK = replace(SLENDER, frequency_parameter=2.14)
PEER = RockingBlock(2.0, math.radians(15.0), 0.89952)
FRAME = RockingFrame(Column(0.75, 3.5), 13.23)
END = "one_sine_end_of_impact_mode"  # the upper end of an interval; the others are lower ends
PRINTED = {
    "one_sine_with_impact": (SLENDER, ONE_SINE),
    END: (SLENDER, ONE_SINE),
    "one_sine_without_impact": (SLENDER, ONE_SINE),
    "one_sine_dimensional": (QUICK, Pulse("one-sine", 1.0, angular_frequency=15.7)),
    "one_cosine_exact": (PEER, Pulse("one-cosine", 1.0, angular_frequency=math.pi)),
    "half_sine_linear": (
        Column(0.2, 0.6).block().linear(),
        Pulse("half-sine", 1.0, angular_frequency=2 * math.pi),
    ),
    "heavy_frame_ricker": (FRAME.block(), Pulse("ricker-symmetric", 1.0, period=3.14)),
}
"""Cases of the literature: a block, and a pulse on which a factor is printed."""


def cells(settings, shape, linearised):
    """Yield the seeded sample of one ensemble: blocks and pulses."""
    draw = np.random.default_rng(settings["seed"])
    for number in range(settings["sample"]):
        slenderness = math.radians(draw.uniform(*settings["slendernesses"]))
        column = Column(math.sin(slenderness), math.cos(slenderness))
        block = RockingFrame(column, draw.choice(settings["mass_ratios"])).block()
        block = block.linear() if linearised else block
        omega = draw.uniform(*settings["frequency_ratios"]) * column.frequency_parameter
        ratio = draw.uniform(*settings["amplitudes"])
        level = block.uplift_acceleration
        if number % 2:
            intervals = overturning_intervals(
                block,
                Pulse(shape, level, angular_frequency=omega),
                (1.0, settings["amplitudes"][1]),
                resolution=0.05,
            )
            if intervals:
                ratio = intervals[0].lower[0] * (1.0 + settings["near"] * draw.uniform(-1.0, 1.0))
        yield block, Pulse(shape, ratio * level, angular_frequency=omega)


def others(sample, tightened, is_solvable):
    """Return what the Taylor solver is compared with: outcomes of the sample by name."""

    def exact(block, pulse):
        response = simulate_linear_exact(block, pulse, duration=pulse.duration, samples=2)
        return Outcome(response.overturned, response.peak_rotation, 0)

    outcomes = {
        "plain solver": plain.judge_pulses(sample),
        "tightened tolerance": [judge(*cell, tolerance=tightened) for cell in sample],
    }
    return outcomes | ({"exact solution": [exact(*cell) for cell in sample]} if is_solvable else {})


def agreement(settings, tightened):
    """Yield how the Taylor solver agrees with itself: outcomes, and peaks normalised by α."""
    for linearised in (False, True):
        for shape in settings["shapes"]:
            sample = list(cells(settings, shape, linearised))
            ours = [judge(*cell) for cell in sample]
            is_solvable = linearised and shape in ELEMENTARY
            for name, theirs in others(sample, tightened, is_solvable).items():
                apart = [
                    abs(first.peak_rotation - second.peak_rotation) / block.slenderness
                    for (block, _), first, second in zip(sample, ours, theirs, strict=True)
                    if not (first.overturned or second.overturned)
                ]
                yield {
                    "equation": "linearised" if linearised else "exact",
                    "shape": shape,
                    "against": name,
                    "cells": len(sample),
                    "outcomes_that_differ": sum(
                        first.overturned != second.overturned
                        for first, second in zip(ours, theirs, strict=True)
                    ),
                    "median_error": power_above(np.median(apart), TOLERANCE),
                    "error_99": power_above(np.quantile(apart, 0.99), TOLERANCE),
                }


def boundary(quantity, near):
    """Return the boundary of overturning that is nearest to a factor, known to 2 %."""
    which = "upper" if quantity == END else "lower"
    intervals = overturning_intervals(
        *PRINTED[quantity], (0.98 * near, 1.02 * near), resolution=1e-4 * near
    )
    ends = [getattr(interval, which) for interval in intervals if getattr(interval, which)]
    middles = [(low + high) / 2.0 for low, high in ends if which == "upper" or low != high]
    return min(middles, key=lambda middle: abs(middle - near))


def published(rows):
    """Return the numbers of the literature, as printed and as computed here."""
    return [row | {"computed": boundary(row["quantity"], row["expected"])} for row in rows]


def free_rocking():
    """Yield quantities of free rocking for p = 1 and α = 0.25: by a closed form and by a solver."""
    slender = RockingBlock(1.0, 0.25, math.sqrt(0.7), linearised=True)
    start = simulate(slender, rotation=0.5 * 0.25, samples=2)
    fifth = np.linspace(start.impact_times[4], start.impact_times[5], 20001)[1:-1]
    peak = np.abs(simulate(slender, rotation=0.5 * 0.25, samples=fifth).rotation).max()
    exact = simulate(
        RockingBlock(1.0, 0.25, 1.0), rotation=0.9 * 0.25, duration=9.0, samples=2
    ).impact_times[0]
    half, least = 0.25 / 2.0, 0.1 * 0.25 / 2.0  # of the angle to the vertical at rest and at first
    angle = math.acos(math.sin(least) / math.sin(half))
    argument = math.asin(math.sin(angle) / math.cos(least))
    rows = {  # θ₀ = α/2: Housner's formulas; θ₀ = 0.9 α: the energy, as an elliptic integral
        "quarter_period_linear": (math.acosh(2.0), start.impact_times[0]),
        "rotation_after_five_impacts": (1.0 - math.sqrt(1.0 - 0.75 * 0.7**5), peak / 0.25),
        "quarter_period_exact": (ellipkinc(argument, math.cos(least) ** 2), exact),
    }
    for quantity, (closed_form, computed) in rows.items():
        yield {"quantity": quantity, "closed_form": closed_form, "computed": computed}


def until_impact(settings):
    """Yield how steered motions order two frames, within the bound of Theorem 2 and beyond."""
    spec = settings["order"]
    for factor in spec["factors"]:
        for degrees in spec["slendernesses"]:
            row = {"factor": factor, "slenderness_deg": degrees}
            case = math.radians(degrees), spec["pairs"], factor, spec["histories"]
            yield row | attack(*case, settings["seed"])


def check_drift(settings):
    """Check that free rocking conserves its energy between impacts."""
    for degrees in settings["slendernesses"]:
        block = RockingBlock(2.0, math.radians(degrees), 0.9)
        for each in (block, block.linear()):
            response = simulate(each, rotation=0.8 * block.slenderness, samples=4000)
            lost = energy_drift(each, response, flights=6)
            check(lost < 1e-8, f"the energy changes by {lost:.1g} of itself between impacts")


def compute(settings, solver):
    check_drift(settings)
    return {
        "verification_routes": list(agreement(settings, solver["tightened"])),
        "verification_published": published(settings["published"]),
        "verification_closed_forms": list(free_rocking()),
        "verification_order": list(until_impact(settings)),
    }


def findings(
    verification_routes, verification_published, verification_closed_forms, verification_order
):
    routes, literature = verification_routes, verification_published
    differ, apart = routes.outcomes_that_differ.sum(), routes.error_99.max()
    check(
        differ == 0 and apart < AGREE,
        f"{differ} outcomes differ; 99 % of peaks within {apart:.1g} α",
    )
    off = (literature.computed - literature.expected).abs()
    nearest = literature.computed.clip(literature.printed, literature.to)
    off_print = (literature.computed / nearest - 1.0).abs()
    wrong = literature.quantity[(off > literature.tolerance) | (off_print >= OF_PRINT)]
    check(wrong.empty, f"of the numbers of the literature, {', '.join(wrong)} differ")
    forms = verification_closed_forms
    off_form = (forms.computed / forms.closed_form - 1.0).abs().max()
    check(off_form < OF_FORM, f"free rocking is {off_form:.1g} of itself from its closed form")
    within = verification_order.factor <= 1.0
    lost = verification_order.order_lost + verification_order.lighter_first
    check(
        lost[within].sum() == 0, f"within its bound Theorem 2 fails in {lost[within].sum()} cases"
    )
    check((lost[~within] > 0).all(), "beyond the bound of Theorem 2 the attack finds nothing")
    return {
        "histories_within_bound": value(verification_order.histories[within].sum(), 0.0),
        "order_lost_beyond_bound": value(
            (verification_order.order_lost / verification_order.histories)[~within].min(), 0.01
        ),
        "comparisons": value(routes.cells.sum(), 0.0),
        "error_99": value(apart, 0.0),
        "farthest_from_print": value(off_print.max(), 0.0),
    }


if __name__ == "__main__":
    run(snakemake, compute, findings)
