"""Which functions draw the findings of this study from its tables, by rule; or why none does."""

from studies.reversals.steps import (
    enough,
    motions_fragility,
    motions_records,
    motions_vase,
    pulses,
)

SOURCES = {
    "reversals_enough": enough.findings,
    "reversals_motions": motions_fragility.findings,
    "reversals_pulses": pulses.findings,
    "reversals_records": motions_records.findings,
    "reversals_vase": motions_vase.findings,
}

UNDRAWN = {
    "reversals_check": "a sample that other solvers judge",
    "reversals_uplift": "its table has means of ratios, and the findings count single ones",
}
