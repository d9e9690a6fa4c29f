"""PEER's AT2 layout: every usual header gives the same record, and every bad file one message."""

import re
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.records.test_units import HEADERS, SPELLINGS
from topheavy import read_at2

SAMPLES = (0.1, -0.2, 0.4, 0.0, -0.3)
HEADER = "A site, a day\nan instrument\nACCELERATION IN UNITS OF G\nNPTS= {n}, DT= .0200 SEC\n"
VALUES = "  0.1 -0.2  0.4\n  0.0 -3.0E-01\n"
GOOD = HEADER.format(n=5) + VALUES

few = settings(deadline=None, derandomize=True, database=None)


@pytest.fixture
def write(tmp_path):
    def write(text: str | bytes) -> Path:
        path = tmp_path / "motion.AT2"
        path.write_bytes(text.encode() if isinstance(text, str) else text)
        return path

    return write


@pytest.fixture(scope="module")
def motion(tmp_path_factory) -> Path:
    """A file to be written again and again."""
    return tmp_path_factory.mktemp("records") / "motion.AT2"


@pytest.mark.parametrize("newline", ["\n", "\r\n", "\r"])
@pytest.mark.parametrize("tail", ["", "\n", "\n\n  \n"])
@pytest.mark.parametrize("mark", ["", "\ufeff"])
def test_line_ends_and_a_mark_of_byte_order_do_not_matter(write, newline, tail, mark):
    text = (mark + HEADER.format(n=5) + VALUES.rstrip() + tail).replace("\n", newline)
    record = read_at2(write(text))
    np.testing.assert_array_equal(record.acceleration, SAMPLES)
    assert record.time_step == 0.02
    assert record.name == "motion"


def test_mark_of_byte_order_does_not_hide_a_count_at_the_start(write):
    record = read_at2(write("\ufeff5 0.02 NPTS, DT, UNITS: G\n" + VALUES))
    np.testing.assert_array_equal(record.acceleration, SAMPLES)


STEPS = [
    # the last line of a header with 5 samples at 0.02 s
    "NPTS=  5, DT= .02000 SEC",
    "NPTS= 5 DT= .02",
    "NPTS=5,DT=2.0D-02",
    "NPTS=5, DT=2.0E-2 SEC,",
    "npts= 5, dt= 2.d-2sec",
    "NPTS= 5, DT= 20 MSEC",
    "NPTS= 5, DT=20ms",
    "NPTS= 5, DT= 20.0D0 Milliseconds",
    "NPTS= 5, DT= .02 S, 8F10.5",
    "NPTS: 5, DT (s): 0.02",
    "NPTS= 5, DT(MSEC)= 20",
    "NPTS= 5, DT= .02 (SEC)",
    "DT= .02 NPTS= 5",
    "NPTS= 5 DT= .02 UNITS: G",
    "DT= .02 SEC, NPTS= 5",
    "  5 0.02 NPTS, DT",
    "     5    .0200    NPTS, DT",
    "5, 2.0D-02, NPTS, DT (SEC)",
    "5 20 MSEC NPTS, DT",
]


@pytest.mark.parametrize("line", STEPS)
def test_number_of_samples_and_step_are_read(write, line):
    record = read_at2(write(GOOD.replace("NPTS= 5, DT= .0200 SEC", line)))
    np.testing.assert_array_equal(record.acceleration, SAMPLES)
    assert record.time_step == pytest.approx(0.02, rel=1e-15)


@pytest.mark.parametrize(
    "line",
    [
        *("NPTS= 5, DT= 1e", "NPTS= 5, DT= .02 MIN", "NPTS= 5, DT= 50 HZ", "NPTS= 5, DT= .02 D"),
        *("NPTS= 5, DT(MSEC)= 20 SEC", "NPTS= 5, DT= x", "NPTS= 5, DT=", "NPTS= 5, DT= 1e-"),
        *("NPTS= 5, DT= 0,02", "NPTS= 5, DT= .02.1", "NPTS= 5, DT= 1/50", "NPTS= 5, DT= 20 ms/2"),
        *("NPTS= 5, DT= 20", "NPTS= 5, DT= 5", "5 20 NPTS, DT", "NPTS, DT", "NPTS= five, DT= .02"),
        *("NPTS= 5.5, DT= .02", "NPTS= 5,000, DT= .02", "NPTS= -5, DT= .02", "NPTS= 5", "5 NPTS"),
    ],
)
def test_step_that_is_not_certain_is_refused_with_its_line(write, line):
    path = write(GOOD.replace("NPTS= 5, DT= .0200 SEC", line))
    with pytest.raises(ValueError, match=rf"^{re.escape(str(path))}: line 4 ") as error:
        read_at2(path)
    assert repr(line) in str(error.value)


@few
@given(
    spelling=st.sampled_from(sorted(SPELLINGS)),
    header=st.sampled_from(HEADERS[:-1]),
    step=st.sampled_from([line for line in STEPS if "UNITS" not in line]),
    samples=st.lists(
        st.floats(-4.9, 4.9).map(lambda a: round(a, 6)), min_size=5, max_size=5
    ).filter(any),
    fortran=st.booleans(),
)
def test_record_in_any_spelling_gives_the_same_accelerations(
    motion, spelling, header, step, samples, fortran
):
    values = " ".join(f"{a / SPELLINGS[spelling]:.15E}" for a in samples)
    values = values.replace("E", "D") if fortran else values
    motion.write_text(f"A site\n{header.format(spelling)}\n{step}\n{values}\n", encoding="utf-8")
    record = read_at2(motion)
    np.testing.assert_allclose(record.acceleration, samples, rtol=1e-13, atol=1e-18)
    assert record.time_step == pytest.approx(0.02, rel=1e-15)


BAD_FILES = [
    # what is wrong, text, what the message must say besides the file's name
    ("fewer values than NPTS", HEADER.format(n=8) + VALUES, r"line 4 says 8 .* hold 5; .* cut"),
    ("more values than NPTS", HEADER.format(n=3) + VALUES, r"line 4 says 3 .* hold 5; .* too many"),
    ("no header", VALUES * 4, r"no NPTS in lines 1 to 4"),
    ("no DT", GOOD.replace("DT=", "XX="), r"line 4 is 'NPTS= 5, XX= \.0200 SEC'; expected .*DT"),
    ("no NPTS", GOOD.replace("NPTS=", "XX="), r"no NPTS in lines 1 to 4"),
    ("time step of zero", GOOD.replace(".0200", ".0000"), r"time_step is 0 s"),
    ("a word", GOOD.replace("0.0 ", "o.o "), r"line 6: 'o\.o' is not a number"),
    ("merged columns", GOOD.replace("0.1 -", "0.1-"), r"line 5: '0\.1-0\.2' is not a number"),
    ("not a number", GOOD.replace("0.4", "NaN"), r"line 5: 'NaN' is not a number"),
    ("infinite", GOOD.replace("0.4", "inf"), r"line 5: 'inf' is not a number"),
    ("too large for a float", GOOD.replace("0.4", "1E999"), r"line 5: '1E999' is not a number"),
    ("Python's digits", GOOD.replace("0.4", "0_4"), r"line 5: '0_4' is not a number"),
    ("header alone", HEADER.format(n=5), r"line 4 says 5 .* hold 0"),
    ("one sample", HEADER.format(n=1) + "0.1\n", r"shape \(1,\); expected .* two samples"),
    ("cut in the header", "\n".join(HEADER.split("\n")[:2]), r"no NPTS"),
    ("empty", "", r"no NPTS"),
    ("not UTF-8", GOOD.encode().replace(b"site", b"st\xe9"), r"line 1 is not UTF-8 .*0xe9"),
    ("another unit", GOOD.replace("OF G", "OF FT/S2"), r"line 3 states .* 'ACCELERATION .* FT/S2'"),
    ("velocity", GOOD.replace("OF G", "OF CM/S"), r"line 3 states a unit that is not understood"),
    ("no unit", GOOD.replace(" IN UNITS OF G", ""), r"lines 1 to 4 state no .*line 3 is 'ACCELER"),
    ("two units", GOOD.replace("day", "day (gal)"), r"line 1 states 'gal' .*line 3 states 'G'"),
    ("beyond 5 g", GOOD.replace("0.4", "341.7"), r"line 5: .* 341\.7 G, .*at most 5 g.* line 3"),
]


@pytest.mark.parametrize(
    ("text", "says"), [r[1:] for r in BAD_FILES], ids=[r[0] for r in BAD_FILES]
)
def test_bad_file_is_refused_in_one_line_with_its_name_and_reason(write, text, says):
    path = write(text)
    with pytest.raises(ValueError, match=rf"^{re.escape(str(path))}: .*{says}") as error:
        read_at2(path)
    assert "\n" not in str(error.value)


def test_missing_file_is_named(tmp_path):
    with pytest.raises(FileNotFoundError, match=r"nowhere\.AT2"):
        read_at2(tmp_path / "nowhere.AT2")


@pytest.mark.parametrize(
    "statement", ["", "ACCELERATION", "UNITS: METRIC", "acceleration, SI", "[m/s/s/s]"]
)
def test_el_centro_in_metres_never_passes_as_g(write, statement):
    original = Path(__file__).parents[2] / "data" / "records" / "el_centro_1940_NS.AT2"
    *_, header, values = original.read_text(encoding="utf-8").split("\n", 4)[:5]
    record = read_at2(original)
    metres = "\n".join(f"{9.81 * a:.17g}" for a in record.acceleration)
    understood = read_at2(write(f"El Centro\nUNITS: M/S2\n{header}\n{metres}\n"))
    np.testing.assert_allclose(understood.acceleration, record.acceleration, rtol=1e-14)
    assert len(values) > 1000
    with pytest.raises(ValueError, match="unit"):
        read_at2(write(f"El Centro\n{statement}\n{header}\n{metres}\n"))
