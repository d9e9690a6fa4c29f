"""The rocking frame of Makris & Vassiliou (2014) as a solitary rocking column.

    Column                    ─┐
                               ├─►  RockingBlock(p, α, √r)  ─►  simulate · overturning · spectra
    RockingFrame(column, γ)   ─┘

Angles are in rad, rotations signed, accelerations in g, everything else in SI units.

- structures: `Column`, `RockingFrame` (equal columns under a rigid cap beam), `RockingBlock` (three
  parameters), and with the mass fixed to one column or to both `FixedMassColumn`,
  `MonolithicPortal`
- ground motions: `Pulse`, `Record`, `read_record`; `vertical=` is the vertical acceleration
- one motion: `simulate`, `judge`, `contact_forces`
- a pulse: `lowest_overturning`, `overturning_spectrum`, `overturning_intervals`, `overturning_map`
- a record: `capacity`, `overturned_by`, `peak_rotations`
- many motions: `fragility`
- pictures: `plot`

In the examples `th` is this package and `np` is NumPy.

In parallel: threads share the histories of one call, on all cores that the process may use. In
workers, set OMP_NUM_THREADS=1 before they start, or each takes all cores (joblib does so itself).
Fork after a first call, which loads or compiles the solver for all. A spawned worker takes seconds
to load it again, and more with PYTHONDONTWRITEBYTECODE=1. Results have the same bits in any number
of threads and processes.

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
