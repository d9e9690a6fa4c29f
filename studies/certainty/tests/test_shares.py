"""Shares in a probability: their sum, and the finding where one is too small."""

import numpy as np
import pandas as pd
import pytest

from steps.shared import sweep
from studies.certainty.steps import shares
from studies.certainty.subjects import exchanges
from studies.certainty.tests.test_rates import ENSEMBLE
from topheavy.ground.synthetic.ensemble import first_draws

CASE = {"seed": 1, "resamples": 200, "confidence": 0.95}


def values(alpha, root_r):
    labels = {"family": "near-fault", "mass_ratio": 1.0, "pgv": 0.6}
    pairs = zip(alpha, root_r, strict=True)
    return pd.DataFrame([labels | {"α": a, "p": 0.0, "√r": r} for a, r in pairs])


@pytest.mark.parametrize(
    ("alpha", "root_r", "holds"),
    [
        ([1.0] * 60 + [0.0] * 20, [0.0] * 60 + [1.0] * 20, True),
        ([1.0] * 42 + [0.0] * 38, [0.0] * 42 + [1.0] * 38, False),  # its interval includes one half
        ([1.0] * 20 + [0.0] * 60, [0.0] * 20 + [1.0] * 60, False),
    ],
)
def test_slenderness_has_most_if_its_interval_is_above_one_half(alpha, root_r, holds):
    table = shares.shares(values(alpha, root_r), CASE)
    assert shares.findings(table)["slenderness_has_most"].holds is holds


def test_worth_of_a_block_is_that_it_survives():
    """All that have α of the fixed mass overturn, and no others: α has all."""
    case = CASE | {"column": {"half_width": 0.5, "half_height": 3.0}, "motions": 1}
    case |= {"mass_ratios": [1.0, 4.0], "pgv": [0.4, 0.6]}
    fixed = ["α" not in one.labels["free"] for one in exchanges(case).subjects]
    draws = first_draws(ENSEMBLE, 1)
    outcomes = np.broadcast_to(np.array(fixed)[:, None], (len(draws), len(fixed), 2))
    found = shares.values_of(case, sweep.Swept(draws, np.ones(len(draws)), outcomes))
    assert len(found) == len(draws) * 2 * 2
    assert found.α.to_numpy() == pytest.approx(1.0)
    assert not found[["p", "√r"]].any(axis=None)
