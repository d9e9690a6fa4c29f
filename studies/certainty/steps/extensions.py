"""What a larger size implies, N columns, and vertical acceleration: proofs, and histories of both.

Measured horizontal and vertical components act together on columns and frames, by SciPy on the
block and by three bodies.
"""

import math
from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import Finding, run, truth
from steps.shared.spectrum import progress
from topheavy import Column, Pulse, Record, RockingFrame, judge, read_record
from topheavy.derivation import extension_theorems
from topheavy.second import reference
from topheavy.second.three_bodies import simulate_three_bodies

ONE_LOBE = "one"
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


def similar(settings: dict) -> pd.DataFrame:
    """Return how often frames do as their columns do with the frames' √r in the time of √k.

    By the shape of the pulses: in how many impacts and outcome differ, and how far peaks are apart.
    k = R̂/R: the column is shaken by the same amplitude at the √k times higher frequency.
    """
    column, spec = Column(**settings["column"]), settings["similarity"]
    p, random = column.frequency_parameter, np.random.default_rng(spec["seed"])
    rows = []
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
        fell = one.overturned or other.overturned
        rows.append(
            {
                "shape": shape,
                "overturned": one.overturned,
                "differ": (one.overturned, one.impacts) != (other.overturned, other.impacts),
                "apart": math.nan if fell else abs(one.peak - other.peak) / column.slenderness,
            }
        )
    return (
        pd.DataFrame(rows)
        .groupby("shape", as_index=False, sort=False)
        .agg(
            pulses=("differ", "size"),
            overturned=("overturned", "sum"),
            differ=("differ", "sum"),
            apart=("apart", "max"),
        )
    )


def shows_stability(settings: dict) -> pd.DataFrame:
    """Return how many pulses of one and of several lobes overturn a heavy frame, not its column."""
    column, spec = Column(**settings["column"]), settings["similarity"]
    random = np.random.default_rng(spec["seed"])
    rows = []
    shapes = {ONE_LOBE: ["half-sine", "constant"], "several": ["one-sine", "ricker-antisymmetric"]}
    frame = RockingFrame(column, max(settings["mass_ratios"]))
    for kind, names in shapes.items():
        for _ in range(spec["pulses"]):
            amplitude = random.uniform(1.0, 10.0) * column.uplift_acceleration
            omega = random.uniform(1.0, 8.0) * column.frequency_parameter
            pulse = Pulse(str(random.choice(names)), amplitude, omega)
            alone = all(  # by both solvers
                route(frame, pulse).overturned and not route(column, pulse).overturned
                for route in (judge, reference.judge)
            )
            rows.append({"lobes": kind, "shape": pulse.shape, "only_the_frame": alone})
    grouped = pd.DataFrame(rows).groupby(["lobes", "shape"], as_index=False, sort=False)
    return grouped.only_the_frame.agg(pulses="size", only_the_frame="sum")


def strongest(record: Record, other: Record, duration: float) -> tuple[Record, Record]:
    """Return the part of both components that ends that long after the window around the peak."""
    step = record.time_step
    size = round(duration / step)
    energy = np.cumsum(np.square(record.acceleration))
    begin = int(np.argmax(energy[size:] - energy[:-size]))
    window = slice(begin, begin + size)
    return tuple(Record(step, one.acceleration[window], one.name) for one in (record, other))


def history(settings: dict, pair: dict, across: Record, up: Record, gamma: float) -> dict:
    """Return how a frame moves under both components, by both routes, and under one alone."""
    frame, caps = RockingFrame(Column(**settings["column"]), gamma), settings["cap"]
    across, up = across.scaled(pair["factor"]), up.scaled(pair["factor"])
    time = np.arange(0.0, settings["duration"], settings["sampled_every"])
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


def main(settings: dict, records: dict[str, Record]) -> tuple:
    rows = []
    cases = [(pair, gamma) for pair in settings["pairs"] for gamma in settings["mass_ratios"]]
    for pair, gamma in progress(cases, len(cases), "histories"):
        across, up = strongest(
            records[pair["horizontal"]], records[pair["vertical"]], settings["duration"]
        )
        rows.append(history(settings, pair, across, up, gamma))
    table = pd.DataFrame(rows)
    theorems = [
        {"theorem": one.id, "holds": one.holds, "statement": one.statement}
        for one in extension_theorems()
    ]
    tables = table, pd.DataFrame(theorems), similar(settings), shows_stability(settings)
    drawn = findings(*tables)
    agree = (table.routes_differ_by < settings["agreement"]).all() and (table.impacts > 1).all()
    return *tables, drawn | {"three_bodies": truth(agree, **drawn["three_bodies"])}


def findings(
    certainty_extensions: pd.DataFrame,
    certainty_proofs: pd.DataFrame,
    certainty_similar: pd.DataFrame,
    certainty_lobes: pd.DataFrame,
) -> dict[str, Any]:
    """Return what proofs, pulses and histories say; the config has the required agreement."""
    table = certainty_extensions
    proved = certainty_proofs.set_index("theorem")
    slower = proved.loc["size_only_slows_time"]
    return {
        "size_is_slower_time": truth(slower.holds, statement=slower.statement),
        "similar": _of_similar(certainty_similar),
        "shows_stability": _of_lobes(certainty_lobes),
        "columns": truth(proved.holds[[*OF_COLUMNS]].all()),
        "vertical": truth(proved.holds[[*OF_VERTICAL]].all()),
        "three_bodies": {
            "histories": len(table),
            "largest": table.routes_differ_by.max(),
            "impacts": int(table.impacts.sum()),
        },
    }


def _of_similar(table: pd.DataFrame) -> Finding:
    """Return whether each pulse has the same outcome, impacts and peak in both."""
    pulses, overturned, differ = (
        int(table[name].sum()) for name in ("pulses", "overturned", "differ")
    )
    return truth(
        differ == 0 and table.apart.max() < SAME and 0 < overturned < pulses,
        pulses=pulses,
        overturned=overturned,
        differ=differ,
        peaks_differ_by=table.apart.max(),
    )


def _of_lobes(table: pd.DataFrame) -> Finding:
    """Return whether no pulse overturns the frame alone; for one lobe it is proved."""
    of_one_lobe = table.lobes == ONE_LOBE
    return truth(
        not table.only_the_frame.any(),
        holds_when=not table.only_the_frame[of_one_lobe].any(),
        condition="the pulse has one lobe",
        pulses=int(table.pulses.sum()),
        only_the_frame=int(table.only_the_frame[~of_one_lobe].sum()),
    )


def work(job: Any) -> tuple:
    return main(job.params.settings, {r.name: r for r in map(read_record, job.input.records)})


if __name__ == "__main__":
    run(snakemake, work)
