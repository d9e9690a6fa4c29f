"""Compute how much a cap beam raises the factor on the measured motions that overturns columns."""

import json
import sys
from pathlib import Path

import numpy as np
from judge import shown
from simulate import CONFIG, read

from topheavy import STANDARD_GRAVITY, Column, RockingFrame, fragility, overturned_by


def chosen(tests, usual):
    """Return for each record the place of its strongest usual test, and of its middle test."""
    order = tests.sort_values("peak")
    is_usual = (order.peak / order.nominal_pga_g).between(*usual)
    middle = order.groupby("record").test.apply(lambda group: group.index[len(group) // 2])
    return {"strongest": order[is_usual].groupby("record").tail(1).index, "middle": middle}


def gains(motions, config):
    """Return gains of a frame over its column in %, with 95 % intervals over the motions."""
    column, factors = Column.of_dimensions(**config["column"]), np.geomspace(**config["factors"])
    structures = [column, RockingFrame(column, config["mass_ratio"])]
    fell = np.array([overturned_by(structures, motion, factors) for motion in motions])
    lowest = np.where(fell.any(axis=2), factors[fell.argmax(axis=2)], np.nan)
    velocity = np.array([motion.peak_velocity for motion in motions])
    length = np.median(velocity / [motion.peak_acceleration for motion in motions])
    levels = np.geomspace(0.5, 2, 50) * np.nanmedian(lowest[:, 0] * velocity)  # PGV, m/s
    pair = fragility(structures, motions, levels, resamples=config["resamples"]).pairs.isel(pair=0)
    median = [100 * pair[name].item() for name in ("gain", "gain_low", "gain_high")]
    numbers = {"median": "{:.0f} ({:.0f} to {:.0f})".format(*median)}
    numbers["length"] = f"{length / STANDARD_GRAVITY:.3f}"
    for name, largest in (("all", np.inf), ("few", config["largest_factor"])):
        ratio = np.log(lowest[:, 1] / lowest[:, 0])[lowest.max(axis=1) <= largest]
        resamples = np.random.default_rng(config["seed"]).choice(
            ratio, (config["resamples"], len(ratio))
        )
        means = (100 * np.expm1(each.mean(axis=-1)) for each in (ratio, resamples))
        numbers[name], numbers[f"{name}_motions"] = shown(*means), len(ratio)
    return numbers


if __name__ == "__main__":
    tests, motions, _ = read(sys.argv[1], **CONFIG["left_out"])
    places = chosen(tests, CONFIG["usual"])
    numbers = {name: gains([motions[k] for k in each], CONFIG) for name, each in places.items()}
    Path("results/columns.json").write_text(json.dumps(numbers, indent=1))
