"""Prove both sides of minimum overturning accelerations, and outcomes of a sample of the spectra.

A boundary is proven where the acceleration below it is survived and that above it overturns. This
does not say that nothing lower overturns: below, the searches of the other rules stand.
"""

import math
from itertools import product
from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import Finding, run, truth
from steps.shared.proofs import WIDTHS, as_lines, proven
from steps.shared.spectra_compared import Place, Spectra
from steps.vase import numbers
from topheavy import Column, Pulse, judge
from topheavy.bodies.structures import Structure

SEED, CELLS = 28, 200  # a sample of the spectra
NEAREST = 1e-7  # of an amplitude: how close to a boundary half of the sample is


def sides(structure: Structure, pulse: Pulse) -> tuple[float, list[dict]]:
    """Return a share w such that 1 ∓ w times the pulse is survived and overturns, and the proofs.

    Infinity and no proof if none of `WIDTHS` is proven.
    """
    for width in WIDTHS:
        proofs = [proven(structure, pulse.scaled(1.0 + side * width)) for side in (-1, 1)]
        if [outcome for outcome, _ in proofs] == ["survives", "overturns"]:
            return width, [certificate for _, certificate in proofs if certificate]
    return math.inf, []


def boundaries(
    column: Column, settings: dict, table: pd.DataFrame
) -> tuple[list[dict], list[tuple[str, dict]]]:
    """Return a row for each structure and shape of the period, and the certificates."""
    rows, certificates = [], []
    minima, shapes = table.minimum_overturning.tolist(), settings["shapes"]
    of_each = product(numbers(column, settings), shapes)
    for ((name, gamma, span, structure), shape), minimum in zip(of_each, minima, strict=True):
        if math.isnan(minimum):
            continue  # a portal whose base is pulled before
        pulse = Pulse(shape, minimum, 2.0 * math.pi / settings["period"])
        width, proofs = sides(structure, pulse)
        labels = {"structure": name, "mass_ratio": gamma, "span": span, "shape": shape}
        of = f"minimum of {name}, γ = {gamma:g}"
        of += "" if math.isnan(span) else f", span {span:g} m"
        certificates += [(f"{of}, under one {shape}", proof) for proof in proofs]
        impacts = [proof["impacts"] for proof in proofs] or [-1, -1]
        rows.append(
            labels
            | {"minimum_overturning": minimum, "relative_width": width}
            | dict(zip(("impacts_below", "impacts_above"), impacts, strict=True))
        )
    return rows, certificates


def sample(spectra: Spectra) -> Finding:
    """Return whether both proofs agree with the solver: cells anywhere, and as many near an end.

    A cell that a proof does not decide is counted, and no agreement.
    """
    random = np.random.default_rng(SEED)
    picked = spectra.table.iloc[random.integers(len(spectra.table), size=CELLS)]
    differ, undecided = 0, 0
    for number, row in enumerate(picked.itertuples()):
        place = Place(row.slenderness_deg, row.shape, row.linearised, row.frequency_ratio)
        if number % 2:
            away = 10.0 ** random.uniform(math.log10(NEAREST), -2.0)
            amplitude = row.lower * (1.0 + random.choice([-1.0, 1.0]) * away)
        else:
            amplitude = random.uniform(1.0, spectra.last)
        _, block, pulse = place.line(row.mass_ratio)
        pulse = pulse.scaled(amplitude)
        (outcome, _), falls = proven(block, pulse), judge(block, pulse).overturned
        undecided += outcome == "undecided"
        differ += outcome == ("survives" if falls else "overturns")
    return truth(
        differ == 0 and undecided == 0,
        cells=CELLS,
        differ=differ,
        undecided=undecided,
        nearest=NEAREST,
    )


def findings(proven: pd.DataFrame) -> dict[str, Finding]:
    """Return whether every boundary of the table is proven."""
    widest = float(proven.relative_width.max())
    return {
        "boundaries": truth(
            bool(np.isfinite(proven.relative_width).all()),
            boundaries=len(proven),
            largest_relative_width=widest if math.isfinite(widest) else None,
        )
    }


def main(settings: dict, spectra: Spectra, vase: pd.DataFrame) -> tuple[pd.DataFrame, str, dict]:
    rows, certificates = boundaries(Column(**settings["column"]), settings, vase)
    table = pd.DataFrame(rows)
    return table, as_lines(certificates), findings(table) | {"sample": sample(spectra)}


def work(job: Any) -> tuple:
    spectra = Spectra(job.params.spectra, pd.read_csv(job.input.spectra))
    return main(job.params.settings, spectra, pd.read_csv(job.input.vase))


if __name__ == "__main__":
    run(snakemake, work)
