import judge
import numpy as np
import pandas as pd
import pytest
from prepare import UNIT, prepared
from simulate import CONFIG, read

TESTS, _, _ = read(CONFIG["data"], **CONFIG["left_out"])
FELL, RECORDS = TESTS.block_1.to_numpy() == 1, TESTS.record.to_numpy()
SIMULATED = dict(np.load("results/simulated.npz"))  # run Snakemake before the tests


def test_the_outcomes_of_a_record_do_not_change_its_probabilities():
    own = RECORDS[0] == RECORDS
    few = SIMULATED | {"oscillators": SIMULATED["oscillators"][::10]}
    before, after = (judge.models(TESTS, fell, few, CONFIG) for fell in (FELL, FELL ^ own))
    for name, probability in before.items():
        assert (probability[own] == after[name][own]).all()
        assert (probability != after[name]).any()


def test_one_fold_by_loops():
    own, best, likeliest = RECORDS[-1] == RECORDS, -np.inf, None
    free = judge.probabilities(SIMULATED["free"], CONFIG["scatters"], CONFIG["lapse"])
    for candidate in free.T:
        product = 0.0
        for probability, fell, is_own in zip(candidate, FELL, own, strict=True):
            product += 0.0 if is_own else np.log(probability if fell else 1.0 - probability)
        if product > best:
            best, likeliest = product, candidate
    written = pd.read_csv("results/tests.csv").probability_1
    assert written[own].to_numpy() == pytest.approx(likeliest[own])


def test_the_source_is_filtered_and_thinned():
    time = np.arange(8000) / 800.0
    slow, fast = np.sin(2 * np.pi * 2.0 * time), np.sin(2 * np.pi * 90.0 * time)
    series = prepared(0.3 + 0.1 * slow + 0.2 * fast) * UNIT
    assert series[100:-100] == pytest.approx(0.1 * slow[::8][100:-100], abs=2e-3)
