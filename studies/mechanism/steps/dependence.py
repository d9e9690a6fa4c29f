"""What friction suffices and what opens at an impact, over γ, slenderness, bay and cap."""

from itertools import pairwise

import pandas as pd

from replication.workbench import Finding, run, truth
from steps.shared.histories import history
from studies.mechanism.steps.demand import demand, impact_demand
from studies.mechanism.steps.setting import cap_of, pulse_on, slender
from topheavy import Cap, Column, RockingFrame, judge

SCAN = 400  # bays, from columns that touch to the longest, at which contact is checked


def worst(frame: RockingFrame, cap: Cap, settings: dict) -> dict:
    """Return the largest demand (over tan α) and least reaction under pulses that are survived."""
    tan, found = frame.uplift_acceleration, []
    for ratio in settings["frequency_ratios"]:
        for amplitude in settings["amplitudes"]:
            spec = {"shape": settings["shape"], "frequency_ratio": ratio}
            pulse = pulse_on(frame.column, spec, amplitude)
            if judge(frame, pulse).overturned:
                break
            found.append(demand(frame, cap, history(frame, pulse, settings["samples"])))
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


def opens_below_the_shortest_bay(frame: RockingFrame, half_depth: float) -> pd.DataFrame:
    """Return the least vertical impulse of an impact over the span, around the shortest bay."""
    bay, width = shortest_bay(frame, half_depth), 2.0 * frame.column.half_width
    spans = [width + (bay - width) * k / SCAN for k in range(1, 3 * SCAN) if k != SCAN]
    least = [impact_demand(frame, Cap(span, half_depth))[1] for span in spans]
    return pd.DataFrame({"span": spans, "least": least, "shortest_bay": bay, "width": width})


def main(settings: dict, cap: Cap) -> tuple[pd.DataFrame, pd.DataFrame, dict]:
    column, gamma = Column(**settings["column"]), settings["mass_ratio"]
    width = 2.0 * column.half_width
    base = RockingFrame(column, gamma)
    variants = [("mass_ratio", g, RockingFrame(column, g), cap) for g in settings["mass_ratios"]]
    variants += [
        ("slenderness", a, RockingFrame(slender(a, column.half_width), gamma), cap)
        for a in settings["slendernesses"]
    ]
    variants += [
        ("span", span, base, Cap(span * width, cap.half_depth)) for span in settings["spans"]
    ]
    variants += [
        ("depth", depth, base, Cap(cap.span, depth * width / 2.0)) for depth in settings["depths"]
    ]
    table = pd.DataFrame(
        [
            {"varied": name, "value": at, "tan": frame.uplift_acceleration}
            | worst(frame, beam, settings)
            for name, at, frame, beam in variants
        ]
    )
    bays = opens_below_the_shortest_bay(base, cap.half_depth)
    return table, bays, findings(table, bays)


def findings(
    mechanism_dependence: pd.DataFrame, mechanism_bays: pd.DataFrame
) -> dict[str, Finding]:
    """Return what friction and which bays suffice, from the tables of demands and of bays."""
    table, bays = mechanism_dependence, mechanism_bays
    bay, over_width = bays.shortest_bay[0], bays.shortest_bay[0] / bays.width[0]
    short = bays.span < bay
    in_short, in_long = bays.least[short].min(), bays.least[~short].min()
    presses = (table.impact_least > 0.0).all()
    harder = table[table.impact > table.rocking]
    heavier = table[table.varied == "mass_ratio"]
    wide = table.query("varied in ['mass_ratio', 'slenderness']")
    return {
        "seat_opens_in_short_bays": truth(
            ((bays.least < 0.0) == short).all(),
            spans=len(bays),
            shortest_bay=bay,
            over_width=over_width,
            least_in_short_bays=in_short,
            least_in_long_bays=in_long,
        ),
        "recesses": truth(
            in_short > 0.0 and presses,
            holds_when=bool(in_long > 0.0 and presses),
            condition="the bay is longer than the shortest one without uplift at the column tops",
            shortest_bay_over_width=over_width,
        ),
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
    }


if __name__ == "__main__":
    run(snakemake, lambda job: main(job.params.settings, cap_of(job.params.cap)))
