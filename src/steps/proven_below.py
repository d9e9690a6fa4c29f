"""Prove that nothing below minimum overturning accelerations overturns: boxes of amplitudes.

The boxes are of the search alone, in ball arithmetic; the checker proves a sample of them again.
"""

import math
from typing import Any

import pandas as pd

from replication.workbench import Finding, run, truth
from steps.shared.proofs import is_checked
from steps.vase import numbers
from topheavy import Column, Pulse
from topheavy.proven import survives_below

RECHECKED = 50  # the checker proves one box of so many again, where it can


def kind(certificate: dict) -> str:
    """Return how a box was proven: by no uplift, by following the motion, or by the lemma."""
    events = {event["event"] for event in certificate["events"]}
    return "bounded" if "bounded" in events else "followed" if events else "no uplift"


def boxes(column: Column, settings: dict, known: pd.DataFrame, ratios: list[float]) -> list[dict]:
    """Return the boxes of each structure with one of these γ, up to its proven boundary."""
    shape, rows = settings["shapes"][0], []
    labels = ["structure", "mass_ratio", "span"]
    known = known[known["shape"] == shape].fillna({"span": 0.0}).set_index(labels)
    for name, gamma, span, structure in numbers(column, settings):
        place = name, gamma, 0.0 if math.isnan(span) else span
        if gamma not in ratios or place not in known.index:
            continue
        at = known.loc[place]
        high = float(f"{at.minimum_overturning * (1.0 - at.relative_width):.15g}")
        pulse = Pulse(shape, 1.0, 2.0 * math.pi / settings["period"])
        found = survives_below(structure, pulse, high)
        labels = {"structure": name, "mass_ratio": gamma, "span": span}
        uplift = structure.block().uplift_acceleration
        for number, certificate in enumerate(found.certificates):
            low, top = (_number(x) for x in certificate["factor"])
            asked = certificate, structure, pulse, (low, top)
            checked = is_checked(*asked) if number % RECHECKED == 0 else None
            rows.append(
                labels
                | {"low": low, "high": top, "kind": kind(certificate)}
                | {"impacts": certificate["impacts"], "checked": checked}
                | {"uplift": uplift, "minimum": high, "steps": len(certificate["events"])}
            )
        rows += [
            labels
            | {"low": low, "high": top, "kind": "open", "impacts": -1, "checked": None}
            | {"uplift": uplift, "minimum": high, "steps": 0}
            for low, top in found.open
        ]
    return rows


def _number(text: str) -> float:
    top, _, below = text.partition("/")
    return int(top) / int(below or 1)


def findings(proven_below: pd.DataFrame) -> dict[str, Finding]:
    """Return for how many structures the boxes leave nothing open from zero to the boundary."""
    labels = ["structure", "mass_ratio", "span"]
    table, whole = proven_below.sort_values([*labels, "low"]), 0
    groups = table.groupby(labels, dropna=False)
    for _, part in groups:
        closed = part.low.tolist()[1:] == part.high.tolist()[:-1] and part.low.iloc[0] == 0.0
        closed &= part.high.iloc[-1] == part.minimum.iloc[0]
        whole += closed and not (part.kind == "open").any()
    return {
        "nothing_below": truth(
            whole == groups.ngroups,
            structures=groups.ngroups,
            whole=whole,
            boxes=int((table.kind != "open").sum()),
            by_lemma=int((table.kind == "bounded").sum()),
            open=int((table.kind == "open").sum()),
            asked_twice=int(table.checked.notna().sum()),
            proven_twice=int((table.checked == True).sum()),  # noqa: E712 - None is neither
        )
    }


def main(settings: dict, ratios: list[float], known: pd.DataFrame) -> tuple[pd.DataFrame, dict]:
    table = pd.DataFrame(boxes(Column(**settings["column"]), settings, known, ratios))
    return table, findings(table)


def work(job: Any) -> tuple:
    known = pd.read_csv(job.input.proven)
    return main(job.params.settings, job.params.mass_ratios, known)


if __name__ == "__main__":
    run(snakemake, work)
