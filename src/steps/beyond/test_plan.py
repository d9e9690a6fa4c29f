"""A plan to test one inequality: a pulse that overturns only the column, and its repeats."""

import math
from itertools import count, product

import pandas as pd
from scipy.special import bdtr, ndtr

from replication.step import check, run, value
from steps.shared import plain
from steps.shared.cases import lowered, lowest
from topheavy import Column, Pulse, RockingFrame, judge

SOLVERS = judge, plain.judge


def compute(settings):
    """Return for each pair of minima a pulse between them, and the repeats that distinguish them.

    The second of a pair has the higher minimum: the frame, or the column with a lower √r. The
    minimum scatters from test to test, by one standard deviation of its logarithm. With a √r that
    is lower by `survived_if_lower_by` the column survives the pulse.
    """
    column = Column(**settings["column"])
    omega = settings["frequency_ratio"] * column.frequency_parameter
    unit, block = Pulse(settings["shape"], 1.0, angular_frequency=omega), column.block()
    stronger = {"frame": RockingFrame(column, settings["mass_ratio"]).block()}
    for reduction in settings["reductions"]:
        stronger[f"column, √r {reduction:.0%} lower"] = lowered(block, reduction)
    rows = []
    for name, frame in stronger.items():
        low, high = (lowest(structure, unit).factor for structure in (block, frame))
        pulse = unit.scaled(math.sqrt(low * high))
        fell = [solve(body, pulse).overturned for body, solve in product((block, frame), SOLVERS)]
        message = f"{pulse} overturns column and {name}, by two solvers: {fell}"
        check(fell == [True, True, False, False], message)
        survived = surviving_reduction(block, pulse)
        for scatter in settings["scatters"]:
            right = float(ndtr(0.5 * math.log(high / low) / scatter))
            rows.append(
                {
                    "other": name,
                    "minimum_of_column": low,
                    "minimum_of_other": high,
                    "pulse": pulse.amplitude,
                    "period": 2.0 * math.pi / omega,
                    "survived_if_lower_by": survived,
                    "scatter": scatter,
                    "repeats": repeats(right, settings["risk"]),
                }
            )
    return pd.DataFrame(rows)


def surviving_reduction(block, pulse):
    """Return the lowest reduction of √r, in steps of 1 %, with which a block survives a pulse."""

    def survives(reduction):
        fell = {solve(lowered(block, reduction), pulse).overturned for solve in SOLVERS}
        check(len(fell) == 1, f"the solvers disagree on √r lower by {reduction:g} under {pulse}")
        return fell == {False}

    return next(number / 100.0 for number in count(1) if survives(number / 100.0))


def repeats(right, risk):
    """Return the least odd number of repeats whose majority is wrong with a probability ≤ risk."""
    return next(n for n in count(1, 2) if bdtr(n // 2, n, right) <= risk)


def findings(test_plan):
    """Return the pulse between column and frame, and all repeats at the largest scatter."""
    rows = test_plan[test_plan.scatter == test_plan.scatter.max()]
    first, repeats = rows.iloc[0], rows.repeats.to_list()
    error = 1e-6 * first.pulse  # far above the width of the brackets of minima
    evidence = {"period": first.period, "scatter": first.scatter, "repeats": repeats}
    evidence |= {"survived_if_lower_by": first.survived_if_lower_by}
    return {"pulse": value(first.pulse, error, "g", **evidence)}


if __name__ == "__main__":
    run(snakemake, compute, findings)
