from . import plot
from .bodies.fixed_mass import FixedMassColumn, MonolithicPortal
from .bodies.free_rocking import Outcome
from .bodies.response import Response
from .bodies.structures import (
    STANDARD_GRAVITY,
    Column,
    RockingBlock,
    RockingFrame,
    Structure,
    Structures,
)
from .forces.contacts import Cap, ContactForces, contact_forces, impact_impulses
from .ground.pulses import Pulse
from .ground.reading import read_record
from .ground.records import Record
from .ground.shapes import FiniteShape, PulseShape
from .outcomes.capacity import Capacity, capacity
from .outcomes.minimum import LowestOverturning, lowest_overturning, overturning_spectrum
from .outcomes.overturning import overturning_map
from .outcomes.search import FactorInterval, overturned_by, overturning_intervals, peak_rotations
from .outcomes.simulate import judge, simulate
from .risk.fragility import Fragility, fragility

__version__: str

__all__ = [
    "STANDARD_GRAVITY",
    "Cap",
    "Capacity",
    "Column",
    "ContactForces",
    "FactorInterval",
    "FiniteShape",
    "FixedMassColumn",
    "Fragility",
    "LowestOverturning",
    "MonolithicPortal",
    "Outcome",
    "Pulse",
    "PulseShape",
    "Record",
    "Response",
    "RockingBlock",
    "RockingFrame",
    "Structure",
    "Structures",
    "capacity",
    "contact_forces",
    "fragility",
    "impact_impulses",
    "judge",
    "lowest_overturning",
    "overturned_by",
    "overturning_intervals",
    "overturning_map",
    "overturning_spectrum",
    "peak_rotations",
    "plot",
    "read_record",
    "simulate",
]
