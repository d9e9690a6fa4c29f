"""The theorem since a common rest: what is tried is what is stated."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from studies.certainty.steps import restarted
from topheavy import Column, Pulse, simulate


def cases(linearised, count=3):
    random = np.random.default_rng(3)
    found = []
    while len(found) < count:
        one = restarted.case_of(random, linearised)
        factor = restarted.factor_beside_a_boundary(one, random) if one else None
        if factor:
            found.append((one, factor))
    return found


@pytest.mark.parametrize("linearised", [True, False])
def test_lighter_frame_overturns_whenever_the_heavier_does(linearised):
    for one, factor in cases(linearised):
        assert one.rests()
        assert (np.abs(one.vertical) > 0.0).any()
        assert one.vertical.min() > -1.0
        assert one.overturns(one.pair[1], factor)
        assert one.overturns(one.pair[0], factor)


def test_heavier_frame_does_not_always_overturn_with_the_lighter():
    found = []
    for one, _ in cases(False, 6):
        turned = replace(one, pair=one.pair[::-1])
        factor = restarted.factor_beside_a_boundary(turned, np.random.default_rng(1))
        found.append(factor is None or turned.overturns(turned.pair[0], factor))
    assert not all(found)


ROWS = [
    {"linearised": linear, "covered": True, "contradicts": False, "by_scipy": True}
    for linear in (True, False)
]


@pytest.mark.parametrize(
    ("change", "holds"),
    [
        ({}, True),
        ({"contradicts": True, "by_scipy": False}, False),
        ({"by_scipy": False}, False),
        ({"by_scipy": None}, True),  # one of both was asked of SciPy
        ({"covered": False, "contradicts": True}, False),  # no exact motion is covered
        ({"linearised": True}, False),
    ],
)
def test_findings_of_motions_that_the_theorems_cover(change, holds):
    found = restarted.findings(pd.DataFrame([ROWS[0], ROWS[1] | change]))
    assert found["restarted"].holds is holds


def test_overturning_after_an_impact_since_the_rest_does_not_count():
    block, found = Column(0.5, 3.0).block(), []
    pulse = Pulse("one-sine", block.uplift_acceleration, 4.0 * block.frequency_parameter)
    step = pulse.duration / restarted.SAMPLES
    after = pulse.excitation(step * np.arange(restarted.SAMPLES))
    before = np.zeros(20)
    one = restarted.Case((block, block), before, after, np.zeros_like(after), step)
    for factor in np.linspace(1.2, 15.0, 70):
        response = simulate(block, one.records(factor)[0])
        if response.overturned:
            found.append(bool(response.impacts.size))
            assert one.overturns(block, factor) is not found[-1]
    assert set(found) == {True, False}
