"""Two-column CSV: units, regular steps within the rounding of print; `files.py` has bad files."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.ground.records.files import CSV, SAMPLES
from topheavy import read_csv, read_record

few = settings(deadline=None, derandomize=True, database=None)


@pytest.fixture
def write(tmp_path):
    def write(text: str | bytes) -> Path:
        path = tmp_path / "motion.csv"
        path.write_bytes(text.encode() if isinstance(text, str) else text)
        return path

    return write


@pytest.fixture(scope="module")
def motion(tmp_path_factory) -> Path:
    """A file to be written again and again."""
    return tmp_path_factory.mktemp("records") / "motion.csv"


def of_times(times: list[str]) -> str:
    return "time (s),acceleration (g)\n" + "".join(f"{time},0.1\n" for time in times)


def test_samples_and_step_are_read(write):
    record = read_csv(write(CSV))
    np.testing.assert_array_equal(record.acceleration, SAMPLES)
    assert record.time_step == pytest.approx(0.02, rel=1e-15)
    assert record.name == "motion"
    assert read_record(write("\ufeff" + CSV.replace("\n", "\r\n"))).time_step == record.time_step


@few
@given(place=st.integers(1, 38), digits=st.integers(3, 9), rate=st.sampled_from([50, 128, 200]))
def test_missing_sample_is_found_with_its_line(motion, place, digits, rate):
    times = [f"{k / rate:.{digits}f}" for k in range(40)]
    del times[place]
    motion.write_text(of_times(times), encoding="utf-8")
    with pytest.raises(ValueError, match=rf"line {place + 2}: the time {times[place]} "):
        read_csv(motion)


@few
@given(place=st.integers(1, 38), shift=st.sampled_from([-0.2, -0.1, 0.1, 0.2]))
def test_uneven_time_is_found_with_its_line(motion, place, shift):
    times = [f"{(k + shift * (k == place)) / 50:.3f}" for k in range(40)]
    motion.write_text(of_times(times), encoding="utf-8")
    with pytest.raises(ValueError, match=rf"line {place + 2}: the time {times[place]} "):
        read_csv(motion)


@pytest.mark.parametrize(
    ("text", "asked"),
    [
        ("t (s),a (g)\n0,.1\n1,2.5\n", r"line 3: the largest acceleration is 2.5 g.*m/s²"),
        ("t (s),a (g)\n0,.1\n10,.2\n", r"time step is 10 s.*is it in ms"),
    ],
)
def test_another_unit_than_the_header_states_is_asked(tmp_path, text, asked):
    (tmp_path / "a.csv").write_text(text, encoding="utf-8")
    with pytest.warns(UserWarning, match=asked):
        read_csv(tmp_path / "a.csv")
