from . import checking
from .below import survives_below
from .prover import certified

__all__ = [
    "certified",
    "checking",
    "survives_below",
]
