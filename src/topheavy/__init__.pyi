from . import plot, proven
from .bodies.fixed_mass import FixedMassColumn, MonolithicPortal
from .bodies.free_rocking import Ending
from .bodies.kinematics import cap_displacement
from .bodies.response import Response
from .bodies.structures import STANDARD_GRAVITY, Column, RockingBlock, RockingFrame, Structure
from .forces.contact import (
    Cap,
    ContactForces,
    Reaction,
    column_forces,
    contact_forces,
    impact_impulses,
)
from .forces.frame import (
    FrameForces,
    base_shear_slope,
    clamped_forces,
    frame_forces,
    largest_forces,
)
from .ground.pulses import Pulse
from .ground.records import Record, read_at2, read_csv, read_record
from .ground.shapes import PULSE_SHAPES
from .outcomes.minimum import LowestOverturning, lowest_overturning
from .outcomes.overturning import overturning_map
from .outcomes.search import Interval, overturned_by, overturning_intervals
from .outcomes.simulate import judge, simulate
from .risk.estimate import Fragility, fragility

__version__: str

__all__ = [
    "PULSE_SHAPES",
    "STANDARD_GRAVITY",
    "Cap",
    "Column",
    "ContactForces",
    "Ending",
    "FixedMassColumn",
    "Fragility",
    "FrameForces",
    "Interval",
    "LowestOverturning",
    "MonolithicPortal",
    "Pulse",
    "Reaction",
    "Record",
    "Response",
    "RockingBlock",
    "RockingFrame",
    "Structure",
    "base_shear_slope",
    "cap_displacement",
    "clamped_forces",
    "column_forces",
    "contact_forces",
    "fragility",
    "frame_forces",
    "impact_impulses",
    "judge",
    "largest_forces",
    "lowest_overturning",
    "overturned_by",
    "overturning_intervals",
    "overturning_map",
    "plot",
    "proven",
    "read_at2",
    "read_csv",
    "read_record",
    "simulate",
]
