"""What is left of the benefit of a free cap beam if √r is lower, of frame and column or of one.

Frame and column, with √r of Eq. (25) and with a factor on it, under all synthetic motions of study
reversals, each scaled to a stated peak ground velocity.
"""

from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import Finding, run, truth
from steps.shared.spectrum import progress
from studies.certainty.steps.restitution import bounds, changed
from topheavy import Column, Fragility, RockingFrame, fragility, judge, reference
from topheavy.fragility.resampling import NEGATIVE, POSITIVE, means, resampled
from topheavy.structures import Structure
from topheavy.synthetic.ensemble import first_draws
from topheavy.synthetic.motions import peak_velocity

BOTH, COLUMN_ALONE, FRAME_ALONE = "both", "column alone", "frame alone"


def called(name: str, factor: float) -> str:
    """Return the name of a structure with a factor on its √r, as `fragility` names columns."""
    return name if factor == 1.0 else f"{name}, √r {100.0 * (1.0 - factor):g} % lower"


def structures(settings: dict) -> dict[str, Structure]:
    """Return column and frame by name, with each factor on their √r."""
    column = Column(**settings["column"])
    named = {"column": column, "frame": RockingFrame(column, settings["mass_ratio"])}
    return {
        called(name, factor): one if factor == 1.0 else changed(one, factor)
        for name, one in named.items()
        for factor in settings["factors"]
    }


def compared(factors: list[float]) -> dict[tuple[str, float], tuple[str, str]]:
    """Return the column and the frame of each comparison, by the way and the factor.

    One of them alone is changed if the factor is lower than 1.
    """
    found = {(BOTH, f): (called("column", f), called("frame", f)) for f in factors}
    lowered = [factor for factor in factors if factor < 1.0]
    found |= {(COLUMN_ALONE, f): (called("column", f), "frame") for f in lowered}
    return found | {(FRAME_ALONE, f): ("column", called("frame", f)) for f in lowered}


def fragilities(settings: dict, ensemble: dict) -> dict[str, Fragility]:
    """Return for each family the outcomes and differences of frame and column at the stated PGV."""
    given = structures(settings)
    # `fragility` lowers the √r of the column, and compares it with every frame.
    drawn = first_draws(ensemble, settings["motions"])
    lower = [1.0 - factor for factor in settings["factors"] if factor < 1.0]
    under = {name: one for name, one in given.items() if name == "column" or "frame" in name}
    return {
        family: fragility(
            under,
            [draw.record() for draw in drawn if draw.family == family],
            [settings["pgv"]],
            lowered=lower,
            seed=settings["seed"],
            **settings["bootstrap"],
        )
        for family in progress(ensemble["families"], len(ensemble["families"]), "families")
    }


def outcomes(found: dict[str, Fragility]) -> pd.DataFrame:
    """Return a row for each motion: its family, and which of the structures it overturns."""
    return pd.concat(
        [
            pd.DataFrame(one.outcomes[..., 0], columns=one.curves.structure).assign(family=family)
            for family, one in found.items()
        ],
        ignore_index=True,
    )


def differences(settings: dict, found: dict[str, Fragility]) -> pd.DataFrame:
    """Return for each family and change the probabilities of column and frame, compared.

    The first less the second, and the second over the first, with intervals of the same resamples.
    """
    rows, boot = [], settings["bootstrap"]
    for family, one in found.items():
        weights = resampled(len(one.outcomes), boot["resamples"], settings["seed"])
        names = one.curves.structure.to_numpy().tolist()
        shares = dict(zip(names, means(weights, one.outcomes[..., 0]).T, strict=True))
        curves, pairs = one.curves.isel(level=0), one.pairs.isel(level=0)
        for (way, factor), (column, frame) in compared(settings["factors"]).items():
            (pair,) = np.flatnonzero((pairs["first"] == column) & (pairs.second == frame))
            of = pairs.isel(pair=pair)
            rows.append(
                {"family": family, "way": way, "factor": factor, "motions": len(one.outcomes)}
                | {"column": int(curves.overturned.sel(structure=column))}
                | {"frame": int(curves.overturned.sel(structure=frame))}
                | {"only_column": int(of.only_first), "only_frame": int(of.only_second)}
                | {name: float(of[name]) for name in ("less", "less_low", "less_high")}
                | {"interval": of.less_words.item()}
                | bounds("over", over(shares[frame], shares[column]), boot)
            )
    return pd.DataFrame(rows)


def over(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Return the ratio of two shares in each resample, NaN where the second is zero."""
    return first / np.where(second > 0.0, second, np.nan)


def confirmed(settings: dict, ensemble: dict, fell: pd.DataFrame) -> Finding:
    """Return whether SciPy overturns the same structures, as a finding.

    A seeded sample of the motions that overturn only one of frame and column, of every change in
    turn. Outcomes that a billionth of the motion changes are undecided, and are not compared.
    """
    random, under, chosen = np.random.default_rng(settings["seed"]), structures(settings), set()
    pairs = list(compared(settings["factors"]).values())
    all_motions = first_draws(ensemble, settings["motions"])
    for place in range(settings["checked"]):
        column, frame = pairs[place % len(pairs)]
        apart = np.flatnonzero(fell[column] != fell[frame])
        at = int(random.choice(apart))
        chosen |= {(at, column), (at, frame)}
    told, differ = 0, 0
    for at, name in progress(sorted(chosen), len(chosen), "checks"):
        record = all_motions[at].record()
        scaled = record.scaled(settings["pgv"] / peak_velocity(record))
        near = {judge(under[name], scaled.scaled(1.0 + n)).overturned for n in (-1e-9, 0.0, 1e-9)}
        if len(near) == 1:
            told += 1
            differ += reference.judge(under[name], scaled).overturned != fell[name][at]
    return truth(differ == 0 and told > 0, checked=len(chosen), told=told, differ=differ)


def main(settings: dict, ensemble: dict) -> tuple[pd.DataFrame, dict]:
    found = fragilities(settings, ensemble)
    table = differences(settings, found)
    return table, findings(table) | {"second_route": confirmed(settings, ensemble, outcomes(found))}


def findings(certainty_benefit: pd.DataFrame) -> dict[str, Finding]:
    """Return whether the frame stays the safer one, from the table of differences."""
    table = certainty_benefit
    both, alone = (table[table.way == way] for way in (BOTH, COLUMN_ALONE))
    lowest = alone[alone.factor == alone.factor.min()]
    return {
        "frame_is_safer": truth(
            (both.interval == POSITIVE).all(), shrinks=shrinks(both), **said(both)
        ),
        "remains": truth((alone.interval == POSITIVE).all(), **said(alone)),
        "reverses": truth((lowest.interval == NEGATIVE).all(), **said(lowest)),
    }


def shrinks(both: pd.DataFrame) -> bool:
    """Return whether the difference of each family is smaller the lower the common factor is.

    The intervals for the lowest factor have to lie below those of Eq. (25).
    """
    of = both.set_index(["factor", "family"])
    lowest, unchanged = of.loc[both.factor.min()], of.loc[1.0]
    return bool((lowest.less_high < unchanged.less_low).all())


def said(rows: pd.DataFrame) -> dict:
    """Return the evidence: the compared rows, and how many there are."""
    return {"compared": len(rows), "changes": rows.to_dict("records")}


def work(job: Any) -> tuple:
    return main(job.params.settings, job.params.ensemble)


if __name__ == "__main__":
    run(snakemake, work)
