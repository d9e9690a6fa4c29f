"""Compute the minimum overturning amplitude of a pulse for frames with increasing γ."""

import math
from itertools import pairwise

import pandas as pd

from replication.workbench import Finding, run, truth, value
from topheavy import Column, Pulse, RockingBlock, RockingFrame, judge, lowest_overturning
from topheavy.second import reference


def lowest(block: RockingBlock, pulse: Pulse, amplitudes: dict) -> tuple[float, float]:
    """Bracket the minimum overturning amplitude (g tan α); `pulse` has the amplitude g tan α."""
    ends = (amplitudes["lowest"], amplitudes["highest"])
    found = lowest_overturning(block, pulse, ends, floor=amplitudes["floor"])
    if found.bracket is None:
        raise ValueError(
            f"gain.amplitudes.highest is {amplitudes['highest']}, which {block} survives; "
            "expected a higher one"
        )
    return found.bracket


def main(settings: dict, solver: dict) -> tuple[pd.DataFrame, dict[str, Finding]]:
    column = Column(**settings["column"])
    omega = 2 * math.pi / settings["pulse"]["period"]
    pulse = Pulse(settings["pulse"]["shape"], column.uplift_acceleration, omega)
    rows = []
    # Last, the column whose √r alone is lower: how much of the gain depends on the impact law?
    for gamma, lowered in [
        *((gamma, 0.0) for gamma in settings["mass_ratios"]),
        (0.0, settings["lowered"]),
    ]:
        block = RockingFrame(column, gamma).block()
        block = block.with_restitution((1.0 - lowered) * block.restitution)
        low, high = lowest(block, pulse, settings["amplitudes"])
        confirmed = True
        for scale, falls in ((low * (1 - 1e-6), False), (high * (1 + 1e-6), True)):
            scaled = pulse.scaled(scale)
            routes = (
                judge(block, scaled, tolerance=solver["tightened"]),
                reference.judge(block, scaled),
            )
            confirmed &= all(route.overturned == falls for route in routes)
        row = {"mass_ratio": gamma, "lowered": lowered, "lowest_low": low, "lowest_high": high}
        rows.append(row | {"width": high - low, "confirmed_by_both_routes": confirmed})
    table = pd.DataFrame(rows)
    return table, findings(table)


def findings(skeleton_gain: pd.DataFrame) -> dict[str, Finding]:
    """Return whether and how much the amplitude rises; `make check` draws them again from here."""
    confirmed = skeleton_gain.confirmed_by_both_routes.all()
    table = skeleton_gain[skeleton_gain.lowered == 0.0]
    first, last, adverse = table.iloc[0], table.iloc[-1], skeleton_gain.iloc[-1]
    return {
        "rises": truth(
            confirmed
            and all(
                a < b
                for (a, _), (_, b) in pairwise(
                    zip(table.lowest_high, table.lowest_low, strict=True)
                )
            ),
            confirmed_by_both_routes=confirmed,
        ),
        "gain": gain(last, first),
        "gain_over_a_column_that_loses_more": gain(last, adverse),
    }


def gain(one: pd.Series, other: pd.Series) -> Finding:
    """Return by how much the amplitude of one is above that of the other, over the other's."""
    return value(
        one.lowest_low / other.lowest_low - 1, (one.width + other.width) / other.lowest_low
    )


if __name__ == "__main__":
    run(snakemake, lambda job: main(job.params.settings, job.params.solver))
