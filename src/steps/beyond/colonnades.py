"""Colonnades with one stone per bay: minimum overturning accelerations in theory and in pymunk."""

import math
from dataclasses import replace

import numpy as np
import pandas as pd

from replication.step import check, run, truth
from steps.beyond.stones import HINGED, OPEN, VERSION, Stones, overturns
from steps.shared.cases import bisected, cap_of, lowest, pulse_on
from topheavy import Column, RockingBlock, RockingFrame

AGREE = 0.03  # largest difference between pymunk and theory, times the column's minimum
UPLIFT = "constant"  # shape of a long push, which overturns from uplift on


def levers(columns, span, half_width):
    """Return the levers of the stones over b, on the side after an impact and on that before it.

    The columns tilt to the right after the impact. Inner stones end on the axes of the columns, the
    outer ones at the outer faces: src/derivation/colonnades.py derives them.
    """
    inner = 1.0 + span / (2.0 * (span - half_width))
    outer = 1.0 + (span + half_width) / (2.0 * (span - half_width))
    after = np.array([2.0, *[inner] * (columns - 3), outer])
    return after, after[::-1]


def colonnade(column, mass_ratio, columns, span):
    """Return the block of a colonnade of slender columns; γ is the stones' mass over the columns'.

    With levers λ b of the stones: tan α' = tan α (1 + λγ)/(1 + 2γ), p̂ of Eq. (23), and 1 − √r =
    (3/2) sin²α (1 + l₂γ)/(1 + 3γ), with l₂ = λ(λ + λ before the impact)/2; means over the stones.
    """
    after, before = levers(columns, span, column.half_width)
    lever, square = after.mean(), (after * (after + before)).mean() / 2.0
    tangent = column.uplift_acceleration * (1.0 + lever * mass_ratio) / (1.0 + 2.0 * mass_ratio)
    loss = (1.0 - column.restitution) * (1.0 + square * mass_ratio) / (1.0 + 3.0 * mass_ratio)
    p_hat = RockingFrame(column, mass_ratio).frequency_parameter
    return RockingBlock(p_hat, math.atan(tangent), 1.0 - loss)


def compute(settings, structures):
    """Return minima in theory and engine, normalised by that of one column in theory."""
    column, cap = Column(**structures[settings["structure"]]), cap_of(settings["cap"])
    usual = {name: settings[name] for name in ("time_step", "friction")}
    gammas, pulses = settings["mass_ratios"], settings["pulses"]
    cases = [(OPEN, gamma, kind, usual) for gamma in gammas for kind in pulses]
    cases += [(HINGED, gammas[0], pulses[0], usual)]
    cases += [(OPEN, gammas[0], pulses[0], usual | changed) for changed in settings["checks"]]
    rows = []
    for joints, gamma, kind, solver in cases:
        pulse = pulse_on(column, **kind)
        pulse = replace(pulse, amplitude=lowest(column, pulse).factor)
        count, block = settings["columns"], RockingFrame(column, gamma).block()
        if joints == OPEN:
            block = colonnade(column, gamma, count, cap.span)
        stones = Stones(
            column, gamma, cap, columns=count, joints=joints, gap=settings["gap"], **solver
        )
        theory = lowest(block, pulse).factor / pulse.amplitude

        def survives(factor, stones=stones, pulse=pulse):
            return not overturns(stones, pulse.scaled(factor))

        ends = theory - settings["near"], theory + settings["near"]
        engine = bisected(survives, ends, settings["resolution"], f"{stones}, {pulse}")
        rows.append(
            {"joints": joints, "mass_ratio": gamma, **kind, **solver}
            | {"theory": theory, "engine": engine, "solver": VERSION}
        )
    return pd.DataFrame(rows)


def findings(colonnades, settings):
    """Return whether stones of single bays lower the uplift acceleration and the minima."""
    apart = (colonnades.engine - colonnades.theory).abs()
    check(apart.max() < AGREE, f"pymunk and theory differ by {apart.max():.3f}")
    usual = colonnades[colonnades.joints == OPEN].drop_duplicates(
        ["mass_ratio", "shape", "frequency_ratio"]
    )
    ends = usual[["theory", "engine"]]
    slow = ends[(usual["shape"] != UPLIFT) & (usual.frequency_ratio <= settings["slow"])]
    uplift = ends[usual["shape"] == UPLIFT].sort_index()  # in the order of γ, which rises
    falls = (uplift.diff().dropna() < 0.0).all(axis=None)
    return {
        "stones_of_single_bays": truth(
            falls and max(slow.max(axis=None), uplift.max(axis=None)) < 1.0,
            apart=apart.max(),
            hinged=colonnades.engine[colonnades.joints == HINGED].iloc[0],
        )
    }


if __name__ == "__main__":
    run(snakemake, compute, findings)
