"""Compare published tables with equations that no step uses, without a run: `make check`."""

from collections.abc import Iterator, Mapping
from pathlib import Path

import numpy as np
import pandas as pd

from replication.pages.edition_check import close
from replication.pages.edition_check import main as recheck
from replication.workbench import Findings


def departures(folder: Path, findings: Mapping[str, Findings]) -> Iterator[str]:
    """Yield the published numbers that do not follow from the arithmetic–geometric mean."""
    table = pd.read_csv(folder / "period.csv")
    expected = _period(np.radians(table.amplitude_deg))
    if not np.allclose(table.by_elliptic_integral, expected, rtol=1e-8):
        yield "period.csv: the period is not that of the arithmetic–geometric mean"
    found, expected = findings["period"]["at_right_angle"].value, _period(np.pi / 2)
    if not np.isclose(found, expected, rtol=1e-8):
        yield f"findings/period.json: at_right_angle.value is {found}; expected {expected:.9g}"


def _period(amplitude):
    """Return 1 over the arithmetic–geometric mean of 1 and cos(θ₀/2)."""
    mean, other = 1.0, np.cos(amplitude / 2.0)
    for _ in range(8):  # it converges quadratically
        mean, other = (mean + other) / 2.0, np.sqrt(mean * other)
    return 1.0 / mean


if __name__ == "__main__":
    close(*recheck(departures))
