"""A second proof of a certificate that shares no code with the search, and needs no Arb."""

from topheavy.proven.checking.asked import concerns
from topheavy.proven.checking.check import check
from topheavy.proven.checking.intervals import Refused

__all__ = ["Refused", "check", "concerns"]
