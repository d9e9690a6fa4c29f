"""Copy the published results from results/ to docs/ and tests/reference/: `make publish`.

docs/ contains the article and its supplement, and the pictures, verdicts and costs that the README
shows. tests/reference/ contains the findings from which `make check` judges the claims, the tables
with which later runs are compared, and their config. The pages that need no run are written, too,
and the table of deliberate faults loses what no longer holds.
"""

import gzip
import shutil
from pathlib import Path

from replication.commands import kill_table, pages
from replication.inputs.checksums import checksum
from replication.origin.recorded import read_crate
from replication.pages.edition import machine, publish
from replication.pages.seal import seal
from steps import headlines
from steps.explorer_still import stills

DOCUMENTS = ("report", "supplement")
PICTURES = ("vase", "heavier", "peak_maps", "spectra", "structures")
MOVING = "animation.gif"
PAGE = "explorer.html"
NOTEBOOKS = ("derivation", "play")
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
    "portal_columns",
    "proven",
    "proven_below_structures",
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
"""Those with which later runs are compared most strictly."""

SOURCES = (
    "allen_peaks",
    "portal_forces",
    "rocking_spectra",
    "scale_outcomes",
    "spectra_published",
    "spectra_sample",
    "stability_minima",
    "stability_runs",
    "statements",
    "theorems",
    "trilith_limits",
    "trilith_numbers",
    "trilith_orbit",
    "trilith_sample",
    "uplift_limits",
    "uplift_routes",
    "verification_published",
    "verification_routes",
)
"""Other tables from which findings follow."""

CERTIFICATES = "certificates.jsonl.gz"
FAULTS = "docs/kill_table.csv"


def certificates(folder: Path, path: Path) -> None:
    """Write all certificates into one file, the same bytes for the same certificates."""
    lines = b"".join(each.read_bytes() for each in sorted(folder.glob("*.jsonl")))
    path.write_bytes(gzip.compress(lines, mtime=0))


def main() -> None:
    results, docs = Path("results"), Path("docs")
    publish(TABLES, SOURCES)
    counted = read_crate().checksums.get(FAULTS) == checksum(FAULTS)
    if kill_table.refresh() or not counted:
        raise SystemExit(
            f"{FAULTS} has changed, and the supplement counts its rows; expected one that was "
            "compiled since: make reproduce publish"
        )
    for name in PICTURES:
        shutil.copyfile(f"figures/{name}.svg", docs / f"{name}.svg")
    for name in DOCUMENTS:
        shutil.copyfile(f"paper/{name}.pdf", docs / f"{name}.pdf")
    for name in (MOVING, PAGE):
        shutil.copyfile(results / name, docs / name)
    for name in NOTEBOOKS:
        shutil.copyfile(results / "notebooks" / f"{name}.html", docs / f"notebook_{name}.html")
    certificates(results / "certificates", docs / CERTIFICATES)
    stills(docs / PAGE)
    pages.write()
    headlines.write()
    (docs / "machine.txt").write_text(machine() + "\n", encoding="utf-8")
    seal()


if __name__ == "__main__":
    main()
