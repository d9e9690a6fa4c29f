"""The fewest intervals with which the trapezoidal rule integrates half a sine within an error."""

import math
from itertools import count

import numpy as np

from replication.workbench import run, truth, value


def error_of(intervals: int) -> float:
    """Return the relative error of the trapezoidal rule for the integral of sin from 0 to π."""
    x = np.linspace(0.0, math.pi, intervals + 1)
    return 1.0 - float(np.trapezoid(np.sin(x), x)) / 2.0


def fewest(error: float) -> int:
    """Return the fewest intervals with which the relative error is at most a given one."""
    return next(intervals for intervals in count(1) if error_of(intervals) <= error)


def main(settings: dict) -> tuple[dict, dict]:
    found = [fewest(error) for error in settings["errors"]]
    findings = {
        "rises": truth(all(np.diff(found) < 0)),
        "most": value(found[0], 0.0),
    }
    return {"error": settings["errors"], "intervals": found}, findings


if __name__ == "__main__":
    run(snakemake, lambda job: main(job.params.settings))
