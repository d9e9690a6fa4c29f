"""Column, vase and frame under eight models of motions: what each model says of the beam.

A row is a model: filtered white noise of a soil and a corner frequency, or a family of study
reversals, of which further rows have the motions that a factor of at most so much brings to the
stated velocity. A statement holds in every model if it does in every row.
"""

import math
from collections.abc import Callable, Iterator
from functools import partial
from itertools import product
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from replication.workbench import Finding, run, truth
from steps.shared.second import beside_a_boundary, by_scipy, overturns
from steps.shared.spectrum import progress
from steps.shared.sweep import Asked, Subject, overturned_under
from topheavy import Column, FixedMassColumn, Record, RockingFrame
from topheavy.ground.synthetic.ensemble import first_draws
from topheavy.ground.synthetic.filtered_noise import Soil, motion
from topheavy.risk.curve import fit, medians
from topheavy.risk.ensemble import Ensemble

NAMES = ("column", "vase", "frame")
COLUMN, VASE, FRAME = range(3)
NOISE = "filtered noise"


class Model(NamedTuple):
    """A model of motions: its labels, its motions on request, and what they have in common."""

    labels: dict[str, Any]
    motions: list[Callable[[], Record]]
    groups: list[int]


def models(settings: dict, ensemble: dict) -> Iterator[Model]:
    """Yield the soils with each corner frequency, then the families."""
    count = settings["motions"]
    for place, (soil, corner) in enumerate(product(settings["soils"], settings["corners"])):
        seed, of = settings["seed"] + place, Soil(soil, corner)
        drawn: list[Callable] = [partial(motion, seed, number, of) for number in range(count)]
        yield Model({"model": NOISE, "soil": soil, "corner": corner}, drawn, [0] * count)
    for family in ensemble["families"]:
        one = ensemble | {"families": [family]}
        draws = first_draws(one, count // len(ensemble["scenarios"]))
        groups = [draw.place for draw in draws]
        yield Model({"model": family}, [draw.record for draw in draws], groups)


def structures(settings: dict) -> list[Subject]:
    """Return the column, the mass fixed to its top, and the frame."""
    column, gamma = Column(**settings["column"]), settings["mass_ratio"]
    each = column, FixedMassColumn(column, gamma), RockingFrame(column, gamma)
    return [
        Subject({"structure": name}, one.block()) for name, one in zip(NAMES, each, strict=True)
    ]


def asked(settings: dict) -> Asked:
    """Return the structures at the velocities of the medians, and last at the stated one."""
    spec = settings["velocities"]
    grid = np.geomspace(spec["lowest"], spec["highest"], spec["points"])
    return Asked(structures(settings), np.append(grid, settings["pgv"]), settings["motions"])


class Swept(NamedTuple):
    """Outcomes, shape (motions, structures, levels), and PGV (m/s) and PGA (g) as drawn."""

    outcomes: np.ndarray
    velocities: np.ndarray
    accelerations: np.ndarray


def swept(model: Model, question: Asked) -> Swept:
    """Return what the motions of a model overturn."""
    rows = []
    for draw in progress(model.motions, len(model.motions), str(model.labels)):
        record = draw()
        (fell,) = overturned_under(record, [question])
        rows.append((fell, record.peak_velocity, record.peak_acceleration))
    return Swept(*map(np.array, zip(*rows, strict=True)))


def row(labels: dict, groups: list[int], found: Swept, settings: dict) -> dict:
    """Return the numbers of one model, with intervals of motions drawn anew."""
    levels, seed = asked(settings).levels, settings["seed"]
    each = Ensemble(found.outcomes, groups, seed=seed, **settings["bootstrap"])
    means, fell = each.means(), found.outcomes[..., -1]
    shares = means[..., -1].T
    middle = medians(levels[:-1], fit(levels[:-1], means[..., :-1], skewed=True))
    of_frame, of_column = fell[:, FRAME] & ~fell[:, COLUMN], fell[:, COLUMN] & ~fell[:, FRAME]
    factors = settings["pgv"] / found.velocities
    scaled = {"factor": factors, "pga": factors * found.accelerations}
    numbers = {name: shares[place] for place, name in enumerate(NAMES)}
    numbers |= {
        "harm": shares[VASE] - shares[COLUMN],
        "benefit": shares[COLUMN] - shares[FRAME],
        "gain": middle[:, FRAME] / middle[:, COLUMN] - 1.0,
        "only_frame": each.means(of_frame),
        "only_column": each.means(of_column),
    }
    found_one = labels | {"motions": len(fell)}
    for name, values in numbers.items():
        found_one |= each.bounds(name, values)
    ends = {"median": 0.5, "p95": 0.95, "largest": 1.0}
    of_scale = {
        f"{name}_{end}": float(np.quantile(values, share))
        for name, values in scaled.items()
        for end, share in ends.items()
    }
    return found_one | of_scale


def restricted(found: Swept, model: Model, settings: dict) -> tuple[Swept, list[int]]:
    """Return what is left with the motions that a small factor brings to the stated velocity."""
    some = settings["pgv"] / found.velocities <= settings["largest_factor"]
    groups = [group for group, kept in zip(model.groups, some, strict=True) if kept]
    return Swept(*(of[some] for of in found)), groups


def sampled(judged: list[tuple[Model, Swept]], settings: dict) -> Iterator[tuple]:
    """Yield a seeded sample of the outcomes under filtered noise, half of it beside a boundary."""
    random, subjects = np.random.default_rng(settings["seed"]), structures(settings)
    levels = asked(settings).levels
    for number in progress(range(settings["checked"]), settings["checked"], "checks"):
        model, found = judged[number % len(judged)]
        at, place = int(random.integers(len(model.motions))), int(random.integers(len(subjects)))
        level = int(random.integers(levels.size))
        block, record = subjects[place].block, model.motions[at]()
        factor = levels[level] / found.velocities[at]
        if number % 2:
            factor = beside_a_boundary(partial(overturns, block, record), factor)
        yield block, record, factor, bool(found.outcomes[at, place, level])


def main(settings: dict, ensemble: dict) -> tuple[pd.DataFrame, dict[str, Finding]]:
    question, rows, judged = asked(settings), [], []
    for model in models(settings, ensemble):
        found = swept(model, question)
        rows.append(row(model.labels | {"most": math.inf}, model.groups, found, settings))
        if model.labels["model"] == NOISE:
            judged.append((model, found))
        else:
            labels = model.labels | {"most": settings["largest_factor"]}
            few, groups = restricted(found, model, settings)
            rows.append(row(labels, groups, few, settings))
    table = pd.DataFrame(rows)
    agreed = by_scipy(sampled(judged, settings))
    checked = settings["checked"]
    confirmed = truth(agreed["differ"] == 0 and agreed["decided"] > 0, checked=checked, **agreed)
    return table, findings(table) | {"second_route": confirmed}


def findings(robustness_models: pd.DataFrame) -> dict[str, Finding]:
    """Return which statements hold in every row, and which numbers lie in every interval."""
    table = robustness_models

    def everywhere(*names: str) -> Finding:
        lows = table[[f"{name}_low" for name in names]]
        return truth(
            len(table) > 0 and bool((lows > 0.0).all(axis=None)),
            rows=len(table),
            least={name: float(table[name].min()) for name in names},
            most={name: float(table[name].max()) for name in names},
        )

    return {
        "order": everywhere("harm", "benefit"),
        "gain": everywhere("gain"),
        "some_only_frame": truth(bool((table.only_frame > 0.0).all()), rows=len(table)),
        **{f"one_{name}": one_number(table, name) for name in ("gain", "column", "frame")},
    }


def one_number(table: pd.DataFrame, name: str) -> Finding:
    """Return whether some number lies in the interval of every row."""
    low, high = float(table[f"{name}_low"].max()), float(table[f"{name}_high"].min())
    return truth(
        low <= high, least=float(table[name].min()), most=float(table[name].max()), rows=len(table)
    )


def work(job: Any) -> tuple:
    return main(job.params.settings, job.params.ensemble)


if __name__ == "__main__":
    run(snakemake, work)
