"""The kernel as the benchmark runs it, on one thread: many histories in lanes, or one at a time."""

from typing import NamedTuple

import numpy as np

from topheavy.kernel.compiled import compiled
from topheavy.kernel.forcing import (
    NO_RECORD,
    RECORD,
    SHAPES,
    prepare_record,
    pulse_forcing,
    record_forcing,
)
from topheavy.kernel.grid import mixed_outcomes_of, outcomes_of, pulse_outcomes_of, record_order
from topheavy.kernel.outcome import NO_RATIOS, PULSE_ORDER, TOLERANCE, outcome, working_array
from topheavy.kernel.taylor import oscillator

#: Factors on a record, the middle one of which is 1; the others shake a block as much.
FACTORS = np.linspace(0.9, 1.1, 129)


class Found(NamedTuple):
    """The outcome of the block; the peak is NaN if it overturned."""

    overturned: bool
    peak: float
    impacts: int


def histories(block, shape, amplitudes, frequencies, tolerance=TOLERANCE):
    """Return the rows overturned, peak and impacts of all pairs of an amplitude and a frequency."""
    pairs = (np.asarray(values, float)[:, np.newaxis] for values in (frequencies, amplitudes))
    found = pulse_outcomes_of(
        oscillator(block), SHAPES[shape], *pairs, tolerance=tolerance, threads=1
    )
    peak, overturned, impacts = (values[:, 0] for values in found)
    return np.array([overturned, peak, impacts], dtype=float)


@compiled(nogil=True)
def _scalar_histories(block, shape, amplitudes, frequencies, order, tolerance, found):
    w = working_array()
    for i in range(amplitudes.size):
        forcing = pulse_forcing(shape, amplitudes[i], frequencies[i])
        one = outcome(w, order, tolerance, block, forcing, NO_RECORD, NO_RATIOS)
        found[0, i], found[1, i], found[2, i] = one.overturned, one.peak, one.impacts


def scalar_histories(block, shape, amplitudes, frequencies, tolerance=TOLERANCE):
    """Return the same by the scalar kernel."""
    found = np.empty((3, len(amplitudes)))
    given = (np.asarray(amplitudes, float), np.asarray(frequencies, float))
    _scalar_histories(oscillator(block), SHAPES[shape], *given, PULSE_ORDER, tolerance, found)
    return found


class KernelRecord:
    """The kernel under one record times `FACTORS`, samples p Δt = `step` apart."""

    histories = FACTORS.size

    def __init__(self, block, samples, step, tolerance):
        self.block, self.tolerance = oscillator(block), tolerance
        self.record, self.step = prepare_record(samples), np.array([step])

    def __call__(self):
        given = (self.block, RECORD, self.step, FACTORS, self.record)
        peak, overturned, impacts = outcomes_of(*given, tolerance=self.tolerance, threads=1)
        middle = (0, FACTORS.size // 2)
        return Found(bool(overturned[middle]), float(peak[middle]), int(impacts[middle]))


@compiled(nogil=True)
def _scalar_factors(w, block, step, factors, record, order, tolerance, found):
    for i in range(factors.size):
        forcing = record_forcing(record, step, factors[i])
        one = outcome(w, order, tolerance, block, forcing, record, NO_RATIOS)
        found[0, i], found[1, i], found[2, i] = one.overturned, one.peak, one.impacts


class ScalarRecord(KernelRecord):
    """The scalar kernel under the same histories."""

    def __call__(self):
        found = scalar_factors(
            self.block, float(self.step[0]), FACTORS, self.record, self.tolerance
        )
        overturned, peak, impacts = found[:, FACTORS.size // 2]
        return Found(bool(overturned), float(peak), int(impacts))


def scalar_factors(block, step, factors, record, tolerance=TOLERANCE):
    """Return the rows overturned, peak and impacts under factors on a record."""
    found = np.empty((3, factors.size))
    order = record_order(step, tolerance)
    _scalar_factors(working_array(), block, step, factors, record, order, tolerance, found)
    return found


def together(blocks, scales, which, factors, record):
    """Judge histories of several blocks on one thread; factors are on both of two records."""
    given = (blocks, RECORD, which, scales[which], factors, record)
    return mixed_outcomes_of(*given, lifts=factors, threads=1)
