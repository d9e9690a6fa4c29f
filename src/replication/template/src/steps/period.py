"""Compute the period against amplitude by two routes, and by Eq. (2) as printed and as meant."""

import math

import numpy as np
import sympy as sp

from replication.workbench import grid, run, truth, value
from theory.motion import PRINTED, period_of_small_swings, theta0
from theory.period import by_elliptic_integral, by_integration


def main(settings: dict) -> tuple[dict, dict]:
    degrees = grid(settings["amplitudes"])
    amplitudes = np.radians(degrees)
    first = by_elliptic_integral(amplitudes)
    second = np.array([by_integration(amplitude) for amplitude in amplitudes])
    table = {
        "amplitude_deg": degrees,
        "by_elliptic_integral": first,
        "by_integration": second,
        "as_printed": sp.lambdify(theta0, PRINTED[2])(amplitudes),
        "as_meant": sp.lambdify(theta0, period_of_small_swings())(amplitudes),
    }
    right = float(by_elliptic_integral(math.pi / 2))
    worst = np.abs(first - second).max()
    findings = {
        "at_right_angle": value(right, abs(right - by_integration(math.pi / 2))),
        "routes_agree": truth(worst < settings["agreement"], worst=worst),
    }
    return table, findings


if __name__ == "__main__":
    run(snakemake, lambda job: main(job.params.settings))
