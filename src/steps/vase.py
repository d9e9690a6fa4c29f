"""The cap beam's mass fixed to one column, against the same mass carried freely by two.

Does a fixed mass always lower the minimum overturning acceleration of the bare column, and a freely
carried one always raise it? Pulses over their frequency and records are searched for exceptions.
"""

import math
from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import Finding, grid, run, truth
from steps.shared.bearing import bearing
from steps.shared.spectrum import progress
from steps.vase_poses import poses
from steps.vase_searches import Minimum, lowest_decided, lowest_wide, minima, minimum, rivals
from steps.vase_shares import PARAMETERS, WORTHS, shares
from topheavy import (
    STANDARD_GRAVITY,
    Column,
    FixedMassColumn,
    MonolithicPortal,
    Pulse,
    Record,
    read_record,
)
from topheavy.second import reference

PORTALS_HIGHEST = 40.0  # g, where minima are sought; no other structure comes near
BESIDE = 1e-3  # over the peak acceleration from which a base is pulled: where SciPy is asked
SEED = 2014  # of the sample of boundaries that SciPy judges
OBJECTS = ("found", "bare", "wide", "bare_wide")  # of a row, which no table holds


def numbers(column: Column, settings: dict) -> list[tuple[str, float, float, Any]]:
    """Return structure, γ, span (NaN but for a portal) and the thing itself."""
    found = [(*rival[:2], math.nan, rival[2]) for rival in rivals(column, settings["mass_ratios"])]
    width, depth = settings["cap"]["width"], settings["cap"]["depth"]
    found += [
        ("fixed, of the drawn size", gamma, math.nan, FixedMassColumn(column, gamma, width, depth))
        for gamma in settings["mass_ratios"]
        if gamma > 0.0
    ]
    gamma = settings["portals"]["mass_ratio"]
    return found + [
        ("portal", gamma, span, MonolithicPortal(column, gamma, span, depth))
        for span in settings["portals"]["spans"]
    ]


def under_pulses(column: Column, settings: dict) -> list[dict]:
    """Return every structure's three numbers, and its minimum under each pulse of the period.

    A portal whose base is pulled below its minimum has none: there the model does not hold.
    """
    rows, below = [], settings["spectra"]["highest"] * column.uplift_acceleration
    for name, gamma, span, structure in numbers(column, settings):
        block, highest = structure.block(), PORTALS_HIGHEST if name == "portal" else below
        size = 3.0 * STANDARD_GRAVITY / (4.0 * block.frequency_parameter**2)
        for shape in settings["shapes"]:
            pulse = Pulse(shape, 1.0, 2.0 * math.pi / settings["period"])
            found = minimum(structure, pulse, highest, settings["floor"])
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
                    **(held_down(structure, pulse, found) if name == "portal" else {}),
                }
            )
    return rows


def held_down(portal: MonolithicPortal, pulse: Pulse, found: Minimum) -> dict[str, float]:
    """Return the peak from which the base is pulled, with SciPy's error, or the friction up to it.

    Where it is pulled, the minimum and its error are NaN.
    """
    last = found.lowest.bracket[0]
    borne = bearing(portal, pulse, last)
    row = {"friction": borne.friction, "pulled_from": math.nan, "pulled_error": math.nan}
    if borne.pulled_from == math.inf:
        return row
    ends = borne.pulled_from * (1.0 - BESIDE), borne.pulled_from * (1.0 + BESIDE)
    scipys = (bearing(portal, pulse, end, reference.simulate, 1).pulled_from for end in ends)
    agrees = [end < math.inf for end in scipys] == [False, True]
    row |= {"pulled_from": borne.pulled_from, "minimum_overturning": math.nan, "error": math.nan}
    return row | {"pulled_error": BESIDE * borne.pulled_from if agrees else math.inf}


def search(
    column: Column, motion: Pulse | Record, ratios: list[float], settings: dict, tightened: float
) -> list[dict]:
    """Return the minima of all structures under one motion, each beside that of the bare column."""
    rows: list[dict] = []
    highest, floor = settings["spectra"]["highest"] * column.uplift_acceleration, settings["floor"]
    under = [*rivals(column, ratios)]
    first = minima([structure for *_, structure in under], motion, highest, floor)
    for (name, gamma, _), lowest in zip(under, first, strict=True):
        found = lowest_decided(lowest, highest, floor, tightened)
        row = {"structure": name, "mass_ratio": gamma, "found": found}
        row["wide"] = lowest_wide(found, highest, floor, settings["widths"])
        bare = rows[0] if rows else row
        rows.append(row | {"bare": bare["found"], "bare_wide": bare["wide"]})
    return rows


def is_exception(row: dict) -> bool:
    """Whether a fixed mass overturns later than the bare column, or a frame earlier."""
    return is_reversed(row["structure"], row["found"].acceleration, row["bare"].acceleration)


def is_reversed(structure: str, ours: float, bare: float) -> bool:
    """Whether the accelerations that overturn are not in the order fixed, bare, free."""
    return {"bare": False, "fixed": ours > bare, "free": ours < bare}[structure]


def both(row: dict) -> list[Minimum]:
    """Return those of a structure and of the bare column that there are."""
    return [one for one in (row["found"], row["bare"]) if math.isfinite(one.acceleration)]


def is_compared(row: dict) -> bool:
    """Whether one of the two overturns at all."""
    return row["structure"] != "bare" and bool(both(row))


def plain(row: dict) -> dict:
    """Return a row of the table; NaN where nothing up to the highest acceleration overturns."""
    labels = {key: value for key, value in row.items() if key not in OBJECTS}
    return labels | {"minimum_overturning": _finite(row["found"])}


def searched(row: dict) -> dict:
    """Return a row with the width of its interval and of lower ones, and the wide intervals, g."""
    found = row["found"]
    width = found.lowest.width if math.isfinite(found.acceleration) else math.nan
    wide = {f"wider_than_{width:g}": _or_nan(first) for width, first in row["wide"].items()}
    return plain(row) | {"width": width, "passed_over": found.passed_over} | wide


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
    return _or_nan(found.acceleration)


def _or_nan(value: float) -> float:
    return value if math.isfinite(value) else math.nan


def question(compared: list[dict], structures: list[str], settings: dict) -> Finding:
    """Return whether the structures keep their rank under every motion, as a finding.

    The evidence has how often the lowest intervals of each width do not.
    """
    longest = settings["longest"]
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
        exceptions_of_width={
            f"{width:g}": reversed_at(asked, width) for width in settings["widths"]
        },
    )


def counted(exceptions: pd.DataFrame, structures: list[str]) -> dict[str, Any]:
    """Return how many exceptions these structures have, and whether there is none."""
    ours = exceptions[exceptions.structure.isin(structures)]
    of_records = int((ours.kind == "record").sum())
    return {"holds": ours.empty, "exceptions": len(ours), "exceptions_under_records": of_records}


def reversed_at(rows: list[dict], width: float) -> dict[str, int]:
    """Return how many ranks the lowest intervals of a width reverse, by the kind of motion."""
    found = [
        row["kind"]
        for row in rows
        if is_reversed(row["structure"], row["wide"][width], row["bare_wide"][width])
    ]
    return {"pulse": len(found) - found.count("record"), "record": found.count("record")}


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


def second_route(errors: list[float], exceptions: list[dict], rows: list[dict]) -> Finding:
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
        neither_overturns=sum(not both(row) for row in asked),
        passed_over=sum(row["found"].passed_over for row in rows),
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
    column: Column, settings: dict, paths: list[str]
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
        for kind, spec in (("pulse", settings["spectra"]), ("fresh", settings["fresh"]))
        for shape in spec["shapes"]
        for ratio in grid(spec["frequency_ratios"])
    ]
    return pulses + [
        (
            record.scaled(1.0 / np.abs(record.acceleration).max()),
            settings["record_mass_ratios"],
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
    """Return whether each portal overturns later than the frame of its γ under each pulse.

    A portal whose base is pulled counts up to there, as nothing lower overturns it.
    """
    at = ["mass_ratio", "shape"]
    frames = summary[summary.structure == "free"].set_index(at).minimum_overturning
    portals = summary[summary.structure == "portal"].set_index(at)
    reached = portals.minimum_overturning.fillna(portals.pulled_from)
    over = reached.to_numpy() / frames.loc[portals.index].to_numpy()
    quoted = portals.minimum_overturning.notna()
    return truth(
        over.min() > 1.0,
        compared=len(over),
        quoted=int(quoted.sum()),
        pulled=int((~quoted).sum()),
        pulled_by_scipy=int(np.isfinite(portals.pulled_error[~quoted]).sum()),
        least_pulled_from=float(portals.pulled_from.min()),
        largest_friction=float(portals.friction[quoted].max()),
        least=over.min(),
    )


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
    fresh = vase_exceptions[vase_exceptions.kind == "fresh"].frequency_ratio
    asked = {name: counted(vase_exceptions, structures) for name, structures in ASKED.items()}
    return asked | {
        "condition_on_a_fresh_grid": {"exceptions_beyond": sorted(fresh)},
        "portal_overturns_last": beside_frames(vase),
        "shares_of_the_gain": whole_gain(vase_shares),
        "second_route": {"exceptions": len(vase_exceptions)},
    }


def main(settings: dict, paths: list[str], tightened: float) -> tuple:
    column = Column(**settings["column"])
    summary = pd.DataFrame(under_pulses(column, settings))
    tried = motions(column, settings, paths)
    found = (
        [labels | row for row in search(column, motion, ratios, settings, tightened)]
        for motion, ratios, labels in tried
    )
    rows = [row for part in progress(found, len(tried), "motions") for row in part]
    compared = [row for row in rows if is_compared(row)]
    broken = [row for row in compared if is_exception(row)]
    exceptions = list(map(exception, broken))
    sample = sampled(compared, "pulse", settings["sample"]["points"])
    sample += sampled(compared, "record", settings["checked_by_second_route"])
    sample += [one for row in broken for one in both(row)]
    errors = [*(one.error / one.acceleration for one in sample)]
    quoted = summary[summary.minimum_overturning.notna()]
    errors += [*(quoted.error / quoted.minimum_overturning)]
    errors += [*(summary.pulled_error / summary.pulled_from).dropna()]
    of_shares = pd.DataFrame(shares(column, settings))
    none = ["structure", "kind", "frequency_ratio"]
    found = {name: question(compared, of, settings) for name, of in ASKED.items()}
    found["support_decides"] = found["support_decides"].with_evidence(
        under_the_pulses_of_the_period=ranks(summary)
    )
    found["condition_on_a_fresh_grid"] = on_a_fresh_grid(compared, settings["longest"])
    drawn = findings(
        summary, pd.DataFrame(exceptions, columns=None if exceptions else none), of_shares
    )
    found |= {name: one for name, one in drawn.items() if isinstance(one, Finding)}
    found["second_route"] = second_route(errors, exceptions, rows)
    tables = summary, pd.DataFrame(map(searched, rows)), pd.DataFrame(exceptions), of_shares
    return *tables, pd.DataFrame(poses(column, settings)), found


def work(job: Any) -> tuple:
    return main(job.params.settings, job.input.records, job.params.solver["tightened"])


if __name__ == "__main__":
    run(snakemake, work)
