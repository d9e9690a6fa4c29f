"""Compute how much a cap beam raises the factor on the measured motions that overturns columns."""

import json
import sys
from pathlib import Path

import numpy as np
from judge import resampled, shown
from simulate import CONFIG, read

from topheavy import STANDARD_GRAVITY, Column, RockingFrame, fragility, overturned_by


def gains(tests, column, factors):
    """Return gains of a frame over its column in %, with 95 % intervals over the motions."""
    structures = [column, RockingFrame(column, CONFIG["mass_ratio"])]
    fell = np.array([overturned_by(structures, motion, factors) for motion in tests.shaking])
    lowest = np.where(fell.any(axis=2), factors[fell.argmax(axis=2)], np.nan)
    levels = np.geomspace(0.5, 2, 50) * np.nanmedian(lowest[:, 0] * tests.velocity)  # PGV, m/s
    curves = fragility(structures, [*tests.shaking], levels, resamples=CONFIG["resamples"])
    median = [100 * curves.pairs[name].item() for name in ("gain", "gain_low", "gain_high")]
    numbers = {"median": "{:.0f} ({:.0f} to {:.0f})".format(*median)}
    numbers["length"] = f"{(tests.velocity / tests.peak).median() / STANDARD_GRAVITY:.3f}"
    for name, largest in (("all", np.inf), ("few", CONFIG["largest_factor"])):
        ratio = np.log(lowest[:, 1] / lowest[:, 0])[lowest.max(axis=1) <= largest]
        means = resampled(len(ratio)) @ ratio[:, None] / len(ratio)
        numbers[name] = *shown(100 * np.expm1([ratio.mean()]), 100 * np.expm1(means)), len(ratio)
    return numbers


if __name__ == "__main__":
    column, factors = Column.of_dimensions(**CONFIG["column"]), np.geomspace(**CONFIG["factors"])
    tests, _ = read(sys.argv[1], **CONFIG["left_out"])
    order = tests.sort_values("peak").groupby("record")
    middle = order.apply(lambda tests: tests.iloc[len(tests) // 2])
    numbers = {"strongest": gains(order.last(), column, factors)}
    numbers["middle"] = gains(middle, column, factors)
    Path("results/columns.json").write_text(json.dumps(numbers))
