"""Files that would hold a reader up; `tests/explorer/test_records.py` tests the page on them."""

import time
from contextlib import suppress
from pathlib import Path

import pytest

from tests.ground.records.files import BODIES, REPEATED
from topheavy.ground.records import at2, columns, read, units

READERS = {
    "unit": lambda line: units.stated_acceleration([f"data {line}x"]),
    "step": lambda line: at2._count_and_step(Path("x"), 4, f"NPTS= 5, {line}x"),
    "old step": lambda line: at2._count_and_step(Path("x"), 4, f"5 .01 NPTS{line}x"),
    "columns": lambda line: columns._layout(Path("x"), f"{line}x,", 1, ""),
}


def seconds(reader, line: str) -> float:
    """Return the least processor time of five calls, of a reader that refuses the line."""
    taken = []
    for _ in range(5):
        begun = time.process_time()
        with pytest.raises(ValueError):  # noqa: PT011
            reader(line)
        taken.append(time.process_time() - begun)
    return min(taken)


@pytest.mark.parametrize("reader", READERS)
@pytest.mark.parametrize("part", REPEATED)
def test_cost_of_a_header_grows_in_proportion_to_its_length(reader, part):
    short, long = (seconds(READERS[reader], part * number) for number in (300, 2400))
    assert long < 3 * 8 * short + 2e-3  # in proportion it is 8, as the square 64


def test_cost_of_many_statements_grows_in_proportion():
    def found(number: int) -> float:
        begun = time.process_time()
        assert units.stated_acceleration([" (g)" * number]).unit == "g"
        return time.process_time() - begun

    assert min(found(8000) for _ in range(3)) < 3 * 8 * min(found(1000) for _ in range(3))


@pytest.mark.parametrize("body", BODIES)
def test_cost_of_a_file_grows_in_proportion_to_its_length(tmp_path, body):
    def taken(number: int) -> float:
        ending, content = BODIES[body](number)
        path = tmp_path / f"motion{ending}"
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        begun = time.process_time()
        with suppress(ValueError):
            read(path)
        return time.process_time() - begun

    short, long = (min(taken(number) for _ in range(3)) for number in (1000, 8000))
    assert long < 3 * 8 * short + 2e-3  # in proportion it is 8, as the square 64
