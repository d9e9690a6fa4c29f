"""Prove that nothing below minimum overturning accelerations overturns: boxes of amplitudes.

Search and checker prove each box. Those below the two minima that README and abstract quote are
written as certificates.
"""

import math
from typing import Any

import pandas as pd

from replication.workbench import Finding, run, truth
from steps.shared.proofs import as_lines, is_checked
from steps.vase import numbers
from topheavy import Column, Pulse
from topheavy.proven import survives_below

STRUCTURES = ("bare", "fixed", "free")
QUOTED = (("bare", 0.0), ("free", math.inf))
LABELS = ["structure", "mass_ratio"]


def kind(certificate: dict) -> str:
    """Return how a box was proven: by the lemma, or by following the motion, if there is one."""
    return "bounded" if any(e["event"] == "bounded" for e in certificate["events"]) else "followed"


def boxes(
    column: Column, settings: dict, known: pd.DataFrame, ratios: list[float]
) -> tuple[list[dict], list[tuple[str, dict]]]:
    """Return the boxes of each structure with one of these γ, up to its proven boundary.

    The certificates are those of the boxes of `QUOTED`.
    """
    shape, rows, certificates = settings["shapes"][0], [], []
    known = known[known["shape"] == shape].set_index(LABELS)
    for name, gamma, _, structure in numbers(column, settings):
        if name not in STRUCTURES or gamma not in ratios:
            continue
        at = known.loc[(name, gamma)]
        high = float(f"{at.minimum_overturning * (1.0 - at.relative_width):.15g}")
        pulse = Pulse(shape, 1.0, 2.0 * math.pi / settings["period"])

        def accepts(certificate: dict, structure: Any = structure, pulse: Pulse = pulse) -> bool:
            return is_checked(certificate, structure, pulse, ends(certificate))

        found = survives_below(structure, pulse, high, accepts=accepts)
        labels = {"structure": name, "mass_ratio": gamma, "minimum": high}
        proven = [(*ends(each), kind(each)) for each in found.certificates]
        rows += [
            labels | {"low": low, "high": top, "kind": how}
            for low, top, how in [*proven, *((*box, "open") for box in found.open)]
        ]
        if (name, gamma) in QUOTED:
            claim = f"nothing below the minimum of {name}, γ = {gamma:g}, under one {shape}"
            certificates += [(claim, each) for each in found.certificates]
    return rows, certificates


def ends(certificate: dict) -> tuple[float, float]:
    """Return the factors of a box."""
    low, high = (_number(text) for text in certificate["factor"])
    return low, high


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
            "whole": is_whole(part.sort_values("low")),
        }
        for place, part in boxes.groupby(LABELS)
    )


def is_whole(boxes: pd.DataFrame) -> bool:
    """Return whether boxes, by their lower ends, go from zero to the minimum without a gap."""
    ends = [0.0, *boxes.high], [*boxes.low, boxes.minimum.iloc[0]]
    return bool(ends[0] == ends[1] and not (boxes.kind == "open").any())


def findings(proven_below_structures: pd.DataFrame) -> dict[str, Finding]:
    """Return for how many structures the boxes leave nothing open from zero to the boundary."""
    table = proven_below_structures
    counts = ("whole", "boxes", "by_lemma", "open")
    return {
        "nothing_below": truth(
            bool(table.whole.all()),
            structures=len(table),
            **{name: int(table[name].sum()) for name in counts},
        )
    }


def main(
    settings: dict, ratios: list[float], known: pd.DataFrame
) -> tuple[pd.DataFrame, str, dict]:
    rows, certificates = boxes(Column(**settings["column"]), settings, known, ratios)
    structures = by_structure(pd.DataFrame(rows))
    return structures, as_lines(certificates), findings(structures)


def work(job: Any) -> tuple:
    known = pd.read_csv(job.input.proven)
    return main(job.params.settings, job.params.mass_ratios, known)


if __name__ == "__main__":
    run(snakemake, work)
