"""At which deficit of the column's √r, or raise of the frame's, the benefit of the cap beam ends.

The gain is the probability that the column overturns less that of the frame under the same motions,
drawn anew within each earthquake. It is undecided where its interval includes zero.
"""

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from replication.workbench import Finding, run, truth
from studies.certainty.changed import COLUMN, FRAME, Subject, columns, subjects
from studies.certainty.rated import fallen, stated
from topheavy import Column, judge, reference
from topheavy.fragility.resampling import NEGATIVE, POSITIVE, in_words, interval, means_within
from topheavy.synthetic.ensemble import first_draws

NUDGE = 1e-9  # of a motion: an outcome that this changes is undecided
KEYS = ["family", "height", "mass_ratio", "way", "measure", "level"]


def compared(under: list[Subject]) -> Iterator[tuple[str, float, int, int, int]]:
    """Yield way, γ, and the places of the changed structure, of column and of frame compared."""
    column = [place for place, one in enumerate(under) if one.mass_ratio == 0.0]
    frames = [place for place, one in enumerate(under) if one.mass_ratio > 0.0]
    for place in frames:
        one = under[place]
        yield FRAME, one.mass_ratio, place, column[0], place
        if one.change == 0.0:
            for lowered in column:
                yield COLUMN, one.mass_ratio, lowered, lowered, place


class Group(NamedTuple):
    """Structures of one size under the motions of one family, and which levels overturn them.

    `fell` has the shape (motions, structures, levels); `motions` a row for each motion.
    """

    family: str
    column: Column
    under: list[Subject]
    fell: np.ndarray
    motions: pd.DataFrame


def groups(shards: pd.DataFrame, settings: dict, ensemble: dict) -> Iterator[Group]:
    """Yield the outcomes in all shards, by size and family."""
    motions = settings["runs"][settings["run"]]["motions"] * len(ensemble["scenarios"])
    for column in columns(settings):
        under = subjects(column, settings)
        here = shards[np.isclose(shards.height, under[0].height)]
        for family in ensemble["families"]:
            fell, firsts = fallen(here[here.family == family], motions, len(under))
            yield Group(family, column, under, fell, firsts)


def gains(group: Group, settings: dict) -> pd.DataFrame:
    """Return the gain and its interval, by γ, changed √r and intensity."""
    under, boot, found = group.under, settings["bootstrap"], []
    measures, levels, pgvs = zip(*stated(group.column, settings), strict=True)
    quakes = group.motions.scenario.tolist()
    means = means_within(group.fell, quakes, boot["resamples"], settings["seed"])
    for way, gamma, place, first, second in compared(under):
        ends = interval(means[:, first] - means[:, second], boot["confidence"])
        found.append(
            {"family": group.family, "height": under[0].height, "mass_ratio": gamma, "way": way}
            | {"change": under[place].change, "restitution": under[place].block.restitution}
            | {"measure": measures, "level": levels, "pgv": pgvs, "motions": len(quakes)}
            | {"column": means[0, first], "frame": means[0, second]}
            | dict(zip(("gain", "gain_low", "gain_high"), ends, strict=True))
            | {"interval": list(map(in_words, *ends[1:]))}
        )
    return pd.concat(map(pd.DataFrame, found))


def confirmed(sampled: list[Group], settings: dict, ensemble: dict) -> Finding:
    """Return whether SciPy finds the same outcomes, each the lowest level that overturns.

    Of a seeded sample. Outcomes that a billionth of the motion changes are not compared.
    """
    random, told, differ = np.random.default_rng(settings["seed"]), 0, 0
    every = first_draws(ensemble, settings["runs"][settings["run"]]["motions"])
    draws = {tuple(draw.labels.values()): draw for draw in every}
    for number in range(settings["checked"]):
        group = sampled[number % len(sampled)]
        motion, place = random.choice(np.argwhere(group.fell.any(axis=-1)))
        level = int(np.argmax(group.fell[motion, place]))
        row = group.motions.iloc[motion]
        record = draws[row.family, row.scenario, row.motion].record()
        *_, pgv = stated(group.column, settings)[level]
        block, scaled = group.under[place].block, record.scaled(pgv / record.peak_velocity)
        near = {judge(block, scaled.scaled(1.0 + n)).overturned for n in (-NUDGE, 0.0, NUDGE)}
        if len(near) == 1:
            told += 1
            differ += reference.judge(block, scaled).overturned != group.fell[motion, place, level]
    return truth(differ == 0 and told > 0, checked=settings["checked"], told=told, differ=differ)


def break_even(table: pd.DataFrame) -> pd.DataFrame:
    """Return for each comparison the changes at which the interval of the gain includes zero.

    `lowest` and `highest` are the ends of this set on the grid; `connected` says that it has all
    changes between them. NaN if the set is empty. `until` is the first change at which the
    interval is not positive, NaN if there is none.
    """
    found = []
    for labels, rows in table.groupby(KEYS, sort=False):
        unchanged, last = rows.iloc[0], rows.iloc[-1]
        places = np.flatnonzero(~rows.interval.isin([POSITIVE, NEGATIVE]))
        change, ended = rows.change.to_numpy(), (rows.interval != POSITIVE).to_numpy()
        zero = change[places]
        found.append(
            dict(zip(KEYS, labels, strict=True))
            | {"column": unchanged.column, "frame": unchanged.frame}
            | {"unchanged": unchanged.interval, "changed_most": last.interval}
            | {"lowest": zero.min(initial=np.inf), "highest": zero.max(initial=-np.inf)}
            | {"until": change[ended].min(initial=np.inf)}
            | {"undecided": len(zero), "connected": bool((np.diff(places) == 1).all())}
            | {"largest": last.change, "restitution": last.restitution}
        )
    return pd.DataFrame(found).replace([np.inf, -np.inf], np.nan)


def main(settings: dict, ensemble: dict, shards: pd.DataFrame) -> tuple:
    found = list(groups(shards, settings, ensemble))
    table = pd.concat([gains(group, settings) for group in found], ignore_index=True)
    sets = break_even(table)
    measured = dict(
        zip(("least", "largest"), ([share] for share in settings["measured"]), strict=True)
    )
    more = {"remains_at_measured": remains(sets, max(settings["measured"]))}
    more["break_even_by_scipy"] = confirmed(found, settings, ensemble)
    return table, sets, pd.DataFrame(measured), findings(sets) | more


def findings(certainty_break_even: pd.DataFrame) -> dict[str, Finding]:
    """Return where the benefit ends, from the table of sets.

    Asked are the comparisons in which the interval is positive with √r of Eq. (25).
    """
    table = certainty_break_even
    safer = table[table.unchanged == POSITIVE]
    lowered, raised = (safer[safer.way == way] for way in (COLUMN, FRAME))
    return {
        "deficit_ends_the_benefit": truth(
            len(lowered) > 0 and bool((lowered.changed_most != POSITIVE).all()), **ranged(lowered)
        ),
        "raise_ends_the_benefit": truth(
            len(raised) > 0 and bool((raised.changed_most != POSITIVE).all()), **ranged(raised)
        ),
        "undecided_deficits_are_connected": truth(
            len(lowered) > 0 and bool(lowered.connected.all()),
            compared=len(lowered),
            apart=int((~lowered.connected.astype(bool)).sum()),
        ),
    }


def ranged(rows: pd.DataFrame) -> dict[str, Any]:
    """Return the evidence: what becomes of the comparisons, and from and up to which changes."""
    return {
        "compared": len(rows),
        "remains": int((rows.changed_most == POSITIVE).sum()),
        "reversed": int((rows.changed_most == NEGATIVE).sum()),
        "least": float(rows.until.min()),
        "most": float(rows.until.max()),
        "median": float(rows.until.median()),
        "largest": float(rows.largest.max()),
    }


def remains(table: pd.DataFrame, deficit: float) -> Finding:
    """Return whether the interval stays positive up to a deficit of the column's √r."""
    safer = table[(table.unchanged == POSITIVE) & (table.way == COLUMN)]
    kept = ~(safer.until <= deficit)
    return truth(
        len(safer) > 0 and bool(kept.all()),
        deficit=deficit,
        compared=len(safer),
        kept=int(kept.sum()),
    )


def work(job: Any) -> tuple:
    shards = pd.concat(map(pd.read_csv, job.input.shards), ignore_index=True)
    return main(job.params.settings, job.params.ensemble, shards)


if __name__ == "__main__":
    run(snakemake, work)
