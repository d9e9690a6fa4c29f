"""Rates of overturning where the answer is known: one motion, one curve, one hazard."""

import math
import re

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import ndtr

from topheavy.risk.hazard import rate_at_levels

LEVELS = np.geomspace(0.1, 10.0, 201)
EXPONENTS = pytest.mark.parametrize("exponent", [1.5, 2.0, 3.0])


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
@pytest.mark.parametrize("ends", [(0.0, math.inf), (0.5, 3.0), (0.0, 2.0)])
def test_rate_of_a_lognormal_curve_is_the_integral_over_it(exponent, ends):
    exact, _ = quad(
        lambda x: ndtr((x - math.log(0.9)) / 0.4) * exponent * math.exp(-exponent * x),
        math.log(max(ends[0], 1e-3)),
        math.log(min(ends[1], 1e8)),
        limit=400,
        points=[math.log(0.3), math.log(0.9)] if ends[1] == math.inf else None,
    )
    shares = ndtr(np.log(LEVELS / 0.9) / 0.4)
    assert shares @ rate_at_levels(LEVELS, exponent, ends) == pytest.approx(exact, rel=2e-3)


def test_bad_hazard_is_refused():
    with pytest.raises(ValueError, match="exponent is 0; expected more than zero"):
        rate_at_levels(LEVELS, 0.0)
    with pytest.raises(ValueError, match=re.escape("ends are 2 and 1; expected ascending")):
        rate_at_levels(LEVELS, 2.0, (2.0, 1.0))
