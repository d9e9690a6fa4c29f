"""Synthetic near-fault ground motions by the stochastic model of Dabaghi and Der Kiureghian.

A broadband motion is white noise, filtered with a variable frequency, modulated in time, and
high-pass filtered. A near-fault motion also contains a velocity pulse. Predictive equations, fitted
to recorded near-fault motions, give the random parameters for a given earthquake and site.

Sources
-------
[1] M. Dabaghi and A. Der Kiureghian (2017). Stochastic model for simulation of near-fault ground
    motions. Earthquake Eng. Struct. Dyn. 46(6), 963–984.
[2] M. Dabaghi and A. Der Kiureghian (2018). Simulation of orthogonal horizontal components of
    near-fault ground motion for specified earthquake source and site characteristics. Earthquake
    Eng. Struct. Dyn. 47(6), 1369–1393.
[3] G. P. Mavroeidis and A. S. Papageorgiou (2003). A mathematical representation of near-fault
    ground motions. Bull. Seismol. Soc. Am. 93(3), 1099–1131: the pulse that [1] modifies.
[4] NHERI-SimCenter/smelt on GitHub, commit 3c5ce76: src/dabaghi_der_kiureghian.cc and its header.
[5] J. Guo, Junjun1guo/SAPStructure on GitHub, commit 0e55c1e: nearFaultGroundMotionSimulation.py in
    auxiliaryModules/nearFaultGroundMotionSimulation_twoComponents.

We did not have the papers and cite [1] to [3] from memory. Every number of the model comes from two
public implementations that cite [1] and [2]: [4] and [5]. They have the same digits, here rounded
to five decimals, the correlations to four. Equations and tables have the numbers that [4] cites.
Comments mark differences between [4] and [5]. Of the two horizontal components of [2] we compute
the first: the one with the pulse, or the stronger one.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numba import njit
from numpy.typing import NDArray
from scipy.fft import irfft, next_fast_len, rfft, rfftfreq
from scipy.optimize import least_squares
from scipy.special import betaincinv, expit, logit, ndtr

from topheavy import STANDARD_GRAVITY, Record

TIME_STEP = 0.01
"""s. [4] and [5] take 0.005. The fastest filters drawn are near 20 Hz, well below 50 Hz."""

LOWEST_FREQUENCY = 0.3
"""Hz: the drifting frequency of the filter does not fall below. [4, 5]"""

FARTHEST = 2.0
"""Standard deviations: draws with an error beyond are drawn again. [4, 5]"""

HELD = 10
"""Time steps for which the frequency of the filter is held, so that it takes a tenth of the time.
It drifts by less than 0.1 Hz meanwhile."""

FORGOTTEN = 1e-5
"""The response of the filter to one impulse is followed until it has decayed to this."""

DIGITS = 9
"""Decimals of the normal values that are kept: BLAS differs between processors in the last bits, of
which, for one draw of six, the fit of the envelope would make another motion. Under AVX-512 so do
NumPy's exp, log, sin, cos and power: compiled functions take those of the C library instead."""

SMALL = math.sqrt(np.finfo(float).eps)
"""Step of the differences by which an envelope is fitted."""

Vector = NDArray[np.float64]

PULSE = ("Vp", "Tp", "gamma", "nu", "tp")
NOISE = ("Ia", "D5_95", "D0_5", "D0_30", "f_mid", "f_slope", "damping")
"""V_p cm/s, T_p s, γ, ν in half turns, time of the pulse's peak s; Arias intensity cm/s, times
between 5 and 95 %, 0 and 5 %, 0 and 30 % of it s, frequency Hz and its slope Hz/s, damping ratio.
"""


@dataclass(frozen=True)
class Scenario:
    """A strike-slip earthquake and a site, with the ranges of the data of [2], as checked in [5].

    The coefficients of reverse faulting are left out.

    Parameters
    ----------
    magnitude : float
        M, 5.5 to 7.9.
    distance : float
        R, from the site to the rupture, km: 0.07 to 31.
    site_velocity : float
        V_S30, m/s: 139 to 2016 (the model is flat beyond 1100).
    directivity : float
        The larger of s and d, km: how much of the rupture runs towards the site, 1.2 to 135.
    """

    magnitude: float
    distance: float
    site_velocity: float
    directivity: float

    def __post_init__(self) -> None:
        for name, (low, high) in {
            "magnitude": (5.5, 7.9),
            "distance": (0.07, 31.0),
            "site_velocity": (139.0, 2016.0),
            "directivity": (1.2, 135.0),
        }.items():
            value = getattr(self, name)
            if not low <= value <= high:
                raise ValueError(f"{name} is {value!r}; the model holds from {low} to {high}")

    def regressors(self) -> Vector:
        """Return what the coefficients multiply. [1, (12)]"""
        log_distance = math.log(math.hypot(self.distance, 6.0))
        return np.array(
            [
                1.0,
                self.magnitude,
                max(self.magnitude - 6.5, 0.0),  # so in [5]; not clipped in [4]
                log_distance,
                self.magnitude * log_distance,
                math.log(min(self.site_velocity, 1100.0)),
                self.directivity,
            ]
        )


@dataclass(frozen=True, eq=False)
class Model:
    """Predictive equations: means over the regressors, and correlated normal errors. [2]"""

    names: tuple[str, ...]
    coefficients: Vector
    deviations: Vector
    correlations: Vector

    def factor(self) -> Vector:
        """Return the Cholesky factor of the correlations, whose lower triangle is given."""
        full = np.eye(len(self.names))
        full[np.tril_indices(len(self.names), -1)] = self.correlations
        return np.linalg.cholesky(full)


# fmt: off
WITHOUT_PULSE = Model(
    NOISE,
    np.array([
        [ 8.09696,  1.00610, -1.39348, -4.85870, 0.47264, -0.86256, 0.0],
        [-1.03474,  0.76909,  0.0,      0.41224, 0.0, -0.42423, 0.0],
        [-4.72728,  0.70972,  0.0,      0.47097, 0.0,  0.0,     0.0],
        [-4.44400,  0.79809,  0.0,      0.34541, 0.0,  0.0,     0.0],
        [ 0.24713, -0.14921,  0.0,      0.0,     0.0,      0.37720, 0.0],
        [-1.44303,  0.22305,  0.0,      0.0,     0.0,      0.0,     0.0],
        [-0.38041,  0.15934,  0.0,     -0.29821, 0.0,      0.0,     0.0],
    ]),
    np.array([1.05272, 0.39843, 0.45683, 0.30573, 0.44752, 0.94129, 1.00768]),
    np.array([
        -0.1836,
         0.0890,  0.0854,
         0.1041,  0.3074,  0.8132,
         0.0143, -0.0150, -0.2254, -0.1629,
         0.2029, -0.1494,  0.0007, -0.0946, -0.1875,
        -0.1519,  0.0888, -0.0841, -0.0192, -0.1637, -0.0854,
    ]),
)
WITH_PULSE = Model(
    PULSE + NOISE,
    np.array([
        [ 1.69863,  0.60819, -0.60819, -0.57622, 0.0, -0.09393, 0.00657],
        [-2.47924,  0.67040,  0.0,      0.0,     0.0, -0.23255, 0.00792],
        [ 0.0,      0.0,      0.0,      0.0,     0.0,      0.0,     0.0],
        [ 0.0,      0.0,      0.0,      0.0,     0.0,      0.0,     0.0],
        [-4.24873,  0.85219,  0.0,      0.38960, 0.0, -0.08801, 0.0],
        [-2.11599,  1.47405, -1.37811, -1.07312, 0.0,  0.0,     0.0],
        [-0.38109,  0.73282,  0.0,      0.21650, 0.0, -0.42657, 0.0],
        [-5.56311,  0.90524,  0.0,      0.38515, 0.0,  0.0,     0.0],
        [-4.77682,  0.87998,  0.0,      0.31061, 0.0,  0.0,     0.0],
        [ 0.96671, -0.11094,  0.0,      0.0,     0.0,      0.18329, 0.0],
        [-2.16588,  0.32150,  0.0,      0.0,     0.0,      0.0,     0.0],
        [-1.70735,  0.43303,  0.0,     -0.41265, 0.0,      0.0,     0.0],
    ]),
    np.array([0.38532, 0.58060, 1.0, 1.0, 0.46860,
              0.78146, 0.37195, 0.44212, 0.39355, 0.40999, 0.82013, 1.09644]),
    np.array([
        -0.1758,
        -0.0203,  0.1834,
         0.1736,  0.0013, -0.1900,
         0.1911,  0.4316,  0.2428,  0.1192,
         0.4466, -0.0803,  0.1782, -0.0812,  0.0597,
         0.0422,  0.0984,  0.1072,  0.0912,  0.1637, -0.0244,
         0.0268,  0.3105,  0.1505,  0.0654,  0.7331,  0.0584,  0.0612,
         0.1200,  0.3682,  0.2364,  0.0718,  0.7887,  0.0857,  0.2454,  0.8552,
        -0.3822,  0.0510, -0.1140, -0.1336, -0.0313,  0.0784, -0.0247,  0.0120,  0.0299,
         0.0573,  0.0223,  0.0536, -0.0920, -0.1538,  0.0991, -0.2248, -0.0490, -0.0618, -0.2415,
         0.1551,  0.1752,  0.0642,  0.0299,  0.1261,  0.0265,  0.0459,  0.2000,  0.1978,  0.1125,
         0.1124,
    ]),
)
# fmt: on


def generator(seed: int, number: int) -> np.random.Generator:
    return np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(number,)))


def parameters(rng: np.random.Generator, scenario: Scenario, pulse: bool) -> dict[str, float]:
    """Return what is drawn for one motion, by the names in PULSE and NOISE, and its envelope."""
    model = WITH_PULSE if pulse else WITHOUT_PULSE
    means, factor = model.coefficients @ scenario.regressors(), model.factor()
    while True:
        errors = factor @ rng.standard_normal(len(means))
        if np.abs(errors).max() > FARTHEST:
            continue
        values = np.round(means + model.deviations * errors, DIGITS)
        normal = dict(zip(model.names, values, strict=True))
        numbers = {name: _MARGINALS.get(name, math.exp)(value) for name, value in normal.items()}
        if "Vp" in numbers and numbers["tp"] < numbers["gamma"] * numbers["Tp"] / 2.0:
            continue  # the pulse would begin before the motion [4, 5]
        shape = envelope(numbers["D0_5"], numbers["D0_30"], numbers["D0_5"] + numbers["D5_95"])
        return numbers | dict(zip(("rise", "decay", "peak"), shape, strict=True))


def _slope(value: float) -> float:
    """Return f′ in Hz/s of a standard normal value: two exponentials back to back. [1, Table 5]"""
    above, below, height, least = 14.29355, 6.40242, 4.42180, -3.5
    share = float(ndtr(value))
    negative = height / below * (1.0 - math.exp(below * least))
    if share <= negative:
        return math.log(share * below / height + math.exp(below * least)) / below
    return -math.log(1.0 - (share - negative) * above / height) / above


_MARGINALS = {  # of standard normal values; the others are lognormal [1, Table 5]
    "gamma": lambda value: 2.0 + 1.2 * float(betaincinv(1.30326, 3.96858, ndtr(value))),
    "nu": lambda value: 2.0 * float(ndtr(value)),
    "f_slope": _slope,
    "damping": lambda value: math.exp(4.7 * float(betaincinv(5.33552, 3.82955, ndtr(value))) - 4.7),
}


def envelope(t5: float, t30: float, t95: float) -> tuple[float, float, float]:
    """Return α, β and t_max of the modulating function from the times of 5, 30 and 95 % Arias.

    The function is (t/t_max)^α up to t_max and exp(−β (t − t_max)) after it. [1, (4)] As in [4]
    and [5] the sum of the squared misfits is least, with 0.01 ≤ α ≤ 10 of [5]. It is zero for
    about four draws of five; the intensity of the others grows too abruptly, or too evenly.
    """

    def shape(free: Vector) -> tuple[float, float, float]:
        rise = 0.01 * 1000.0 ** float(expit(free[0]))
        return rise, math.exp(free[1]), math.exp(free[2])

    def misfit(free: Vector) -> Vector:
        return times_of((0.05, 0.30, 0.95), *shape(free)) - (t5, t30, t95)

    def slopes(free: Vector) -> Vector:
        # SciPy's own differences to the last bit; all that it asks before each takes twice the time
        value, ahead = misfit(free), free + SMALL * np.copysign(np.maximum(1.0, np.abs(free)), free)
        moved = np.where(np.eye(3, dtype=bool), ahead, free)
        return np.transpose([misfit(x) - value for x in moved]) / (ahead - free)

    start = [float(logit(0.7)), math.log(2.0 / t95), math.log(t30)]
    return shape(least_squares(misfit, start, slopes, method="lm", xtol=1e-10).x)


@njit(cache=True)
def times_of(shares, rise, decay, peak):
    """Return the times in s by which these shares of the intensity of an envelope are reached."""
    before, after = peak / (2.0 * rise + 1.0), 0.5 / decay
    top = before / (before + after)
    times = np.empty(len(shares))
    for k, share in enumerate(shares):
        if share < top:
            times[k] = peak * (share / top) ** (1.0 / (2.0 * rise + 1.0))
        else:
            times[k] = peak - after * math.log((1.0 - share) / (after / (before + after)))
    return times


def motion(seed: int, number: int, scenario: Scenario, *, pulse: bool) -> Record:
    """Return motion `number`: noise filtered, modulated, high-passed and scaled, and its pulse.

    It depends on the seed, the number and the scenario, and on nothing else. The same seed under
    another scenario gives the same noise, filtered otherwise. Without a pulse it is the stronger
    of the two horizontal components, with a pulse the one that holds it.
    """
    rng = generator(seed, number)
    numbers = parameters(rng, scenario, pulse)
    time = np.arange(math.ceil(2.5 * (numbers["D0_5"] + numbers["D5_95"]) / TIME_STEP)) * TIME_STEP
    noise = filtered(rng.standard_normal(time.size), frequency(time, numbers), numbers["damping"])
    corner = 10.0 ** (1.4071 - 0.3452 * scenario.magnitude)  # Hz [4, 5]
    shape = modulation(time, numbers["rise"], numbers["decay"], numbers["peak"])
    shaking, before = high_passed(noise * shape, corner)
    shaking *= math.sqrt(numbers["Ia"] / 100.0 / arias_intensity(shaking))
    if pulse:
        shaking[before : before + time.size] += pulse_acceleration(time, numbers)
    return Record(
        TIME_STEP, shaking, f"{'near fault' if pulse else 'broadband'} {seed}:{number}", unit="g"
    )


@njit(cache=True)
def modulation(time, rise, decay, peak):
    """Return the modulating function at these times, 1 at its peak. [1, (4)]"""
    values = np.empty(time.size)
    for k, now in enumerate(time):
        values[k] = min(now / peak, 1.0) ** rise * math.exp(-decay * max(now - peak, 0.0))
    return values


def frequency(time: Vector, numbers: dict[str, float]) -> Vector:
    """Return the frequency of the filter in Hz: linear between 1 and 99 % Arias, then constant."""
    start, middle, end = times_of(
        (0.01, 0.30, 0.99), numbers["rise"], numbers["decay"], numbers["peak"]
    )
    drift = numbers["f_slope"] * (np.clip(time, start, end) - middle)
    return np.maximum(numbers["f_mid"] + drift, LOWEST_FREQUENCY)


@njit(cache=True)
def filtered(noise, frequency, damping):
    """Return white noise through the filter, of unit variance at every time but the first.

    Each sample of the noise sets off the response of a damped oscillator with the frequency of
    that time. [1] The samples of HELD steps share one frequency, so that one recursion
    gives their common response; h² is summed over a window as long, for the variance.
    """
    response = np.zeros(noise.size)
    variance = np.zeros(noise.size)
    free = math.sqrt(1.0 - damping * damping)
    for start in range(0, noise.size, HELD):
        angle = 2.0 * math.pi * frequency[start] * TIME_STEP
        decay = math.exp(-damping * angle)
        twice, squared = 2.0 * decay * math.cos(free * angle), decay * decay
        first = angle / free * decay * math.sin(free * angle)  # h one step after an impulse
        stop = min(start + HELD, noise.size)
        last = min(stop + 1 + int(-math.log(FORGOTTEN) / (damping * angle)), noise.size)
        now, before = 0.0, 0.0  # the response, and h as it enters and leaves the window
        enters, enters_before = first, 0.0
        leaves, leaves_before = 0.0, 0.0
        window = 0.0
        for k in range(start + 1, last):
            now, before = twice * now - squared * before, now
            if k <= stop:
                now += first * noise[k - 1]
            response[k] += now
            window += enters * enters - leaves * leaves
            variance[k] += window
            enters, enters_before = twice * enters - squared * enters_before, enters
            leaves, leaves_before = twice * leaves - squared * leaves_before, leaves
            if k == stop:
                leaves = first
    for k in range(1, noise.size):  # an array's division takes 3 s to compile
        response[k] /= math.sqrt(variance[k])
    return response


def high_passed(motion: Vector, corner: float) -> tuple[Vector, int]:
    """Return a motion between zeros, high-passed, and how many samples the zeros before it are.

    A zero-phase Butterworth filter of order 4. [4, 5] It leaves no final velocity and next to no
    displacement.
    """

    def gain(ratio: Vector) -> Vector:
        power = np.square(np.square(np.square(ratio)))
        return np.sqrt(power / (1.0 + power))

    return between_zeros(motion, corner, gain)


def between_zeros(
    motion: Vector, corner: float, gain: Callable[[Vector], Vector]
) -> tuple[Vector, int]:
    """Return a motion times a gain of f/corner, between zeros, and how many are before it.

    The zeros on either side last 1.5 · 4 / 2 periods of the corner frequency. [4, 5]
    """
    zeros = math.ceil(3.0 / corner / TIME_STEP)
    size = next_fast_len(motion.size + 2 * zeros, real=True)
    padded = np.zeros(size)
    padded[zeros : zeros + motion.size] = motion
    gains = gain(rfftfreq(size, TIME_STEP) / corner)
    return irfft(rfft(padded) * gains, size), zeros


def pulse_acceleration(time: Vector, numbers: dict[str, float]) -> Vector:
    """Return the acceleration of the pulse in g: that of [3], less what would displace. [1]

    Its velocity is {V_p/2 cos(2π(t − t_p)/T_p + ν) − D_r/(γT_p)} {1 + cos(2π(t − t_p)/(γT_p))}
    for |t − t_p| ≤ γT_p/2, and D_r is the displacement that the first term alone would leave.
    """
    turns = (time - numbers["tp"]) / numbers["Tp"]
    slope = _pulse_slope(turns, math.pi * numbers["nu"], numbers["gamma"])
    return numbers["Vp"] / 100.0 * slope * 2.0 * math.pi / numbers["Tp"] / STANDARD_GRAVITY


@njit(cache=True)
def _pulse_slope(turns, phase, cycles):
    """Return the slope of the velocity over V_p, a period being 2π long, at these turns."""
    left = math.sin(phase + cycles * math.pi) - math.sin(phase - cycles * math.pi)
    offset = left / (4.0 * math.pi * cycles) / (1.0 - cycles**2)  # D_r/(γT_p V_p)
    slope = np.zeros(turns.size)
    for k, turn in enumerate(turns):
        if abs(turn) <= cycles / 2.0:
            wave, bell = 2.0 * math.pi * turn + phase, 2.0 * math.pi * turn / cycles
            slope[k] = -0.5 * math.sin(wave) * (1.0 + math.cos(bell))
            slope[k] -= (0.5 * math.cos(wave) - offset) * math.sin(bell) / cycles
    return slope


# ---------------------------------------------------------------------------- measures


def arias_intensity(acceleration: NDArray) -> float:
    """Return π g/2 ∫ a² dt with samples of a in g: m/s."""
    energy = float(np.square(acceleration).sum()) * TIME_STEP
    return math.pi / 2.0 * STANDARD_GRAVITY * energy
