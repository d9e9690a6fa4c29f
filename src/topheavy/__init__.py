"""The rocking frame of Makris & Vassiliou (2014) as a solitary rocking column.

    Column(b, h)              ─┐
                               ├─►  RockingBlock(p, α, √r)  ─►  simulate · overturning · spectra
    RockingFrame(column, γ)   ─┘

Angles are in rad, rotations signed, accelerations in g, everything else in SI units.
"""

import lazy_loader

# A name is loaded from its module when it is first used (SPEC 1); __init__.pyi says from which.
__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
