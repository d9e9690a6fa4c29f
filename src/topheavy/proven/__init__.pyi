from .blocks import BlockBox
from .certificate import certified
from .march import Outcome
from .outcome import outcome

__all__ = ["BlockBox", "Outcome", "certified", "outcome"]
