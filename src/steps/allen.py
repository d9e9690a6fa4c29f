"""The model of Allen et al. (1986), linearised and with massless columns."""

from itertools import product

import numpy as np
import pandas as pd

from replication.step import grid, run, value
from steps.shared import plain
from steps.shared.cases import column_of, pulse_on
from steps.shared.linear import simulate_linear_exact
from steps.shared.samples import check_histories
from topheavy import Column, Pulse, RockingFrame, judge, read_record, simulate
from topheavy.bodies.structures import simplified

AGREE = 1e-6  # difference of rotations between solvers, times α


def histories(frame, settings, record, tightened):
    """Return the rotation of the exact frame and of the whole model, under a pulse and a record."""
    shape, amplitude, period = settings["pulse"].values()
    motions = {
        "pulse": (Pulse(shape, amplitude, period=period), 6.0 * period),
        "record": (read_record(record).scaled(settings["factor"]), 30.0),
    }
    courses = []
    for motion, (excitation, duration) in motions.items():
        times = np.linspace(0.0, duration, 1501)
        course = {"motion": motion, "time": times, "acceleration": excitation.excitation(times)}
        for model in ("exact", "all"):
            block = simplified(frame)[model]
            response = simulate(block, excitation, samples=times)
            repeated = [
                simulate(block, excitation, samples=times, tolerance=tightened),
                plain.simulate(block, excitation, samples=times),
            ]
            if model == "all":
                repeated.append(simulate_linear_exact(block, excitation, samples=times))
            check_histories(response, repeated, AGREE, f"{motion}, {model}")
            course[model] = response.rotation / frame.slenderness
        courses.append(pd.DataFrame(course))
    return pd.concat(courses)


def errors(settings):
    """Return the errors of the peak, and the wrong outcomes, by pulse, γ and model.

    The peaks are compared under the amplitudes and slendernesses at which neither the exact frame
    nor the model overturns. Each simplification alone is compared under the first pulse.
    """
    rows, first = [], settings["pulses"][0]
    for pulse, gamma in product(settings["pulses"], settings["mass_ratios"]):
        cells = []
        for degrees in settings["slendernesses"]:
            column = column_of(degrees)
            models = simplified(RockingFrame(column, gamma))
            shown = models if pulse == first else {name: models[name] for name in ("exact", "all")}
            for ratio in grid(settings["amplitudes"]):
                motion = pulse_on(column, **pulse, amplitude=ratio)
                outcomes = {name: judge(block, motion) for name, block in shown.items()}
                exact = outcomes.pop("exact")
                for name, outcome in outcomes.items():
                    error = outcome.peak_rotation / exact.peak_rotation - 1.0
                    cells.append((name, exact.overturned, outcome.overturned, error))
        table = pd.DataFrame(cells, columns=["model", "exact", "falls", "error"])
        for model, part in table.groupby("model"):
            survive = part[~part.exact & ~part.falls]
            rows.append(
                {"shape": pulse["shape"], "frequency_ratio": pulse["frequency_ratio"]}
                | {"mass_ratio": gamma, "model": model, "pulses": len(part)}
                | {"compared": len(survive), "wrong": int((part.exact != part.falls).sum())}
                | {"too_small": int((survive.error < 0.0).sum())}
                | {"median_error": survive.error.abs().median()}
            )
    return rows


def outcomes(settings):
    """Return which pulses overturn the exact frame, the linearised one and the whole model."""
    column = column_of(settings["slenderness"])
    frame = RockingFrame(column, settings["mass_ratio"])
    models = {
        name: block for name, block in simplified(frame).items() if not name.startswith("massless")
    }
    rows = []
    for ratio, amplitude in product(
        grid(settings["frequency_ratios"]), grid(settings["amplitudes"])
    ):
        pulse = pulse_on(column, settings["shape"], ratio, amplitude)
        fell = {name: int(judge(block, pulse).overturned) for name, block in models.items()}
        rows.append({"frequency_ratio": ratio, "amplitude_over_uplift": amplitude} | fell)
    return rows


def compute(settings, structures, record, solver):
    frame = RockingFrame(Column(**structures["temple"]), settings["mass_ratio"])
    return {
        "allen_histories": histories(frame, settings, record, solver["tightened"]),
        "allen_errors": errors(settings["errors"]),
        "allen_maps": outcomes(settings["maps"]),
    }


def findings(allen_errors, allen_maps):
    """Return the median error of the peak by γ, and the shares of wrong outcomes.

    The errors are those under the first pulse. `least` and `most` are their range over all pulses.
    """
    results = {}
    quoted = allen_errors[~allen_errors.model.str.startswith("massless")]
    for (gamma, model), pulses in quoted.groupby(["mass_ratio", "model"], sort=False):
        first = pulses.iloc[0]
        results[f"error_{model}_{gamma:g}"] = value(
            first.median_error,
            AGREE,
            least=pulses.median_error.min(),
            most=pulses.median_error.max(),
            **first[["pulses", "compared", "too_small", "wrong"]],
        )
    exact = allen_maps.exact
    for model in ("linearised", "all"):
        falls = allen_maps[model]
        results[f"falsely_safe_{model}"] = value(((exact == 1) & (falls == 0)).mean(), 0.0)
        results[f"falsely_overturned_{model}"] = value(((exact == 0) & (falls == 1)).mean(), 0.0)
    return results


if __name__ == "__main__":
    run(snakemake, compute, findings)
