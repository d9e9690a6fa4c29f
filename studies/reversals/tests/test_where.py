"""The outlines of the regions on the map of reversals."""

import numpy as np
import pandas as pd
import pytest

from studies.reversals.figures.where import WINDOW, outlines


def area(corners):
    (x, y), (right, up) = corners[:-1].T, corners[1:].T
    return abs(np.sum(x * up - right * y)) / 2


def test_areas_are_those_of_the_intervals_joined_over_frequency():
    rows = [(omega, 1.0 + omega, np.nan, "without impact") for omega in (1.0, 2.0, 3.0)]
    rows += [(omega, 1.0, 1.0 + omega / 2, "with impact") for omega in (1.0, 2.0, 3.0)]
    rows += [(2.0, 2.5, 2.6, "with impact")]  # narrower, drawn as a bar
    cells = pd.DataFrame(rows, columns=["frequency_ratio", "lower", "upper", "mode"])
    at_once = 2.0 * (WINDOW[3] - 3.0)
    assert [area(one) for one in outlines(cells)] == pytest.approx([at_once, 2.0, 0.1])
