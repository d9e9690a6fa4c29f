"""What contacts have to give under the motions of the quoted probabilities, which assume no slip.

Of a motion that overturns a structure, the forces up to its last |θ| = α.
"""

import math
from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import Finding, run, truth
from steps.shared.histories import history
from steps.shared.spectrum import progress
from studies.mechanism.steps.demand import demand
from studies.mechanism.steps.setting import cap_of
from topheavy import Cap, Column, RockingFrame
from topheavy.ground.synthetic.ensemble import first_draws

RELIED_ON, SAID, LIGHT = 0.7, 0.05, 1.0
"""A coefficient of friction, the share of motions that may need more before a text says so, and the
γ below which a beam is light."""


def histories(settings: dict, ensemble: dict, cap: Cap) -> pd.DataFrame:
    """Return what each motion that uplifts a structure requires."""
    column, rows = Column(**settings["column"]), []
    draws = first_draws(ensemble, settings["motions"] // len(ensemble["scenarios"]))
    for draw in progress(draws, len(draws), "motions"):
        record = draw.record().scaled_to(pgv=settings["pgv"])
        for gamma in settings["mass_ratios"]:
            frame = RockingFrame(column, gamma)
            found = demand(frame, cap, history(frame, record, settings["samples"]))
            rows.append(
                {"family": draw.family, "mass_ratio": gamma, "outcome": found.outcome}
                | {"friction": found.whole, "error": found.friction_error, "pulls": found.pulls}
            )
    return pd.DataFrame(rows)


def summed(table: pd.DataFrame, coefficients: list[float]) -> pd.DataFrame:
    """Return for each family and γ what survivors require, those that overturn, and all.

    Shares are of the motions that uplift the structure.
    """
    rows = []
    for (family, gamma), part in table.groupby(["family", "mass_ratio"]):
        fell = part.outcome == "overturned"
        for name, some in (("survive", part[~fell]), ("overturn", part[fell]), ("all", part)):
            moved = some[np.isfinite(some.friction)]
            ends = np.quantile(moved.friction, (0.5, 0.95, 1.0)) if len(moved) else [math.nan] * 3
            rows.append(
                {"family": family, "mass_ratio": gamma, "motions": name, "uplifted": len(moved)}
                | dict(zip(("median", "p95", "largest"), ends, strict=True))
                | {f"above_{mu:g}": float((moved.friction > mu).mean()) for mu in coefficients}
                | {"tension": int(moved.pulls.sum()), "error": float(moved.error.max())}
            )
    return pd.DataFrame(rows)


def main(settings: dict, ensemble: dict, cap: Cap) -> tuple[pd.DataFrame, dict[str, Finding]]:
    table = summed(histories(settings, ensemble, cap), settings["coefficients"])
    return table, findings(table)


def findings(robustness_friction: pd.DataFrame) -> dict[str, Finding]:
    """Return whether few motions need more friction than is relied on, and if contacts pull."""
    table = robustness_friction[robustness_friction.motions == "all"]
    survivors = robustness_friction[robustness_friction.motions == "survive"]
    above = table[f"above_{RELIED_ON:g}"]
    beyond = table[above > SAID]
    is_light = (table.mass_ratio > 0.0) & (table.mass_ratio < LIGHT)
    return {
        "enough": truth(
            not len(beyond),
            holds_when=not (above[~is_light] > SAID).any(),
            condition=f"no beam, or γ of {LIGHT:g} or more",
            coefficient=RELIED_ON,
            said=SAID,
            compared=len(table),
            beyond=len(beyond),
            most=float(above.max()),
            mass_ratios=sorted({float(gamma) for gamma in beyond.mass_ratio}),
        ),
        "no_tension": truth(
            not survivors.tension.any(),
            histories=int(survivors.uplifted.sum()),
            tension=int(survivors.tension.sum()),
        ),
    }


def work(job: Any) -> tuple:
    return main(job.params.settings, job.params.ensemble, cap_of(job.params.cap))


if __name__ == "__main__":
    run(snakemake, work)
