"""List every claim with its verdict, and links to its script, table and figure."""

import json
from collections import Counter
from pathlib import Path
from typing import Any

from replication.config import read_yaml
from replication.step import log_to, publish
from replication.verdicts import VERDICTS

HEAD = """# Claims and verdicts

Written by the workflow from its results. One row is one claim, with its place in the paper, the
printed and the computed value, and the verdict:

- **confirmed**: true; a number agrees within the rounding of its print.
- **qualified**: true on a condition that is stated and tested.
- **supported**: true in simulations, where only a measurement could confirm it.
- **refuted**: none of these.
- **by definition**: it cannot be false.
- **not tested**: with the reason.

We worked from a transcription of the paper. *Our copy differs* where a sign, letter, bracket,
radical or number in it contradicts the paper's own premises. There we judge the evident meaning;
the places are listed once, below, to be compared with the print, and no verdict counts them.
"""
TITLES = {"paper": "The paper's claims", "ours": "Claims of our own"}


def links(row: dict[str, Any], captions: dict[str, dict], rules: dict[str, dict]) -> str:
    """Return links to the script, the tables and the figures of a claim, from the folder docs."""
    if not row["rule"]:
        return ""
    rule = rules[row["rule"]]
    found = [(Path(rule["script"]).name, rule["script"])]
    found += [(Path(path).name, f"tests/reference/{Path(path).name}") for path in rule["tables"]]
    found += [
        (f"{name}.py", f"figures/{name}.py")
        for name, about in captions.items()
        if row["id"] in about["claims"]
    ]
    return " ".join(f"[{name}](../{path})" for name, path in found)


def line(row: dict[str, Any], captions: dict[str, dict], rules: dict[str, dict]) -> str:
    """Return a row of a table of Markdown."""
    printed = "" if row["printed"] is None else f"{row['printed']} {row['unit']}".strip()
    verdict = row["verdict"] + (" (our copy differs)" if row["differs"] else "")
    notes = [] if row["verdict"] == "confirmed" else [row.get("condition"), row["remark"]]
    about = f"`{row['id']}`, {row['where']}. {row['statement']}" + "".join(
        f" *{n}*" for n in notes if n
    )
    computed = row["shown"] or {"confirmed": "holds", "qualified": "on a condition"}.get(
        row["verdict"], ""
    )
    cells = about, printed, computed, verdict, links(row, captions, rules)
    return (
        "| " + " | ".join(cell.replace("|", "&#124;").replace("\n", " ") for cell in cells) + " |"
    )


def page(rows: list[dict[str, Any]], captions: dict[str, dict], rules: dict[str, dict]) -> str:
    """Return the page: the paper's claims, ours, those of each study, and the discrepancies."""
    text = [HEAD]
    for part in dict.fromkeys(row["part"] for row in rows):
        own = [row for row in rows if row["part"] == part]
        count = Counter(row["verdict"] for row in own)
        text += [
            f"## {TITLES.get(part, 'Study ' + part)}\n",
            ", ".join(f"{count[verdict]} {verdict}" for verdict in VERDICTS if count[verdict])
            + ".\n",
            "| claim | printed | computed | verdict | script, tables, figure |",
            "|---|---|---|---|---|",
            *(line(row, captions, rules) for row in own),
            "",
        ]
    text += ["## Places where our copy differs\n"]
    text += [
        f"- {row['where']} (`{row['id']}`): {row['differs']}" for row in rows if row["differs"]
    ]
    return "\n".join(text) + "\n"


if __name__ == "__main__":
    with log_to(snakemake.log[0]):
        claims = json.loads(Path(snakemake.input.claims).read_text("utf-8"))
        text = page(claims, read_yaml(snakemake.input.captions), snakemake.params.rules)
        publish(snakemake, {snakemake.output[0]: text})
