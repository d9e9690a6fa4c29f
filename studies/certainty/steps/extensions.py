"""What a larger size implies, N columns, and vertical acceleration: proofs, and histories of both.

Measured horizontal and vertical components act together on columns and frames, by SciPy on the
block and by three bodies.
"""

import math
from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import run, truth, value
from steps.spectrum import progress
from topheavy import Column, Pulse, Record, RockingFrame, judge, read_record, reference
from topheavy.derivation import extension_theorems
from topheavy.three_bodies import simulate_three_bodies

SAME = 1e-9  # of α: by how much the peaks of similar structures may differ

OF_COLUMNS = (
    "columns_count_only_in_the_mass_ratio",
    "lagrange_agrees_for_columns",
    "impacts_do_not_count_the_columns",
)
OF_VERTICAL = (
    "vertical_acceleration_adds_to_gravity",
    "vertical_acceleration_changes_the_uplift",
    "vertical_acceleration_is_a_change_of_gravity_and_push",
)
"""The theorems on N columns, and those on vertical acceleration."""


def similar(case: dict) -> dict:
    """Return whether a frame survives a pulse just if its column, with the frame's √r, does in √k.

    k = R̂/R: the column is shaken by the same amplitude at the √k times higher frequency.
    """
    column, spec = Column(**case["column"]), case["similarity"]
    p, random = column.frequency_parameter, np.random.default_rng(spec["seed"])
    differ, overturned, largest = 0, 0, 0.0
    for _ in range(spec["pulses"]):
        gamma = float(random.choice([*random.uniform(0.0, 4.0, 3), math.inf]))
        frame = RockingFrame(column, gamma)
        slowed = math.sqrt(frame.equivalent_size / column.size)
        shape = str(random.choice(["one-sine", "one-cosine", "ricker-antisymmetric"]))
        amplitude = random.uniform(1.0, 8.0) * column.uplift_acceleration
        omega = random.uniform(1.0, 8.0) * p
        one = judge(frame, Pulse(shape, amplitude, omega))
        alike = column.block(frame.restitution)
        other = judge(alike, Pulse(shape, amplitude, omega * slowed))
        overturned += one.overturned
        differ += (one.overturned, one.impacts) != (other.overturned, other.impacts)
        if not one.overturned and not other.overturned:
            largest = max(largest, abs(one.peak - other.peak) / column.slenderness)
    return truth(
        differ == 0 and largest < SAME and 0 < overturned < spec["pulses"],
        pulses=spec["pulses"],
        overturned=overturned,
        differ=differ,
        peaks_differ_by=largest,
    )


def shows_stability(case: dict) -> dict:
    """Return whether every pulse that a column survives leaves a heavy frame of it standing.

    The condition is that the pulse has one lobe, for which it is proved.
    """
    column, spec = Column(**case["column"]), case["similarity"]
    random = np.random.default_rng(spec["seed"])
    alone = {"one lobe": 0, "several": 0}
    shapes = {
        "one lobe": ["half-sine", "constant"],
        "several": ["one-sine", "ricker-antisymmetric"],
    }
    frame = RockingFrame(column, max(case["mass_ratios"]))
    for kind, names in shapes.items():
        for _ in range(spec["pulses"]):
            amplitude = random.uniform(1.0, 10.0) * column.uplift_acceleration
            omega = random.uniform(1.0, 8.0) * column.frequency_parameter
            pulse = Pulse(str(random.choice(names)), amplitude, omega)
            if judge(frame, pulse).overturned and not judge(column, pulse).overturned:
                confirmed = reference.judge(frame, pulse).overturned
                alone[kind] += confirmed and not reference.judge(column, pulse).overturned
    return truth(
        not any(alone.values()),
        holds_when=not alone["one lobe"],
        condition="the pulse has one lobe",
        pulses=2 * spec["pulses"],
        only_the_frame=alone["several"],
    )


def strongest(record: Record, other: Record, duration: float) -> tuple[Record, Record]:
    """Return the part of both components that ends that long after the window around the peak."""
    step = record.time_step
    size = round(duration / step)
    energy = np.cumsum(np.square(record.acceleration))
    begin = int(np.argmax(energy[size:] - energy[:-size]))
    window = slice(begin, begin + size)
    return tuple(Record(step, one.acceleration[window], one.name) for one in (record, other))


def history(case: dict, pair: dict, across: Record, up: Record, gamma: float) -> dict:
    """Return how a frame moves under both components, by both routes, and under one alone."""
    frame, caps = RockingFrame(Column(**case["column"]), gamma), case["cap"]
    across, up = across.scaled(pair["factor"]), up.scaled(pair["factor"])
    time = np.arange(0.0, case["duration"], case["sampled_every"])
    both = reference.simulate(frame, across, samples=time, duration=time[-1], vertical=up)
    alone = reference.simulate(frame, across, samples=time, duration=time[-1])
    bodies = simulate_three_bodies(
        frame, across, **caps, duration=float(time[-1]), samples=time, vertical=up
    )
    alpha = frame.slenderness
    apart = np.nanmax(np.abs(bodies.rotation - both.rotation[:, None]))
    return {
        "horizontal": across.name,
        "factor": pair["factor"],
        "pga": across.peak_acceleration,
        "vertical_pga": up.peak_acceleration,
        "mass_ratio": gamma,
        "impacts": both.impacts.size,
        "peak": np.nanmax(np.abs(both.rotation)) / alpha,
        "peak_without_vertical": np.nanmax(np.abs(alone.rotation)) / alpha,
        "routes_differ_by": apart / alpha,
    }


def main(case: dict, records: dict[str, Record]) -> tuple[pd.DataFrame, dict]:
    theorems = extension_theorems()
    rows = []
    cases = [(pair, gamma) for pair in case["pairs"] for gamma in case["mass_ratios"]]
    for pair, gamma in progress(cases, len(cases), "histories"):
        across, up = strongest(
            records[pair["horizontal"]], records[pair["vertical"]], case["duration"]
        )
        rows.append(history(case, pair, across, up, gamma))
    table = pd.DataFrame(rows)
    drawn = findings(table)
    proved = {theorem.id: theorem for theorem in theorems}
    return table, {
        "size_is_slower_time": truth(
            proved["size_only_slows_time"].holds, statement=proved["size_only_slows_time"].statement
        ),
        "similar": similar(case),
        "shows_stability": shows_stability(case),
        "columns": truth(all(proved[name].holds for name in OF_COLUMNS)),
        "vertical": truth(all(proved[name].holds for name in OF_VERTICAL)),
        "theorems": truth(
            all(theorem.holds for theorem in theorems), theorems=[t.statement for t in theorems]
        ),
        "three_bodies": truth(
            (table.routes_differ_by < case["agreement"]).all() and (table.impacts > 1).all(),
            **drawn["three_bodies"],
        ),
        "largest_change": drawn["largest_change"],
    }


def findings(certainty_extensions: pd.DataFrame) -> dict[str, Any]:
    """Return what the histories say; the agreement required is in the config."""
    table = certainty_extensions
    change = (table.peak / table.peak_without_vertical - 1.0).abs()
    return {
        "three_bodies": {
            "histories": len(table),
            "largest": table.routes_differ_by.max(),
            "impacts": int(table.impacts.sum()),
        },
        "largest_change": value(
            change.max(), table.routes_differ_by.max() / table.peak.min(), median=change.median()
        ),
    }


def work(job: Any) -> tuple:
    return main(job.params.case, {r.name: r for r in map(read_record, job.input.records)})


if __name__ == "__main__":
    run(snakemake, work)
