"""The model of Allen et al. (1986), linearised and with massless columns."""

from itertools import product

import numpy as np
import pandas as pd

from replication.step import check, grid, run, value
from steps.shared import plain
from steps.shared.cases import column_of, pulse_on
from steps.shared.linear import simulate_linear_exact
from topheavy import Column, Pulse, RockingFrame, judge, read_record, simulate
from topheavy.bodies.structures import simplified

AGREE = 1e-6  # of α, between solvers


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
            # Beyond 2α differences grow; the outcomes are compared, too.
            upright = np.abs(response.rotation) <= 2.0 * frame.slenderness
            others = [
                simulate(block, excitation, samples=times, tolerance=tightened),
                plain.simulate(block, excitation, samples=times),
            ]
            if model == "all":
                others.append(simulate_linear_exact(block, excitation, samples=times))
            for other in others:
                apart = np.abs(other.rotation - response.rotation)[upright].max()
                apart /= frame.slenderness
                check(
                    apart < AGREE and other.outcome == response.outcome,
                    f"{motion}, {model}: two solvers are {apart:.1g} α apart, or differ in outcome",
                )
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
                endings = {name: judge(block, motion) for name, block in shown.items()}
                exact = endings.pop("exact")
                cells += [
                    (
                        name,
                        exact.overturned,
                        other.overturned,
                        other.peak_rotation / exact.peak_rotation - 1.0,
                    )
                    for name, other in endings.items()
                ]
        table = pd.DataFrame(cells, columns=["model", "exact", "falls", "error"])
        for model, some in table.groupby("model"):
            survive = some[~some.exact & ~some.falls]
            rows.append(
                {"shape": pulse["shape"], "frequency_ratio": pulse["frequency_ratio"]}
                | {"mass_ratio": gamma, "model": model, "pulses": len(some)}
                | {"compared": len(survive), "wrong": int((some.exact != some.falls).sum())}
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
    results, at = {}, ["shape", "frequency_ratio"]
    first = (allen_errors[at] == allen_errors[at].iloc[0]).all(axis=1)
    for row in allen_errors[first].itertuples():
        if not row.model.startswith("massless"):
            same = allen_errors[
                (allen_errors.mass_ratio == row.mass_ratio) & (allen_errors.model == row.model)
            ]
            results[f"error_{row.model}_{row.mass_ratio:g}"] = value(
                row.median_error,
                AGREE,
                least=same.median_error.min(),
                most=same.median_error.max(),
                pulses=row.pulses,
                compared=row.compared,
                too_small=row.too_small,
                wrong=row.wrong,
            )
    exact = allen_maps.exact
    for model in ("linearised", "all"):
        falls = allen_maps[model]
        results[f"falsely_safe_{model}"] = value(((exact == 1) & (falls == 0)).mean(), 0.0)
        results[f"falsely_overturned_{model}"] = value(((exact == 0) & (falls == 1)).mean(), 0.0)
    return results


if __name__ == "__main__":
    run(snakemake, compute, findings)
