"""Fit models of the outcomes, each on the tests of the other records."""

import numpy as np
from simulate import CONFIG, FACTORS
from sklearn.feature_selection import SelectKBest
from sklearn.linear_model import LogisticRegression
from sklearn.metrics import log_loss
from sklearn.model_selection import LeaveOneGroupOut, cross_val_predict
from sklearn.pipeline import make_pipeline

CURVE = LogisticRegression(C=500)  # slopes stay finite where a measure separates all outcomes


def probabilities(overturned):
    """Return the share of a lognormal scatter of each motion's scale that overturns candidates."""
    scatters = np.array(CONFIG["candidates"]["scatter"])[:, None]
    bells = np.exp(-0.5 * (np.log(FACTORS) / scatters) ** 2)
    shares = np.einsum("tcf,sf->tcs", overturned, bells / bells.sum(axis=1, keepdims=True))
    return CONFIG["lapse"] / 2 + (1 - CONFIG["lapse"]) * shares.reshape(len(overturned), -1)


def logarithms(probability, fell):
    """Return the logarithm of the probability of what happened, shape (tests, candidates)."""
    return np.log(np.where(fell.to_numpy()[:, None], probability, 1 - probability))


def likeliest(probability, fell, records):
    """Return for each test the candidate that is likeliest on the tests of all other records."""
    logs = logarithms(probability, fell)
    best = {each: logs[records != each].sum(axis=0).argmax() for each in records.unique()}
    return records.map(best)


def likelihoods(measures, fell):
    """Return the likelihood of the logistic curve over each measure, up to a scale."""
    columns = measures.T[..., None]
    return np.array([-log_loss(fell, CURVE.fit(x, fell).predict_proba(x)) for x in columns])


def models(tests, fell, simulated):
    """Return the probability of each test by each model, without the tests of its record."""
    one, free = (probabilities(simulated[name]) for name in ("one", "free"))
    each, peaks = np.arange(len(tests)), np.log(tests[["peak", "velocity"]].to_numpy())
    best = make_pipeline(SelectKBest(likelihoods, k=1), CURVE)
    folds = {"groups": tests.record, "cv": LeaveOneGroupOut(), "method": "predict_proba"}
    return {
        "Eq. (23), slenderness fitted": one[each, likeliest(one, fell, tests.record)],
        "Eq. (23), four numbers fitted": free[each, likeliest(free, fell, tests.record)],
        "linear oscillator": cross_val_predict(best, simulated["oscillators"], fell, **folds)[:, 1],
        "PGV": cross_val_predict(CURVE, peaks[:, 1:], fell, **folds)[:, 1],
        "PGA and PGV": cross_val_predict(CURVE, peaks, fell, **folds)[:, 1],
    }
