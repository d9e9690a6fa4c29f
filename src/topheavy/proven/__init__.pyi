from .below import Below, survives_below
from .blocks import BlockBox
from .certificate import certified
from .march import Outcome
from .orbit import SteadyRocking, settles, steady_rocking
from .outcome import outcome

__all__ = [
    "Below",
    "BlockBox",
    "Outcome",
    "SteadyRocking",
    "certified",
    "outcome",
    "settles",
    "steady_rocking",
    "survives_below",
]
