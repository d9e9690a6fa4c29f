"""How much friction does it take in the engine that nothing slides, and how much in theory?"""

import math

import pandas as pd

from replication.workbench import Finding, truth
from steps.shared.histories import history
from studies.mechanism.steps.demand import demand
from studies.mechanism.steps.engine import slips
from studies.mechanism.steps.rigs import (
    Model,
    experiment,
    lowest_overturning,
    models,
    rig_of,
    shaken,
    units,
)
from topheavy import Cap, Pulse, judge

SLIDES = 0.01  # of the half width b: a corner that goes farther along a surface slides
GAP = 0.01  # of the half width b: a corner nearer to a surface than this touches it
CLEAR = 1.1  # times the demand: friction from here on is clearly enough


def needed(model: Model, pulse: Pulse, cap: Cap, samples: int) -> float:
    """Return the required coefficient of friction by the forces of the theory."""
    return demand(model.frame, cap, history(model.frame, pulse, samples)).whole


def main(settings: dict, structures: dict, caps: dict[str, Cap]) -> tuple[pd.DataFrame, dict]:
    rows = []
    for model in models(settings["frames"], structures, caps):
        frame, b = model.frame, model.frame.column.half_width
        ((kind, unit),) = units(frame.column, [settings["pulse"]])
        pulse = lowest_overturning(frame, unit).scaled(kind["factor"])
        enough = needed(model, pulse, caps[model.name], settings["samples"])
        for friction in settings["frictions"]:
            rig = rig_of(model, settings["time_step"], friction=friction)
            overturned, peak, motion = shaken(rig, pulse)
            base, seat = slips(rig, motion, gap=GAP * b)
            rows.append(
                {
                    "structure": model.name,
                    "mass_ratio": frame.mass_ratio,
                    "friction": friction,
                    "needed": enough,
                    "tan": math.tan(frame.slenderness),
                    "base_slip": base / b,
                    "seat_slip": seat / b,
                    "slides": max(base, seat) > SLIDES * b,
                    "overturned": overturned,
                    "peak": peak / frame.slenderness,
                    "theory_peak": judge(frame, pulse).peak / frame.slenderness,
                }
            )
    table = pd.DataFrame(rows)
    return table, findings(table)


def findings(mechanism_slides: pd.DataFrame) -> dict[str, Finding]:
    """Return whether it slides where the forces of the theory say so, from the table of runs."""
    table = mechanism_slides
    above, below = table[table.friction >= CLEAR * table.needed], table[table.friction < table.tan]
    between = table[(table.friction >= table.tan) & (table.friction < table.needed)]
    return {
        "slides_as_the_forces_say": truth(
            len(above) > 0 and len(below) > 0 and not above.slides.any() and below.slides.all(),
            enough=len(above),
            too_little=len(below),
            between=len(between),
            between_that_slide=int(between.slides.sum()),
            peak_apart_with_enough=float((above.peak - above.theory_peak).abs().max()),
            largest_slip_with_enough=float(above[["base_slip", "seat_slip"]].max().max()),
        ),
    }


if __name__ == "__main__":
    experiment(snakemake, main)
