"""What friction suffices and what opens at an impact, over γ, slenderness, bay and cap."""

from itertools import pairwise

import numpy as np
import pandas as pd

from replication.workbench import Finding, run, truth, value
from steps.histories import history
from studies.mechanism.steps.demand import demand, impact_demand
from studies.mechanism.steps.setting import cap_of, pulse_on, slender
from topheavy import Cap, Column, RockingFrame, judge

SCAN = 400  # bays, from columns that touch to the longest, at which contact is checked


def worst(frame: RockingFrame, cap: Cap, case: dict) -> dict:
    """Return the largest demand (over tan α) and least reaction under pulses that are survived."""
    tan, found = frame.uplift_acceleration, []
    for ratio in case["frequency_ratios"]:
        for amplitude in case["amplitudes"]:
            spec = {"shape": case["shape"], "frequency_ratio": ratio}
            pulse = pulse_on(frame.column, spec, amplitude)
            if judge(frame, pulse).overturned:
                break
            found.append(demand(frame, cap, history(frame, pulse, case["samples"])))
    friction, least = impact_demand(frame, cap)
    return {
        "rocking": max(one.friction for one in found) / tan,
        "rocking_error": max(one.friction_error for one in found) / tan,
        "least_vertical": min(one.least for one in found),
        "impact": friction / tan,
        "impact_least": least,
        "pulses": len(found),
    }


def shortest_bay(frame: RockingFrame, half_depth: float) -> float:
    """Return the least span (m) without opening at impact: 2b + 2d (1−√r)/((1+√r) tan α)."""
    r = frame.restitution
    share = (1.0 - r) / ((1.0 + r) * frame.uplift_acceleration)
    return 2.0 * frame.column.half_width + 2.0 * half_depth * share


def opens_below_the_shortest_bay(frame: RockingFrame, half_depth: float) -> Finding:
    """Return whether a column-top contact opens at impact in all shorter bays, in no longer one."""
    bay, width = shortest_bay(frame, half_depth), 2.0 * frame.column.half_width
    spans = [width + (bay - width) * k / SCAN for k in range(1, 3 * SCAN) if k != SCAN]
    least = np.array([impact_demand(frame, Cap(span, half_depth))[1] for span in spans])
    short = np.array(spans) < bay
    return truth(
        ((least < 0.0) == short).all(),
        spans=len(spans),
        shortest_bay=bay,
        over_width=bay / width,
        least_in_short_bays=least[short].min(),
        least_in_long_bays=least[~short].min(),
    )


def main(case: dict, cap: Cap) -> tuple[pd.DataFrame, dict]:
    column, gamma = Column(**case["column"]), case["mass_ratio"]
    width = 2.0 * column.half_width
    base = RockingFrame(column, gamma)
    variants = [("mass_ratio", g, RockingFrame(column, g), cap) for g in case["mass_ratios"]]
    variants += [
        ("slenderness", a, RockingFrame(slender(a, column.half_width), gamma), cap)
        for a in case["slendernesses"]
    ]
    variants += [("span", span, base, Cap(span * width, cap.half_depth)) for span in case["spans"]]
    variants += [
        ("depth", depth, base, Cap(cap.span, depth * width / 2.0)) for depth in case["depths"]
    ]
    table = pd.DataFrame(
        [
            {"varied": name, "value": at, "tan": frame.uplift_acceleration}
            | worst(frame, beam, case)
            for name, at, frame, beam in variants
        ]
    )
    opens = opens_below_the_shortest_bay(base, cap.half_depth)
    return table, {
        "seat_opens_in_short_bays": opens,
        "recesses": truth(
            opens["least_in_short_bays"] > 0.0 and (table.impact_least > 0.0).all(),
            holds_when=bool(opens["least_in_long_bays"] > 0.0 and (table.impact_least > 0.0).all()),
            condition="the bay is longer than the shortest one without uplift at the column tops",
            shortest_bay_over_width=shortest_bay(base, cap.half_depth) / width,
        ),
        **findings(table),
    }


def findings(mechanism_dependence: pd.DataFrame) -> dict[str, Finding]:
    """Return the friction that suffices, and what it falls with, from the table of demands."""
    table = mechanism_dependence
    harder = table[table.impact > table.rocking]
    heavier = table[table.varied == "mass_ratio"]
    wide = table.query("varied in ['mass_ratio', 'slenderness']")
    return {
        "impact_asks_for_less_than_rocking": truth(
            harder.empty,
            largest_impact=float(wide.impact.max()),
            frames=len(table),
        ),
        "heavier_needs_less": truth(
            all(low > high for low, high in pairwise(heavier.rocking)),
            lightest=float(heavier.rocking.iloc[0]),
            heaviest=float(heavier.rocking.iloc[-1]),
            error=float(heavier.rocking_error.max()),
        ),
        "sufficient": value(
            wide.rocking.max(), wide.rocking_error.max(), "tan α", least=wide.rocking.min()
        ),
    }


if __name__ == "__main__":
    run(snakemake, lambda job: main(job.params.case, cap_of(job.params.cap)))
