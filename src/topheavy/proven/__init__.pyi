from . import checking
from .prover import certified, survives_below

__all__ = [
    "certified",
    "checking",
    "survives_below",
]
