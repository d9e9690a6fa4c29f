"""The numbers of this study in the README."""

from pathlib import Path

from replication.judging.findings import read_findings
from steps.shared.published import Numbers


def of_mechanism(reference: Path) -> list[str]:
    apart = read_findings(reference / "findings" / "mechanism_equivalence.json")
    shares = (apart["share_apart"].value, apart["identical_response"]["largest_share_apart"])
    return [f"{100 * share:.1f}" for share in shares]


HEADLINES: dict[str, Numbers] = {
    "The mechanism requires friction, and contacts without rebound": of_mechanism
}
