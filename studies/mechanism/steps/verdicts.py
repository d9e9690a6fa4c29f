"""Does the engine overturn under the pulses that overturn the theory's frame?"""

import numpy as np
import pandas as pd

from replication.workbench import Finding, truth
from steps.shared.spectra_compared import without
from studies.mechanism.steps.engine import Motion, slips
from studies.mechanism.steps.rigs import (
    FALLEN,
    HIGHEST,
    Model,
    experiment,
    lowest_overturning,
    models,
    rebound,
    rig_of,
    shaken,
    units,
)
from topheavy import Cap, Pulse, RockingFrame, judge, overturning_intervals

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
                    "slip": max(slips(rig, motion, gap=GAP * frame.column.half_width))
                    / frame.column.half_width,
                    "cap_tilt": _cap_tilt(motion) / frame.slenderness,
                }
            )
    return rows


def _cap_tilt(motion: Motion) -> float:
    """Return the largest rotation of the cap beam before the columns overturn, rad."""
    standing = abs(motion.rotation) < 0.5 * FALLEN
    return float(abs(motion.pose[standing, -1, 2]).max())


def beside_its_column(model: Model, spec: dict) -> list[dict]:
    """Return what overturns frame and column in the engine, where theory overturns only one.

    For each pulse that is the middle of the widest band of amplitudes that overturns the column
    alone, and of the widest that overturns the frame alone, where there is one.
    """
    alone = Model(model.name, RockingFrame(model.frame.column, 0.0), None)
    friction, step = spec["friction"], spec["time_step"]
    settings = spec["contacts"]["plastic"]
    rows = []
    for kind, unit in units(model.frame.column, spec["beside"]):
        sets = [_overturning(one.frame, unit) for one in (alone, model)]
        for who, amplitude in _bands_apart(*sets).items():
            falls = [
                shaken(rig_of(one, step, friction=friction, **settings), unit.scaled(amplitude))[0]
                for one in (alone, model)
            ]
            rows.append(
                {
                    "structure": model.name,
                    **kind,
                    "amplitude": amplitude,
                    "theory": who,
                    "column_overturns": falls[0],
                    "frame_overturns": falls[1],
                }
            )
    return rows


def _overturning(frame: RockingFrame, unit: Pulse) -> np.ndarray:
    """Return the amplitudes (g) of a pulse that overturn a frame in theory, shape (n, 2)."""
    tan = frame.uplift_acceleration
    found = overturning_intervals(frame, unit, (tan, HIGHEST * tan), resolution=0.01 * tan)
    ends = [(one.lower[1], one.upper[0] if one.upper else HIGHEST * tan) for one in found]
    return np.array(ends).reshape(-1, 2)


def _bands_apart(column: np.ndarray, frame: np.ndarray) -> dict[str, float]:
    """Return the middle of the widest band that overturns one and not the other, by which one."""
    bands = {"column": without(column, frame), "frame": without(frame, column)}
    return {
        who: float(band[np.argmax(np.diff(band, axis=1)[:, 0])].mean())
        for who, band in bands.items()
        if len(band)
    }


def main(case: dict, structures: dict, caps: dict[str, Cap]) -> tuple[pd.DataFrame, dict]:
    frames = models(case["frames"], structures, caps)
    table = pd.DataFrame(
        [
            row
            for model in frames
            for contact in case["contacts"]
            for row in pulses_around(model, case, contact)
        ]
    )
    beside = pd.DataFrame([row for model in frames for row in beside_its_column(model, case)])
    as_theory = (beside.column_overturns == (beside.theory == "column")) & (
        beside.frame_overturns == (beside.theory == "frame")
    )
    reversals = beside[beside.theory == "frame"]
    return table, findings(table) | {
        "frame_outlasts_column": truth(
            not (beside.frame_overturns & ~beside.column_overturns).any(),
            pulses=len(beside),
            only_column=int((beside.column_overturns & ~beside.frame_overturns).sum()),
            only_frame=int((beside.frame_overturns & ~beside.column_overturns).sum()),
        ),
        "beside_as_in_theory": truth(
            bool(as_theory.all()) and 0 < len(reversals) < len(beside),
            pulses=len(beside),
            reversals=len(reversals),
            apart=int((~as_theory).sum()),
        ),
    }


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
