"""Copy the published results from results/ to docs/ and tests/reference/: `make publish`.

docs/ contains the article and its supplement, and the pictures, verdicts and costs that the README
shows. tests/reference/ contains the findings from which `make check` judges the claims, the tables
with which later runs are compared, and their config. The pages that need no run are written, too,
and the table of deliberate faults loses what no longer holds.
"""

import shutil
from pathlib import Path

from replication.commands import kill_table, pages
from replication.publishing import machine, publish
from steps.explorer_still import still

DOCUMENTS = ("report", "supplement")
PICTURES = ("vase", "heavier", "peak_maps", "spectra", "structures")
REVERSALS = "studies/reversals/figures/where.svg"
"""Where a heavier cap beam prevents and causes overturning."""
MOVING = "animation.gif"
PAGE = "explorer.html"
TABLES = (
    "allen_errors",
    "allen_overturning",
    "equations",
    "heavier",
    "mass_ratio",
    "moment_rotation",
    "quarter_period",
    "restitution_over_mass_ratio",
    "restitution_over_slenderness",
    "spectra_areas",
    "trilith_map",
    "trilith_nearness",
    "trilith_starts",
    "trilith_states",
    "uplift_ratios",
    "uplift_slopes",
    "vase",
    "vase_exceptions",
    "vase_shares",
)

STUDY_TABLES = (
    "certainty_benefit",
    "certainty_extensions",
    "certainty_intensities",
    "certainty_lowest",
    "certainty_records",
    "certainty_restitution",
    "certainty_theorem",
    "mechanism_dependence",
    "mechanism_equivalence",
    "mechanism_first_impacts",
    "mechanism_rebounds",
    "mechanism_records",
    "mechanism_slides",
    "mechanism_three_bodies",
    "mechanism_verdicts",
    "reversals_areas",
    "reversals_enough",
    "reversals_fragility",
    "reversals_medians",
    "reversals_pairs",
    "reversals_records",
    "reversals_uplift",
    "reversals_vase_ranks",
    "reversals_why",
)
"""The sources of the studies' findings; too sensitive to the processor to compare runs with."""


def main() -> None:
    results, docs = Path("results"), Path("docs")
    publish(TABLES, STUDY_TABLES)
    for name in PICTURES:
        shutil.copyfile(f"figures/{name}.svg", docs / f"{name}.svg")
    shutil.copyfile(REVERSALS, docs / "reversals.svg")
    for name in DOCUMENTS:
        shutil.copyfile(f"paper/{name}.pdf", docs / f"{name}.pdf")
    for name in (MOVING, PAGE):
        shutil.copyfile(results / name, docs / name)
    still(docs / PAGE, docs / "explorer.png")
    shutil.copyfile(results / "costs.csv", docs / "costs.csv")
    pages.write()
    kill_table.refresh()
    (docs / "machine.txt").write_text(machine() + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
