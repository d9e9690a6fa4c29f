"""Does vertical ground acceleration change the benefit of the beam?

The vertical motion is another one of the family, of a share of the horizontal PGA, with the same
frequencies or compressed in time. A motion beyond −1 g would leave the ground in free fall: it is
counted, and left out with and without its vertical component.
"""

from collections.abc import Callable, Iterator
from functools import partial
from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import Finding, run, truth
from steps.shared.second import NEAR, decided
from steps.shared.spectrum import progress
from topheavy import Column, Record, RockingFrame, judge, read_record
from topheavy.ground.synthetic.ensemble import Draw, first_draws
from topheavy.risk.ensemble import Ensemble
from topheavy.risk.resampling import in_words
from topheavy.second import reference

NAMES = ("column", "frame")
MEASURED = "measured"


def structures(settings: dict) -> tuple[Column, RockingFrame]:
    column = Column(**settings["column"])
    return column, RockingFrame(column, settings["mass_ratio"])


def pair(draw: Draw, other: Draw, settings: dict, faster: float) -> tuple[Record, Record]:
    """Return a horizontal motion at the stated velocity, and its vertical one."""
    across, up = draw.record().scaled_to(pgv=settings["pgv"]), other.record()
    compressed = Record(up.time_step / faster, up.acceleration, up.name, unit="g")
    return across, compressed.scaled_to(pga=settings["share"] * across.peak_acceleration)


def partners(settings: dict, ensemble: dict) -> Iterator[tuple[Draw, Draw]]:
    """Yield each motion and the one of its scenario, as many further on, that shakes upward."""
    count = settings["motions"] // len(ensemble["scenarios"])
    draws = first_draws(ensemble, 2 * count)
    of = {(draw.family, draw.place, draw.number): draw for draw in draws}
    for (family, place, number), draw in of.items():
        if number < count:
            yield draw, of[family, place, number + count]


def overturned(structure: Any, across: Record, up: Record | None) -> bool:
    return judge(structure, across, vertical=up).overturned


def compared(settings: dict, ensemble: dict) -> pd.DataFrame:
    """Return the outcomes of each motion with and without its vertical component."""
    rows, both = [], list(partners(settings, ensemble))
    each = dict(zip(NAMES, structures(settings), strict=True))
    for draw, other in progress(both, len(both), "motions"):
        pairs = [pair(draw, other, settings, faster) for faster in settings["faster"]]
        alone = {name: overturned(one, pairs[0][0], None) for name, one in each.items()}
        for faster, (across, up) in zip(settings["faster"], pairs, strict=True):
            row = {"family": draw.family, "scenario": draw.place, "faster": faster}
            row["free_fall"] = falls_freely(up)
            if not row["free_fall"]:
                row |= alone
                row |= {
                    f"{name}_vertical": overturned(one, across, up) for name, one in each.items()
                }
            rows.append(row)
    return pd.DataFrame(rows)


def changes(table: pd.DataFrame, settings: dict) -> pd.DataFrame:
    """Return by how much the vertical motion changes the benefit, of the same motions."""
    rows = []
    for (family, faster), part in table.groupby(["family", "faster"], sort=False):
        kept = part[~part.free_fall]
        each = Ensemble(
            np.empty((len(kept), 0), bool),
            kept.scenario.tolist(),
            seed=settings["seed"],
            **settings["bootstrap"],
        )
        benefit = {
            end: kept[f"column{end}"].astype(float) - kept[f"frame{end}"].astype(float)
            for end in ("", "_vertical")
        }
        change = each.bounds("change", each.means((benefit["_vertical"] - benefit[""]).to_numpy()))
        rows.append(
            {"family": family, "faster": faster, "motions": len(kept)}
            | {"free_fall": int(part.free_fall.sum())}
            | {f"{name}{end}": int(kept[f"{name}{end}"].sum()) for name in NAMES for end in benefit}
            | each.bounds("benefit", each.means(benefit[""].to_numpy()))
            | each.bounds("benefit_vertical", each.means(benefit["_vertical"].to_numpy()))
            | change
            | {"interval": in_words(change["change_low"], change["change_high"])}
        )
    return pd.DataFrame(rows)


def second_route(settings: dict, ensemble: dict) -> Finding:
    """Return whether SciPy has the same outcomes with a vertical motion, of a seeded sample.

    Where a factor of a half or more on both components changes the outcome, half of the sample is
    brought beside it. Outcomes that a nudge of the motions changes are not compared.
    """
    random, both = np.random.default_rng(settings["seed"]), list(partners(settings, ensemble))
    told = differ = near_a_boundary = 0
    count = settings["checked"] * len(ensemble["families"])
    for number in progress(range(count), count, "checks"):
        faster = settings["faster"][number % len(settings["faster"])]
        while falls_freely((motions := pair(*random.choice(both), settings, faster))[1]):
            pass
        falls = partial(scaled, structures(settings)[int(random.integers(2))], *motions)
        factor = beside(falls) if random.integers(2) else 1.0
        fell = decided(falls, factor)
        if fell is not None:
            told, near_a_boundary = told + 1, near_a_boundary + (factor < 1.0)
            differ += falls(factor, judge=reference.judge) != fell
    return truth(
        differ == 0 and told > 0,
        checked=count,
        decided=told,
        near_a_boundary=near_a_boundary,
        differ=differ,
    )


def falls_freely(up: Record) -> bool:
    return bool(up.acceleration.min() <= -1.0)


def scaled(
    structure: Any, across: Record, up: Record, factor: float, judge: Callable = judge
) -> bool:
    """Return whether both components times a factor overturn a structure."""
    return judge(structure, across.scaled(factor), vertical=up.scaled(factor)).overturned


def beside(falls: Callable[[float], bool], low: float = 0.5, high: float = 1.0) -> float:
    """Return a factor within 1e-3 of a change of outcome in a range, or its end without one."""
    if falls(low) == falls(high):
        return high
    while high - low > NEAR:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if falls(middle) == falls(low) else (low, middle)
    return low


def measured(settings: dict, records: list[tuple[Record, Record]]) -> dict:
    """Return the counts of measured pairs, scaled together: too few for an interval."""
    row = dict.fromkeys((f"{name}{end}" for name in NAMES for end in ("", "_vertical")), 0)
    for across, up in records:
        factor = settings["pgv"] / across.peak_velocity
        for name, one in zip(NAMES, structures(settings), strict=True):
            row[name] += judge(one, across.scaled(factor)).overturned
            row[f"{name}_vertical"] += scaled(one, across, up, factor)
    return {"family": MEASURED, "motions": len(records), "free_fall": 0} | row


def main(
    settings: dict, ensemble: dict, records: list[tuple[Record, Record]]
) -> tuple[pd.DataFrame, dict[str, Finding]]:
    table = changes(compared(settings, ensemble), settings)
    whole = pd.concat([table, pd.DataFrame([measured(settings, records)])])
    return whole, findings(whole) | {"vertical_second_route": second_route(settings, ensemble)}


def findings(robustness_vertical: pd.DataFrame) -> dict[str, Finding]:
    """Return whether the benefit stays positive, and by how much it changes."""
    table = robustness_vertical[robustness_vertical.family != MEASURED]
    return {
        "benefit_remains": truth(
            bool((table.benefit_vertical_low > 0.0).all()),
            compared=len(table),
            free_fall=int(table.free_fall.sum()),
            least_change=float(table.change_low.min()),
            most_change=float(table.change_high.max()),
            includes_zero=int((table.interval == "includes zero").sum()),
        )
    }


def work(job: Any) -> tuple:
    read = [read_record(path) for path in job.input.records]
    pairs = list(zip(read[::2], read[1::2], strict=True))
    return main(job.params.settings, job.params.ensemble, pairs)


if __name__ == "__main__":
    run(snakemake, work)
