"""The numbers of the trilith, and whether it rocks below uplift."""

from functools import partial

import numpy as np

from replication.workbench import truth, value
from steps.assumptions.choices import Choices
from steps.assumptions.quantity import Answer, Quantity, Sections
from topheavy import Column, RockingBlock, RockingFrame, simulate
from topheavy.bodies.structures import STANDARD_GRAVITY
from topheavy.derivation.mends import mended_quotient
from topheavy.ground.shaking_table import abrupt_start, table_acceleration, table_motion

EPS = 1e-14


def trilith(choices: Choices, sections: Sections) -> tuple[RockingBlock, RockingBlock]:
    """Return the solitary column and the frame."""
    settings = sections["trilith"]
    cap, columns = choices.masses or (settings["mass_ratio"], 1.0)
    column = Column(**settings["column"])
    return choices.block(column), choices.block(RockingFrame(column, cap / columns))


def passage(choices: Choices, sections: Sections) -> dict[str, float]:
    """The numbers of p. 4, by their claims."""
    settings, (column, frame) = sections["trilith"], trilith(choices, sections)
    level = table_acceleration(settings["table_amplitude"], settings["table_frequency"])
    level *= STANDARD_GRAVITY / choices.gravity  # in the g that is chosen
    cap, columns = choices.masses or settings["printed_masses"]
    return {
        "trilith_frequency_parameter": column.frequency_parameter,
        "trilith_frequency_ratio": frame.frequency_parameter / column.frequency_parameter,
        "trilith_frame_frequency_parameter": frame.frequency_parameter,
        "trilith_mass_ratio": cap / columns,
        "trilith_base_acceleration_in_g": level,
        "trilith_uplift_acceleration": frame.uplift_acceleration,
        "trilith_stays_below_uplift": level / frame.uplift_acceleration,
    }


def number(choices: Choices, sections: Sections, claim: str) -> Answer:
    found = passage(choices, sections)[claim]
    if claim == "trilith_stays_below_uplift":
        return Answer(found, truth(found < 1.0))
    meant = {}
    if claim == "trilith_mass_ratio":
        cap, columns = choices.masses or sections["trilith"]["printed_masses"]
        if mended := mended_quotient(cap, columns, f"{sections['trilith']['mass_ratio']}"):
            meant = {"meant_value": mended[1], "kind": mended[0].kind}
    return Answer(found, value(found, EPS, **meant))


def no_pure_rocking(choices: Choices, sections: Sections) -> Answer:
    """The largest steady rotation over α after all starts, and whether it always comes to rest."""
    settings, (_, frame) = sections["trilith"], trilith(choices, sections)
    u, f, duration = settings["table_amplitude"], settings["table_frequency"], settings["duration"]
    # In the chosen g the same motion of the table has another acceleration; p̂² takes g along.
    motion = table_motion(u, f).scaled(STANDARD_GRAVITY / choices.gravity)
    full = abrupt_start(frame, u, f) * STANDARD_GRAVITY / choices.gravity
    steady, rests = 0.0, {}
    for share in choices.table_starts:
        response = simulate(
            frame,
            motion,
            velocity=share * full,
            duration=duration,
            samples=2401,
            tolerance=choices.tolerance,
        )
        rests[share] = response.outcome in ("no uplift", "rests")
        late = np.abs(response.rotation[response.time > 0.75 * duration]).max()
        steady = max(steady, float(late) / frame.slenderness)
    return Answer(steady, truth(all(rests.values()), holds_when=rests.get(0.0, False)))


def _numbered(claim: str, unit: str = "") -> Quantity:
    return Quantity(claim, unit, partial(number, claim=claim))


QUANTITIES = {
    "trilith: p": _numbered("trilith_frequency_parameter", "rad/s"),
    "trilith: p̂/p": _numbered("trilith_frequency_ratio"),
    "trilith: p̂": _numbered("trilith_frame_frequency_parameter", "rad/s"),
    "trilith: γ": _numbered("trilith_mass_ratio"),
    "trilith: base acceleration": _numbered("trilith_base_acceleration_in_g", "g"),
    "trilith: uplift": _numbered("trilith_uplift_acceleration", "g"),
    "trilith: below uplift": _numbered("trilith_stays_below_uplift", "of uplift"),
    "trilith: steady rocking": Quantity("trilith_no_pure_rocking", "α", no_pure_rocking),
}
