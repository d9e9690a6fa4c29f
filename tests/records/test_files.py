"""The library's reader on the table of odd and bad files."""

import re

import numpy as np
import pytest

from tests.records.files import FILES
from topheavy import read_record


@pytest.mark.parametrize("row", FILES, ids=lambda row: f"{row.ending[1:]}: {row.what}")
def test_file_is_read_or_refused_in_one_line_with_its_name_and_reason(tmp_path, row):
    path = tmp_path / f"motion{row.ending}"
    path.write_bytes(row.encoded)
    if isinstance(row.expected, str):
        says = rf"^{re.escape(str(path))}: .*{row.expected}"
        with pytest.raises(ValueError, match=says) as error:
            read_record(path)
        assert "\n" not in str(error.value)
        return
    step, samples = row.expected
    record = read_record(path)
    assert record.time_step == pytest.approx(step, rel=1e-13)
    np.testing.assert_allclose(record.acceleration, samples, rtol=1e-13)
    assert record.name == "motion"
