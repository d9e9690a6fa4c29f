"""The numbers of this study in the README."""

import json
from pathlib import Path

from steps.shared.published import Numbers


def of_mechanism(reference: Path) -> list[str]:
    path = reference / "findings" / "mechanism_equivalence.json"
    found = json.loads(path.read_text(encoding="utf-8"))
    mean, most = found["share_apart"]["value"], found["identical_response"]["largest_share_apart"]
    return [f"{100 * share:.1f}" for share in (mean, most)]


HEADLINES: dict[str, Numbers] = {
    "The mechanism requires friction, and contacts without rebound": of_mechanism
}
