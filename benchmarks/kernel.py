"""Run the Taylor solver one history at a time on one thread, like the other solvers."""

import numpy as np
from numba import njit

from topheavy.kernel.forcing import (
    NO_RECORD,
    SHAPES,
    prepare_record,
    pulse_forcing,
    record_forcing,
)
from topheavy.kernel.grid import record_order
from topheavy.kernel.outcome import PULSE_ORDER, TOLERANCE, outcome, working_array
from topheavy.kernel.taylor import oscillator


@njit(cache=True, nogil=True, error_model="numpy")
def _histories(block, shape, amplitudes, frequencies, order, tolerance, found):
    w = working_array()
    for i in range(amplitudes.size):
        forcing = pulse_forcing(shape, amplitudes[i], frequencies[i])
        one = outcome(w, order, tolerance, block, forcing, NO_RECORD)
        found[0, i], found[1, i], found[2, i] = one.overturned, one.peak, one.impacts


def histories(block, shape, amplitudes, frequencies, tolerance=TOLERANCE, order=PULSE_ORDER):
    """Return the rows overturned, peak and impacts of all pairs of an amplitude and a frequency."""
    found = np.empty((3, len(amplitudes)))
    given = (np.asarray(amplitudes, float), np.asarray(frequencies, float))
    _histories(oscillator(block), SHAPES[shape], *given, order, tolerance, found)
    return found


class KernelRecord:
    """The kernel under one record, samples p Δt = `step` apart."""

    def __init__(self, block, samples, step, tolerance):
        self.record, self.tolerance = prepare_record(samples), tolerance
        self.block, self.forcing = oscillator(block), record_forcing(self.record, step, 1.0)
        self.order, self.w = record_order(step, tolerance), working_array()

    def __call__(self):
        return outcome(self.w, self.order, self.tolerance, self.block, self.forcing, self.record)
