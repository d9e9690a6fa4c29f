"""A second proof of a certificate that shares no code with the search, and needs no Arb."""

from .checker import check
from .intervals import Refused
from .question import concerns

__all__ = ["Refused", "check", "concerns"]
