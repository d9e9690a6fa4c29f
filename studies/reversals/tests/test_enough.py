"""How much is enough, in closed form."""

import math

import pytest

from steps.shared.spectra_compared import Place
from steps.shared.spectrum import search
from studies.reversals.steps.enough import mass_ratio, size_gain_needed, size_gain_of_frequency_gain
from topheavy import Column, RockingFrame

COLUMN = Column(1.0, 4.0)
AMPLITUDES = {"amplitudes": {"lowest": 1.0, "highest": 12.0, "resolution": 0.05}}


@pytest.mark.parametrize("share", [0.0, 0.3, 0.9, 1.0])
def test_mass_ratio_brings_its_share_of_the_gain_in_size(share):
    size = RockingFrame(COLUMN, mass_ratio(share)).equivalent_size
    assert size / COLUMN.size - 1.0 == pytest.approx(0.5 * share)


@pytest.mark.parametrize("share", [0.0, 0.3, 0.9, 1.0])
def test_mass_ratio_brings_its_share_of_the_gain_in_frequency(share):
    gamma = mass_ratio(min(1.0, size_gain_of_frequency_gain(share)))
    fall = 1.0 - RockingFrame(COLUMN, gamma).frequency_parameter / COLUMN.frequency_parameter
    assert fall == pytest.approx(share * (1.0 - math.sqrt(2.0 / 3.0)))


def test_size_gain_that_is_needed_brings_the_amplitude_that_is_asked_for():
    place = Place(14.0, "one-sine", False, 4.0)

    def lowest(gamma):
        return search(place.line(gamma), (1.0, 12.0), 0.05)[0].lower[0]

    ends = lowest(0.0), lowest(math.inf)
    needed = size_gain_needed(place, 0.5, ends, AMPLITUDES)
    assert lowest(mass_ratio(needed)) == pytest.approx(0.5 * sum(ends), rel=1e-5)
