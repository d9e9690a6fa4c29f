"""Structures and records of a study, from their entries in its config."""

import warnings
from pathlib import Path
from typing import Any

import numpy as np

from replication.step import stop
from topheavy import Column, Record, RockingFrame, read_record


def structure(entry: dict[str, Any]) -> Column | RockingFrame:
    """Return the column, or the frame, of an entry of `structures`."""
    column = Column.of_dimensions(width=entry["width"], height=entry["height"])
    if entry["columns"] == 1:
        return column
    return RockingFrame.of_masses(column, entry["cap_mass"], entry["column_mass"], entry["columns"])


def motion(entry: dict[str, Any]) -> Record:
    """Return the record of an entry of `records`; what its reader warns of stops the step."""
    path = entry["file"]
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            if Path(path).suffix.lower() in (".at2", ".csv"):
                return read_record(path)
            time, acceleration = np.loadtxt(
                path, skiprows=entry["skip"], usecols=(0, 1), unpack=True
            )
            step = (time[-1] - time[0]) / (len(time) - 1)
            if abs(np.diff(time) - step).max() > 0.01 * step:
                stop(f"{path}: expected times in equal steps of {step:.6g} s")
            return Record(step, acceleration, name=entry["name"], unit=entry["unit"])
    except (ValueError, UserWarning) as fault:
        stop(f"{path}, unit {entry['unit']}, below `skip: {entry['skip']}` lines: {fault}")
