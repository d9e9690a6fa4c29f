"""Deliberate faults, and the table of what catches each."""
