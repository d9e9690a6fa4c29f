"""The frame in space, in the rigid-body engine: eccentric beams, oblique shaking, real friction.

All six freedoms of each body are free, and columns are as deep as wide. One engine with soft
contacts: what differs from the plane is reported. The same boxes as in `engine`, which
moves them in a plane.
"""

import math
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from replication.workbench import Finding, truth
from studies.mechanism.steps.engine import CHUNK, COLUMN_MASS, FALLEN, Contact
from studies.mechanism.steps.rigs import FREE, Model, experiment, lowest_overturning, models, units
from topheavy import STANDARD_GRAVITY, Cap, Pulse

OBLIQUE = 5.0  # degrees, up to which a direction counts as that of the frame
ASIDE = 1.0 / 3.0  # of the wait: a run is over when nothing has rocked for so long


class Setting(NamedTuple):
    """What differs from the plane: e/b across the span, the direction (degrees), contacts."""

    eccentricity: float = 0.0
    direction: float = 0.0
    friction: float = 5.0
    finer: float = 1.0  # divides time step and time constant


def settings_of(spec: dict) -> Iterator[Setting]:
    """Yield the plane, each eccentricity and direction, with each friction; the plane finer."""
    for friction in spec["frictions"]:
        yield Setting(friction=friction)
        yield from (Setting(eccentricity=e, friction=friction) for e in spec["eccentricities"])
        yield from (Setting(direction=d, friction=friction) for d in spec["directions"])
    yield Setting(friction=max(spec["frictions"]), finer=2.0)


def overturns(model: Model, pulse: Pulse, setting: Setting, spec: dict) -> bool:
    """Return whether a column leans by π/3 in any direction."""
    import mujoco

    column, cap = model.frame.column, model.cap
    scale = 1.0 / (model.frame.column.frequency_parameter * setting.finer)
    step, contact = scale * spec["time_step"], Contact(**spec["contact"], friction=setting.friction)
    engine = mujoco.MjModel.from_xml_string(
        _xml(model, cap, setting, step, scale * contact.time_constant, contact)
    )
    data, angle = mujoco.MjData(engine), math.radians(setting.direction)
    wait = FREE / model.frame.frequency_parameter
    steps = math.ceil((pulse.duration + wait) / step)
    push = -STANDARD_GRAVITY * np.asarray(pulse.excitation((np.arange(steps) + 0.5) * step))
    gravity, still, alpha = engine.opt.gravity, 0, column.slenderness
    forced = math.ceil(pulse.duration / step)
    for number in range(steps):
        gravity[:2] = push[number] * math.cos(angle), push[number] * math.sin(angle)
        mujoco.mj_step(engine, data)
        if number % CHUNK == CHUNK - 1:
            upright = data.xmat[1:3, 8].min()  # cos of the lean of the columns
            if upright < math.cos(FALLEN):
                return True
            still = still + 1 if number > forced and upright > math.cos(0.05 * alpha) else 0
            if still * CHUNK * step > ASIDE * wait:
                break
    if any(warning.number for warning in data.warning):
        raise ArithmeticError(f"{model.name}, {setting}: MuJoCo warns at a step of {step:.6g} s")
    return False


def _xml(
    model: Model, cap: Cap, setting: Setting, step: float, constant: float, contact: Contact
) -> str:
    b, h = model.frame.column.half_width, model.frame.column.half_height
    length, heavy = 0.5 * cap.span + 2.0 * b, 2.0 * COLUMN_MASS * model.frame.mass_ratio
    boxes = [
        _box(f"column{i}", (side * 0.5 * cap.span, 0.0, h), (b, b, h), COLUMN_MASS)
        for i, side in enumerate((-1, 1))
    ]
    top = (0.0, setting.eccentricity * b, 2.0 * h + cap.half_depth)
    boxes.append(_box("cap", top, (length, b, cap.half_depth), heavy))
    touch = (
        f'condim="3" friction="{contact.friction} {contact.friction} 0 0 0"'
        f' solref="{constant} {contact.damping_ratio}"'
        f' solimp="{contact.impedance} {contact.impedance} 0.001 0.5 1"'
    )
    pairs = [(one, f"column{i}") for i in range(2) for one in ("ground", "cap")]
    touching = "".join(f'<pair geom1="{one}" geom2="{two}" {touch}/>' for one, two in pairs)
    return (
        f'<mujoco><option timestep="{step}" gravity="0 0 {-STANDARD_GRAVITY}" integrator="Euler"'
        f' solver="Newton" tolerance="1e-12" cone="elliptic"'
        f' impratio="{contact.friction_impedance}"/><worldbody>'
        '<geom name="ground" type="plane" size="1 1 1" contype="0" conaffinity="0"/>'
        f"{''.join(boxes)}</worldbody><contact>{touching}</contact></mujoco>"
    )


def _box(name: str, at: tuple, sides: tuple, mass: float) -> str:
    place, half = (" ".join(map(str, numbers)) for numbers in (at, sides))
    return (
        f'<body name="{name}" pos="{place}"><freejoint/><geom name="{name}" type="box"'
        f' size="{half}" mass="{mass}" contype="0" conaffinity="0"/></body>'
    )


def main(spec: dict, structures: dict, caps: dict[str, Cap]) -> tuple[pd.DataFrame, dict]:
    rows = []
    for model in models(spec["frames"], structures, caps):
        for kind, unit in units(model.frame.column, spec["pulses"]):
            lowest = lowest_overturning(model.frame, unit)
            for factor in spec["factors"]:
                pulse = lowest.scaled(factor)
                rows += [
                    {"structure": model.name, **kind, "factor": factor, **setting._asdict()}
                    | {"overturns": overturns(model, pulse, setting, spec)}
                    | {"in_theory": factor > 1.0}
                    for setting in settings_of(spec)
                ]
    table = summed(pd.DataFrame(rows))
    return table, findings(table)


def summed(rows: pd.DataFrame) -> pd.DataFrame:
    """Return for each setting the pulses, those that overturn, and where it differs from theory."""
    table: Any = rows.assign(differs=rows.overturns != rows.in_theory)
    return table.groupby([*Setting._fields], sort=False, as_index=False).agg(
        pulses=("overturns", "size"),
        overturned=("overturns", "sum"),
        in_theory=("in_theory", "sum"),
        differ=("differs", "sum"),
    )


def findings(mechanism_space: pd.DataFrame) -> dict[str, Finding]:
    """Return whether the plane gives the outcomes of theory, and how far the others differ."""
    table = mechanism_space
    plane = (table.eccentricity == 0.0) & (table.direction == 0.0)
    rough = table.friction == table.friction.max()
    return {
        "plane_in_space": truth(
            not table.differ[plane & rough].any(),
            pulses=int(table.pulses[plane & rough].max()),
            differ=int(table.differ[plane & rough].sum()),
        ),
        "same_outcomes_in_space": truth(
            not table.differ.any(),
            holds_when=not table.differ[table.direction <= OBLIQUE].any(),
            condition=f"the shaking is at most {OBLIQUE:g}° out of the plane",
            settings=len(table),
            most=int(table.differ.max()),
            pulses=int(table.pulses.max()),
        ),
    }


if __name__ == "__main__":
    experiment(snakemake, main)
