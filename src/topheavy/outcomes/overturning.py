"""Overturning maps: of pulses over frequency and amplitude, of a record over size and PGA."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from topheavy import checks
from topheavy.bodies.structures import Column, Structure, as_block, solitary_size
from topheavy.ground.pulses import checked_shape
from topheavy.ground.records import Record
from topheavy.ground.shapes import FiniteShape
from topheavy.kernel.forcing import pulse_waveform
from topheavy.kernel.grid import outcomes_of
from topheavy.kernel.taylor import oscillator
from topheavy.outcomes.simulate import Shaking

if TYPE_CHECKING:
    import xarray


def overturning_map(
    structure: Structure, motion: FiniteShape | Record, scales: ArrayLike, amplitudes: ArrayLike
) -> xarray.Dataset:
    """Return which pulses or records overturn a structure, and its peak rotation under the others.

    Pulses have frequencies and amplitudes. A record is scaled to peak accelerations, and the
    structure in size: slenderness and restitution remain, p is proportional to R to the power −1/2.

    Parameters
    ----------
    structure : Structure
    motion : str or Record
        A shape of `Pulse` that ends ("harmonic" does not), or a record.
    scales : array_like
        Of a pulse, ω in rad/s; under a record, R in m: half the diagonal of the column, or of each
        column of the structure. Of a block without a column, R = 3g/4p². Positive.
    amplitudes : array_like
        Of the pulse, or the peak of the record, in g; not negative.

    Returns
    -------
    xarray.Dataset
        peak_rotation (rad, NaN where overturned), overturned and number_of_impacts, over
        (angular_frequency, amplitude) or (size, peak_acceleration). The peaks equal those of
        `judge` to about 1e-10 α.

    Examples
    --------
    >>> outcomes = th.overturning_map(th.Column(0.5, 3.0), "one-sine", [2.0, 4.0], [0.2, 0.4, 0.8])
    >>> outcomes.overturned.values
    array([[ True,  True,  True],
           [False,  True,  True]])
    >>> record = th.read_record("data/records/el_centro_1940_NS.AT2")
    >>> outcomes = th.overturning_map(th.Column(0.5, 3.0), record, [1.0, 3.0], [0.3, 0.9])
    >>> outcomes.overturned.values
    array([[False,  True],
           [False, False]])
    """
    import xarray

    block = as_block(structure)
    p = block.frequency_parameter
    unit = "m" if isinstance(motion, Record) else "rad/s"
    axis = checks.axis_values("scales", scales, unit)
    accelerations = checks.axis_values("amplitudes", amplitudes, "g", zero_allowed=True)
    checks.number_of_cells("scales by amplitudes", axis.size, accelerations.size)
    if isinstance(motion, Record):
        if (peak := motion.peak_acceleration) == 0.0:
            raise ValueError(
                f"record {motion.name!r} has a peak acceleration of 0 g; expected a motion, as it "
                "is scaled to peak accelerations"
            )
        column = structure if isinstance(structure, Column) else getattr(structure, "column", None)
        size = column.size if isinstance(column, Column) else solitary_size(p)
        frequencies = p * np.sqrt(size / axis)
        waveform, factors = Shaking.of(motion).waveform, accelerations / peak
        rows = frequencies * motion.time_step
        dims = "size", "peak_acceleration"
        axes = {
            "size": ("size", axis, {"units": "m", "long_name": "size R of the column"}),
            "peak_acceleration": (
                "peak_acceleration",
                accelerations,
                {"units": "g", "long_name": "peak ground acceleration"},
            ),
            "frequency_parameter": ("size", frequencies, {"units": "rad/s"}),
        }
        attributes: dict[str, str | float] = {"record": motion.name}
    else:
        if checked_shape(motion) == "harmonic":
            raise ValueError(
                "motion is 'harmonic', which goes on forever; expected a pulse that ends"
            )
        waveform, factors, rows = pulse_waveform(motion), accelerations, axis / p
        dims = "angular_frequency", "amplitude"
        axes = {
            "angular_frequency": ("angular_frequency", axis, {"units": "rad/s"}),
            "amplitude": ("amplitude", accelerations, {"units": "g"}),
        }
        attributes = {"shape": motion, "frequency_parameter": p}
    cells = np.repeat(rows, factors.size), np.tile(factors, rows.size)
    block_index = np.zeros(cells[0].size, np.int64)
    peak_rotation, overturned, number_of_impacts = (
        values.reshape(rows.size, factors.size)
        for values in outcomes_of([oscillator(block)], waveform, block_index, *cells)
    )
    return xarray.Dataset(
        {
            "peak_rotation": (dims, peak_rotation, {"units": "rad", "long_name": "largest |θ|"}),
            "overturned": (dims, overturned, {"units": "1"}),
            "number_of_impacts": (dims, number_of_impacts, {"units": "1"}),
        },
        coords=axes,
        attrs=attributes
        | {
            "slenderness": block.slenderness,
            "restitution": block.restitution,
            "linearised": int(block.linearised),
        },
    )
