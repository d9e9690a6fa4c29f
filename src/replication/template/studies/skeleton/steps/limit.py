"""The fewest intervals with which the trapezoidal rule integrates half a sine within an error."""

import math
from itertools import count, pairwise

import numpy as np

from replication.workbench import run, truth, value

CLOSE = 1e-9
"""The second route has to give the same error to this."""


def error_of(intervals: int) -> float:
    """Return the relative error of the trapezoidal rule for the integral of sin from 0 to π."""
    x = np.linspace(0.0, math.pi, intervals + 1)
    return 1.0 - float(np.trapezoid(np.sin(x), x)) / 2.0


def fewest(error: float) -> int:
    """Return the fewest intervals with which the relative error is at most a given one."""
    return next(intervals for intervals in count(1) if error_of(intervals) <= error)


def main(settings: dict) -> tuple[list[dict], dict]:
    rows = [{"error": error, "intervals": fewest(error)} for error in settings["errors"]]
    gaps = []
    for row in rows:
        half = math.pi / (2 * row["intervals"])
        gaps.append(abs(error_of(row["intervals"]) - (1.0 - half / math.tan(half))))  # its sum
    findings = {
        "rises": truth(
            max(gaps) < CLOSE
            and all(one["intervals"] > other["intervals"] for one, other in pairwise(rows)),
            largest_gap=max(gaps),
        ),
        "most": value(rows[0]["intervals"], 0.0),
    }
    return rows, findings


if __name__ == "__main__":
    run(snakemake, lambda job: main(job.params.settings))
