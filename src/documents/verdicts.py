"""List every claim with its verdict, and links to its script, tables and figures."""

import json
from pathlib import Path
from typing import Any

from replication.config import read_yaml
from replication.job import log_to, write
from replication.verdicts import counted

HEAD = """# Claims and verdicts

The workflow writes this page from its results. Each line is one claim, with its place in the paper,
its verdict, and links to the script and the figures. Claims that are not plainly confirmed have a
paragraph below the table. The verdicts:

- **confirmed**: true; a number agrees within the rounding of its print.
- **qualified**: true on a condition that is stated and tested.
- **supported**: true in simulations, where only a measurement could confirm it.
- **refuted**: none of the three above.
- **by definition**: it cannot be false.
- **not tested**: with the reason.

We worked from a transcription of the paper. *Our copy differs* where a sign, letter, bracket,
radical or number in it contradicts the paper's own premises. There we judge the evident meaning.
The last list has these places, to be compared with the print. A claim that is confirmed there holds
in a mended form, as the counts say.
"""
TITLES = {"paper": "The paper's claims", "ours": "Claims of our own"}


def link(path: str) -> str:
    """Return a link from the folder docs, whose text is the path within steps or tables."""
    return f"[{path.removeprefix('src/steps/').removeprefix('tests/reference/')}](../{path})"


def line(row: dict[str, Any], captions: dict[str, dict], rules: dict[str, dict]) -> str:
    """Return the line of a claim: a row of a table of Markdown."""
    values = f" (printed {row['printed']} {row['unit']}" if row["shown"] else ""
    values = f"{values.rstrip()}, computed {row['shown']})" if values else ""
    figures = [f"figures/{name}.py" for name, one in captions.items() if row["id"] in one["claims"]]
    scripts = [rules[row["rule"]]["script"], *figures] if row["rule"] else []
    cells = (
        f"`{row['id']}`, {row['where']}. {row['statement']}{values}",
        row["verdict"] + (" (our copy differs)" if row["differs"] else ""),
        " ".join(link(path) for path in scripts),
    )
    return (
        "| " + " | ".join(cell.replace("|", "&#124;").replace("\n", " ") for cell in cells) + " |"
    )


def reason(row: dict[str, Any]) -> str:
    """Return the paragraph of a claim that is not plainly confirmed: condition and remark."""
    condition = f" True if {row['condition']}." if row.get("condition") else ""
    return f"**`{row['id']}`** ({row['verdict']}).{condition} {row['remark']}".rstrip() + "\n"


def page(rows: list[dict[str, Any]], captions: dict[str, dict], rules: dict[str, dict]) -> str:
    """Return the page: the paper's claims, ours, tables, discrepancies."""
    text = [HEAD]
    for part in dict.fromkeys(row["part"] for row in rows):
        own = [row for row in rows if row["part"] == part]
        text += [
            f"## {TITLES[part]}\n",
            counted(own) + ".\n",
            "| claim | verdict | script and figures |",
            "|---|---|---|",
            *(line(row, captions, rules) for row in own),
            "",
            *(reason(row) for row in own if row["verdict"] != "confirmed"),
        ]
    text += ["## Published tables of each script\n"]
    text += [
        f"- {link(rules[name]['script'])}: "
        + ", ".join(link(f"tests/reference/{Path(path).name}") for path in rules[name]["tables"])
        for name in dict.fromkeys(row["rule"] for row in rows if row["rule"])
    ]
    text += ["\n## Places where our copy differs\n"]
    text += [
        f"- {row['where']} (`{row['id']}`), {row['differs']}. {row['remark']}"
        for row in rows
        if row["differs"]
    ]
    return "\n".join(text) + "\n"


if __name__ == "__main__":
    with log_to(snakemake.log[0]):
        claims = json.loads(Path(snakemake.input.claims).read_text("utf-8"))
        text = page(claims, read_yaml(snakemake.input.captions), snakemake.params.rules)
        write(snakemake, {snakemake.output[0]: text})
