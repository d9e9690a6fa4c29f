"""Two-column CSV: units, regular steps within the rounding of print; `files.py` has bad files."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from tests.ground.records.files import CSV, SAMPLES
from tests.ground.records.test_units import SPELLINGS
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
@given(
    spelling=st.sampled_from(sorted(SPELLINGS)),
    samples=st.lists(
        st.floats(-4.9, 4.9).map(lambda a: round(a, 6)), min_size=2, max_size=9
    ).filter(any),
    milliseconds=st.booleans(),
    bracket=st.sampled_from(["()", "[]"]),
)
def test_record_in_any_spelling_gives_the_same_accelerations(
    motion, spelling, samples, milliseconds, bracket
):
    assume("(" not in spelling)  # brackets within brackets are refused
    (left, right), step = bracket, 20 if milliseconds else 0.02
    header = f"Time {left}{'ms' if milliseconds else 's'}{right} , a {left}{spelling}{right}\n"
    rows = (f"{step * k:.6g},{a / SPELLINGS[spelling]:.15e}\n" for k, a in enumerate(samples))
    motion.write_text(header + "".join(rows), encoding="utf-8")
    record = read_csv(motion)
    np.testing.assert_allclose(record.acceleration, samples, rtol=1e-13, atol=1e-18)
    assert record.time_step == pytest.approx(0.02, rel=1e-14)


@few
@given(
    rate=st.floats(10.0, 500.0),
    start=st.floats(-10.0, 100.0),
    count=st.integers(10, 500),
    form=st.sampled_from([".3f", ".4f", ".6g", ".9g", ".17g", ".5e"]),
)
def test_regular_times_are_read_whatever_their_digits(motion, rate, start, count, form):
    assume(start + count / rate < 1000.0)
    unit = {".3f": 1e-3, ".4f": 1e-4, ".6g": 1e-3, ".5e": 1e-3}.get(form, 1e-6)
    assume(rate * unit < 0.25)  # coarser digits could hide a missing sample
    times = [f"{start + k / rate:{form}}" for k in range(count)]
    motion.write_text(of_times(times), encoding="utf-8")
    step = 1.0 / rate
    assert read_csv(motion).time_step == pytest.approx(step, abs=1.01 * unit / (count - 1))


@pytest.mark.parametrize("cut", [lambda t: f"{t:.3f}", lambda t: f"{int(1000 * t) / 1000:.3f}"])
@pytest.mark.parametrize("rate", [128, 200, 75.3])
def test_times_rounded_or_cut_to_three_digits_are_regular(write, cut, rate):
    step = read_csv(write(of_times([cut(k / rate) for k in range(4000)]))).time_step
    assert step == pytest.approx(1.0 / rate, rel=1e-4)


def test_times_of_six_significant_digits_are_regular(write):
    times = [f"{k / 128:g}" for k in range(16000)]  # 0.0078125 to 124.992
    assert read_csv(write(of_times(times))).time_step == pytest.approx(1 / 128, rel=1e-5)


def test_time_is_not_the_less_certain_for_its_zeros_that_are_left_out(write):
    times = [f"{0.024 * k:g}" for k in range(40)]
    times[4] = "0.1"  # 0.100, not 0.096
    with pytest.raises(ValueError, match=r"line 6: the time 0\.1 follows 0\.072 of line 5"):
        read_csv(write(of_times(times)))


def test_times_computed_in_single_precision_are_regular(write):
    times = np.float32(0.005) * np.arange(8000, dtype=np.float32)
    assert read_csv(write(of_times([repr(float(t)) for t in times]))).time_step == pytest.approx(
        0.005, rel=1e-6
    )


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


def test_steps_that_grow_are_refused(write):
    with pytest.raises(ValueError, match=r"line \d+: the time .* follows .*; expected equal steps"):
        read_csv(write(of_times([f"{0.01 * k + 1e-5 * k * k:.6f}" for k in range(100)])))


def test_digits_too_coarse_to_show_a_gap_are_refused(write):
    with pytest.raises(ValueError, match="expected equal steps"):
        read_csv(write(of_times([f"{k / 128:.2f}" for k in range(100)])))


THREE = "t (s),NS (g),EW (m/s²)\n0,.1,.981\n1,.1,1.962\n"


def test_named_column_is_read(tmp_path):
    (tmp_path / "a.csv").write_text(THREE, encoding="utf-8")
    assert read_csv(tmp_path / "a.csv", column="ns").acceleration == pytest.approx([0.1, 0.1])
    east = read_record(tmp_path / "a.csv", column="EW")
    assert east.acceleration == pytest.approx([0.1, 0.2])
    with pytest.raises(ValueError, match="that is called 'UD'; those are 'NS', 'EW'"):
        read_csv(tmp_path / "a.csv", column="UD")
    with pytest.raises(ValueError, match=r"ends in .csv, which alone has columns"):
        read_record(tmp_path / "a.at2", column="NS")


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
