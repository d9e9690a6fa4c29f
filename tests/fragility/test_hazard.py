"""Rates of overturning where the answer is known: one motion, one curve, one hazard."""

import math
import re

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import ndtr

from topheavy.fragility.hazard import lognormal_rate, rate_at_levels

LEVELS = np.geomspace(0.1, 10.0, 201)
EXPONENTS = pytest.mark.parametrize("exponent", [1.5, 2.0, 3.0])
ENDS = pytest.mark.parametrize("ends", [(0.0, math.inf), (0.5, 3.0), (0.0, 2.0)])


@EXPONENTS
def test_rate_of_a_motion_is_the_hazard_between_its_boundaries(exponent):
    """It overturns from 0.5 to 0.8 and from 2 on, each to half a level."""
    fell = ((LEVELS > 0.5) & (LEVELS < 0.8)) | (LEVELS > 2.0)
    exact = 0.5**-exponent - 0.8**-exponent + 2.0**-exponent
    error = exponent * math.log(LEVELS[1] / LEVELS[0]) / 2.0 * 2.0 * 0.5**-exponent
    assert fell @ rate_at_levels(LEVELS, exponent) == pytest.approx(exact, abs=error)
    cut = fell @ rate_at_levels(LEVELS, exponent, (0.6, 3.0))
    exact = 0.6**-exponent - 0.8**-exponent + 2.0**-exponent - 3.0**-exponent
    assert cut == pytest.approx(exact, abs=error)


@EXPONENTS
def test_structure_that_always_overturns_does_so_as_often_as_there_are_motions(exponent):
    assert rate_at_levels(LEVELS, exponent).sum() == pytest.approx(0.1**-exponent)
    within = rate_at_levels(LEVELS, exponent, (0.2, 5.0)).sum()
    assert within == pytest.approx(0.2**-exponent - 5.0**-exponent)


@EXPONENTS
@ENDS
def test_lognormal_rate_is_the_integral_over_its_curve(exponent, ends):
    median, dispersion = 0.9, 0.4
    found, _ = quad(
        lambda x: ndtr((x - math.log(median)) / dispersion) * exponent * math.exp(-exponent * x),
        math.log(max(ends[0], 1e-3)),
        math.log(min(ends[1], 1e8)),
        epsabs=1e-13,
        epsrel=1e-11,
        limit=400,
        points=[math.log(0.3), math.log(median)] if ends[1] == math.inf else None,
    )
    assert lognormal_rate(median, dispersion, exponent, ends) == pytest.approx(found, rel=1e-8)


def test_lognormal_rate_of_all_intensities_is_that_of_the_formula():
    median, dispersion = np.array([0.5, 2.0]), np.array([0.3, 0.5])
    expected = median**-2.0 * np.exp(2.0 * dispersion**2)
    assert lognormal_rate(median, dispersion, 2.0) == pytest.approx(expected, rel=1e-12)


@EXPONENTS
@ENDS
def test_both_rates_agree_for_a_lognormal_curve(exponent, ends):
    shares = ndtr(np.log(LEVELS / 0.9) / 0.4)
    found = shares @ rate_at_levels(LEVELS, exponent, ends)
    assert found == pytest.approx(lognormal_rate(0.9, 0.4, exponent, ends), rel=2e-3)


@pytest.mark.parametrize("rate", [rate_at_levels, lambda *given: lognormal_rate(1.0, 0.4, *given)])
def test_bad_hazard_is_refused(rate):
    before = (LEVELS,) if rate is rate_at_levels else ()
    with pytest.raises(ValueError, match="exponent is 0; expected more than zero"):
        rate(*before, 0.0)
    with pytest.raises(ValueError, match=re.escape("ends are 2 and 1; expected ascending")):
        rate(*before, 2.0, (2.0, 1.0))
