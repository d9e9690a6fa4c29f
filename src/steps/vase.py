"""The cap beam's mass fixed to one column, against the same mass carried freely by two.

Does a fixed mass always lower the minimum overturning acceleration of the bare column, and a freely
carried one always raise it? Pulses over their frequency and records are searched for exceptions.
"""

import math
from typing import Any

import numpy as np
import pandas as pd
from spectrum import progress
from vase_poses import poses
from vase_searches import Minimum, minimum, rivals
from vase_shares import PARAMETERS, shares

from replication.workbench import grid, run, truth
from topheavy import (
    Column,
    FixedMassColumn,
    MonolithicPortal,
    Pulse,
    Record,
    read_record,
)

HIGHEST = 40.0  # g, of the portals, which no other structure comes near
SEED = 2014  # of the sample of boundaries that SciPy judges


def numbers(column: Column, case: dict) -> list[tuple[str, float, float, Any]]:
    """Return structure, γ, span (NaN but for a portal) and the thing itself."""
    found = [(*rival[:2], math.nan, rival[2]) for rival in rivals(column, case["mass_ratios"])]
    width, depth = case["cap"]["width"], case["cap"]["depth"]
    found += [
        ("fixed, of the drawn size", gamma, math.nan, FixedMassColumn(column, gamma, width, depth))
        for gamma in case["mass_ratios"]
        if gamma > 0.0
    ]
    gamma = case["portals"]["mass_ratio"]
    return found + [
        ("portal", gamma, span, MonolithicPortal(column, gamma, span, depth))
        for span in case["portals"]["spans"]
    ]


def under_pulses(column: Column, case: dict) -> list[dict]:
    """Return the three numbers of every structure and its minimum under each pulse of the period."""
    rows = []
    for name, gamma, span, structure in numbers(column, case):
        block = structure.block()
        size = 3.0 * 9.81 / (4.0 * block.frequency_parameter**2)
        for shape in case["shapes"]:
            pulse = Pulse(shape, 1.0, 2.0 * math.pi / case["period"])
            found = minimum(structure, pulse, HIGHEST)
            rows.append(
                {
                    "structure": name,
                    "mass_ratio": gamma,
                    "span": span,
                    "slenderness_deg": math.degrees(block.slenderness),
                    "frequency_parameter": block.frequency_parameter,
                    "restitution": block.restitution,
                    "equivalent_size": size,
                    "uplift_acceleration": block.uplift_acceleration,
                    "shape": shape,
                    "minimum_overturning": found.acceleration,
                    "error": found.error(),
                }
            )
    return rows


def search(
    column: Column, motion: Pulse | Record, ratios: list[float], highest: float, labels: dict
) -> list[dict]:
    """Return a row for every structure under one motion, with what it has to exceed: the bare one."""
    rows: list[dict] = []
    for name, gamma, structure in rivals(column, [0.0, *ratios]):
        found = minimum(structure, motion, highest)
        bare = rows[0]["found"] if rows else found
        rows.append(labels | {"structure": name, "mass_ratio": gamma, "found": found, "bare": bare})
    return rows


def is_exception(row: dict) -> bool:
    """Whether a fixed mass survives what overturns the bare column first, or a frame falls first.

    Where neither overturns up to the highest acceleration nothing is said.
    """
    ours, bare = row["found"].acceleration, row["bare"].acceleration
    return {"bare": False, "fixed": ours > bare, "free": ours < bare}[row["structure"]]


def is_compared(row: dict) -> bool:
    """Whether at least one of the two minima was found: the other one is then higher."""
    return row["structure"] != "bare" and math.isfinite(
        min(row["found"].acceleration, row["bare"].acceleration)
    )


def finite(value: float) -> float | None:
    return value if math.isfinite(value) else None


def plain(row: dict) -> dict:
    """Return a row of the table: the middle of the bracket, NaN where nothing overturns."""
    kept = {key: value for key, value in row.items() if key not in ("found", "bare")}
    ours = row["found"].acceleration
    return kept | {"minimum_overturning": ours if math.isfinite(ours) else math.nan}


def exception(row: dict) -> dict:
    """Return an exception with the error of both of its minima, by SciPy."""
    ours, bare = row["found"], row["bare"]
    return plain(row) | {
        "bare_column": bare.acceleration if math.isfinite(bare.acceleration) else math.nan,
        "error": _error(ours),
        "bare_error": _error(bare),
    }


def _error(found: Minimum) -> float:
    return found.error() if math.isfinite(found.acceleration) else math.nan


def question(rows: list[dict], structure: str, exceptions: list[dict]) -> dict:
    """Return whether one structure keeps its rank under every motion, as a finding."""
    asked = [row for row in rows if row["structure"] == structure and is_compared(row)]
    broken = [row for row in exceptions if row["structure"] == structure]
    return truth(
        not broken,
        comparisons=len(asked),
        exceptions=len(broken),
        records=sorted({row["motion"] for row in broken if "record" in row["kind"]}),
    )


def sampled(rows: list[dict], count: int) -> list[Minimum]:
    """Return minima of a seeded sample of rows."""
    found = [row["found"] for row in rows if math.isfinite(row["found"].acceleration)]
    picked = np.random.default_rng(SEED).permutation(len(found))[:count]
    return [found[index] for index in picked]


def carried(table: pd.DataFrame) -> dict:
    """Return the share of the difference between frame and fixed mass that each parameter carries."""
    ends = {of: table[table.of_free == of].survived.to_numpy() for of in ("none", "α p √r")}
    total = ends["α p √r"] - ends["none"]
    return {name: table[table.of_free == name].shapley.to_numpy() / total for name in PARAMETERS}


def main(case: dict, paths: list[str], tightened: float) -> tuple:
    column, spec = Column(**case["column"]), case["spectra"]
    summary = pd.DataFrame(under_pulses(column, case))
    level, p = column.uplift_acceleration, column.frequency_parameter
    pulses = [
        (
            Pulse(shape, 1.0, ratio * p),
            spec["mass_ratios"],
            {"kind": "pulse", "motion": shape, "frequency_ratio": ratio},
        )
        for shape in spec["shapes"]
        for ratio in grid(spec["frequency_ratios"])
    ]
    records = [
        (
            record.scaled(1.0 / np.abs(record.acceleration).max()),
            case["record_mass_ratios"],
            {"kind": "record", "motion": record.name, "frequency_ratio": math.nan},
        )
        for record in map(read_record, paths)
    ]
    motions = pulses + records
    found = (
        search(column, motion, ratios, spec["highest"] * level, labels)
        for motion, ratios, labels in motions
    )
    rows = [row for part in progress(found, len(motions), "motions") for row in part]
    broken = [row for row in rows if is_exception(row)]
    checked = case["checked_by_second_route"]
    again = {
        kind: sampled([row for row in rows if row["kind"] == f"{kind[:-1]}"], count)
        for kind, count in {"pulses": checked["spectra"], "records": checked["records"]}.items()
    }
    errors = [one.error() / one.acceleration for some in again.values() for one in some]
    exceptions = pd.DataFrame([exception(row) for row in broken])
    of_shares = pd.DataFrame(shares(column, spec["shapes"], case["shares"]))
    findings = {
        "fixed_mass_always_lowers": question(rows, "fixed", broken),
        "frame_always_raises": question(rows, "free", broken),
        "second_route": truth(
            summary.error.notna().all() and not np.isnan(errors).any(),
            boundaries=len(summary) + len(errors),
            largest_error=float(max(np.nanmax(errors), (summary.error / summary.minimum_overturning).max())),
        ),
    }
    table = pd.DataFrame(map(plain, rows))
    return summary, table, exceptions, of_shares, pd.DataFrame(poses(column, case)), findings


if __name__ == "__main__":
    run(
        snakemake,
        lambda job: main(job.params.case, job.input.records, job.params.solver["tightened"]),
    )
