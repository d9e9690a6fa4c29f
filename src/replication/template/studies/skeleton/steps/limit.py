"""The largest amplitude for which the period is that of small swings, within a given share."""

import math
from itertools import pairwise

from scipy.optimize import brentq

from replication.workbench import run, truth, value
from theory.period import by_elliptic_integral, by_integration

CLOSE = 1e-9
"""The second route has to give the same share to this."""


def largest_amplitude(share: float) -> float:
    """Return the amplitude in rad at which the period exceeds that of small swings by a share."""
    return brentq(lambda amplitude: by_elliptic_integral(amplitude) - 1.0 - share, 0.0, 3.1)


def main(settings: dict) -> tuple[list[dict], dict]:
    rows = [
        {"share": share, "amplitude_deg": math.degrees(largest_amplitude(share))}
        for share in settings["shares"]
    ]
    gaps = [
        abs(by_integration(math.radians(row["amplitude_deg"])) - 1.0 - row["share"]) for row in rows
    ]
    findings = {
        "rises": truth(
            max(gaps) < CLOSE
            and all(one["amplitude_deg"] < other["amplitude_deg"] for one, other in pairwise(rows)),
            largest_gap=max(gaps),
        ),
        "last": value(rows[-1]["amplitude_deg"], CLOSE, "°"),
    }
    return rows, findings


if __name__ == "__main__":
    run(snakemake, lambda job: main(job.params.settings))
