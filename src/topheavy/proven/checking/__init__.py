"""Check certificates with the standard library alone; `python3 -I -S` runs this folder."""

from .checker import Check, check
from .intervals import NotProven

__all__ = ["Check", "NotProven", "check"]
