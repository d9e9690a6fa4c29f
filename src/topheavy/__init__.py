"""The rocking frame of Makris & Vassiliou (2014) as a solitary rocking column.

    Column                    ─┐
                               ├─►  RockingBlock(p, α, √r)  ─►  simulate · overturning · spectra
    RockingFrame(column, γ)   ─┘

Angles are in rad, rotations signed, accelerations in g, everything else in SI units. To begin with:

- structures: `Column`, `RockingFrame` (equal columns under a rigid cap beam), and with the mass
  fixed to one column or to both `FixedMassColumn`, `MonolithicPortal`
- what shakes them: `Pulse`, `Record`, `read_record`; `vertical=` is the vertical acceleration
- what becomes of them: `simulate`, `judge`, `lowest_overturning`, `overturning_map`, `fragility`,
  `plot`

`dir(topheavy)` has the other names, such as `contact_forces` with the friction that rocking
requires; each has an example in its docstring, in which `th` is this package and `np` NumPy.

It does not model

- sliding: compare the friction that `contact_forces` requires with what there is; beyond it take a
  rigid-body engine (MuJoCo, for instance) or discrete elements
- rebound, and impacts elsewhere than at the new pivots: `structure.block(restitution=…)` changes
  the loss alone; else a rigid-body engine
- unequal or inclined columns, a cap beam that tilts, three dimensions: a rigid-body engine
- flexible columns, soil, dampers, tendons: finite elements (OpenSees, for instance)
"""

import lazy_loader

__version__ = "0.1.0"

# A name is loaded from its module when it is first used (SPEC 1); __init__.pyi says from which.
__getattr__, __dir__, _ = lazy_loader.attach_stub(__name__, __file__)

__all__ = [
    "Column",
    "FixedMassColumn",
    "MonolithicPortal",
    "Pulse",
    "Record",
    "RockingFrame",
    "fragility",
    "judge",
    "lowest_overturning",
    "overturning_map",
    "plot",
    "read_record",
    "simulate",
]
