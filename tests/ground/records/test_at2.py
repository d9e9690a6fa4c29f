"""PEER's AT2 layout: every usual header gives the same record; `files.py` has the bad files."""

from pathlib import Path

import numpy as np
import pytest

from tests.cases import RECORDS
from tests.ground.records.files import HEADER, SAMPLES, VALUES
from topheavy import read_at2


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
