"""A test of one inequality: a pulse that overturns the column and not the frame, and repeats."""

import math
from itertools import count

import pandas as pd
from scipy.special import bdtr, ndtr

from replication.step import check, run, value
from steps.shared import plain
from steps.shared.cases import lowest
from topheavy import Column, Pulse, RockingFrame, judge

SOLVERS = judge, plain.judge


def compute(settings):
    """Return for each pair of minima the pulse between them, and the repeats that tell them apart.

    The second of a pair has the higher minimum: the frame, or the column with a lower √r. The
    minimum scatters from test to test, by one standard deviation of its logarithm. With a √r that
    is lower by `survived_if_lower_by` the column survives the pulse.
    """
    column = Column(**settings["column"])
    omega = settings["frequency_ratio"] * column.frequency_parameter
    unit, alone = Pulse(settings["shape"], 1.0, angular_frequency=omega), column.block()
    others = {"frame": RockingFrame(column, settings["mass_ratio"]).block()}
    for reduction in settings["reductions"]:
        lower = alone.with_restitution(alone.restitution * (1.0 - reduction))
        others[f"column, √r {reduction:.0%} lower"] = lower
    rows = []
    for name, other in others.items():
        low, high = (lowest(block, unit).factor for block in (alone, other))
        pulse = unit.scaled(math.sqrt(low * high))
        fell = [solve(block, pulse).overturned for block in (alone, other) for solve in SOLVERS]
        check(fell == [True, True, False, False], f"{name}, {pulse}: overturned {fell}")
        survived = surviving_reduction(alone, pulse)
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
        lower = block.with_restitution(block.restitution * (1.0 - reduction))
        fell = {solve(lower, pulse).overturned for solve in SOLVERS}
        check(len(fell) == 1, f"the solvers disagree on √r lower by {reduction:g} under {pulse}")
        return fell == {False}

    return next(number / 100.0 for number in count(1) if survives(number / 100.0))


def repeats(right, risk):
    """Return the least odd number of repeats whose majority is wrong with at most a risk."""
    return next(n for n in count(1, 2) if bdtr(n // 2, n, right) <= risk)


def findings(test_plan):
    """Return the pulse between column and frame, and the repeats of all pairs, widest scatter."""
    rows = test_plan[test_plan.scatter == test_plan.scatter.max()]
    first, repeats = rows.iloc[0], rows.repeats.to_list()
    error = 1e-6 * first.pulse  # far above the width of the brackets of minima
    more = {"period": first.period, "scatter": first.scatter, "repeats": repeats}
    more |= {"survived_if_lower_by": first.survived_if_lower_by}
    return {"pulse": value(first.pulse, error, "g", **more)}


if __name__ == "__main__":
    run(snakemake, compute, findings)
