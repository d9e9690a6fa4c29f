import json
from pathlib import Path

import pytest
import rock
from summary import released

ROWS = json.loads(Path("results/summary.json").read_text())["rows"]  # run Snakemake before


@pytest.mark.parametrize("row", [row for row in ROWS if not row["is_default"]], ids=str)
def test_every_engine_comes_close_to_theory(row):
    assert row["frequency"] == pytest.approx(1.0, abs=2e-3)
    assert row["restitutions"] == pytest.approx([row["restitution"]] * 3, abs=5e-3)


def test_the_measurements_find_the_theory_in_its_own_history():
    restitution, exact = released(0)
    states = [*zip(0 * exact.rotation, exact.rotation, strict=True)]
    numbers = rock.free(lambda *_, **__: (exact.time, rock.np.array(states)), 0)
    assert numbers["restitutions"] == pytest.approx([restitution] * 3, 1e-4)
    assert numbers["upright"] == pytest.approx(exact.impact_times[0], 1e-4)
    assert rock.lowest(lambda factor: factor > 1.3, 1.2, 0.1, 3.0, 9) == pytest.approx(1.3, 1e-3)
    assert rock.lowest(lambda factor: False, 1.2, 0.1, 3.0, 9) == float("inf")
