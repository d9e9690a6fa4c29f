"""Files that would hold a reader up; `tests/explorer/test_records.py` tests the page on them."""

import time
from contextlib import suppress

import pytest

from tests.ground.records.files import BODIES
from topheavy.ground.records import read


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
