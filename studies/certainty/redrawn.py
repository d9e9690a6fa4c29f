"""Which functions draw the findings of this study from its tables, by rule; or why none does."""

from studies.certainty.steps import (
    benefit,
    extensions,
    intensities,
    lowest,
    reach,
    records,
    rescaled,
    restarted,
    restitution,
    shares,
    theorem,
)

SOURCES = {
    "certainty_benefit": benefit.findings,
    "certainty_extensions": extensions.findings,
    "certainty_intensities": intensities.findings,
    "certainty_lowest": lowest.findings,
    "certainty_reach": reach.findings,
    "certainty_records": records.findings,
    "certainty_rescaled": rescaled.findings,
    "certainty_restarted": restarted.findings,
    "certainty_restitution": restitution.findings,
    "certainty_shares": shares.findings,
    "certainty_theorem": theorem.findings,
}

UNDRAWN: dict[str, str] = {}
