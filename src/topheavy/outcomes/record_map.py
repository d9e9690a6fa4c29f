"""Which similar structures a recorded ground motion overturns, over size and peak acceleration."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from topheavy import checks
from topheavy.bodies.structures import Column, Structure, as_block, solitary_size
from topheavy.checks import short
from topheavy.ground.records import Record
from topheavy.kernel.forcing import RECORD, prepare_record
from topheavy.kernel.grid import outcomes_of
from topheavy.kernel.taylor import oscillator
from topheavy.outcomes.overturning import outcomes_dataset

if TYPE_CHECKING:
    import xarray


def overturning_map_of_record(
    structure: Structure, record: Record, sizes: ArrayLike, peak_accelerations: ArrayLike
) -> xarray.Dataset:
    """Return which sizes of a structure a record overturns, and how far the others rock.

    All lengths of the structure change in proportion, so that its slenderness and restitution stay
    and its p goes with the size to the power −1/2. The time of the record is not scaled.

    Parameters
    ----------
    structure : RockingBlock, Column, RockingFrame, FixedMassColumn or MonolithicPortal
    record : Record
    sizes : array_like
        R in m, positive: half the diagonal of the column, or of each column of the structure. Of a
        block without a column, R = 3g/4p².
    peak_accelerations : array_like
        PGA to which the record is scaled, g, not negative.

    Returns
    -------
    xarray.Dataset
        peak_rotation (rad, NaN where overturned), overturned and impacts, over
        (size, peak_acceleration), with the frequency_parameter (p, rad/s) of each size. As of
        `judge`, but for what both leave out of the peak: it differs by 1e-10 α or so.

    Raises
    ------
    ValueError
        For a record that is none or has no acceleration, sizes that are not positive, and
        accelerations that are negative or beyond `checks.LARGEST_ACCELERATION`.

    Examples
    --------
    >>> record = th.read_record("data/records/el_centro_1940_NS.AT2")
    >>> found = th.overturning_map_of_record(th.Column(0.5, 3.0), record, [1.0, 3.0], [0.3, 0.9])
    >>> found.overturned.values
    array([[False,  True],
           [False, False]])
    """
    block = as_block(structure)
    if not isinstance(record, Record):
        raise ValueError(
            f"record is {short(record)}; expected a Record (overturning_map "
            "maps the pulses of a shape)"
        )
    peak = record.peak_acceleration
    if peak == 0.0:
        raise ValueError(
            f"record {record.name!r} has a peak acceleration of 0 g; expected a motion, as it is "
            "scaled to peak accelerations"
        )
    lengths = checks.axis("sizes", sizes, zero_allowed=False)
    accelerations = checks.axis("peak_accelerations", peak_accelerations, zero_allowed=True)
    checks.acceleration("the largest of peak_accelerations", accelerations.max())
    checks.cells("sizes by peak_accelerations", lengths.size, accelerations.size)
    column = structure if isinstance(structure, Column) else getattr(structure, "column", None)
    size = column.size if isinstance(column, Column) else solitary_size(block.frequency_parameter)
    frequencies = block.frequency_parameter * np.sqrt(size / lengths)
    outcomes = outcomes_of(
        oscillator(block),
        RECORD,
        frequencies * record.time_step,
        accelerations / peak,
        prepare_record(record.acceleration),
    )
    frequency = {"units": "rad/s", "long_name": "frequency parameter p"}
    acceleration = {"units": "g", "long_name": "peak ground acceleration"}
    return outcomes_dataset(
        block,
        outcomes,
        {
            "size": ("size", lengths, {"units": "m", "long_name": "size R of the column"}),
            "peak_acceleration": ("peak_acceleration", accelerations, acceleration),
            "frequency_parameter": ("size", frequencies, frequency),
        },
        record=record.name,
    )
