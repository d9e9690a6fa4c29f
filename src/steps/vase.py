"""The cap beam's mass fixed to one column, against the same mass carried freely by two.

Does a fixed mass always lower the minimum overturning acceleration of the bare column, and a freely
carried one always raise it? Pulses over their frequency and records are searched for exceptions.
"""

import math
from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import Finding, grid, run, truth
from steps.shared.spectrum import progress
from steps.vase_poses import poses
from steps.vase_searches import FINEST, Minimum, minimum, refined, rivals
from steps.vase_shares import PARAMETERS, WORTHS, shares
from topheavy import (
    STANDARD_GRAVITY,
    Column,
    FixedMassColumn,
    MonolithicPortal,
    Pulse,
    Record,
    read_record,
    reference,
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
    """Return every structure's three numbers, and its minimum under each pulse of the period."""
    rows = []
    for name, gamma, span, structure in numbers(column, case):
        block = structure.block()
        size = 3.0 * STANDARD_GRAVITY / (4.0 * block.frequency_parameter**2)
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
                    "error": found.error,
                }
            )
    return rows


def search(
    column: Column, motion: Pulse | Record, ratios: list[float], highest: float, labels: dict
) -> list[dict]:
    """Return the minima of all structures under one motion, each beside that of the bare column."""
    rows: list[dict] = []
    for name, gamma, structure in rivals(column, ratios):
        found = minimum(structure, motion, highest)
        bare = rows[0]["found"] if rows else refined(found, min(found.bracket[0], highest))
        found = refined(found, min(bare.acceleration, highest)) if rows else bare
        rows.append(labels | {"structure": name, "mass_ratio": gamma, "found": found, "bare": bare})
    return rows


def is_exception(row: dict) -> bool:
    """Whether a fixed mass overturns later than the bare column, or a frame earlier."""
    ours, bare = row["found"].acceleration, row["bare"].acceleration
    return {"bare": False, "fixed": ours > bare, "free": ours < bare}[row["structure"]]


def minima(row: dict) -> list[Minimum]:
    """Return those of a structure and of the bare column that there are."""
    return [one for one in (row["found"], row["bare"]) if math.isfinite(one.acceleration)]


def is_compared(row: dict, tightened: float) -> bool:
    """Whether one of the two overturns at all, and the tolerance does not change the minima."""
    found = minima(row)
    return row["structure"] != "bare" and bool(found) and all(one.told(tightened) for one in found)


def plain(row: dict) -> dict:
    """Return a row of the table; NaN where nothing up to the highest acceleration overturns."""
    labels = {key: value for key, value in row.items() if key not in ("found", "bare")}
    return labels | {"minimum_overturning": _finite(row["found"])}


def exception(row: dict) -> dict:
    """Return an exception with the error of both of its minima, by SciPy."""
    ours, bare = row["found"], row["bare"]
    errors = (one.error if math.isfinite(one.acceleration) else math.nan for one in (ours, bare))
    pair = dict(zip(("error", "bare_error"), errors, strict=True))
    later = ours if ours.acceleration > bare.acceleration else bare
    earlier = min(ours.acceleration, bare.acceleration)
    survives = not reference.judge(later.structure, later.motion.scaled(earlier)).overturned
    return plain(row) | {"bare_column": _finite(bare), **pair, "later_one_survives": survives}


def _finite(found: Minimum) -> float:
    return found.acceleration if math.isfinite(found.acceleration) else math.nan


def question(compared: list[dict], structures: list[str], longest: float) -> Finding:
    """Return whether the structures keep their rank under every motion, as a finding."""
    asked = [row for row in compared if row["structure"] in structures]
    broken = pd.DataFrame(filter(is_exception, asked), columns=["structure", "kind"])
    found = counted(broken, structures)
    long_ones = [row for row in asked if row["frequency_ratio"] <= longest]
    return truth(
        found.pop("holds"),
        holds_when=bool(long_ones) and not any(map(is_exception, long_ones)),
        condition=f"the ground motion is a pulse of ω at most {longest:g} p",
        comparisons=len(asked),
        comparisons_when=len(long_ones),
        **found,
        records=sum(row["kind"] == "record" for row in asked),
        steps={kind.__name__: step for kind, step in FINEST.items()},
    )


def counted(exceptions: pd.DataFrame, structures: list[str]) -> dict[str, Any]:
    """Return how many exceptions these structures have, and whether there is none."""
    ours = exceptions[exceptions.structure.isin(structures)]
    of_records = int((ours.kind == "record").sum())
    return {"holds": ours.empty, "exceptions": len(ours), "exceptions_under_records": of_records}


def on_a_fresh_grid(compared: list[dict], longest: float) -> Finding:
    """Return whether the condition, stated before, holds where it was not found, as a finding."""
    fresh = [row for row in compared if row["kind"] == "fresh"]
    inside = [row for row in fresh if row["frequency_ratio"] <= longest]
    broken = sorted(row["frequency_ratio"] for row in fresh if is_exception(row))
    return truth(
        bool(inside) and not any(map(is_exception, inside)),
        comparisons=len(inside),
        beyond=len(fresh) - len(inside),
        exceptions_beyond=broken,
    )


def sampled(compared: list[dict], kind: str, count: int) -> list[Minimum]:
    """Return minima of a seeded sample of the motions of a kind, of records the smallest."""
    found = [row["found"] for row in compared if row["kind"] == kind]
    found = [one for one in found if math.isfinite(one.acceleration)]
    if kind == "record":
        return sorted(found, key=lambda one: one.motion.acceleration.size)[:count]
    return [found[place] for place in np.random.default_rng(SEED).permutation(len(found))[:count]]


def second_route(
    errors: list[float], exceptions: list[dict], rows: list[dict], compared: list[dict]
) -> Finding:
    """Return whether SciPy finds every boundary of the sample, as a finding.

    Of every exception, the structure that overturns later has to survive where the other falls.
    """
    found = bool(np.all(np.isfinite(errors)))
    asked = [row for row in rows if row["structure"] != "bare"]
    return truth(
        found and all(row["later_one_survives"] for row in exceptions),
        boundaries=len(errors),
        largest_relative_error=float(np.max(errors)) if found else None,
        exceptions=len(exceptions),
        neither_overturns=sum(not minima(row) for row in asked),
        not_told=sum(bool(minima(row)) for row in asked) - len(compared),
    )


def whole_gain(table: pd.DataFrame) -> Finding:
    """Return whether α, p and √r carry the whole gain, and how much each: mean and range."""
    single = table[table.shapley_value.notna()]
    whole = single.groupby(["worth", "shape", "mass_ratio"]).share_of_gain.sum()
    found = single.groupby(["worth", "taken_from_the_frame"]).share_of_gain
    shares = {
        worth: {
            name: [float(found.agg(how)[worth, name]) for how in ("mean", "min", "max")]
            for name in PARAMETERS
        }
        for worth in WORTHS
    }
    return truth(bool(np.allclose(whole, 1.0)), **shares)


def motions(
    column: Column, case: dict, paths: list[str]
) -> list[tuple[Pulse | Record, list[float], dict]]:
    """Return every motion, of unit peak, with the γ that it is tried with and its labels.

    Those of the kind "fresh" test the condition that the others led to.
    """
    p = column.frequency_parameter
    pulses = [
        (
            Pulse(shape, 1.0, ratio * p),
            spec["mass_ratios"],
            {"kind": kind, "motion": shape, "frequency_ratio": ratio},
        )
        for kind, spec in (("pulse", case["spectra"]), ("fresh", case["fresh"]))
        for shape in spec["shapes"]
        for ratio in grid(spec["frequency_ratios"])
    ]
    return pulses + [
        (
            record.scaled(1.0 / np.abs(record.acceleration).max()),
            case["record_mass_ratios"],
            {"kind": "record", "motion": record.name, "frequency_ratio": math.nan},
        )
        for record in map(read_record, paths)
    ]


def ranks(summary: pd.DataFrame) -> bool:
    """Whether fixed < bare < free under each pulse of the period, for every γ > 0."""
    of = summary.set_index(["structure", "shape"]).sort_index().minimum_overturning
    return all(
        of["fixed", shape].max() < of["bare", shape].min()
        and of["free", shape].min() > of["bare", shape].max()
        for shape in summary["shape"].unique()
    )


def beside_frames(summary: pd.DataFrame) -> Finding:
    """Return whether each portal overturns later than the frame of its γ under each pulse."""
    at = ["mass_ratio", "shape"]
    frames = summary[summary.structure == "free"].set_index(at).minimum_overturning
    portals = summary[summary.structure == "portal"].set_index(at).minimum_overturning
    over = portals.to_numpy() / frames.loc[portals.index].to_numpy()
    return truth(over.min() > 1.0, compared=len(over), least=over.min(), largest=over.max())


ASKED = {
    "fixed_mass_always_lowers": ["fixed"],
    "frame_always_raises": ["free"],
    "support_decides": ["fixed", "free"],
}
"""Which structures each question about all motions is asked of."""


def findings(
    vase: pd.DataFrame, vase_exceptions: pd.DataFrame, vase_shares: pd.DataFrame
) -> dict[str, Any]:
    """Return what follows from the tables of minima, exceptions and shares of the gain."""
    portals = vase[(vase.structure == "portal") & (vase["shape"] == vase["shape"][0])]
    fresh = vase_exceptions[vase_exceptions.kind == "fresh"].frequency_ratio
    asked = {name: counted(vase_exceptions, structures) for name, structures in ASKED.items()}
    return asked | {
        "condition_on_a_fresh_grid": {"exceptions_beyond": sorted(fresh)},
        "portal_has_a_wider_base": truth(
            (portals.slenderness_deg > vase.slenderness_deg[0]).all(),
            slenderness_deg=portals.slenderness_deg,
            minimum_overturning_g=portals.minimum_overturning,
        ),
        "portal_overturns_last": beside_frames(vase),
        "shares_of_the_gain": whole_gain(vase_shares),
        "second_route": {"exceptions": len(vase_exceptions)},
    }


def main(case: dict, paths: list[str], tightened: float) -> tuple:
    column = Column(**case["column"])
    summary = pd.DataFrame(under_pulses(column, case))
    highest = case["spectra"]["highest"] * column.uplift_acceleration
    tried = motions(column, case, paths)
    found = (search(column, motion, ratios, highest, labels) for motion, ratios, labels in tried)
    rows = [row for part in progress(found, len(tried), "motions") for row in part]
    compared = [row for row in rows if is_compared(row, tightened)]
    broken = [row for row in compared if is_exception(row)]
    exceptions = list(map(exception, broken))
    sample = sampled(compared, "pulse", case["sample"]["points"])
    sample += sampled(compared, "record", case["checked_by_second_route"])
    sample += [one for row in broken for one in minima(row)]
    errors = [*(one.error / one.acceleration for one in sample)]
    errors += [*(summary.error / summary.minimum_overturning)]
    of_shares = pd.DataFrame(shares(column, case))
    longest, none = case["longest"], ["structure", "kind", "frequency_ratio"]
    found = {name: question(compared, of, longest) for name, of in ASKED.items()}
    found["support_decides"] = found["support_decides"].with_evidence(
        under_the_pulses_of_the_period=ranks(summary)
    )
    found["condition_on_a_fresh_grid"] = on_a_fresh_grid(compared, longest)
    drawn = findings(
        summary, pd.DataFrame(exceptions, columns=None if exceptions else none), of_shares
    )
    found |= {name: one for name, one in drawn.items() if isinstance(one, Finding)}
    found["second_route"] = second_route(errors, exceptions, rows, compared)
    searched = pd.DataFrame(plain(row) | {"search_step": row["found"].step} for row in rows)
    tables = summary, searched, pd.DataFrame(exceptions), of_shares
    return *tables, pd.DataFrame(poses(column, case)), found


def work(job: Any) -> tuple:
    return main(job.params.case, job.input.records, job.params.solver["tightened"])


if __name__ == "__main__":
    run(snakemake, work)
