"""The rocking frame of Makris & Vassiliou (2014) as a solitary rocking column.

    Column(b, h)              ─┐
                               ├─►  RockingBlock(p, α, √r)  ─►  simulate
    RockingFrame(column, γ)   ─┘

Angles are in rad, rotations signed, accelerations in g, everything else in SI units.
"""

from topheavy.pulses import PULSE_SHAPES, Pulse
from topheavy.records import Record, read_at2
from topheavy.reference import simulate
from topheavy.response import Response
from topheavy.structures import STANDARD_GRAVITY, Column, RockingBlock, RockingFrame

__all__ = [
    "PULSE_SHAPES",
    "STANDARD_GRAVITY",
    "Column",
    "Pulse",
    "Record",
    "Response",
    "RockingBlock",
    "RockingFrame",
    "read_at2",
    "simulate",
]
