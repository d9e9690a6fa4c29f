"""Does the engine overturn under the pulses that overturn the theory's frame?"""

import math

import pandas as pd

from replication.workbench import Finding, truth
from studies.mechanism.steps.engine import Motion, Rig, slips
from studies.mechanism.steps.rigs import (
    FALLEN,
    Model,
    experiment,
    lowest_overturning,
    models,
    rebound,
    rig_of,
    shaken,
    units,
)
from topheavy import Cap, judge

GAP = 0.01  # of the half width b: a corner nearer to a surface than this touches it
ENOUGH = 30  # pulses


def pulses_around(model: Model, spec: dict, contact: str) -> list[dict]:
    """Return the outcomes of engine and theory near the minimum overturning amplitude.

    A further column has the outcome of the theory with the √r of the engine.
    """
    frame = model.frame
    settings = spec["contacts"][contact]
    rig = rig_of(model, spec["time_step"], friction=spec["friction"], **settings)
    measured, rows = rebound(rig, spec["lean"] * frame.slenderness), []
    refitted = frame.block().with_restitution(measured)
    for kind, unit in units(frame.column, spec["pulses"]):
        lowest = lowest_overturning(frame, unit)
        for factor in spec["factors"]:
            pulse = lowest.scaled(factor)
            overturned, peak, motion = shaken(rig, pulse)
            theory, with_rebound = judge(frame, pulse), judge(refitted, pulse)
            rows.append(
                {
                    "structure": model.name,
                    "mass_ratio": frame.mass_ratio,
                    "contact": contact,
                    **kind,
                    "factor": factor,
                    "engine": overturned,
                    "theory": theory.overturned,
                    "theory_with_rebound": with_rebound.overturned,
                    "rebound_ratio": measured / frame.restitution,
                    "peak": peak / frame.slenderness,
                    "theory_peak": theory.peak / frame.slenderness,
                    "slip": _slip(rig, motion, frame.column.half_width, contact),
                    "cap_tilt": _cap_tilt(motion) / frame.slenderness,
                }
            )
    return rows


def _slip(rig: Rig, motion: Motion, half_width: float, contact: str) -> float:
    """Return the largest slip over b. That of contacts with rebound depends on last bits: NaN."""
    if contact != "plastic":
        return math.nan
    return max(slips(rig, motion, gap=GAP * half_width)) / half_width


def _cap_tilt(motion: Motion) -> float:
    """Return the largest rotation of the cap beam before the columns overturn, rad."""
    standing = abs(motion.rotation) < 0.5 * FALLEN
    return float(abs(motion.pose[standing, -1, 2]).max())


def main(settings: dict, structures: dict, caps: dict[str, Cap]) -> tuple[pd.DataFrame, dict]:
    frames = models(settings["frames"], structures, caps)
    table = pd.DataFrame(
        [
            row
            for model in frames
            for contact in settings["contacts"]
            for row in pulses_around(model, settings, contact)
        ]
    )
    return table, findings(table)


def findings(mechanism_verdicts: pd.DataFrame) -> dict[str, Finding]:
    """Return how often engine and theory agree, from the table of pulses."""
    table = mechanism_verdicts
    agrees = table.engine == table.theory
    plastic = table.contact == "plastic"
    refitted = table.engine == table.theory_with_rebound
    apart = table[~agrees]
    return {
        "same_verdicts": truth(
            bool(agrees.all()),
            holds_when=bool(agrees[plastic].all()) and int(plastic.sum()) >= ENOUGH,
            condition="the contacts give nothing back",
            pulses=int(plastic.sum()),
            share_plastic=agrees[plastic].mean(),
            share_bouncing=agrees[~plastic].mean(),
            share_bouncing_with_rebound=refitted[~plastic].mean(),
            apart=len(apart),
            apart_where_engine_stands=int((~apart.engine).sum()),
            largest_factor_apart=float(apart.factor.max()) if len(apart) else 1.0,
            peak_apart=float((table.peak - table.theory_peak)[plastic].abs().max()),
            slip=float(table.slip[plastic].max()),
            cap_tilt=float(table.cap_tilt[plastic].max()),
            cap_tilt_bouncing=float(table.cap_tilt[~plastic].max()),
        ),
    }


if __name__ == "__main__":
    experiment(snakemake, main)
