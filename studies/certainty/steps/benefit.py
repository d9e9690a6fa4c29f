"""What is left of the benefit of a free cap beam if √r is lower, of frame and column or of one.

Frame and column, with √r of Eq. (25) and with a factor on it, under all synthetic motions of study
reversals, each scaled to a stated peak ground velocity.
"""

from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import Finding, run, truth
from steps.shared.spectrum import progress
from studies.certainty.steps.restitution import changed, difference
from topheavy import Column, RockingFrame, judge, overturned_by, reference
from topheavy.structures import Structure
from topheavy.synthetic import fragility
from topheavy.synthetic.ensemble import Draw, draws
from topheavy.synthetic.motions import peak_velocity

BOTH, COLUMN_ALONE = "both", "column alone"


def structures(case: dict) -> dict[tuple[str, float], Structure]:
    """Return column and frame by each factor on their √r."""
    column = Column(**case["column"])
    named = {"column": column, "frame": RockingFrame(column, case["mass_ratio"])}
    return {
        (name, factor): changed(one, factor)
        for name, one in named.items()
        for factor in case["factors"]
    }


def compared(factors: list[float]) -> dict[tuple[str, float], tuple]:
    """Return the column and the frame of each comparison, by the way and the factor.

    The column alone is changed if its factor is lower than 1.
    """
    found = {(BOTH, factor): (("column", factor), ("frame", factor)) for factor in factors}
    lowered = [factor for factor in factors if factor < 1.0]
    return found | {
        (COLUMN_ALONE, factor): (("column", factor), ("frame", 1.0)) for factor in lowered
    }


def motions(case: dict, ensemble: dict) -> list[Draw]:
    """Return the first motions of each scenario and family."""
    return draws({**ensemble, "runs": {ensemble["run"]: {"motions": case["motions"]}}})


def outcomes(case: dict, ensemble: dict) -> pd.DataFrame:
    """Return a row for each motion: its family, and which of the structures it overturns."""
    under, chosen, rows = structures(case), motions(case, ensemble), []
    for draw in progress(chosen, len(chosen), "motions"):
        record = draw.record()
        scale = [case["pgv"] / peak_velocity(record)]
        fell = {name: overturned_by(one, record, scale)[0] for name, one in under.items()}
        rows.append({"family": draw.family} | fell)
    return pd.DataFrame(rows)


def differences(case: dict, fell: pd.DataFrame) -> pd.DataFrame:
    """Return for each family and change the probability of the column less that of the frame.

    Column and frame stay paired under each motion.
    """
    boot, rows = case["bootstrap"], []
    for family, part in fell.groupby("family", sort=False):
        weights = fragility.resampled(len(part), boot["resamples"], case["seed"])
        for (way, factor), (column, frame) in compared(case["factors"]).items():
            less = part[column].astype(float) - part[frame].astype(float)
            rows.append(
                {"family": family, "way": way, "factor": factor, "motions": len(part)}
                | {"column": int(part[column].sum()), "frame": int(part[frame].sum())}
                | {"only_column": int((less > 0).sum()), "only_frame": int((less < 0).sum())}
                | difference(fragility.means(weights, less), boot)
            )
    return pd.DataFrame(rows)


def confirmed(case: dict, ensemble: dict, fell: pd.DataFrame) -> Finding:
    """Return whether SciPy overturns the same structures, as a finding.

    A seeded sample of the motions that overturn only one of frame and column, of every change in
    turn. Outcomes that a billionth of the motion changes are undecided, and are not compared.
    """
    random, under, chosen = np.random.default_rng(case["seed"]), structures(case), set()
    pairs, all_motions = list(compared(case["factors"]).values()), motions(case, ensemble)
    for place in range(case["checked"]):
        column, frame = pairs[place % len(pairs)]
        apart = np.flatnonzero(fell[column] != fell[frame])
        at = int(random.choice(apart))
        chosen |= {(at, column), (at, frame)}
    told, differ = 0, 0
    for at, name in progress(sorted(chosen), len(chosen), "checks"):
        record = all_motions[at].record()
        scaled = record.scaled(case["pgv"] / peak_velocity(record))
        near = {judge(under[name], scaled.scaled(1.0 + n)).overturned for n in (-1e-9, 0.0, 1e-9)}
        if len(near) == 1:
            told += 1
            differ += reference.judge(under[name], scaled).overturned != fell[name][at]
    return truth(differ == 0 and told > 0, checked=len(chosen), told=told, differ=differ)


def main(case: dict, ensemble: dict) -> tuple[pd.DataFrame, dict]:
    fell = outcomes(case, ensemble)
    table = differences(case, fell)
    return table, findings(table) | {"second_route": confirmed(case, ensemble, fell)}


def findings(certainty_benefit: pd.DataFrame) -> dict[str, Finding]:
    """Return whether the frame stays the safer one, from the table of differences."""
    table = certainty_benefit
    both, alone = (table[table.way == way] for way in (BOTH, COLUMN_ALONE))
    lowest = alone[alone.factor == alone.factor.min()]
    return {
        "frame_is_safer": truth((both.interval == fragility.POSITIVE).all(), **said(both)),
        "remains": truth((alone.interval == fragility.POSITIVE).all(), **said(alone)),
        "reverses": truth((lowest.interval == fragility.NEGATIVE).all(), **said(lowest)),
    }


def said(rows: pd.DataFrame) -> dict:
    """Return the evidence: the compared rows, and how many there are."""
    return {"compared": len(rows), "changes": rows.to_dict("records")}


def work(job: Any) -> tuple:
    return main(job.params.case, job.params.ensemble)


if __name__ == "__main__":
    run(snakemake, work)
