"""Each figure shows what the published table says."""

import pandas as pd
import pytest

from documents import shown


@pytest.mark.parametrize("name", shown.names())
def test_figure_shows_what_is_published(name):
    expected = pd.read_csv(shown.TABLE).query("figure == @name").reset_index(drop=True)
    table = shown.table(name, shown.drawn(name))
    pd.testing.assert_frame_equal(table, expected, rtol=1e-5, atol=1e-6, check_dtype=False)
