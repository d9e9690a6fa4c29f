"""A second proof of a certificate that shares no code with the search, and needs no Arb."""

from .asked import concerns
from .checker import check
from .intervals import Refused

__all__ = ["Refused", "check", "concerns"]
