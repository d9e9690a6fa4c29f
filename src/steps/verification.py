"""Compare the solvers with each other, and our numbers with the literature.

A seeded sample represents all cells of the ensembles. Half of it comes from the grid, and half lies
near a boundary of overturning (in amplitude), where errors of the outcome are likely.
"""

import math
from dataclasses import replace
from itertools import product

import numpy as np
import pandas as pd
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
from topheavy.bodies.free_rocking import energy_drift
from topheavy.ground.shapes import ELEMENTARY
from topheavy.kernel.step import TOLERANCE

OF_PRINT = 0.005  # relative difference from a printed number, which has three digits
OF_FORM = 1e-7  # relative difference from a closed form
AGREE = 1e-6  # difference of 99 % of the peaks of two solvers, times α

SLENDER = RockingBlock(1.0, 0.25, 0.9, linearised=True)
ONE_SINE = Pulse("one-sine", 0.25, angular_frequency=5.0)  # with the amplitude α g
QUICK = replace(SLENDER, frequency_parameter=2.14)
PEER = RockingBlock(2.0, math.radians(15.0), 0.89952)
FRAME = RockingFrame(Column(0.75, 3.5), 13.23)
END = "one_sine_end_of_impact_mode"  # an upper end of an interval; all others are lower ends
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
            pulse, ends = (
                Pulse(shape, level, angular_frequency=omega),
                (1.0, settings["amplitudes"][1]),
            )
            intervals = overturning_intervals(block, pulse, ends, resolution=0.05)
            if intervals:
                ratio = intervals[0].lower[0] * (1.0 + settings["near"] * draw.uniform(-1.0, 1.0))
        yield block, Pulse(shape, ratio * level, angular_frequency=omega)


def agreement(settings, tightened):
    """Yield how the Taylor solver agrees with others: outcomes, and peaks normalised by α."""
    for linearised, shape in product((False, True), settings["shapes"]):
        sample = list(cells(settings, shape, linearised))
        solvers = {
            "plain solver": plain.judge_pulses(sample),
            "tightened tolerance": [judge(*cell, tolerance=tightened) for cell in sample],
        }
        if linearised and shape in ELEMENTARY:
            solvers["exact solution"] = [
                simulate_linear_exact(block, pulse, duration=pulse.duration, samples=2)
                for block, pulse in sample
            ]
        ours = [judge(*cell) for cell in sample]
        for name, theirs in solvers.items():
            pairs = [*zip(ours, theirs, strict=True)]
            apart = [
                abs(first.peak_rotation - second.peak_rotation) / block.slenderness
                for (block, _), (first, second) in zip(sample, pairs, strict=True)
                if not (first.overturned or second.overturned)
            ]
            yield {
                "equation": "linearised" if linearised else "exact",
                "shape": shape,
                "against": name,
                "cells": len(sample),
                "outcomes_that_differ": sum(a.overturned != b.overturned for a, b in pairs),
                "error_99": power_above(np.quantile(apart, 0.99), TOLERANCE),
            }


def boundary(quantity, near):
    """Return the boundary of overturning that is nearest to a factor, and within 2 % of it."""
    intervals = overturning_intervals(
        *PRINTED[quantity], (0.98 * near, 1.02 * near), resolution=1e-4 * near
    )
    if quantity == END:
        ends = [interval.upper for interval in intervals if interval.upper]
    else:  # the range does not begin within the interval
        ends = [interval.lower for interval in intervals if interval.lower[0] < interval.lower[1]]
    return min((sum(end) / 2.0 for end in ends), key=lambda middle: abs(middle - near))


def free_rocking():
    """Return quantities of free rocking for p = 1 and α = 0.25, by closed forms and a solver."""
    alpha = 0.25
    slender = RockingBlock(1.0, alpha, math.sqrt(0.7), linearised=True)
    impacts = simulate(slender, rotation=0.5 * alpha, samples=2).impact_times
    times = np.linspace(impacts[4], impacts[5], 20001)[1:-1]
    peak = np.abs(simulate(slender, rotation=0.5 * alpha, samples=times).rotation).max()
    exact = RockingBlock(1.0, alpha, 1.0)
    first, *_ = simulate(exact, rotation=0.9 * alpha, duration=9.0, samples=2).impact_times
    half, least = alpha / 2.0, 0.1 * alpha / 2.0  # halves of α, and of α − |θ₀|
    angle = math.acos(math.sin(least) / math.sin(half))
    argument = math.asin(math.sin(angle) / math.cos(least))
    rows = [  # θ₀ = α/2: Housner's formulas; θ₀ = 0.9 α: the energy, as an elliptic integral
        ("quarter_period_linear", math.acosh(2.0), impacts[0]),
        ("rotation_after_five_impacts", 1.0 - math.sqrt(1.0 - 0.75 * 0.7**5), peak / alpha),
        ("quarter_period_exact", ellipkinc(argument, math.cos(least) ** 2), first),
    ]
    return pd.DataFrame(rows, columns=["quantity", "closed_form", "computed"])


def until_impact(settings):
    """Yield how steered motions order two frames, within the bound of Theorem 2 and beyond."""
    spec = settings["order"]
    for factor, degrees in product(spec["factors"], spec["slendernesses"]):
        case = math.radians(degrees), spec["pairs"], factor, spec["histories"]
        counts = attack(*case, settings["seed"])
        yield {"factor": factor, "slenderness_deg": degrees} | counts


def check_drift(settings):
    """Check that free rocking conserves its energy between impacts."""
    for degrees in settings["slendernesses"]:
        block = RockingBlock(2.0, math.radians(degrees), 0.9)
        for equation in (block, block.linear()):
            response = simulate(equation, rotation=0.8 * block.slenderness, samples=4000)
            lost = energy_drift(equation, response, flights=6)
            check(lost < 1e-8, f"the energy changes by {lost:.1g} of its value between impacts")


def compute(settings, solver):
    check_drift(settings)
    return {
        "verification_routes": list(agreement(settings, solver["tightened"])),
        "verification_published": [
            row | {"computed": boundary(row["quantity"], row["expected"])}
            for row in settings["published"]
        ],
        "verification_closed_forms": free_rocking(),
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
    check(off_form < OF_FORM, f"free rocking is off its closed form by {off_form:.1g} of it")
    order, within = verification_order, verification_order.factor <= 1.0
    lost = order.order_lost + order.lighter_first
    fails = lost[within].sum()
    check(fails == 0, f"within its bound Theorem 2 fails in {fails} cases")
    check((lost[~within] > 0).all(), "beyond the bound of Theorem 2 the attack finds nothing")
    return {
        "histories_within_bound": value(order.histories[within].sum(), 0.0),
        "order_lost_beyond_bound": value((order.order_lost / order.histories)[~within].min(), 0.01),
        "comparisons": value(routes.cells.sum(), 0.0),
        "error_99": value(apart, 0.0),
        "farthest_from_print": value(off_print.max(), 0.0),
    }


if __name__ == "__main__":
    run(snakemake, compute, findings)
