"""Each condition of what the comparison with a positive stiffness says, where it alone fails."""

import pandas as pd
import pytest

from steps.negative_stiffness import findings

ROW = {"free": 0.5, "restrained": 0.6, "error": 1e-3, "by_scipy": 0.6}
LESS, MORE = ROW, ROW | {"free": 0.7}
OUT = ROW | {"free": 2.0, "by_scipy": None}
UNTOLD = ROW | {"free": 0.7, "error": 0.2}


@pytest.mark.parametrize(
    ("rows", "holds", "holds_when"),
    [
        ([LESS], True, True),
        ([LESS, MORE], False, True),
        ([MORE], False, False),
        ([LESS, OUT], False, True),
        ([LESS, UNTOLD], True, True),
    ],
)
def test_negative_stiffness_is_beneficial_where_it_rotates_less(rows, holds, holds_when):
    found = findings(pd.DataFrame(rows))["negative_stiffness_and_gravity"]
    assert (found.holds, found.holds_when) == (holds, holds_when)


@pytest.mark.parametrize(("rows", "holds"), [([OUT, LESS], True), ([LESS, MORE], False)])
def test_positive_stiffness_is_counted_by_what_stays_within_alpha(rows, holds):
    found = findings(pd.DataFrame(rows))
    assert found["positive_stiffness_stays_within_more"].holds is holds


@pytest.mark.parametrize(("by_scipy", "holds"), [(0.605, True), (0.607, False), (0.593, False)])
def test_second_route_is_close_in_every_history(by_scipy, holds):
    rows = [LESS, LESS | {"by_scipy": by_scipy}]
    assert findings(pd.DataFrame(rows))["second_route"].holds is holds
