"""Each condition of the reach of the theorems, in a case in which it alone fails."""

import pandas as pd
import pytest

from studies.certainty.steps import reach

PULSES = {"kind": "pulses", "mass_ratio": 1.0, "overturned": 9, "without_impact": 4}
RECORDS = {"kind": "records", "mass_ratio": 1.0, "overturned": 9, "without_impact": 0}


@pytest.mark.parametrize(
    ("pulses", "records", "holds"),
    [
        ({}, {}, True),
        ({}, {"without_impact": 1}, False),
        ({}, {"overturned": 0}, False),  # nothing was overturned
        ({"without_impact": 0}, {}, False),
    ],
)
def test_no_overturning_in_earthquakes_is_without_an_impact(pulses, records, holds):
    rows = [PULSES | pulses, RECORDS | records]
    found = reach.findings(pd.DataFrame(rows).assign(asked=1, differ=0))
    assert found["none_in_earthquakes"].holds is holds


@pytest.mark.parametrize(("asked", "differ", "holds"), [(3, 0, True), (3, 1, False), (0, 0, False)])
def test_scipy_has_to_agree_in_the_whole_sample(asked, differ, holds):
    found = reach.findings(pd.DataFrame([PULSES, RECORDS]).assign(asked=asked, differ=differ))
    assert found["reach_by_scipy"].holds is holds
