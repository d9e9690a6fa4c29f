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

LABELS = ["structure", "mass_ratio", "span"]
RECHECKED = 50  # the checker proves one box of so many again, where it can


def kind(certificate: dict) -> str:
    """Return how a box was proven: by no uplift, by following the motion, or by the lemma."""
    events = {event["event"] for event in certificate["events"]}
    return "bounded" if "bounded" in events else "followed" if events else "no uplift"


def boxes(column: Column, settings: dict, known: pd.DataFrame, ratios: list[float]) -> list[dict]:
    """Return the boxes of each structure with one of these γ, up to its proven boundary."""
    shape, rows = settings["shapes"][0], []
    known = known[known["shape"] == shape].fillna({"span": 0.0}).set_index(LABELS)
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


def by_structure(boxes: pd.DataFrame) -> pd.DataFrame:
    """Return for each structure how many boxes there are, and whether they leave nothing open."""
    return pd.DataFrame(
        dict(zip(LABELS, place, strict=True))
        | {
            "minimum": part.minimum.iloc[0],
            "boxes": int((part.kind != "open").sum()),
            "by_lemma": int((part.kind == "bounded").sum()),
            "open": int((part.kind == "open").sum()),
            "asked_twice": int(part.checked.notna().sum()),
            "proven_twice": int((part.checked == True).sum()),  # noqa: E712 - None is neither
            "whole": is_whole(part.sort_values("low")),
        }
        for place, part in boxes.groupby(LABELS, dropna=False)
    )


def is_whole(boxes: pd.DataFrame) -> bool:
    """Return whether boxes, by their lower ends, go from zero to the minimum without a gap."""
    ends = [0.0, *boxes.high], [*boxes.low, boxes.minimum.iloc[0]]
    return bool(ends[0] == ends[1] and not (boxes.kind == "open").any())


def findings(proven_below_structures: pd.DataFrame) -> dict[str, Finding]:
    """Return for how many structures the boxes leave nothing open from zero to the boundary."""
    table = proven_below_structures
    counts = ("whole", "boxes", "by_lemma", "open", "asked_twice", "proven_twice")
    return {
        "nothing_below": truth(
            bool(table.whole.all()),
            structures=len(table),
            **{name: int(table[name].sum()) for name in counts},
        )
    }


def main(
    settings: dict, ratios: list[float], known: pd.DataFrame
) -> tuple[pd.DataFrame, pd.DataFrame, dict]:
    table = pd.DataFrame(boxes(Column(**settings["column"]), settings, known, ratios))
    structures = by_structure(table)
    return table, structures, findings(structures)


def work(job: Any) -> tuple:
    known = pd.read_csv(job.input.proven)
    return main(job.params.settings, job.params.mass_ratios, known)


if __name__ == "__main__":
    run(snakemake, work)
