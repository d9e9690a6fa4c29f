"""Copy what is published from results/ to docs/ and tests/reference/: `make publish`.

docs/ has what the README shows: pictures, the verdict table, what a run costs. tests/reference/ has
the tables that later runs are compared with, and the config that made them.
"""

import json
import os
import platform
import shutil
import sys
from pathlib import Path

from strict_yaml import read_yaml

PICTURES = ("heavier", "peak_maps", "spectra", "structures")
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

STUDY_TABLES = ("reversals_medians", "reversals_pairs")
"""Shown in the README; too sensitive to the processor to compare later runs with."""


def verdict_table(claims: list[dict]) -> str:
    """Return the table of docs/verdicts.md."""
    lines = [
        "# The verdict on every claim",
        "",
        "Computed by the workflow (`results/claims.json`); this page is written by `make publish`.",
        "",
        "| claim | where | in our words | printed | computed | verdict | remark |",
        "|---|---|---|---|---|---|---|",
    ]
    for row in claims:
        cells = [
            f"`{row['id']}`",
            row["where"],
            row["statement"],
            _shown(row["printed"], row["unit"]),
            _shown(row["computed"], row["unit"]),
            row["verdict"],
            row["remark"],
        ]
        lines.append("| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |")
    return "\n".join(lines) + "\n"


def machine() -> str:
    """Return one line that names this machine."""
    cpuinfo = Path("/proc/cpuinfo")
    names = [
        line.split(":", 1)[1].strip()
        for line in (cpuinfo.read_text().splitlines() if cpuinfo.exists() else [])
        if line.startswith("model name")
    ]
    processor = names[0] if names else platform.processor() or platform.machine()
    python = f"Python {platform.python_version()}"
    return f"{os.cpu_count()} cores of {processor}, {platform.system()}, {python}"


def _shown(value: object, unit: str) -> str:
    match value:
        case None:
            return ""
        case bool():
            return "holds" if value else "does not hold"
        case float() | int():
            return f"{value:.6g} {unit}".rstrip()
        case _:
            return str(value)


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
    reference.mkdir(exist_ok=True)
    for name in PICTURES:
        shutil.copyfile(f"figures/{name}.svg", docs / f"{name}.svg")
    shutil.copyfile(results / MOVING, docs / MOVING)
    for name in TABLES:
        shutil.copyfile(results / "tables" / f"{name}.csv", reference / f"{name}.csv")
    (reference / "studies").mkdir(exist_ok=True)
    for name in STUDY_TABLES:
        if (results / "tables" / f"{name}.csv").exists():
            shutil.copyfile(
                results / "tables" / f"{name}.csv", reference / "studies" / f"{name}.csv"
            )
    shutil.copyfile(results / "claims.json", reference / "claims.json")
    shutil.copyfile("config/config.yaml", reference / "config.yaml")
    shutil.copyfile(results / "costs.csv", docs / "costs.csv")
    (docs / "machine.txt").write_text(machine() + "\n", encoding="utf-8")
    claims = json.loads((results / "claims.json").read_text(encoding="utf-8"))
    (docs / "verdicts.md").write_text(verdict_table(claims), encoding="utf-8")


if __name__ == "__main__":
    main()
