"""Check certificates with the standard library alone; `python3 -I -S` runs this folder."""

from .checker import Check, check
from .intervals import Refused

__all__ = ["Check", "Refused", "check"]
