import judge
import numpy as np
import pytest
from prepare import UNIT, prepared
from simulate import CONFIG, read

TESTS, _ = read(CONFIG["data"], **CONFIG["left_out"])
FELL, RECORDS = TESTS.block_1 == 1, TESTS.record
SIMULATED = dict(np.load("results/simulated.npz"))  # run Snakemake before the tests
SIMULATED["oscillators"] = SIMULATED["oscillators"][:, ::10]


def test_the_outcomes_of_a_record_do_not_change_its_probabilities():
    own = RECORDS[0] == RECORDS
    before, after = (judge.models(TESTS, fell, SIMULATED) for fell in (FELL, FELL ^ own))
    for name, probability in before.items():
        assert probability[own] == pytest.approx(after[name][own], abs=0)
        assert (probability != after[name]).any()


def test_one_fold_by_loops():
    free, own, likelihoods = judge.probabilities(SIMULATED["free"]), RECORDS[0] == RECORDS, []
    for candidate in free.T:
        others = [each for each in zip(candidate, FELL, own, strict=True) if not each[2]]
        likelihoods.append(np.prod([p if fell else 1 - p for p, fell, _ in others]))
    chosen = judge.likeliest(free, FELL, RECORDS)[own]
    assert free[own, chosen] == pytest.approx(free[own, np.argmax(likelihoods)])


def test_the_source_is_filtered_and_thinned():
    time = np.arange(8000) / 800.0
    slow, fast = np.sin(2 * np.pi * 2.0 * time), np.sin(2 * np.pi * 90.0 * time)
    series = prepared(0.3 + 0.1 * slow + 0.2 * fast) * UNIT
    assert series[100:-100] == pytest.approx(0.1 * slow[::8][100:-100], abs=2e-3)
