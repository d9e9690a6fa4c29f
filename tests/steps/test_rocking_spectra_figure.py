"""The figure of real records has room for any number of them."""

import pandas as pd
import pytest

from figures.rocking_spectra import draw

SIZES = [0.5, 1.0, 2.0]


def table(records):
    rows = [
        {
            "record": f"record_{number}",
            "mass_ratio": ratio,
            "size": size,
            "peak_over_alpha": 0.5,
            "overturned": size < 1.0,
            "decided": True,
        }
        for number in range(records)
        for ratio in (0.0, 1.0)
        for size in SIZES
    ]
    return pd.DataFrame(rows)


@pytest.mark.parametrize("records", [1, 5, 6, 8])
def test_key_has_a_place_of_its_own(records):
    *panels, key = draw(rocking_spectra=table(records)).axes
    titles = [axis.get_title() for axis in panels]
    assert len([title for title in titles if title]) == records
    assert key.get_title() == ""
    assert [text.get_text() for text in key.texts]
