"""The rocking frame of Makris & Vassiliou (2014) as a solitary rocking column.

    Column                    ─┐
                               ├─►  RockingBlock(p, α, √r)  ─►  simulate · overturning · spectra
    RockingFrame(column, γ)   ─┘

Angles are in rad, rotations signed, accelerations in g, everything else in SI units.

It models

- a solitary column, and equal columns under a rigid cap beam: `Column`, `RockingFrame`
- the mass fixed to one column (a vase) or to both: `FixedMassColumn`, `MonolithicPortal`
- pulses, records, vertical ground acceleration: `Pulse`, `Record`, `vertical=`
- the forces at the contacts, and the friction that rocking requires: `contact_forces`

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
__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
