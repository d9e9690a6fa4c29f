"""Ground motion records: interpolation, the AT2 reader, and every way in which a file is bad."""

import math
from pathlib import Path

import numpy as np
import pytest

from topheavy import Record, read_at2, read_csv, read_record

RECORDS = Path(__file__).parents[1] / "data" / "records"
CERTIFIED = [
    # file, samples, time step (s), peak (g): data/records/README.md
    ("el_centro_1940_NS.AT2", 1559, 0.02, 0.319),
    ("ridgecrest_2019_CCC_090.AT2", 6000, 0.01, 0.567),
    ("ridgecrest_2019_CCC_360.AT2", 6000, 0.01, 0.471),
    ("ridgecrest_2019_CLC_090.AT2", 6000, 0.01, 0.344),
    ("ridgecrest_2019_CLC_360.AT2", 6000, 0.01, 0.511),
]
SAMPLES = (0.1, -0.2, 0.4, 0.0, -0.3)
HEADER = "A site, a day\nan instrument\nACCELERATION IN UNITS OF G\nNPTS= {n}, DT= .0200 SEC\n"
VALUES = "  0.1 -0.2  0.4\n  0.0 -3.0E-01\n"


@pytest.fixture
def record() -> Record:
    return Record(0.02, np.array(SAMPLES), name="five samples")


@pytest.fixture
def write(tmp_path):
    def write(text: str) -> Path:
        path = tmp_path / "motion.AT2"
        path.write_bytes(text.encode())
        return path

    return write


# ---------------------------------------------------------------------------- Record


def test_record_passes_through_its_samples(record):
    for index, value in enumerate(SAMPLES):
        assert record.excitation(index * 0.02) == pytest.approx(value, abs=1e-14)


def test_record_is_linear_between_samples(record):
    assert record.excitation(0.01) == pytest.approx(-0.05, abs=1e-14)
    assert record.excitation(0.045) == pytest.approx(0.3, abs=1e-14)
    fine = np.linspace(0.04, 0.06, 21)
    np.testing.assert_allclose(np.diff(record.excitation(fine), 2), 0.0, atol=1e-14)


def test_record_is_zero_outside_its_duration(record):
    outside = np.array([-1.0, -1e-9, 0.08 + 1e-9, 0.1, 1e3])
    assert np.all(record.excitation(outside) == 0)
    assert record.excitation(-1e-9) == 0
    assert record.excitation(0.08 + 1e-9) == 0


def test_record_lasts_from_its_first_sample_to_its_last(record):
    assert record.duration == pytest.approx(0.08, rel=1e-15)


def test_record_keeps_its_name_and_needs_none(record):
    assert record.name == "five samples"
    assert record.time_step == 0.02
    assert Record(0.02, SAMPLES).name == ""


def test_record_excitation_of_an_array_is_that_of_its_elements(record):
    time = np.linspace(-0.02, 0.1, 30).reshape(5, 6)
    values = record.excitation(time)
    assert values.shape == time.shape
    expected = [[record.excitation(float(t)) for t in row] for row in time]
    np.testing.assert_allclose(values, expected, rtol=1e-14, atol=1e-16)


@pytest.mark.parametrize("time", [-1.0, 0.0, 0, 0.03, 1])
def test_record_excitation_at_one_time_is_a_float(record, time):
    assert isinstance(record.excitation(time), float)


def test_scaled_record_differs_in_acceleration_alone(record):
    scaled = record.scaled(-2.0)
    np.testing.assert_array_equal(scaled.acceleration, -2.0 * np.array(SAMPLES))
    np.testing.assert_array_equal(record.acceleration, SAMPLES)
    assert scaled.time_step == record.time_step
    assert scaled.duration == record.duration


def test_record_holds_a_copy_that_nobody_can_change():
    mine = np.array(SAMPLES)
    record = Record(0.02, mine)
    mine[2] = 99.0  # still writable, and no longer the record's
    assert record.acceleration[2] == 0.4
    with pytest.raises(ValueError, match="read-only"):
        record.acceleration[2] = 99.0
    with pytest.raises(AttributeError):
        record.time_step = 0.01


def test_record_takes_integers_and_lists_as_floats():
    assert Record(1, [0, 1, 0]).excitation(0.5) == pytest.approx(0.5)
    assert Record(0.1, np.array([0, 1], dtype=np.int32)).acceleration.dtype == np.float64


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf])
def test_record_names_the_sample_that_is_not_finite(bad):
    samples = np.zeros(40)
    samples[17] = bad
    with pytest.raises(ValueError, match=r"\b17\b") as error:
        Record(0.02, samples)
    assert error.match(str(bad))


@pytest.mark.parametrize("samples", [[], [0.1]])
def test_record_needs_two_samples(samples):
    with pytest.raises(ValueError, match=rf"\b{len(samples)}\b|two|2"):
        Record(0.02, samples)


def test_record_refuses_a_table_of_samples():
    with pytest.raises(ValueError, match=r"one.dimension|1.?[dD]\b|shape|dimension"):
        Record(0.02, np.zeros((3, 4)))


@pytest.mark.parametrize("value", [0.0, -0.02, math.nan, math.inf])
def test_record_refuses_a_time_step_that_is_not_positive(value):
    with pytest.raises(ValueError, match=f"time_step.*{value:g}"):
        Record(value, SAMPLES)


@pytest.mark.parametrize("value", [math.nan, math.inf])
def test_record_refuses_a_factor_that_is_not_finite(record, value):
    with pytest.raises(ValueError, match=str(value)):
        record.scaled(value)


# ---------------------------------------------------------------------------- read_at2


def test_every_record_in_the_repository_is_certified():
    assert sorted(path.name for path in RECORDS.glob("*.AT2")) == sorted(r[0] for r in CERTIFIED)


@pytest.mark.parametrize(("file", "samples", "time_step", "peak"), CERTIFIED)
def test_read_at2_finds_the_certified_count_step_and_peak(file, samples, time_step, peak):
    record = read_at2(RECORDS / file)
    assert record.acceleration.shape == (samples,)
    assert record.time_step == time_step
    assert record.duration == pytest.approx((samples - 1) * time_step, rel=1e-14)
    assert np.max(np.abs(record.acceleration)) == pytest.approx(peak, abs=5e-4)


def test_read_at2_keeps_first_and_last_values_in_place():
    record = read_at2(str(RECORDS / "el_centro_1940_NS.AT2"))  # a path in a string, too
    np.testing.assert_array_equal(record.acceleration[:3], [0.0063, 0.00364, 0.00099])
    np.testing.assert_array_equal(record.acceleration[-3:], [-0.00013, -0.00006, 0.0])


@pytest.mark.parametrize("newline", ["\n", "\r\n"])
@pytest.mark.parametrize("tail", ["", "\n", "\n\n  \n"])
def test_read_at2_does_not_mind_line_ends(write, newline, tail):
    text = (HEADER.format(n=5) + VALUES.rstrip() + tail).replace("\n", newline)
    record = read_at2(write(text))
    np.testing.assert_array_equal(record.acceleration, SAMPLES)
    assert record.time_step == 0.02


BAD_FILES = [
    # what is wrong, text, what the message must say besides the file's name
    ("fewer values than NPTS", HEADER.format(n=8) + VALUES, r"(?s)(\b8\b.*\b5\b|\b5\b.*\b8\b)"),
    ("more values than NPTS", HEADER.format(n=3) + VALUES, r"(?s)(\b3\b.*\b5\b|\b5\b.*\b3\b)"),
    ("no header", VALUES * 4, r"NPTS"),
    ("no DT", HEADER.format(n=5).replace("DT=", "XX=") + VALUES, r"DT"),
    ("no NPTS", HEADER.format(n=5).replace("NPTS=", "XX=") + VALUES, r"NPTS"),
    ("time step of zero", HEADER.format(n=5).replace(".0200", ".0000") + VALUES, r"DT|time_step"),
    ("a word", HEADER.format(n=5) + VALUES.replace("0.0", "o.o"), r"(?s)line 6.*o\.o|o\.o.*line 6"),
    ("merged columns", HEADER.format(n=5) + VALUES.replace("0.1 -", "0.1-"), r"line 5"),
    ("not a number", HEADER.format(n=5) + VALUES.replace("0.4", "NaN"), r"(?i)nan"),
    ("header alone", HEADER.format(n=5), r"\b5\b"),
    ("cut in the header", "\n".join(HEADER.split("\n")[:2]), r"NPTS|header"),
    ("empty", "", r"(?i)empty|NPTS|header"),
]


@pytest.mark.parametrize(
    ("text", "says"), [r[1:] for r in BAD_FILES], ids=[r[0] for r in BAD_FILES]
)
def test_read_at2_refuses_a_bad_file_by_name_and_reason(write, text, says):
    with pytest.raises(ValueError, match=r"motion\.AT2") as error:
        read_at2(write(text))
    assert error.match(says)


def test_read_at2_says_when_there_is_no_file(tmp_path):
    with pytest.raises(FileNotFoundError, match=r"nowhere\.AT2"):
        read_at2(tmp_path / "nowhere.AT2")


def test_read_at2_refuses_another_unit(write):
    text = HEADER.format(n=5).replace("UNITS OF G", "UNITS OF CM/S/S") + VALUES
    with pytest.raises(ValueError, match=r"'UNITS OF CM/S/S'; expected units of g"):
        read_at2(write(text))


def test_read_at2_refuses_what_cannot_be_in_g(write):
    text = HEADER.format(n=5).replace("IN UNITS OF G", "") + VALUES.replace("0.4", "341.7")
    with pytest.raises(ValueError, match=r"largest acceleration is 341\.7; expected .* in g"):
        read_at2(write(text))


# ---------------------------------------------------------------------------- read_csv

CSV = "time (s),acceleration (g)\n0.00,0.1\n0.02,-0.2\n0.04,0.4\n0.06,0.0\n0.08,-3.0E-01\n"


@pytest.fixture
def write_csv(tmp_path):
    def write(text: str) -> Path:
        path = tmp_path / "motion.csv"
        path.write_text(text, encoding="utf-8")
        return path

    return write


def test_read_csv_gives_the_record_that_at2_gives(write, write_csv):
    one, other = read_csv(write_csv(CSV)), read_at2(write(HEADER.format(n=5) + VALUES))
    np.testing.assert_array_equal(one.acceleration, other.acceleration)
    assert one.time_step == pytest.approx(other.time_step, rel=1e-12)
    assert one.name == other.name == "motion"


def test_read_csv_takes_times_rounded_to_print(write_csv):
    times = [f"{k / 200:.3f}" for k in range(400)]
    lines = "".join(f"{time},{0.1 * (k % 3)}\n" for k, time in enumerate(times))
    assert read_csv(write_csv(f"Time (s) , Acceleration (G)\n{lines}")).time_step == pytest.approx(
        0.005, rel=1e-9
    )


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("", "line 1 is ''; expected 'time"),
        ("0.00,0.1\n0.02,0.2\n", "line 1 is '0.00,0.1'; expected 'time"),
        (CSV.replace("(g)", "(m/s2)"), "units s, m/s2; expected s and g"),
        (CSV.replace("(s)", "(ms)"), "units ms, g; expected s and g"),
        (CSV.replace("0.04,0.4\n", ""), "sample 3 of 4 is at 0.06 s, the one before at 0.02 s"),
        (CSV.replace("0.04,", "0.01,"), "sample 3 of 5 is at 0.01 s"),
        (CSV.replace("0.04,", "nan,"), "sample 3 of 5 is at nan s"),
        (CSV.replace("0.4", "four"), "line 4 is '0.04,four'; expected a time in s"),
        (CSV.replace("0.4", "0.4,1"), "line 4 is '0.04,0.4,1'"),
        (CSV.replace("0.4", "nan"), "sample 2 of 5 is nan; expected finite"),
        (CSV.replace("0.4", "39.2"), "largest acceleration is 39.2; expected accelerations in g"),
        (CSV[:35], "holds 1 samples; expected at least two"),
    ],
)
def test_read_csv_refuses_a_bad_file_by_name_and_reason(write_csv, text, says):
    with pytest.raises(ValueError, match=r"motion\.csv") as error:
        read_csv(write_csv(text))
    assert says in str(error.value)


def test_read_record_tells_the_two_layouts_by_name(write, write_csv, tmp_path):
    assert read_record(write_csv(CSV)).duration == pytest.approx(
        read_record(write(HEADER.format(n=5) + VALUES)).duration
    )
    with pytest.raises(ValueError, match=r"motion\.txt: expected .* \.AT2 or \.csv"):
        read_record(tmp_path / "motion.txt")
