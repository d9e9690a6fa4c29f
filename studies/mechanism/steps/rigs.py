"""The structures put before the engine, and what is read off their motion there."""

import math
from collections.abc import Callable, Iterator, Mapping
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from replication import workbench
from studies.mechanism.steps.engine import Array, Contact, Motion, Rig, leaning, raised_energy, run
from studies.mechanism.steps.setting import cap_of
from topheavy import Cap, Column, Pulse, RockingFrame, minimum_overturning, simulate

NO_ENGINE = (
    "needs the optional group `engine` (MuJoCo), which is not installed: "
    "run `make reproduce`, or `uv run --group engine snakemake --cores 2`; "
    "with pip or conda, `pip install -r requirements.txt`"
)

FALLEN = math.pi / 3  # rad, from where no pulse brings a column back; the cap is still aloft
FREE = 20.0  # over p̂: how long a verdict is waited for after a pulse
HIGHEST = 40.0  # over g tan α: end of the search for the minimum overturning amplitude
STEPS_IN_CONTACT = 4  # time steps in a time constant of a contact, where it is not the subject


class Model(NamedTuple):
    """A structure of the config, as a frame or alone."""

    name: str
    frame: RockingFrame
    cap: Cap | None


def experiment(job, main: Callable[..., tuple[pd.DataFrame, dict]]) -> None:
    """Run an experiment of a Snakemake job, or say in its outputs why it was not run."""

    def work(job) -> tuple[pd.DataFrame, dict]:
        if job.params.engine is None:
            return pd.DataFrame({"not_tested": [NO_ENGINE]}), {"not_tested": NO_ENGINE}
        caps = {name: cap_of(entry) for name, entry in job.params.caps.items()}
        return main(job.params.settings, job.params.structures, caps)

    workbench.run(job, work)


def models(frames: Mapping[str, list], structures: Mapping[str, Any], caps: Mapping[str, Cap]):
    """Return the models of a config entry: the mass ratios by structure."""
    return [
        Model(name, RockingFrame(Column(**structures[name]), gamma), caps[name] if gamma else None)
        for name, ratios in frames.items()
        for gamma in ratios
    ]


def rig_of(model: Model, step: float, **contact: float) -> Rig:
    """Return the rig of a model with a time step over 1/p; contact by default four steps long."""
    scale = 1.0 / model.frame.column.frequency_parameter
    constant = contact.pop("time_constant", STEPS_IN_CONTACT * step)
    return Rig(model.frame, model.cap, Contact(scale * constant, **contact), scale * step)


def crossing(motion: Motion) -> tuple[int, float]:
    """Return the first step with θ ≤ 0 and the time of the crossing, s.

    Raises
    ------
    ArithmeticError
        When there is no impact.
    """
    theta, times = motion.rotation, motion.time
    after = int(np.argmax(theta <= 0.0))
    if after == 0:
        raise ArithmeticError(f"no impact within {times[-1]:.6g} s; expected one")
    share = theta[after - 1] / (theta[after - 1] - theta[after])
    return after, float(times[after - 1] + share * (times[after] - times[after - 1]))


def rebound(rig: Rig, rotation: float) -> float:
    """Return the ratio of velocities across the first impact after a release from rest at θ.

    Between impacts energy is kept, so it is the root of the ratio of the potential energies of the
    peak after the impact and of the release, both with the corners just touching.
    """
    first, second = simulate(rig.frame, rotation=rotation, samples=2).impacts[:2]
    motion = run(rig, rotation=rotation, duration=float(first + 0.75 * (second - first)))
    after, _ = crossing(motion)
    peak = after + int(np.argmax(np.abs(motion.rotation[after:])))
    reached = leaning(rig, float(motion.rotation[peak]))
    return math.sqrt(raised_energy(rig, reached) / raised_energy(rig, leaning(rig, rotation)))


def lowest_overturning(frame: RockingFrame, unit: Pulse) -> Pulse:
    """Return the pulse of the minimum overturning amplitude in theory.

    Raises
    ------
    ValueError
        When no amplitude up to 40 g tan α does.
    """
    tan = frame.uplift_acceleration
    found = minimum_overturning(frame, unit, (tan, HIGHEST * tan), resolution=0.01 * tan)
    if found is None:
        raise ValueError(f"{unit}: nothing up to {HIGHEST:.3g} g tan α overturns {frame}")
    return unit.scaled(found[1])


def shaken(rig: Rig, pulse: Pulse) -> tuple[bool, float, Motion]:
    """Return whether a pulse overturns a rig, the peak of |θ| if it does not (rad), its motion.

    A column overturns when it leans by π/3. It is safe when it has come to rest after the pulse,
    or has gone through two impacts since, as each takes energy.

    Raises
    ------
    ArithmeticError
        When neither comes within 20/p̂ after the pulse.
    """
    alpha, step = rig.frame.slenderness, rig.time_step

    def safe(theta: Array, pulse_steps: int) -> bool:
        free = theta[pulse_steps:]
        if free.size < 2:
            return False
        last = free[-min(free.size, round(0.1 / rig.frame.frequency_parameter / step)) :]
        still = bool(np.abs(last).max() < 0.005 * alpha) and np.ptp(last) < 1e-4 * alpha
        swings = free[np.abs(free) > 0.01 * alpha]
        return still or int((np.diff(np.sign(swings)) != 0).sum()) >= 2

    def ends(theta: Array, pulse_steps: int) -> bool:
        return abs(theta[-1]) > FALLEN or safe(theta, pulse_steps)

    wait = FREE / rig.frame.frequency_parameter
    motion = run(rig, pulse, duration=pulse.duration + wait, ends=ends)
    if abs(motion.rotation[-1]) > FALLEN:
        return True, math.nan, motion
    if not safe(motion.rotation, math.ceil(pulse.duration / step)):
        raise ArithmeticError(f"{pulse}: no verdict {wait:.6g} s after its end")
    return False, float(np.abs(motion.rotation).max()), motion


def units(column: Column, pulses: list[Mapping[str, Any]]) -> Iterator[tuple[dict, Pulse]]:
    """Yield the pulses of a config entry, each with the amplitude 1 g."""
    for spec in pulses:
        omega = spec["frequency_ratio"] * column.frequency_parameter
        yield dict(spec), Pulse(spec["shape"], 1.0, omega)
