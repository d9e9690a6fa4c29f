"""Probability of overturning at stated peak ground velocities and accelerations, with bands.

Bare columns, frames with a free cap beam, and columns with the same mass fixed to the top, under
the synthetic motions of study reversals, each scaled to the intensity.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import Finding, run, truth
from steps.shared.spectrum import progress
from topheavy import (
    Column,
    FixedMassColumn,
    Record,
    RockingFrame,
    judge,
    overturned_together,
    reference,
)
from topheavy.fragility.tables import exact_interval
from topheavy.structures import Structure
from topheavy.synthetic.ensemble import first_draws
from topheavy.synthetic.motions import peak_velocity

SUPPORTS = ("bare", "free", "fixed")
MEASURES = ("pgv", "pga")


@dataclass(frozen=True)
class Subject:
    """A structure: columns by name, bare, under a free cap beam, or with its mass fixed."""

    name: str
    support: str
    mass_ratio: float
    height: float  # of the columns, m
    structure: Structure

    @property
    def labels(self) -> dict[str, Any]:
        return {
            "structure": self.name,
            "support": self.support,
            "mass_ratio": self.mass_ratio,
        }


def subjects(settings: Mapping[str, Any], structures: Mapping[str, Any]) -> list[Subject]:
    """Return all structures, each with its three supports.

    Those of `scaled` are similar to a named structure, so many times as large.
    """
    found = []
    for entry in settings["columns"]:
        dimensions = structures[entry["structure"]]
        column = Column(*(entry["scaled"] * dimensions[k] for k in ("half_width", "half_height")))
        height, gamma = 2.0 * column.half_height, entry["mass_ratio"]
        name = f"{height:g} m {entry['structure']}"
        found += [
            Subject(name, "bare", 0.0, height, column),
            Subject(name, "free", gamma, height, RockingFrame(column, gamma)),
            Subject(name, "fixed", gamma, height, FixedMassColumn(column, gamma)),
        ]
    return found


def intensity(record: Record, measure: str) -> float:
    """Return PGV (m/s) or PGA (g) of a record."""
    return peak_velocity(record) if measure == "pgv" else record.peak_acceleration


def outcomes(settings: dict, ensemble: dict, under: list[Subject]) -> pd.DataFrame:
    """Return a row for each motion and subject: which of all levels overturn it."""
    levels = [(measure, level) for measure in MEASURES for level in settings[measure]]
    rows, chosen = [], first_draws(ensemble, settings["motions"])
    for draw in progress(chosen, len(chosen), "motions"):
        record = draw.record()
        scales = [level / intensity(record, measure) for measure, level in levels]
        fell = overturned_together([subject.structure for subject in under], record, scales)
        rows += [
            draw.labels | subject.labels | {"measure": m, "level": level, "fell": one}
            for subject, outcomes in zip(under, fell, strict=True)
            for (m, level), one in zip(levels, outcomes, strict=True)
        ]
    return pd.DataFrame(rows)


def probabilities(cells: pd.DataFrame, confidence: float) -> pd.DataFrame:
    """Return the probability of overturning with its interval, over the motions of each family."""
    keys = ["family", "structure", "support", "mass_ratio", "measure", "level"]
    table = cells.groupby(keys, sort=False, as_index=False).fell.agg(fell="sum", motions="size")
    (motions,) = table.motions.unique()  # every family has as many
    low, high = exact_interval(table.fell.to_numpy(), motions, confidence)
    return table.assign(
        probability=table.fell / table.motions, probability_low=low, probability_high=high
    )


def confirmed(settings: dict, ensemble: dict, under: list[Subject], cells: pd.DataFrame) -> dict:
    """Judge a seeded sample of the cells by SciPy, and at a nudged scale.

    Cells that a billionth of the motion changes are undecided, and are not compared.
    """
    random = np.random.default_rng(settings["seed"])
    motions = {
        tuple(draw.labels.values()): draw for draw in first_draws(ensemble, settings["motions"])
    }
    named = {(subject.name, subject.support): subject for subject in under}
    differ, told = 0, 0
    for at in progress(
        random.choice(len(cells), settings["checked"], False), settings["checked"], "checks"
    ):
        cell = cells.iloc[at]
        record = motions[cell.family, cell.scenario, cell.motion].record()
        scaled = record.scaled(cell.level / intensity(record, cell.measure))
        structure = named[cell.structure, cell.support].structure
        nudged = {judge(structure, scaled.scaled(1.0 + n)).overturned for n in (-1e-9, 0.0, 1e-9)}
        if len(nudged) == 1:
            told += 1
            differ += reference.judge(structure, scaled).overturned != cell.fell
    return truth(differ == 0 and told > 0, checked=settings["checked"], told=told, differ=differ)


def worst(table: pd.DataFrame, **at: Any) -> float:
    """Return the largest upper end of an interval among the rows with these labels."""
    for name, wanted in at.items():
        table = table[
            table[name].isin(wanted) if isinstance(wanted, list) else table[name] == wanted
        ]
    return float(table.probability_high.max())


def main(settings: dict, ensemble: dict, structures: dict) -> tuple[pd.DataFrame, dict]:
    under = subjects(settings, structures)
    cells = outcomes(settings, ensemble, under)
    table = probabilities(cells, settings["confidence"])
    velocity, ample = table[table.measure == "pgv"], settings["ample"]
    large = [s.name for s in under if s.support == "free" and s.height >= ample["height"]]
    framed = velocity[(velocity.support == "free") & velocity.structure.isin(large)]
    modest = framed[framed.level <= ample["pgv"]]
    return table, {
        "ample_stability": truth(
            worst(framed) < ample["probability"],
            holds_when=worst(modest) < ample["probability"],
            condition=f"PGV up to {ample['pgv']:g} m/s, columns of {ample['height']:g} m or more",
            largest_upper_end=worst(modest),
            at_highest=worst(framed),
            margin=ample["probability"],
            structures=large,
        ),
        **findings(table),
        "second_route": confirmed(settings, ensemble, under, cells),
    }


def findings(certainty_intensities: pd.DataFrame) -> dict[str, Finding]:
    """Return whether the support decides, from the table of probabilities."""
    each = ["family", "structure", "measure", "level"]
    wide = certainty_intensities.pivot_table(index=each, columns="support", values="fell")
    summed = wide.groupby(level=each[:2]).sum()
    return {
        "free_cap_helps": truth(
            (summed.free < summed.bare).all(),
            compared=len(wide),
            differ=int((wide.free != wide.bare).sum()),
            exceptions=int((wide.free > wide.bare).sum()),
        ),
        "fixed_mass_harms": truth(
            (summed.fixed > summed.bare).all(),
            compared=len(wide),
            differ=int((wide.fixed != wide.bare).sum()),
            exceptions=int((wide.fixed < wide.bare).sum()),
        ),
    }


def work(job: Any) -> tuple:
    return main(job.params.settings, job.params.ensemble, job.params.structures)


if __name__ == "__main__":
    run(snakemake, work)
