"""What the HTML report opens on: the README's picture and the verdicts, before any rule."""

import re
from base64 import encodebytes
from mimetypes import guess_type
from pathlib import Path

from replication.inputs.strict_yaml import read_yaml
from replication.judging.claim import JudgedClaim
from replication.judging.ledger import read_judged
from replication.judging.verdicts import by_origin
from replication.pages.captions import escaped, verdict

TITLES = {"qualified": "On a condition", "misprint": "Misprints", "refuted": "Refuted"}
"""The verdicts whose claims come first, and their headings."""


def opening(root: Path = Path()) -> dict[str, list[str]]:
    """Return headings with their lines, in reStructuredText, from CITATION.cff and results/."""
    cited = read_yaml(root / "CITATION.cff")
    rows = read_judged(root / "results" / "claims.json")
    start = "Figures and their claims are in the menu on the left, by subject."
    told = {
        title: [_line(row) for row in rows if row.verdict == of] for of, title in TITLES.items()
    }
    return {
        escaped(cited["title"]): [
            escaped(f"{cited.get('abstract', '')} {start}"),
            *_pictures(root),
        ],
        "Verdicts": [
            escaped(f"{name}: {verdict(found)}") for name, found in by_origin(rows).items()
        ],
        **{title: lines for title, lines in told.items() if lines},
    }


def _pictures(root: Path) -> list[str]:
    """Return the pictures of the README, within the page; docutils refuses long lines."""
    shown = re.findall(r"!\[(.*?)\]\((?!http)(.+?)\)", (root / "README.md").read_text("utf-8"))
    made = []
    for alt, path in shown:
        lines = encodebytes((root / path).read_bytes()).decode().splitlines()
        start = f".. image:: data:{guess_type(path)[0]};base64,"
        made.append("\n     ".join([start, *lines, f":alt: {escaped(alt)}"]))
    return made


def _line(row: JudgedClaim) -> str:
    condition = f"On condition: {row.condition}." if row.condition else ""
    return escaped(f"{row.statement} ({row.where}) {condition} {row.remark}")
