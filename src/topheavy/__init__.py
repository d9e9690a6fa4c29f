"""The rocking frame of Makris & Vassiliou (2014) as a solitary rocking column.

    Column(b, h)              ─┐
                               ├─►  RockingBlock(p, α, √r)  ─►  simulate · overturning · spectra
    RockingFrame(column, γ)   ─┘

Angles are in rad, rotations signed, accelerations in g, everything else in SI units.
"""

from topheavy.contact_forces import (
    Cap,
    ContactForces,
    Reaction,
    column_forces,
    column_impulse,
    contact_forces,
    impact_impulses,
)
from topheavy.overturning import overturned_by, overturning_intervals, overturning_map
from topheavy.pulses import PULSE_SHAPES, Pulse
from topheavy.records import Record, read_at2, read_csv, read_record
from topheavy.response import Response
from topheavy.simulate import judge, simulate
from topheavy.structures import STANDARD_GRAVITY, Column, RockingBlock, RockingFrame

__all__ = [
    "PULSE_SHAPES",
    "STANDARD_GRAVITY",
    "Cap",
    "Column",
    "ContactForces",
    "Pulse",
    "Reaction",
    "Record",
    "Response",
    "RockingBlock",
    "RockingFrame",
    "column_forces",
    "column_impulse",
    "contact_forces",
    "impact_impulses",
    "judge",
    "overturned_by",
    "overturning_intervals",
    "overturning_map",
    "read_at2",
    "read_csv",
    "read_record",
    "simulate",
]
