"""The frame beside its column in the rigid-body engine: which of the two overturns first.

Boxes with unilateral contacts and friction are what a discrete element program computes; Papaloizou
& Komodromos (2009) compared columns with and without cap beams in such a program.
"""

import numpy as np
import pandas as pd

from replication.workbench import Finding, truth
from steps.shared.spectra_compared import ends_of, without
from studies.mechanism.steps.rigs import (
    HIGHEST,
    Model,
    experiment,
    lowest_overturning,
    models,
    rig_of,
    shaken,
    units,
)
from topheavy import Cap, Pulse, RockingFrame, overturning_intervals

BAND, SCAN = "band", "scan"  # how the amplitude of a row was chosen
FIRST = 0.8  # of the column's minimum in theory: where a scan of amplitudes starts
STEP = 1.02  # from one amplitude of a scan to the next
ENOUGH = 8  # scans


def in_bands(pair: list[Model], unit: Pulse) -> dict[str, float]:
    """Return the amplitude (g) in the middle of the widest band that overturns only one, by which.

    The bands are those of the theory.
    """
    return _bands_apart(*(_overturning(one.frame, unit) for one in pair))


def _overturning(frame: RockingFrame, unit: Pulse) -> np.ndarray:
    """Return the amplitudes (g) of a pulse that overturn a frame in theory, shape (n, 2)."""
    tan = frame.uplift_acceleration
    found = overturning_intervals(frame, unit, (tan, HIGHEST * tan), resolution=0.01 * tan)
    return ends_of(found, HIGHEST * tan)


def _bands_apart(column: np.ndarray, frame: np.ndarray) -> dict[str, float]:
    """Return the middle of the widest band that overturns one and not the other, by which one."""
    bands = {"column": without(column, frame), "frame": without(frame, column)}
    return {
        who: float(band[np.argmax(np.diff(band, axis=1)[:, 0])].mean())
        for who, band in bands.items()
        if len(band)
    }


def beside_its_column(model: Model, spec: dict) -> list[dict]:
    """Return what overturns frame and column in the engine: in the bands, and from below.

    A scan of amplitudes ends with the first that overturns one of the two.
    """
    pair = [Model(model.name, RockingFrame(model.frame.column, 0.0), None), model]
    contact, rows = {"friction": spec["friction"], **spec["contact"]}, []

    def row(kind: dict, pulse: Pulse, chosen: str, theory: str) -> dict:
        rigs = (rig_of(one, spec["time_step"], **contact) for one in pair)
        falls = [shaken(rig, pulse)[0] for rig in rigs]
        level = pulse.amplitude / model.frame.uplift_acceleration
        who = {"column_overturns": falls[0], "frame_overturns": falls[1]}
        of = {"structure": model.name, "mass_ratio": model.frame.mass_ratio, **kind}
        return of | {"amplitude": level, "chosen": chosen, "theory": theory, **who}

    for kind, unit in units(model.frame.column, spec["bands"]):
        for who, amplitude in in_bands(pair, unit).items():
            rows.append(row(kind, unit.scaled(amplitude), BAND, who))
    for kind, unit in units(model.frame.column, spec["scans"]):
        pulse = lowest_overturning(pair[0].frame, unit).scaled(FIRST)
        while True:
            rows.append(row(kind, pulse, SCAN, ""))
            if rows[-1]["column_overturns"] or rows[-1]["frame_overturns"]:
                break
            pulse = pulse.scaled(STEP)
    return rows


def main(settings: dict, structures: dict, caps: dict[str, Cap]) -> tuple[pd.DataFrame, dict]:
    frames = models(settings["frames"], structures, caps)
    table = pd.DataFrame([row for model in frames for row in beside_its_column(model, settings)])
    return table, findings(table)


def findings(mechanism_beside: pd.DataFrame) -> dict[str, Finding]:
    """Return which of frame and column overturns, and which first, from the table of pulses."""
    table = mechanism_beside
    only_column = table.column_overturns & ~table.frame_overturns
    only_frame = table.frame_overturns & ~table.column_overturns
    bands, scans = table[table.chosen == BAND], table[table.chosen == SCAN]
    last = scans.groupby(["structure", "mass_ratio", "shape", "frequency_ratio"]).tail(1)
    as_theory = (bands.column_overturns == (bands.theory == "column")) & (
        bands.frame_overturns == (bands.theory == "frame")
    )
    reversals = bands.theory == "frame"
    return {
        "column_overturns_first": truth(
            len(last) >= ENOUGH and bool(only_column[last.index].all()),
            pulses=len(last),
            column_first=int(only_column[last.index].sum()),
            step=STEP - 1.0,
            only_frame=int(only_frame.sum()),
        ),
        "frame_outlasts_column": truth(
            not only_frame[bands.index].any(),
            pulses=len(bands),
            only_column=int(only_column[bands.index].sum()),
            only_frame=int(only_frame[bands.index].sum()),
        ),
        "beside_as_in_theory": truth(
            bool(as_theory.all()) and 0 < int(reversals.sum()) < len(bands),
            pulses=len(bands),
            reversals=int(reversals.sum()),
            apart=int((~as_theory).sum()),
        ),
    }


if __name__ == "__main__":
    experiment(snakemake, main)
