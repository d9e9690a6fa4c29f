from .blocks import BlockBox
from .outcome import Outcome, outcome

__all__ = ["BlockBox", "Outcome", "outcome"]
