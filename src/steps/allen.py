"""The model of Allen et al. (1986), linearised and with massless columns."""

import math

import numpy as np
import pandas as pd

from replication.step import check, grid, run, value
from steps.shared.linear import simulate_linear_exact
from topheavy import Column, Pulse, RockingFrame, judge, read_record, simulate
from topheavy.bodies.massless_columns import SIMPLIFICATIONS, simplified
from topheavy.second import reference

AGREE = 1e-6  # of α, between solvers


def column_of(degrees):
    alpha = math.radians(degrees)
    return Column(math.sin(alpha), math.cos(alpha))


def models_of(frame):
    return {"exact": frame.block()} | {name: simplified(frame, name) for name in SIMPLIFICATIONS}


def histories(frame, settings, record, tightened):
    """Return the rotation of the exact frame and of the whole model, under a pulse and a record."""
    shape, amplitude, period = settings["pulse"].values()
    motions = {
        "pulse": (Pulse(shape, amplitude, 2 * math.pi / period), 6.0 * period),
        "record": (read_record(record).scaled(settings["factor"]), 30.0),
    }
    courses = []
    for motion, (excitation, duration) in motions.items():
        times = np.linspace(0.0, duration, 1501)
        course = {"motion": motion, "time": times, "acceleration": excitation.excitation(times)}
        for model in ("exact", "all"):
            block = models_of(frame)[model]
            response = simulate(block, excitation, samples=times)
            others = [
                simulate(block, excitation, samples=times, tolerance=tightened),
                reference.simulate(block, excitation, samples=times),
            ]
            if model == "all":
                others.append(simulate_linear_exact(block, excitation, samples=times))
            for other in others:
                apart = np.abs(other.rotation - response.rotation).max() / frame.slenderness
                check(apart < AGREE, f"{motion}, {model}: two solvers are {apart:.1g} α apart")
            course[model] = response.rotation / frame.slenderness
        courses.append(pd.DataFrame(course))
    return pd.concat(courses)


def errors(settings):
    """Return the relative error of the peak by γ and model, over slendernesses and amplitudes."""
    cells = []
    for degrees in settings["slendernesses"]:
        column = column_of(degrees)
        omega = settings["frequency_ratio"] * column.frequency_parameter
        for gamma in settings["mass_ratios"]:
            models = models_of(RockingFrame(column, gamma))
            for ratio in grid(settings["amplitudes"]):
                pulse = Pulse(settings["shape"], ratio * column.uplift_acceleration, omega)
                endings = {name: judge(block, pulse) for name, block in models.items()}
                exact = endings.pop("exact")
                cells += [
                    (gamma, name, other.peak / exact.peak - 1.0) for name, other in endings.items()
                ]
    table = pd.DataFrame(cells, columns=["mass_ratio", "model", "error"])
    return [
        {
            "mass_ratio": gamma,
            "model": model,
            "median_error": some.error.abs().median(),  # NaN where one overturns
        }
        for (gamma, model), some in table.groupby(["mass_ratio", "model"])
    ]


def outcomes(settings):
    """Return which pulses overturn the exact frame, the linearised one and the whole model."""
    frame = RockingFrame(column_of(settings["slenderness"]), settings["mass_ratio"])
    models = {
        name: block for name, block in models_of(frame).items() if not name.startswith("massless")
    }
    level, p = frame.uplift_acceleration, frame.column.frequency_parameter
    rows = []
    for omega in grid(settings["frequency_ratios"]):
        for amplitude in grid(settings["amplitudes"]):
            pulse = Pulse(settings["shape"], amplitude * level, omega * p)
            fell = {name: int(judge(block, pulse).overturned) for name, block in models.items()}
            rows.append({"frequency_ratio": omega, "amplitude_over_uplift": amplitude} | fell)
    return rows


def compute(settings, structures, record, solver):
    frame = RockingFrame(Column(**structures["temple"]), settings["mass_ratio"])
    return {
        "allen_histories": histories(frame, settings, record, solver["tightened"]),
        "allen_errors": errors(settings["errors"]),
        "allen_maps": outcomes(settings["maps"]),
    }


def findings(allen_errors, allen_maps):
    """Return the median error of the peak by γ, and the shares of wrong outcomes."""
    results = {
        f"error_{row.model}_{row.mass_ratio:g}": value(row.median_error, AGREE)
        for row in allen_errors.itertuples()
        if not row.model.startswith("massless")
    }
    exact = allen_maps.exact
    for model in ("linearised", "all"):
        falls = allen_maps[model]
        results[f"falsely_safe_{model}"] = value(((exact == 1) & (falls == 0)).mean(), 0.0)
        results[f"falsely_overturned_{model}"] = value(((exact == 0) & (falls == 1)).mean(), 0.0)
    return results


if __name__ == "__main__":
    run(snakemake, compute, findings)
