"""PEER's AT2 layout: every usual header gives the same record; `files.py` has the bad files."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.cases import RECORDS
from tests.ground.records.files import HEADER, SAMPLES, STEPS, VALUES
from tests.ground.records.test_units import HEADERS, SPELLINGS
from topheavy import read_at2

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
