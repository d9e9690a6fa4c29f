"""Files of records: AT2, columns, limits of size and cost."""

import re
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.cases import RECORDS
from tests.ground.records.files import CSV, FILES, HEADER, LARGEST, MOST, SAMPLES, VALUES, longest
from topheavy.ground.records import read_at2, read_csv, read_record, reading


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


@pytest.fixture
def write(tmp_path):
    def write(text: str, name: str = "motion.AT2") -> Path:
        path = tmp_path / name
        path.write_bytes(text.encode())
        return path

    return write


@pytest.mark.parametrize("newline", ["\n", "\r\n", "\r"])
@pytest.mark.parametrize("tail", ["", "\n", "\n\n  \n"])
@pytest.mark.parametrize("mark", ["", "\ufeff"])
def test_line_ends_and_a_mark_of_byte_order_do_not_matter(write, newline, tail, mark):
    text = (mark + HEADER.format(n=5) + VALUES.rstrip() + tail).replace("\n", newline)
    record = read_at2(write(text))
    np.testing.assert_array_equal(record.acceleration, SAMPLES)
    assert record.time_step == 0.02
    assert record.name == "motion"


def test_missing_file_is_named(tmp_path):
    with pytest.raises(FileNotFoundError, match=r"nowhere\.AT2"):
        read_at2(tmp_path / "nowhere.AT2")


@pytest.mark.parametrize(
    "statement", ["", "ACCELERATION", "UNITS: METRIC", "acceleration, SI", "[m/s/s/s]"]
)
def test_el_centro_in_metres_never_passes_as_g(write, statement):
    original = RECORDS / "el_centro_1940_NS.AT2"
    *_, header, values = original.read_text(encoding="utf-8").split("\n", 4)[:5]
    record = read_at2(original)
    metres = "\n".join(f"{9.81 * a:.17g}" for a in record.acceleration)
    understood = read_at2(write(f"El Centro\nUNITS: M/S2\n{header}\n{metres}\n"))
    np.testing.assert_allclose(understood.acceleration, record.acceleration, rtol=1e-14)
    assert len(values) > 1000
    with pytest.raises(ValueError, match="unit"):
        read_at2(write(f"El Centro\n{statement}\n{header}\n{metres}\n"))


few = settings(deadline=None, derandomize=True, database=None)


@pytest.fixture(scope="module")
def table(tmp_path_factory) -> Path:
    """A file to be written again and again."""
    return tmp_path_factory.mktemp("records") / "table.csv"


def of_times(times: list[str]) -> str:
    return "time (s),acceleration (g)\n" + "".join(f"{time},0.1\n" for time in times)


def test_samples_and_step_are_read(write):
    record = read_csv(write(CSV, "table.csv"))
    np.testing.assert_array_equal(record.acceleration, SAMPLES)
    assert record.time_step == pytest.approx(0.02, rel=1e-15)
    assert record.name == "table"
    assert (
        read_record(write("\ufeff" + CSV.replace("\n", "\r\n"), "table.csv")).time_step
        == record.time_step
    )


@few
@given(place=st.integers(1, 38), digits=st.integers(3, 9), rate=st.sampled_from([50, 128, 200]))
def test_missing_sample_is_found_with_its_line(table, place, digits, rate):
    times = [f"{k / rate:.{digits}f}" for k in range(40)]
    del times[place]
    table.write_text(of_times(times), encoding="utf-8")
    with pytest.raises(ValueError, match=rf"line {place + 2}: the time {times[place]} "):
        read_csv(table)


@few
@given(place=st.integers(1, 38), shift=st.sampled_from([-0.2, -0.1, 0.1, 0.2]))
def test_uneven_time_is_found_with_its_line(table, place, shift):
    times = [f"{(k + shift * (k == place)) / 50:.3f}" for k in range(40)]
    table.write_text(of_times(times), encoding="utf-8")
    with pytest.raises(ValueError, match=rf"line {place + 2}: the time {times[place]} "):
        read_csv(table)


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
