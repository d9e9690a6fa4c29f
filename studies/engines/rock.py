"""Rock a column, and frames where the config says so, in one engine: python rock.py RUN"""

import json
import math
import sys
from importlib.metadata import version
from pathlib import Path

import numpy as np
import yaml
from engines import ENGINES, Box

from topheavy import STANDARD_GRAVITY, Column

CONFIG = yaml.safe_load(Path("config.yaml").read_text("utf-8"))
COLUMN = Column.of_dimensions(**CONFIG["column"])
ALPHA, P = COLUMN.slenderness, COLUMN.frequency_parameter
UPLIFT = STANDARD_GRAVITY * math.tan(ALPHA)  # m/s2
DRAWN = 0.02  # s, between points of the figure
FLAT = 1.0  # rad, from where a column has overturned


def boxes(mass_ratio, rotation):
    """Return the column, or two and their cap; columns turn by θ ≥ 0 about their right corners."""
    b, h, frame = COLUMN.half_width, COLUMN.half_height, CONFIG["frame"]
    shift = h * math.sin(rotation) + b * (1.0 - math.cos(rotation))
    height = h * math.cos(rotation) + b * math.sin(rotation) - CONFIG["overlap"]
    size, span, thick = (2 * b, 2 * h, CONFIG["mass"]), frame["span"], frame["cap_height"]
    places = (-span / 2, span / 2) if mass_ratio else (0.0,)
    columns = [Box(*size, x + shift, height, rotation) for x in places]
    cap = Box(span + 2 * b, thick, 2 * mass_ratio * size[2], 2 * shift, 2 * height + thick / 2, 0)
    return [*columns, cap] if mass_ratio else columns


def free(rock, mass_ratio):
    """Return when a released structure is upright (s), √r of three impacts, and θ/α over time.

    Energy is kept between impacts, so that peaks give √r.
    """
    release, duration = CONFIG["release"].values()
    time, states = rock(duration, mass_ratio=mass_ratio, rotation=release * ALPHA)
    rotation = states[:, 1]
    turns = np.flatnonzero(rotation[1:] * rotation[:-1] < 0.0) + 1
    peaks = np.array([np.abs(flight).max() for flight in np.split(rotation, turns)])
    rise = np.cos(ALPHA - peaks[peaks > 0.01 * ALPHA]) - math.cos(ALPHA)
    first = slice(turns[0] - 1, turns[0] + 1)
    every = max(1, round(DRAWN / time[1]))
    return {
        "mass_ratio": mass_ratio,
        "upright": np.interp(0.0, -rotation[first], time[first]),
        "restitutions": np.sqrt(rise[1:] / rise[:-1])[:3].tolist(),
        "history": [time[::every].tolist(), (rotation[::every] / ALPHA).tolist()],
    }


def rest(rock):
    """Return the largest θ/α, and the slip (mm), on ground that cannot lift the column."""
    level, frequency, duration = CONFIG["rest"].values()
    omega = 2.0 * math.pi * frequency
    _, states = rock(duration, lambda time: level * UPLIFT * math.sin(omega * time))
    return np.abs(states[:, 1]).max() / ALPHA, 1e3 * abs(states[-1, 0] - states[0, 0])


def lowest(overturns, start, step, stop, halvings):
    """Return the lowest factor that overturns, from `start` on; infinite if none before `stop`."""
    factors = np.arange(start, stop, step)
    high = next((factor for factor in factors if overturns(factor)), math.inf)
    low = high - step
    for _ in range(halvings if math.isfinite(high) else 0):
        middle = (low + high) / 2.0
        low, high = (low, middle) if overturns(middle) else (middle, high)
    return high - step / 2.0 ** (halvings + 1)


def uplift(rock):
    """Return the ground acceleration over g tan α that, held long, overturns a column at rest."""
    wait, ramp, hold, search = CONFIG["uplift"].values()

    def overturns(factor):
        _, states = rock(
            wait + ramp + hold, lambda t: factor * UPLIFT * np.clip((t - wait) / ramp, 0, 1)
        )
        return abs(states[-1, 1]) > 0.5 * ALPHA

    return lowest(overturns, **search)


def minimum(rock):
    """Return the lowest amplitude over g tan α of one sine that overturns the column."""
    frequency, wait, after, search = CONFIG["pulse"].values()
    omega = frequency * P
    end = 2.0 * math.pi / omega

    def overturns(factor):
        def ground(time):
            return factor * UPLIFT * math.sin(omega * (time - wait)) * (0.0 < time - wait < end)

        return abs(rock(wait + end + after / P, ground)[1][-1, 1]) > FLAT

    return lowest(overturns, **search)


if __name__ == "__main__":
    settings = dict(CONFIG["runs"][int(sys.argv[1])])
    name, is_default = settings.pop("engine"), settings.pop("is_default")
    world, distribution = ENGINES[name]

    def rock(duration, ground=lambda time: 0.0, mass_ratio=0, rotation=0.0):
        """Return times and the first column's states (x, θ) up to the duration, or until flat."""
        friction = (CONFIG["frame"] if mass_ratio else CONFIG)["friction"]
        step, state = world(boxes(mass_ratio, rotation), friction, **settings)
        states, time_step = [state()], settings["time_step"]
        while len(states) * time_step < duration and abs(states[-1][1]) < FLAT:
            step(ground((len(states) - 0.5) * time_step))
            states.append(state())
        return time_step * np.arange(len(states)), np.array(states)

    frames = CONFIG["frame"]["mass_ratios"] if name in CONFIG["frame"]["engines"] else []
    numbers = {"engine": name, "version": version(distribution), "is_default": is_default}
    numbers |= {"settings": settings, "free": [free(rock, ratio) for ratio in (0, *frames)]}
    numbers |= {question.__name__: question(rock) for question in (rest, uplift, minimum)}
    Path(f"results/run_{sys.argv[1]}.json").write_text(json.dumps(numbers))
