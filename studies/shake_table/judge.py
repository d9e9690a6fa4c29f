"""Fit models of the outcomes, each on the tests of the other records, and compare them."""

import json
import sys
from itertools import product
from pathlib import Path

import numpy as np
import pandas as pd
from scipy.optimize import minimize
from scipy.special import log_expit
from simulate import CONFIG, FACTORS, candidates, read

NAMES = ("slenderness", "frequency_parameter", "restitution", "scatter")


def probabilities(overturned, scatters, lapse):
    """Return the probability of overturning, shape (tests, candidates times scatters).

    It is the share of a lognormal scatter of the motion's scale that overturns the block.
    """
    bells = np.exp(-0.5 * (np.log(FACTORS) / np.array(scatters)[:, None]) ** 2)
    shares = np.einsum("tcf,sf->tcs", overturned, bells / bells.sum(axis=1, keepdims=True))
    return lapse / 2 + (1 - lapse) * shares.reshape(len(overturned), -1)


def scores(probability, fell):
    """Return the logarithm of the probability of what happened, shape (tests, candidates)."""
    return np.log(np.where(fell[:, None], probability, 1 - probability))


def likeliest(probability, fell):
    """Return the model that takes the candidate which is likeliest on the other records."""
    logs = scores(probability, fell)
    return lambda train, test: probability[test, logs[train].sum(axis=0).argmax()]


def by_measures(measures, fell):
    """Return the logistic model of the likeliest of several measures, shape (tests, m)."""
    terms = [(x - x.mean(axis=0)) / x.std(axis=0) for x in measures]
    terms = [np.insert(x, 0, 1, axis=1) for x in terms]

    def fit(x, fell):  # the last term keeps slopes finite where a measure separates all outcomes
        signed = np.where(fell[:, None], x, -x)
        return minimize(lambda b: 1e-3 * b @ b - log_expit(signed @ b).sum(), np.zeros(x.shape[1]))

    def model(train, test):
        fits = [fit(x[train], fell[train]) for x in terms]
        best = np.argmin([each.fun for each in fits])
        return np.exp(log_expit(terms[best][test] @ fits[best].x))

    return model


def unseen(records, model):
    """Return the probability of each test by the model of the tests of all other records."""
    probability = np.full(len(records), np.nan)
    for record in np.unique(records):
        test = records == record
        probability[test] = model(~test, test)
    return probability


def models(tests, fell, simulated, config):
    """Return the probability of each test by each model, without the tests of its record."""
    settings = config["scatters"], config["lapse"]
    one, free = (probabilities(simulated[name], *settings) for name in ("one", "free"))
    measures = np.log(tests[["peak", "velocity"]].to_numpy())
    fitted = {
        "Eq. (23), slenderness fitted": likeliest(one, fell),
        "Eq. (23), four numbers fitted": likeliest(free, fell),
        "linear oscillator": by_measures(simulated["oscillators"][:, :, None], fell),
        "PGV": by_measures([measures[:, 1:]], fell),
        "PGA and PGV": by_measures([measures], fell),
    }
    return {name: unseen(tests.record, model) for name, model in fitted.items()}


def threshold(peaks, fell):
    """Return the peak that separates the outcomes best (NaN at an end), and the exceptions."""
    order = np.argsort(peaks, kind="stable")
    below = np.append(0, np.cumsum(fell[order]))
    wrong = below + (~fell).sum() - (np.arange(len(peaks) + 1) - below)
    k = wrong.argmin()
    inside = 0 < k < len(peaks)
    return np.sqrt(np.prod(peaks[order[k - 1 : k + 1]])) if inside else np.nan, wrong[k]


def thresholds(tests, fell, overturned):
    """Return the peaks at which measured and computed outcomes change, and the exceptions."""
    rows = []
    for motion, place in tests.groupby("motion").indices.items():
        peaks = tests.peak.to_numpy()[place]
        computed, _ = threshold((peaks[:, None] * FACTORS).ravel(), overturned[place].ravel())
        rows.append((motion, *threshold(peaks, fell[place]), computed))
    return pd.DataFrame(rows, columns=["motion", "measured", "exceptions", "computed"])


def shown(value, resamples, digits="z.0f"):
    """Return a value and the 95 % interval of its resamples as text."""
    three = value, *np.percentile(resamples, [2.5, 97.5])
    return "{} ({} to {})".format(*(format(x, digits).replace("-", "−") for x in three))


def judge(tests, block, simulated, config):
    """Return the numbers of a block, its thresholds, and the probabilities of its tests."""
    fell, elements = tests[[f"block_{block}", f"discrete_elements_{block}"]].to_numpy().T == 1
    records, place = np.unique(tests.record, return_inverse=True)
    random, even = np.random.default_rng(config["seed"]), np.full(len(records), 1 / len(records))
    counts = random.multinomial(len(records), even, config["resamples"])
    probability = models(tests, fell, simulated, config)
    first, velocity = probability["Eq. (23), four numbers fitted"], probability["PGV"]
    probability["discrete elements, chosen in sample"] = elements * 1.0
    probability["none overturns"] = 0.0 * first
    unclear = np.abs(velocity - 0.5) <= 0.4

    def over_records(values):
        means = counts @ np.bincount(place, values) / (counts @ np.bincount(place))
        return shown(values.mean(), means)

    rows, first_right = {}, 100 * ((first > 0.5) == fell)
    for name, p in probability.items():
        right = 100 * ((p > 0.5) == fell)
        few = f"{right[unclear].mean():.0f}", f"{np.mean((p - fell) ** 2):.2f}"
        rows[name] = over_records(right), over_records(first_right - right), *few

    logs = scores(probabilities(simulated["free"], config["scatters"], config["lapse"]), fell)
    logs = np.array([logs[place == k].sum(axis=0) for k in range(len(records))])
    numbers = product(candidates(**config)["free"], config["scatters"])
    numbers = np.array([(*number, scatter) for number, scatter in numbers])
    best, chosen = numbers[logs.sum(axis=0).argmax()], numbers[(counts @ logs).argmax(axis=1)]
    fold = (logs.sum(axis=0) - logs).argmax(axis=1)[place] // len(config["scatters"])
    peaks = thresholds(tests, fell, simulated["free"][np.arange(len(tests)), fold])
    ratio = np.log(peaks.computed / peaks.measured).dropna()
    bins = pd.DataFrame({"p": first, "fell": fell}).groupby(np.digitize(first, [0.1, 0.5, 0.9]))
    scan = (simulated["scan"][:, :, len(FACTORS) // 2] == fell[:, None]).mean(axis=0)
    numbers = {
        "overturned": fell.sum(),
        "models": rows,
        "fitted": {n: shown(*x, ".2g") for n, *x in zip(NAMES, best, chosen.T, strict=True)},
        "calibration": bins.mean().to_numpy(),
        "scan": f"{100 * min(scan):.0f} to {100 * max(scan):.0f}",
        "unclear": unclear.sum(),
        "exceptions": peaks.exceptions.sum(),
        "thresholds": len(ratio),
        "ratio": [f"{np.exp(ratio.median()):.2f}", f"{ratio.std():.2f}"],
    }
    return numbers, peaks.assign(block=block), first


def alone(tests, a, b, campaign):
    """Return of the tests that overturned block a alone: number, expected and foretold number."""
    p, q = tests[f"probability_{a}"], tests[f"probability_{b}"]
    seen = (tests[f"block_{a}"] > tests[f"block_{b}"]) & campaign
    expected = f"{(p * (1 - q))[campaign].sum():.0f}"
    return [seen.sum(), expected, (seen & (p > 0.5) & (q < 0.5)).sum()]


if __name__ == "__main__":
    tests, _, out = read(sys.argv[1], **CONFIG["left_out"])
    blocks = [judge(tests, k, np.load("results/simulated.npz"), CONFIG) for k in (1, 2)]
    tests["probability_1"], tests["probability_2"] = (first for _, _, first in blocks)
    august = tests.date >= CONFIG["august"]
    counts = len(tests), tests.record.nunique(), len(out), out.block_1.sum(), out.block_2.sum()
    numbers = {"tests": counts, "blocks": [each for each, _, _ in blocks]}
    for name, campaign in (("june", ~august), ("august", august)):
        numbers[name] = [alone(tests, a, b, campaign) for a, b in ((1, 2), (2, 1))]
    tests.to_csv("results/tests.csv", index=False)
    pd.concat(peaks for _, peaks, _ in blocks).to_csv("results/thresholds.csv", index=False)
    text = json.dumps(numbers, indent=1, default=lambda each: each.tolist())
    Path("results/numbers.json").write_text(text)
