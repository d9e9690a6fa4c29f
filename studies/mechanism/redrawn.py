"""Which functions draw the findings of this study from its tables, by rule; or why none does."""

from studies.mechanism.steps import (
    beside,
    dependence,
    equivalence,
    first_impacts,
    rebounds,
    records,
    slides,
    three_bodies,
    verdicts,
)

SOURCES = {
    "mechanism_beside": beside.findings,
    "mechanism_dependence": dependence.findings,
    "mechanism_equivalence": equivalence.findings,
    "mechanism_first_impacts": first_impacts.findings,
    "mechanism_rebounds": rebounds.findings,
    "mechanism_records": records.findings,
    "mechanism_slides": slides.findings,
    "mechanism_three_bodies": three_bodies.findings,
    "mechanism_verdicts": verdicts.findings,
}

UNDRAWN = {
    "mechanism_admissible": "its table has a row for each of 8832 pulses",
    "mechanism_forces": "theorems",
}
