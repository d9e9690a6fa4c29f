"""Compare the models by their outcomes and probabilities, with intervals over the records."""

import json
import sys
from itertools import product
from pathlib import Path

import numpy as np
import pandas as pd
from models import likeliest, logarithms, models, probabilities
from simulate import CONFIG, FACTORS, read

FIRST = "Eq. (23), four numbers fitted"
LISTS = CONFIG["candidates"]


def resampled(number):
    """Return how often each of a number of records is in each resample of them."""
    random = np.random.default_rng(CONFIG["seed"])
    return random.multinomial(number, np.full(number, 1 / number), CONFIG["resamples"])


def shown(values, resamples, digits="z.0f"):
    """Return values as text, each with the 95 % interval of its column of resamples."""
    ends = np.percentile(resamples, [2.5, 97.5], axis=0)
    rows = [[format(x, digits).replace("-", "−") for x in row] for row in (values, *ends)]
    return [f"{value} ({low} to {high})" for value, low, high in zip(*rows, strict=True)]


def over_records(values, records):
    """Return the means of the columns, with their intervals over the records."""
    sums, sizes = values.groupby(records).sum(), values.groupby(records).size()
    counts = resampled(len(sums))
    return shown(values.mean(), counts @ sums / (counts @ sizes)[:, None])


def fitted(free, fell, records):
    """Return the likeliest four numbers, with their intervals over the records."""
    logs = pd.DataFrame(logarithms(free, fell)).groupby(records).sum().to_numpy()
    numbers = np.array([*product(*LISTS.values())])
    chosen = numbers[(resampled(len(logs)) @ logs).argmax(axis=1)]
    return dict(zip(LISTS, shown(numbers[logs.sum(axis=0).argmax()], chosen, ".2g"), strict=True))


def threshold(peaks, fell):
    """Return the peak that as many tests exceed as overturned, and how many overturned below it."""
    order, survived = np.argsort(peaks, axis=None, kind="stable"), (~fell).sum()
    around = np.append(np.append(np.nan, peaks.flat[order]), np.nan)[survived : survived + 2]
    return np.sqrt(around.prod()), fell.flat[order[:survived]].sum()


def thresholds(tests, fell, overturned):
    """Return of each motion the measured threshold, its exceptions, and the computed threshold."""
    rows, peaks = [], tests.peak.to_numpy()
    for place in tests.groupby("motion").indices.values():
        computed, _ = threshold(peaks[place, None] * FACTORS, overturned[place])
        rows.append((*threshold(peaks[place], fell[place]), computed))
    return pd.DataFrame(rows, columns=["measured", "exceptions", "computed"])


def judge(tests, block, simulated):
    """Return the numbers of a block, and add the probabilities by the first model to the tests."""
    fell, records = tests[f"block_{block}"] == 1, tests.record
    table = pd.DataFrame(models(tests, fell, simulated))
    table["discrete elements, chosen in sample"] = tests[f"discrete_elements_{block}"]
    table["none overturns"] = 0
    right = 100.0 * (table > 0.5).eq(fell, axis=0)
    unclear = (table["PGV"] - 0.5).abs() <= 0.4
    columns = (
        over_records(right, records),
        over_records(right.rsub(right[FIRST], axis=0), records),
        right[unclear].mean().map("{:.0f}".format),
        table.sub(fell * 1.0, axis=0).pow(2).mean().map("{:.2f}".format),
    )
    tests[f"probability_{block}"], free = table[FIRST], probabilities(simulated["free"])
    candidate = likeliest(free, fell, records) // len(LISTS["scatter"])
    overturned = simulated["free"][np.arange(len(tests)), candidate]
    peaks = thresholds(tests, fell.to_numpy(), overturned)
    ratio = np.log(peaks.computed / peaks.measured).dropna()
    bins = pd.DataFrame({"p": table[FIRST], "fell": fell})
    of_scan = simulated["one"][:, -len(CONFIG["scan"]["slenderness"]) :, len(FACTORS) // 2]
    scan = 100 * (of_scan == fell.to_numpy()[:, None]).mean(axis=0)
    return {
        "overturned": fell.sum(),
        "models": dict(zip(table, zip(*columns, strict=True), strict=True)),
        "fitted": fitted(free, fell, records),
        "calibration": bins.groupby(np.digitize(bins.p, [0.1, 0.5, 0.9])).mean().to_numpy(),
        "scan": f"{min(scan):.0f} to {max(scan):.0f}",
        "unclear": unclear.sum(),
        "exceptions": peaks.exceptions.sum(),
        "thresholds": peaks[["measured", "computed"]].dropna().to_numpy(),
        "ratio": [f"{np.exp(ratio.median()):.2f}", f"{ratio.std():.2f}"],
    }


def alone(tests, a, b):
    """Return of the tests that overturned block a alone: number, expected and computed number."""
    p, q = tests[f"probability_{a}"], tests[f"probability_{b}"]
    seen = tests[f"block_{a}"] > tests[f"block_{b}"]
    return [seen.sum(), f"{(p * (1 - q)).sum():.0f}", (seen & (p > 0.5) & (q < 0.5)).sum()]


if __name__ == "__main__":
    tests, out = read(sys.argv[1], **CONFIG["left_out"])
    counts = len(tests), tests.record.nunique(), len(out), out.block_1.sum(), out.block_2.sum()
    blocks = [judge(tests, block, np.load("results/simulated.npz")) for block in (1, 2)]
    numbers = {"tests": counts, "blocks": blocks}
    august = tests.date >= CONFIG["august"]
    for name, campaign in (("both", tests), ("june", tests[~august]), ("august", tests[august])):
        numbers[name] = alone(campaign, 1, 2), alone(campaign, 2, 1)
    Path("results/numbers.json").write_text(json.dumps(numbers, default=lambda x: x.tolist()))
