"""Which functions draw the findings of this study from its tables, by rule; or why none does."""

SOURCES = {}

UNDRAWN = {"reversals_check": "a sample that other solvers judge"}
