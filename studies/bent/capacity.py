"""Compute and draw capacities of a frame and its column on records, and fragility under motions."""

import json
import warnings
from glob import glob
from itertools import product
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import yaml

import topheavy as th


def made(key, section, function, *values):
    """Return what a function makes of a section of the config; if it refuses, stop with the key."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error", UserWarning)  # of a doubtful unit, for instance
            return function(*values, **section)
    except (TypeError, ValueError, OSError, UserWarning) as error:
        raise SystemExit(f"config.yaml: {key}: {error}") from None


def structures(config, share):
    """Return the blocks of the column and the frame, √r of each times a share."""
    column = made("column", config["column"], th.Column.of_dimensions)
    frame = made("beam", config["beam"], th.RockingFrame.of_masses, column)
    two = ("column", column), ("frame", frame)
    return {key: made("restitution", {}, body.block, share * body.restitution) for key, body in two}


def capacities(config):
    """Return the capacity of each structure, by record and share of √r."""
    results, shares = {}, made("restitution", {}, list, config["restitution"])
    for (name, section), share in product(config["records"].items(), shares):
        record, pair = made(f"records: {name}", section, th.read_record), structures(config, share)
        results[name, share] = {key: th.capacity(block, record) for key, block in pair.items()}
    return results


def fragilities(config):
    """Return the fragility of pair structures under the set of motions, by share of √r."""
    section, levels = dict(config["motions"]), made("levels", config["levels"], np.geomspace)
    paths = sorted(glob(section.pop("paths")))
    motions = [made(f"motions: {path}", section, th.read_record, path) for path in paths]
    sets = {share: (structures(config, share), motions, levels) for share in config["restitution"]}
    return {share: made("levels", {}, th.fragility, *values) for share, values in sets.items()}


def numbers(capacities, fragilities, scale):
    """Return the numbers of the text; None where one is unknown."""
    rows, sets, scale = [], [], made("scale", {}, float, scale)
    for (name, share), pair in capacities.items():
        row = {key: known(result.factor, *result.range) for key, result in pair.items()}
        factors, fell = pair["frame"].factors, pair["frame"].overturned
        is_covered = fell.any() or scale <= factors[-1]
        row["survives"] = not fell[factors <= scale].any() if is_covered else None
        row["gain"] = known(pair["frame"].factor / pair["column"].factor)
        rows.append(row | {"record": name, "share": share})
    for share, result in fragilities.items():
        gain = [1.0 + float(result.pairs[f"gain{end}"][0]) for end in ("", "_low", "_high")]
        sets.append({"share": share, "motions": len(result.outcomes), "gain": known(*gain)})
    return {"capacities": rows, "sets": sets}


def known(*values):
    return [*values] if np.isfinite(values).all() else None


if __name__ == "__main__":
    config = yaml.safe_load(Path("config.yaml").read_text())
    results, curves = capacities(config), fragilities(config)
    Path("results/numbers.json").write_text(json.dumps(numbers(results, curves, config["scale"])))
    figure, (top, low) = plt.subplots(2, figsize=(6.3, 4.5), layout="constrained")
    (case, pair), *_ = results.items()
    for key, result in pair.items():
        th.plot.capacity(result, label=f"{key}, {case[0]}, {case[1]} √r", axes=top)
    th.plot.fragility(curves[case[1]], axes=low).set_title(f"Set of motions, {case[1]} √r")
    figure.savefig("results/capacity.svg", metadata={"Date": None})
