"""Copy the published results from results/ to docs/ and tests/reference/: `make publish`.

docs/ contains the pictures, verdicts and costs that the README shows. tests/reference/ contains the
findings from which `make check` judges the claims, the tables with which later runs are compared,
and their config.
"""

import shutil
import sys
from pathlib import Path

from replication.ledger import read_ledger
from replication.publishing import (
    CHECKSUMS,
    checksums,
    machine,
    publish_findings,
    publish_verdicts,
)
from replication.strict_yaml import read_yaml

PICTURES = ("vase", "heavier", "peak_maps", "spectra", "structures")
MOVING = "animation.gif"
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
)

STUDY_TABLES = (
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
    "reversals_why",
)
"""The sources of the studies' findings; too sensitive to the processor to compare runs with."""


def main() -> None:
    results, docs, reference = Path("results"), Path("docs"), Path("tests/reference")
    if not (results / "claims.json").exists():
        sys.exit("results/claims.json does not exist; expected a finished run: make reproduce")
    used, ours = read_yaml(results / "config.yaml"), read_yaml("config/config.yaml")
    if used != ours:
        sections = sorted(key for key in {*used, *ours} if used.get(key) != ours.get(key))
        sys.exit(
            f"results/ was made with another config, which differs in {', '.join(sections)}; "
            "expected that of config/config.yaml: make reproduce"
        )
    docs.mkdir(exist_ok=True)
    for name in PICTURES:
        shutil.copyfile(f"figures/{name}.svg", docs / f"{name}.svg")
    shutil.copyfile(results / MOVING, docs / MOVING)
    shutil.copyfile(results / "costs.csv", docs / "costs.csv")
    (docs / "machine.txt").write_text(machine() + "\n", encoding="utf-8")
    shutil.copyfile("config/config.yaml", reference / "config.yaml")
    publish_tables(results / "tables", reference)
    publish_findings(results / "findings", reference / "findings")
    (reference / CHECKSUMS).write_text(checksums(reference), encoding="utf-8")
    studies = [f"studies/{name}/claims.yaml" for name in ours["studies"]]
    publish_verdicts(read_ledger(["paper/claims.yaml", *studies]), Path())


def publish_tables(tables: Path, reference: Path) -> None:
    """Copy the tables, without those of a study that was not part of the run."""
    (reference / "studies").mkdir(parents=True, exist_ok=True)
    for name in TABLES:
        shutil.copyfile(tables / f"{name}.csv", reference / f"{name}.csv")
    for name in STUDY_TABLES:
        if (tables / f"{name}.csv").exists():
            shutil.copyfile(tables / f"{name}.csv", reference / "studies" / f"{name}.csv")


if __name__ == "__main__":
    main()
