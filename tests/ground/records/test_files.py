"""The library's reader on the table of odd and bad files."""

import re

import numpy as np
import pytest

from tests.ground.records.files import CSV, FILES, LARGEST, MOST, longest
from topheavy import read_record
from topheavy.ground.records import reading


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


def test_most_samples_are_read_and_one_more_is_refused(tmp_path, monkeypatch):
    path, other = tmp_path / "motion.AT2", tmp_path / "motion.csv"
    path.write_bytes(longest())
    record = read_record(path)
    assert record.acceleration.size == MOST
    assert (record.acceleration.reshape(-1, 2) == [0.3141592, -0.1414214]).all()
    assert reading.MOST_SAMPLES == MOST
    monkeypatch.setattr(reading, "MOST_SAMPLES", 4)
    other.write_text(CSV)
    says = r"motion\.csv: line 6 holds sample 5; expected at most 4 samples"
    with pytest.raises(ValueError, match=says):
        read_record(other)


def test_file_that_is_too_large_is_refused_before_it_is_read(tmp_path):
    path = tmp_path / "motion.AT2"
    with path.open("wb") as file:
        file.truncate(LARGEST + 1)  # without a block on the disk
    with pytest.raises(ValueError, match=r"motion\.AT2: the file has 100000001 bytes; expected at"):
        read_record(path)
