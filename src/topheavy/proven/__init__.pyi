from .below import Below, survives_below
from .blocks import BlockBox
from .certificate import certified
from .march import Outcome
from .search import outcome

__all__ = [
    "Below",
    "BlockBox",
    "Outcome",
    "certified",
    "outcome",
    "survives_below",
]
