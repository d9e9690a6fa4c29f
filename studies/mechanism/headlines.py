"""The numbers of this study in the README."""

from pathlib import Path

from steps.shared.published import Numbers, computed


def of_mechanism(reference: Path) -> list[str]:
    return [f"{100 * computed(reference)['mechanism_share_apart']:.1f}"]


HEADLINES: dict[str, Numbers] = {
    "The mechanism requires friction, and contacts without rebound": of_mechanism
}
