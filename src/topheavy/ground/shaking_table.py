"""A frame on a shake table that moves as u = u₀ sin 2πft, as in Peña et al. (2008)."""

import math

from topheavy import checks
from topheavy.bodies.structures import STANDARD_GRAVITY, Structure
from topheavy.ground.pulses import Pulse


def table_acceleration(amplitude: float, frequency: float) -> float:
    """Return the peak acceleration u₀ (2πf)², in g, of u₀ in m and f in Hz (p. 4)."""
    angular = 2.0 * math.pi * checks.positive("frequency", frequency, "Hz")
    return checks.positive("amplitude", amplitude, "m") * angular**2 / STANDARD_GRAVITY


def table_motion(amplitude: float, frequency: float) -> Pulse:
    """Return the steady acceleration of the shake table, −u₀ (2πf)² sin 2πft, from t = 0 on."""
    return Pulse("harmonic", -table_acceleration(amplitude, frequency), 2.0 * math.pi * frequency)


def abrupt_start(structure: Structure, amplitude: float, frequency: float) -> float:
    """Return θ̇ (rad/s) at t = 0⁺ of a structure whose shake table starts at full velocity.

    A displacement u₀ sin 2πft starts with the velocity 2πf u₀. This jump is an infinite
    acceleration, which uplifts the structure for every u₀. Integration of Eq. (23) over the jump at
    θ = 0 gives θ̇ = −p̂² cos α (2πf u₀)/g.
    """
    block = structure.block()
    jump = 2.0 * math.pi * frequency * amplitude
    lever = 1.0 if block.linearised else math.cos(block.slenderness)
    return -(block.frequency_parameter**2) * lever * jump / STANDARD_GRAVITY


def amplitude_to_uplift(structure: Structure, frequency: float) -> float:
    """Return the u₀ (m) whose peak acceleration at f (Hz) is the uplift acceleration."""
    return structure.block().uplift_acceleration / table_acceleration(1.0, frequency)


def frequency_to_uplift(structure: Structure, amplitude: float) -> float:
    """Return the f (Hz) at which the peak acceleration of u₀ (m) is the uplift acceleration."""
    return math.sqrt(structure.block().uplift_acceleration / table_acceleration(amplitude, 1.0))
